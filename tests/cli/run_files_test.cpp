// The files that clothlab run writes and reads: rows, meshes, states.
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/simulation.h"
#include "support/effort.h"
#include "support/run.h"

using namespace clothlab;
using namespace clothlab::test;
using nlohmann::ordered_json;

TEST_CASE("run --csv writes every point of every frame, with digits that read back as the same bits", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), file = (folder / "out.csv").string();
    for (const std::string precision : {"single", "double"}) {
        const std::string set = "simulation.precision=" + precision;
        run(scene, {"--frames", "3", "--csv", file, "--set", set});
        const auto rows = read_csv(read_file(file));
        REQUIRE(rows.size() == 4 * 42);
        sim::Description description = scene::load_scene(scene).simulation;
        description.stepping.precision =
            precision == "single" ? sim::Precision::single_precision : sim::Precision::double_precision;
        const auto simulation = sim::Simulation::create(description);
        for (std::size_t n = 0; n < rows.size(); ++n) {
            if (n > 0 && n % 42 == 0)
                simulation->step_frame();
            REQUIRE(rows[n].frame == n / 42);
            REQUIRE(rows[n].index == n % 42);
            const sim::Vec3 p = simulation->position(rows[n].index);
            for (const auto& [read, exact] :
                 {std::pair{rows[n].position[0], p.x}, {rows[n].position[1], p.y}, {rows[n].position[2], p.z}}) {
                if (precision == "single")
                    REQUIRE(std::bit_cast<std::uint32_t>(static_cast<float>(read)) ==
                            std::bit_cast<std::uint32_t>(static_cast<float>(exact)));
                else
                    REQUIRE(std::bit_cast<std::uint64_t>(read) == std::bit_cast<std::uint64_t>(exact));
            }
        }
        REQUIRE(run(scene, {"--frames", "3", "--csv", "-", "--set", set}) == read_file(file));
    }
}

TEST_CASE("run --every writes frame 0 and every Nth after it", "[program]") {
    const TemporaryFolder folder;
    const auto rows = read_csv(run(small_scene(folder), {"--frames", "10", "--csv", "-", "--every", "4"}));
    REQUIRE(rows.size() == 3 * 42);
    for (std::size_t n = 0; n < 3; ++n)
        REQUIRE(rows[42 * n].frame == 4 * n);
}

TEST_CASE("A run saved after 5 frames and resumed for 5 ends as one of 10, files included", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), state = (folder / "half.state").string();
    for (const std::string set : {"simulation.precision=single", "simulation.precision=double"}) {
        run(scene, {"--frames", "5", "--state", state, "--set", set});
        REQUIRE(run(scene, {"--frames", "5", "--resume", state, "--hash", "--set", set}) ==
                run(scene, {"--frames", "10", "--hash", "--set", set}));
        const auto rows = read_csv(run(scene, {"--frames", "1", "--resume", state, "--csv", "-", "--set", set}));
        REQUIRE(rows.front().frame == 5); // the rows go on where they stopped
        REQUIRE(rows.back().frame == 6);
        const ordered_json json =
            ordered_json::parse(run(scene, {"--frames", "5", "--resume", state, "--json", "--set", set}));
        REQUIRE(json["steps"] == 20);
        REQUIRE(std::abs(json["simulated_s"].get<double>() - 10 / 90.0) < 1e-6);
    }
}

TEST_CASE("A damaged, foreign or missing state is refused with its file and nothing on standard output", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), state = (folder / "half.state").string();
    run(scene, {"--frames", "2", "--state", state});
    std::string bytes = read_file(state);
    const auto require_refused = [&](const std::string& file, const std::vector<std::string>& rest = {}) {
        std::vector<std::string> all{"--frames", "1", "--hash", "--resume", file};
        all.insert(all.end(), rest.begin(), rest.end());
        const Finished finished = clothlab::test::clothlab(arguments(scene, all));
        INFO(finished.err);
        REQUIRE(finished.status == 2);
        REQUIRE(finished.out.empty());
        REQUIRE(finished.err.find(file + ": ") != std::string::npos);
    };
    require_refused(state, {"--set", "simulation.precision=double"});
    require_refused(state, {"--set", "cloth.num_width_points=8"});
    bytes[bytes.size() / 2] ^= 1;
    write_file(state, bytes);
    require_refused(state);
    write_file(state, bytes.substr(0, 20));
    require_refused(state);
    require_refused(scene);
    require_refused((folder / "missing").string());
    require_refused(folder.path().string());
}

TEST_CASE("The largest cloth's state can be resumed as well", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), state = (folder / "large.state").string();
    const std::vector<std::string> large{
        "--set", "cloth.num_width_points=2048", "--set",    "cloth.num_height_points=700",
        "--set", "simulation.precision=double", "--frames", "0"};
    auto with = large;
    with.insert(with.end(), {"--hash", "--state", state});
    const std::string hash = run(scene, with);
    REQUIRE(std::filesystem::file_size(state) > (64u << 20)); // more than any scene file may have
    with = large;
    with.insert(with.end(), {"--hash", "--resume", state});
    REQUIRE(run(scene, with) == hash);
}

TEST_CASE("run --obj writes the mesh: vertices, texture coordinates and triangles that refer to them", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), file = (folder / "cloth.obj").string();
    run(scene, {"--frames", "2", "--obj", file});
    const auto simulation = sim::Simulation::create(scene::load_scene(scene).simulation);
    simulation->step_frame();
    simulation->step_frame();
    std::istringstream lines(read_file(file));
    std::string line;
    std::size_t vertices = 0, coordinates = 0, faces = 0;
    while (std::getline(lines, line)) {
        std::array<double, 3> v{};
        std::array<std::size_t, 6> f{};
        if (line.rfind("v ", 0) == 0) {
            REQUIRE(std::sscanf(line.c_str(), "v %lf %lf %lf", &v[0], &v[1], &v[2]) == 3);
            const sim::Vec3 p = simulation->position(vertices++);
            REQUIRE((float(v[0]) == float(p.x) && float(v[1]) == float(p.y) && float(v[2]) == float(p.z)));
        } else if (line.rfind("vt ", 0) == 0) {
            REQUIRE(std::sscanf(line.c_str(), "vt %lf %lf", &v[0], &v[1]) == 2);
            REQUIRE((v[0] >= 0 && v[0] <= 1 && v[1] >= 0 && v[1] <= 1));
            ++coordinates;
        } else if (line.rfind("f ", 0) == 0) {
            REQUIRE(std::sscanf(line.c_str(), "f %zu/%zu %zu/%zu %zu/%zu", &f[0], &f[1], &f[2], &f[3], &f[4], &f[5]) ==
                    6);
            for (const std::size_t index : f)
                REQUIRE((index >= 1 && index <= 42));
            REQUIRE((f[0] == f[1] && f[2] == f[3] && f[4] == f[5]));
            REQUIRE((f[0] != f[2] && f[2] != f[4] && f[4] != f[0]));
            ++faces;
        } else {
            REQUIRE((line[0] == '#' || line[0] == 'o'));
        }
    }
    REQUIRE(vertices == 42);
    REQUIRE(coordinates == 42);
    REQUIRE(faces == 2 * 6 * 5);
}

TEST_CASE("The command line meets the supplied trajectory of pinned cloth within 1e-9 m at frame 10", "[program]") {
    const TemporaryFolder folder;
    const std::string csv = (folder / "out.csv").string();
    const int frames = sanitized ? 10 : 90;
    // That program spaces 50 points by 1/50 m.
    run(pinned2, {"--frames", std::to_string(frames), "--csv", csv, "--set", "simulation.precision=double", "--set",
                  "cloth.width=0.98", "--set", "cloth.height=0.98", "--set", "cloth.density=156.1849229487713", "--set",
                  "cloth.thickness=1e-9"});
    const auto rows = read_csv(read_file(csv));
    REQUIRE(rows.size() == 2500 * static_cast<std::size_t>(frames + 1));
    std::istringstream reference(read_file(checkout() / "tests/data/cs184-pinned2.txt"));
    std::size_t frame = 0, index = 0, compared = 0;
    std::array<double, 3> p{};
    double worst = 0;
    while (reference >> frame >> index >> p[0] >> p[1] >> p[2]) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            worst = std::max(worst, std::abs(rows[2500 * frame + index].position[axis] - p[axis]));
        compared += frame == 10;
    }
    REQUIRE(compared == 834);
    REQUIRE(worst < 1e-9);
}

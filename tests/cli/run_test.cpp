// clothlab run, as a program: its numbers are those of the library.
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/simulation.h"
#include "support/run.h"

using namespace clothlab;
using namespace clothlab::test;
using nlohmann::ordered_json;

TEST_CASE("run --hash prints the 16 hex digits of the library's hash, for any number of threads",
          "[program][threads]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const auto simulation = sim::Simulation::create(scene::load_scene(scene).simulation);
    for (int n = 0; n < 5; ++n)
        simulation->step_frame();
    std::array<char, 20> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx\n", static_cast<unsigned long long>(simulation->hash()));
    for (const char* threads : {"1", "1", "2", "4"})
        REQUIRE(run(scene, {"--frames", "5", "--hash", "--threads", threads}) == digits.data());
    REQUIRE(run(scene, {"--frames", "5", "--hash", "--set", "simulation.seed=1"}) != digits.data());
    REQUIRE(run(scene, {"--frames", "6", "--hash"}) != digits.data());
}

TEST_CASE("run --json prints one object with the documented keys and consistent values", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const ordered_json json =
        ordered_json::parse(run(scene, {"--frames", "5", "--json", "--set", "simulation.precision=double"}));
    const auto keys = [](const ordered_json& object) {
        std::vector<std::string> names;
        for (const auto& [name, value] : object.items())
            names.push_back(name);
        return names;
    };
    REQUIRE(keys(json) == std::vector<std::string>{"scene",        "name",       "integrator",  "precision",
                                                   "instructions", "threads",    "frames",      "steps",
                                                   "simulated_s",  "wall_s",     "steps_per_s", "stage_s",
                                                   "energy_J",     "max_strain", "rms_speed",   "intersections",
                                                   "status",       "cause",      "stability",   "hash"});
    REQUIRE(keys(json["stability"]) == std::vector<std::string>{"omega", "omega_bound", "omega_dt", "limit", "dt_max_s",
                                                                "ks_max", "density_min", "substeps_min"});
    REQUIRE(keys(json["energy_J"]) == std::vector<std::string>{"kinetic", "spring", "gravity", "total"});
    REQUIRE(json["scene"] == scene);
    REQUIRE(json["name"] == "Small");
    REQUIRE(json["integrator"] == "course-verlet");
    REQUIRE(json["precision"] == "double");
    REQUIRE(json["frames"] == 5);
    REQUIRE(json["steps"] == 20);
    REQUIRE(std::abs(json["simulated_s"].get<double>() - 5 / 90.0) < 1e-12);
    REQUIRE(json["status"] == "ok");
    REQUIRE(json["cause"] == "");
    REQUIRE_FALSE(json["stage_s"].empty());
    double stages = 0;
    for (const auto& [name, seconds] : json["stage_s"].items()) {
        REQUIRE(seconds.get<double>() >= 0);
        stages += seconds.get<double>();
    }
    REQUIRE(stages <= json["wall_s"].get<double>());

    sim::Description description = scene::load_scene(scene).simulation;
    description.stepping.precision = sim::Precision::double_precision;
    const auto simulation = sim::Simulation::create(description);
    for (int n = 0; n < 5; ++n)
        simulation->step_frame();
    const sim::Diagnostics d = simulation->diagnose();
    REQUIRE(json["energy_J"]["kinetic"] == d.energy.kinetic);
    REQUIRE(json["energy_J"]["spring"] == d.energy.spring);
    REQUIRE(json["energy_J"]["gravity"] == d.energy.gravity);
    REQUIRE(json["energy_J"]["total"] == d.energy.total());
    const sim::StabilityMargin margin = simulation->stability();
    REQUIRE(json["stability"]["omega"] == margin.omega);
    REQUIRE(json["stability"]["omega_dt"] == margin.omega_dt);
    REQUIRE(json["stability"]["dt_max_s"] == margin.dt_max);
    REQUIRE(json["stability"]["substeps_min"] == margin.substeps_min);
    REQUIRE(json["max_strain"] == d.max_strain);
    REQUIRE(json["rms_speed"] == d.rms_speed);
    REQUIRE(json["hash"].get<std::string>() + "\n" ==
            run(scene, {"--frames", "5", "--hash", "--set", "simulation.precision=double"}));
}

TEST_CASE("run --seconds is rounded up to whole frames, and 0.1 s at 90 frames/s is 9 of them", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const auto frames = [&](const std::string& seconds) {
        return ordered_json::parse(run(scene, {"--seconds", seconds, "--json"}))["frames"].get<int>();
    };
    REQUIRE(frames("0.1") == 9);
    REQUIRE(frames("0.7") == 63);
    REQUIRE(frames("1.1") == 99); // the product is a little more
    REQUIRE(frames("0.101") == 10);
    REQUIRE(frames("0") == 0);
    REQUIRE(ordered_json::parse(run(scene, {"--json"}))["frames"] == 90); // without a word
}

TEST_CASE("run --frames 0 shows the start", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const ordered_json json = ordered_json::parse(run(scene, {"--frames", "0", "--json"}));
    REQUIRE(json["steps"] == 0);
    REQUIRE(json["simulated_s"] == 0);
    REQUIRE(json["energy_J"]["kinetic"] == 0);
    REQUIRE(read_csv(run(scene, {"--frames", "0", "--csv", "-"})).size() == 42);
}

TEST_CASE("A blow-up is a result: status diverged, with its cause and frame, and success", "[program]") {
    const ordered_json json = ordered_json::parse(
        run(pinned2, {"--frames", "3", "--json", "--set", "cloth.ks=1e9", "--set", "rules.limit=off"}));
    REQUIRE(json["status"] == "diverged");
    REQUIRE(json["cause"].get<std::string>().find("at 0.01111 s (frame 1) ") == 0);
    REQUIRE(json["cause"].get<std::string>().find("too stiff for 30 substeps") != std::string::npos);
    REQUIRE(json["steps"] == 90); // it is run to its end
    REQUIRE(json["intersections"].is_null());
    REQUIRE(json["stability"]["omega"].is_null()); // infinite
}

TEST_CASE("A jitter is a result too: the margin of what is left says why", "[program]") {
    const ordered_json json =
        ordered_json::parse(run(pinned2, {"--frames", "20", "--json", "--set", "cloth.ks=225000"}));
    REQUIRE(json["status"] == "jitter");
    REQUIRE(json["cause"].get<std::string>().find("ks 225 000 too stiff for 30 substeps") != std::string::npos);
    REQUIRE(json["intersections"].is_null());
    REQUIRE(json["stability"]["omega_dt"] > json["stability"]["limit"]);
    REQUIRE(json["stability"]["substeps_min"] > 30);
    REQUIRE(json["stability"]["ks_max"] < 225000);
}

TEST_CASE("A negative density runs, as in the course", "[program]") {
    const ordered_json json =
        ordered_json::parse(run(pinned2, {"--frames", "2", "--json", "--set", "cloth.density=-150"}));
    REQUIRE(json["steps"] == 60);
    REQUIRE(json["hash"].get<std::string>() + "\n" != run(pinned2, {"--frames", "2", "--hash"}));
}

TEST_CASE("A scene whose name is not UTF-8 runs, and its JSON is JSON", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = (folder / "caf\xe9.json").string();
    std::filesystem::copy_file(small_scene(folder), scene);
    const ordered_json json = ordered_json::parse(run(scene, {"--frames", "1", "--json"}));
    REQUIRE(json["scene"].get<std::string>().find("caf\uFFFD.json") != std::string::npos);
}

// Meshes of a range of frames, read back as other programs would.
#include "timeline/mesh_sequence.h"

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstring>
#include <sstream>

#include "sim/grid.h"
#include "support/recordings.h"
#include "timeline/reader.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

using Names = std::vector<std::string>;

Names names_in(const std::filesystem::path& folder) {
    Names names;
    for (const auto& file : files_of(folder))
        names.push_back(file.filename().string());
    return names;
}

timeline::Timeline played(const sim::Description& description, int frames) {
    timeline::Player player;
    player.start(description);
    for (int n = 0; n < frames * description.stepping.substeps; ++n)
        player.step();
    return player.timeline();
}

template <class T>
T take(std::istream& in) {
    T value{};
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    REQUIRE(in.good());
    return value;
}

std::string sentence_of(const timeline::Timeline& timeline, const timeline::MeshSequence& sequence) {
    try {
        timeline::write_meshes(timeline, sequence);
    } catch (const timeline::RecordingError& e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST_CASE("Each Nth frame of a range becomes a file that is called by its frame") {
    const TemporaryFolder folder;
    const timeline::Timeline timeline = played(recorded_cloth(4, 3), 9);
    timeline::MeshSequence sequence;
    sequence.folder = folder / "new" / "meshes";
    sequence.line = 1;
    sequence.frames = {2, 100};
    sequence.every = 3;
    double share = 0;
    const timeline::MeshesWritten written = timeline::write_meshes(timeline, sequence, {}, [&](double s) {
        REQUIRE(s > share);
        share = s;
        return true;
    });
    REQUIRE(written.files == 3);
    REQUIRE(written.missing == 0);
    REQUIRE(names_in(sequence.folder) == Names{"cloth_0002.obj", "cloth_0005.obj", "cloth_0008.obj"});
    timeline::Reader reader;
    reader.seek(timeline, {1, timeline.step_of_frame(1, 5)});
    REQUIRE(read_file(sequence.folder / "cloth_0005.obj") ==
            timeline::mesh_text(reader.simulation(), timeline::MeshFormat::obj, ", frame 5"));
}

TEST_CASE("A PLY file has positions to the bit, unit normals, texture coordinates and the grid's triangles") {
    for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
        const auto simulation = sim::Simulation::create(recorded_cloth(5, 4, precision));
        for (int n = 0; n < 30; ++n)
            simulation->step_frame();
        std::istringstream in(timeline::mesh_text(*simulation, timeline::MeshFormat::ply, "two\nlines"));
        const bool is_single = precision == sim::Precision::single_precision;
        const std::string real = is_single ? "float" : "double";
        const Names expected{"ply",
                             "format binary_little_endian 1.0",
                             "comment clothlab: two lines",
                             "element vertex 20",
                             "property " + real + " x",
                             "property " + real + " y",
                             "property " + real + " z",
                             "property float nx",
                             "property float ny",
                             "property float nz",
                             "property float s",
                             "property float t",
                             "element face 24",
                             "property list uchar int vertex_indices",
                             "end_header"};
        for (const std::string& line : expected) {
            std::string read;
            std::getline(in, read);
            REQUIRE(read == line);
        }
        std::vector<sim::Vec3> normals;
        for (std::size_t i = 0; i < simulation->points(); ++i) {
            sim::Vec3 p;
            for (double* x : {&p.x, &p.y, &p.z})
                *x = is_single ? static_cast<double>(take<float>(in)) : take<double>(in);
            REQUIRE(p == simulation->position(i));
            sim::Vec3& n = normals.emplace_back();
            for (double* x : {&n.x, &n.y, &n.z})
                *x = static_cast<double>(take<float>(in));
            REQUIRE(std::abs(std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z) - 1) < 1e-6);
            REQUIRE(take<float>(in) == static_cast<float>(static_cast<double>(i % 5) / 4));
            REQUIRE(take<float>(in) == static_cast<float>(static_cast<double>(i / 5) / 3));
        }
        sim::for_each_triangle(5, 4, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            REQUIRE(take<std::uint8_t>(in) == 3);
            for (const std::uint32_t corner : {a, b, c})
                REQUIRE(take<std::int32_t>(in) == static_cast<std::int32_t>(corner));
            const sim::Vec3 p = simulation->position(a), q = simulation->position(b), r = simulation->position(c);
            const sim::Vec3 e{q.x - p.x, q.y - p.y, q.z - p.z}, f{r.x - p.x, r.y - p.y, r.z - p.z};
            const sim::Vec3& n = normals[a]; // on the side that the triangle's corners go round
            REQUIRE(n.x * (e.y * f.z - e.z * f.y) + n.y * (e.z * f.x - e.x * f.z) + n.z * (e.x * f.y - e.y * f.x) > 0);
        });
        REQUIRE(in.peek() == std::char_traits<char>::eof());
    }
}

TEST_CASE("Frames that have been dropped are counted, and when none is left nothing is written") {
    const TemporaryFolder folder;
    timeline::Player player({.budget = 60'000, .seek_s = 0, .least_reach_s = 0});
    player.start(recorded_cloth(12, 12));
    for (int n = 0; n < 4 * 60; ++n)
        player.step();
    timeline::MeshSequence sequence;
    sequence.folder = folder.path();
    sequence.line = 1;
    sequence.frames = {0, 60};
    const timeline::MeshesWritten written = timeline::write_meshes(player.timeline(), sequence);
    REQUIRE(written.files == files_of(folder.path()).size());
    REQUIRE(written.files + written.missing == 61);
    REQUIRE(written.missing > 5);
    sequence.frames = {10, 12};
    REQUIRE(sentence_of(player.timeline(), sequence).find("none of the frames 10 to 12") != std::string::npos);
    sequence.frames = {70, 80};
    REQUIRE(sentence_of(player.timeline(), sequence).find("the last one of \"Run 1\" is 60") != std::string::npos);
}

TEST_CASE("An export ends where it is cancelled, with whole files, and says where it cannot write") {
    const TemporaryFolder folder;
    const timeline::Timeline timeline = played(recorded_cloth(4, 3), 9);
    timeline::MeshSequence sequence;
    sequence.folder = folder.path();
    sequence.line = 1;
    sequence.frames = {0, 9};
    int called = 0;
    REQUIRE_THROWS_AS(timeline::write_meshes(timeline, sequence, {}, [&](double) { return ++called < 4; }),
                      timeline::RecordingError);
    REQUIRE(names_in(folder.path()) == Names{"cloth_0000.obj", "cloth_0001.obj", "cloth_0002.obj", "cloth_0003.obj"});
    write_file(folder / "file", "");
    sequence.folder = folder / "file" / "below";
    REQUIRE(sentence_of(timeline, sequence).find((folder / "file" / "below").string() + ": ") == 0);
}

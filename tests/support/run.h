// Runs of scenes by the program.
#pragma once

#include <array>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstdio>
#include <sstream>

#include "scene/io.h"
#include "support/files.h"
#include "support/program.h"

namespace clothlab::test {

inline const std::string pinned2 = (checkout() / "tests/data/cs184-pinned2.json").string();

/// A small scene with a bit of everything, in a file of a folder.
inline std::string small_scene(const TemporaryFolder& folder) {
    scene::Scene scene;
    scene.name = "Small";
    sim::Description& d = scene.simulation;
    d.cloth.num_width_points = 7;
    d.cloth.num_height_points = 6;
    d.cloth.pinned = {{0, 0}};
    d.cloth.orientation = sim::Orientation::vertical;
    d.colliders = {sim::Sphere{{0.5, 0.4, 0.1}, 0.2, 0.2}};
    d.stepping.substeps = 4;
    const auto file = folder / "small.json";
    scene::save_scene(scene, file);
    return file.string();
}

inline std::vector<std::string> arguments(const std::string& scene, const std::vector<std::string>& rest) {
    std::vector<std::string> all{"run", scene};
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

/// Standard output of a run that succeeds and has nothing to say on standard error.
inline std::string run(const std::string& scene, const std::vector<std::string>& rest) {
    const Finished finished = clothlab::test::clothlab(arguments(scene, rest));
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    REQUIRE(finished.err.empty());
    return finished.out;
}

struct Row {
    std::uint64_t frame = 0;
    std::size_t index = 0;
    std::array<double, 3> position{};
};

inline std::vector<Row> read_csv(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    REQUIRE(std::getline(lines, line));
    REQUIRE(line == "frame,index,x,y,z");
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
        Row row;
        int used = 0;
        REQUIRE(std::sscanf(line.c_str(), "%lu,%zu,%lf,%lf,%lf%n", &row.frame, &row.index, &row.position[0],
                            &row.position[1], &row.position[2], &used) == 5);
        REQUIRE(static_cast<std::size_t>(used) == line.size());
        rows.push_back(row);
    }
    return rows;
}

} // namespace clothlab::test

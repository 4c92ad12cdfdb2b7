// Timelines to record, and what can be had of a recording.
#pragma once

#include <map>

#include "support/files.h"
#include "timeline/player.h"
#include "timeline/recording.h"

namespace clothlab::test {

inline constexpr auto single = sim::Precision::single_precision;

inline sim::Description recorded_cloth(int columns, int rows,
                                       sim::Precision precision = sim::Precision::single_precision) {
    sim::Description description;
    description.cloth.num_width_points = columns;
    description.cloth.num_height_points = rows;
    description.cloth.pinned = {{0, 0}};
    description.cloth.ks = 300;
    description.colliders = {sim::Sphere{{0.5, 0.9, 0.5}, 0.15, 0.3}};
    description.stepping.precision = precision;
    description.stepping.substeps = 4;
    return description;
}

/// A session with two runs, branches, changes within frames and at their ends, bookmarks and marks; each line ends
/// within a frame.
inline timeline::Recording busy_recording(int columns, int rows, sim::Precision precision,
                                          std::size_t budget = std::size_t{64} << 20) {
    timeline::Recording recording;
    recording.scene.name = "Busy";
    recording.scene.simulation = recorded_cloth(columns, rows, precision);
    timeline::Player player({.budget = budget});
    player.start(recording.scene.simulation);
    sim::Description changed = recording.scene.simulation;
    const auto steps = [&](int n) {
        while (n-- > 0)
            player.step();
    };
    const auto change = [&](double ks, int substeps) {
        changed.cloth.ks = ks;
        changed.stepping.substeps = substeps;
        player.change(changed);
    };
    change(280, 4);
    steps(14);
    change(250, 5);
    steps(9);
    player.bookmark("half-way", scene::Camera{});
    steps(20);
    player.seek(17);
    change(400, 3);
    steps(10);
    player.seek(20);
    change(500, 3);
    steps(8);
    player.bookmark("a later one", {});
    changed.cloth.density = 200;
    player.start(changed);
    steps(11);
    player.seek(6);
    recording.timeline = player.timeline();
    recording.at = player.moment();
    return recording;
}

/// The hash of the state at every reachable step of a branch's own part.
inline std::map<std::uint64_t, std::uint64_t> hashes_of(const timeline::Timeline& timeline, timeline::BranchId id) {
    std::map<std::uint64_t, std::uint64_t> hashes;
    timeline::Reader reader;
    const timeline::Branch& branch = *timeline.find(id);
    for (std::uint64_t step = branch.fork_step; step <= branch.end; ++step)
        if (timeline.reachable({id, step})) {
            reader.seek(timeline, {id, step});
            hashes[step] = reader.simulation().hash();
        }
    return hashes;
}

} // namespace clothlab::test

// A run with two futures, for comparing them.
#pragma once

#include "timeline/player.h"

namespace clothlab::test {

struct Branches {
    sim::Description description, softer;
    timeline::Player player;
    timeline::BranchId stiff = 0, soft = 0;

    /// A small cloth on two pins, 4 steps a frame, played for `frames`; from frame `fork` on, for `more` frames in all,
    /// with its ks times `share`, and in `substeps` per frame.
    Branches(int frames, int fork, double share, int more, int substeps = 4) {
        description.cloth.num_width_points = 7;
        description.cloth.num_height_points = 6;
        description.cloth.pinned = {{0, 0}, {6, 0}};
        description.cloth.ks = 2000;
        description.stepping.substeps = 4;
        description.stepping.integrator = sim::IntegratorId::velocity_verlet; // keeps its speed whatever the step
        softer = description;
        softer.cloth.ks *= share;
        softer.stepping.substeps = substeps;
        player.start(description);
        play(frames);
        stiff = player.line();
        player.seek(4 * static_cast<std::uint64_t>(fork));
        player.change(softer);
        soft = player.line();
        play(more - fork);
    }

    void play(int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            const std::uint64_t now = player.simulation().frame();
            while (player.simulation().frame() == now)
                player.step();
        }
    }

    /// So that states can be dropped from it one by one.
    static void store_every_frame(timeline::Timeline& timeline, timeline::BranchId line) {
        timeline::Reader reader;
        const std::uint64_t end = timeline.find(line)->end;
        for (std::uint64_t step = timeline.find(line)->fork_step; step <= end; ++step) {
            reader.seek(timeline, {line, step});
            if (reader.simulation().substep() != 0)
                continue;
            timeline.store(line, {step, step, reader.description(),
                                  timeline::keep_in_memory(timeline::compress_state(reader.simulation().save_state())),
                                  false});
        }
    }
};

} // namespace clothlab::test

// What the simulation's thread has to show.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/snapshot.h"
#include "sim/step_trace.h"
#include "timeline/overview.h"

namespace clothlab::app {

struct Published {
    std::shared_ptr<const sim::Snapshot> snapshot; ///< none before the first scene has been built
    std::uint64_t run = 0;                         ///< counts the starts: which start the snapshot belongs to
    bool playing = false;
    bool backwards = false;      ///< playing goes towards the start
    double real_time_factor = 0; ///< simulated seconds per second, over the last half second of playing; 0 when unknown
    std::string error;           ///< why the last start or change was refused; empty when it was not

    timeline::DescriptionPtr description; ///< in force at the snapshot: it may have changed by a seek
    timeline::Playhead playhead;
    std::shared_ptr<const timeline::Overview> overview; ///< may be a few frames behind while the run goes on
    std::optional<std::size_t> hit;                     ///< the breakpoint that paused, until the run goes on
    std::shared_ptr<const sim::Snapshot> ghost;         ///< of the branch to compare with, at the same time
    std::shared_ptr<const sim::StepTrace> trace;        ///< of the next step, while it is wanted and the run is paused

    std::uint64_t taken = 0; ///< tickets up to this one had been taken up when this was published
    std::uint64_t done = 0;  ///< tickets up to this one have been done, or ended by trouble or a newer command
};

} // namespace clothlab::app

// What the panels of the timeline show, and what they ask the app for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/step_trace.h"
#include "timeline/breakpoints.h"
#include "timeline/comparison.h"
#include "timeline/mesh_sequence.h"
#include "timeline/overview.h"

namespace clothlab::ui {

// What panels ask for. All of it but playing pauses.
struct PlayBackwards {};
struct StepBack {
    bool frame = true; ///< to the last frame's end before; otherwise one substep
};
struct JumpToStart {};
struct JumpToEnd {};
/// A step of the line shown, or the nearest one in the cache; asked for in every frame while the playhead is dragged.
struct SeekStep {
    std::uint64_t step = 0;
};
struct GoToMoment {
    timeline::Moment moment;
    std::optional<scene::Camera> camera; ///< to fly to
};
/// Playing goes round in this range of frames of the line; none: to the end and on.
struct SetLoop {
    std::optional<timeline::FrameRange> range;
};
struct SwitchBranch {
    timeline::BranchId branch = 0;
};
struct RenameBranch {
    timeline::BranchId branch = 0;
    std::string name;
};
struct RemoveBranch {
    timeline::BranchId branch = 0;
};
/// Draws this branch over the one shown; 0: none.
struct ShowGhost {
    timeline::BranchId branch = 0;
};
/// Of the present moment, with the present camera.
struct AddBookmark {
    std::string name; ///< empty: one is made up
};
struct RenameBookmark {
    std::uint32_t bookmark = 0;
    std::string name;
};
struct RemoveBookmark {
    std::uint32_t bookmark = 0;
};
struct SetBreakpoints {
    std::vector<timeline::Breakpoint> breakpoints;
};
struct SetCacheBudget {
    std::size_t bytes = 0;
    double least_reach_s = 0; ///< timeline::CacheOptions, as what follows
    std::size_t disk = 0;
};
/// Whether the lab looks into the next step (TimelineWork::trace).
struct InspectStep {
    bool on = false;
};
struct SaveRecording {
    std::filesystem::path file;
    bool replace = false; ///< a file that is there already
};
struct CancelSaving {};
/// One file for each frame of a range of the line shown.
struct ExportMeshes {
    std::filesystem::path folder;
    timeline::MeshFormat format = timeline::MeshFormat::obj;
    timeline::FrameRange frames;
    int every = 1;
};
using TimelineRequest =
    std::variant<PlayBackwards, StepBack, JumpToStart, JumpToEnd, SeekStep, GoToMoment, SetLoop, SwitchBranch,
                 RenameBranch, RemoveBranch, ShowGhost, AddBookmark, RenameBookmark, RemoveBookmark, SetBreakpoints,
                 SetCacheBudget, InspectStep, SaveRecording, CancelSaving, ExportMeshes>;

/// Filled in by the app, but for what is said to be the panels' own.
struct TimelineWork {
    std::shared_ptr<const timeline::Overview> overview; ///< none before the first
    timeline::Playhead playhead;
    bool backwards = false; ///< plays towards the start
    std::optional<timeline::FrameRange> loop;

    timeline::BranchId ghost = 0;                        ///< the branch that is drawn over the one shown; 0: none
    std::shared_ptr<const sim::Snapshot> ghost_snapshot; ///< at the playhead; none where the ghost has nothing so late
    std::optional<timeline::Distance> ghost_distance;    ///< at the playhead; none where the ghost has nothing so late
    std::shared_ptr<const std::vector<timeline::DistanceSample>> ghost_curve; ///< as far as it has been computed
    double ghost_progress = 0;                                                ///< of the curve, 0 to 1

    std::vector<timeline::Breakpoint> breakpoints;
    std::optional<std::size_t> hit; ///< the breakpoint that paused, until the run goes on

    /// The inside of the step after the playhead, while somebody looks at it (InspectStep).
    std::shared_ptr<const sim::StepTrace> trace;
    // The step panel's own: what the viewport shows of the trace.
    int stage = -1;                      ///< of sim::Stage; -1: the state before the step
    std::optional<std::uint32_t> picked; ///< the point whose arrow alone is drawn; none: all points'
    float arrow_scale = 1;               ///< drawn length / real length of displacements
    bool fit_arrows = true;              ///< arrow_scale follows from the stage's longest arrow
    bool inspecting = false;             ///< InspectStep was asked for last

    struct Job {
        std::string what; ///< "Saving fold.clothrec"
        double share = 0; ///< done, 0 to 1
    };
    std::optional<Job> job; ///< saving or exporting, in the background; CancelSaving ends it
};

} // namespace clothlab::ui

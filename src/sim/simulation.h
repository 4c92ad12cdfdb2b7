// A run of a description: the one interface to single and double precision. What is virtual here is called per step,
// never per particle.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/description.h"
#include "sim/diagnostics.h"
#include "sim/execution.h"
#include "sim/monitor.h"
#include "sim/snapshot.h"
#include "sim/stability.h"
#include "sim/step.h"
#include "sim/step_trace.h"

namespace clothlab::sim {

class Simulation {
public:
    /// Starts a run at time 0. Throws std::invalid_argument for a description without meaning (see make_grid,
    /// make_model) and for an execution that this machine cannot give.
    static std::unique_ptr<Simulation> create(const Description& description, const Execution& execution = {});
    virtual ~Simulation() = default;

    /// Takes over another description between two steps; positions, velocities and time stay. Throws
    /// std::invalid_argument, and changes nothing, where can_change_live says no or the description has no meaning.
    virtual void change(const Description& description) = 0;
    const Description& description() const { return description_; }

    /// Takes one step; a frame's last one completes the frame.
    virtual StepCounts step() = 0;
    /// Takes so many steps, at least none; returns what they did in all. The same bits as so many calls of step(), in
    /// less time where several threads take steps that are nothing but springs (sim/slabs.h).
    virtual StepCounts advance(int steps) = 0;
    /// Looks into the step that step() would take now, without taking it: works on copies, so that nothing of the run
    /// changes, not even what it keeps to be faster. Takes memory for another run meanwhile, and, besides the step, as
    /// long as a few diagnoses: about 1 ms for 50 x 50 points.
    virtual StepTrace trace_step() const = 0;
    /// Steps to the end of the frame under way.
    void step_frame();

    virtual double time() const = 0; ///< s
    virtual std::uint64_t steps() const = 0;
    std::uint64_t frame() const { return frame_; }
    int substep() const { return substep_; }

    /// A point's position in m, exact in either precision.
    virtual Vec3 position(std::size_t point) const = 0;
    virtual std::size_t points() const = 0;
    virtual Diagnostics diagnose() const = 0;
    virtual Momentum momentum() const = 0;
    virtual std::uint64_t hash() const = 0;
    /// How far the present state is from the method's stability limit. Costs as much as some hundred steps.
    virtual StabilityMargin stability() const = 0;
    /// Fills a snapshot, reusing its memory.
    virtual void capture(Snapshot& snapshot, const SnapshotExtras& extras) const = 0;
    void capture(Snapshot& snapshot) const { capture(snapshot, SnapshotExtras{}); }

    /// Looks for trouble at the end of every frame from now on. Off at the start; does not change the run.
    virtual void watch(bool on) = 0;
    /// The first trouble since watching began or since the last change of the description or the state.
    virtual const std::optional<Trouble>& trouble() const = 0;

    /// The instruction set in use, and the threads that the steps use now.
    virtual InstructionSet instructions() const = 0;
    virtual int threads() const = 0;
    /// All memory that the run holds, in bytes: grid, model, state and workspace.
    virtual std::size_t memory_bytes() const = 0;

    /// Measures wall time per stage from now on; the sums start at zero.
    virtual void time_stages(bool on) = 0;
    virtual const StageSeconds& stage_seconds() const = 0;

    /// The state as bytes: magic, version, precision, grid, time, steps, frame, positions, previous positions,
    /// checksum.
    virtual std::vector<std::byte> save_state() const = 0;
    /// Goes on from such bytes, bit for bit. Throws std::invalid_argument, and changes nothing, when they are damaged
    /// or of another grid or precision.
    virtual void load_state(std::span<const std::byte> bytes) = 0;

protected:
    explicit Simulation(Description description) : description_(std::move(description)) {}
    void count_step();

    Description description_;
    std::uint64_t frame_ = 0;
    int substep_ = 0;
};

} // namespace clothlab::sim

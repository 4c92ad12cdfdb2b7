// Goes to any moment of a timeline, bit for bit: loads the state stored before it and takes the steps and makes the
// changes that lie between. It has a simulation of its own, so that many may read the same timeline, or copies of it,
// in other threads.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "sim/simulation.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {

class Reader {
public:
    explicit Reader(const sim::Execution& execution = {}) : execution_(execution) {}

    /// Throws std::out_of_range, and changes nothing, for a moment that is not reachable (Timeline::reachable);
    /// std::runtime_error when a stored state cannot be read.
    void seek(const Timeline& timeline, const Moment& moment);
    /// One step further on the line, with the changes that are made there. The timeline must know the step.
    sim::StepCounts step(const Timeline& timeline, BranchId line);

    bool has_simulation() const { return simulation_ != nullptr; }
    sim::Simulation& simulation() { return *simulation_; }
    const sim::Simulation& simulation() const { return *simulation_; }
    /// In force.
    const DescriptionPtr& description() const { return description_; }

    /// Bytes of states that are kept because the next step back will want them.
    std::size_t memory() const { return passed_bytes_; }

protected:
    /// The simulation at a state of a description; null: at its start.
    void take(const DescriptionPtr& description, const std::vector<std::byte>* state);
    void change(const DescriptionPtr& description);
    sim::Execution execution_;
    std::size_t most_passed_bytes_ = std::size_t{8} << 20;
    bool observed_ = false; ///< simulations are timed and watched for trouble
    std::unique_ptr<sim::Simulation> simulation_;
    DescriptionPtr description_;
    Moment at_; ///< by the branch that owns it; branch 0: unknown

private:
    // A state on the way of a seek, so that going back from there step by step does not replay the way each time.
    struct Passed {
        Moment moment; ///< by the branch that owns it
        DescriptionPtr description;
        std::vector<std::byte> state;
    };
    const Passed* passed_before(const Moment& moment, std::uint64_t from) const;
    void pass();
    /// Should the timeline not be the one it was, what is known of it may no longer be true.
    void check_revision(const Timeline& timeline);

    std::uint64_t revision_ = 0; ///< of the timeline that what is known is of
    std::deque<Passed> passed_;
    std::size_t passed_bytes_ = 0;
};

} // namespace clothlab::timeline

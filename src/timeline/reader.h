// Goes to any moment of a timeline, bit for bit: loads the state stored before it and takes the steps and makes the
// changes that lie between. It has a simulation of its own, so that many may read the same timeline, or copies of it,
// in other threads.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
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

    /// Bytes of states that are kept because the next step back will want them.
    std::size_t memory() const;
    void set_memory(std::size_t most) { most_ = most; }

protected:
    friend class Player;
    // A state of the last replay, so that going back through it does not replay it for each step.
    struct Passed {
        BranchId owner;
        std::uint64_t step;
        DescriptionPtr description;
        std::vector<std::byte> state;
    };
    void take(const DescriptionPtr& description, std::span<const std::byte> state);
    void make_changes(const Branch& owner);
    void pass(const Branch& owner, std::uint64_t target, std::uint64_t from);

    sim::Execution execution_;
    std::unique_ptr<sim::Simulation> simulation_;
    std::deque<Passed> passed_;
    std::size_t most_ = std::size_t{16} << 20;
};

} // namespace clothlab::timeline

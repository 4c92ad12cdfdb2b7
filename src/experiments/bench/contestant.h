// What the bench times: runs of one scene that can all be put into the same state.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "experiments/bench/textbook.h"
#include "sim/description.h"
#include "sim/execution.h"
#include "sim/state.h"
#include "sim/step.h"

namespace clothlab::experiments {

/// A state of a scene, for all contestants. In single and double precision the scene took the same number of steps.
struct Moment {
    std::array<std::vector<std::byte>, 2> saved; ///< by sim::Precision
    std::vector<sim::Vec3> position, last;       ///< m, of double precision: now and one step earlier
};

/// Takes a scene's first steps, at least one, as fast as this machine can. Single precision only if wanted.
Moment advance(const sim::Description& description, int steps, bool single_precision);

class Contestant {
public:
    virtual ~Contestant() = default;
    /// Goes on from a moment, with nothing remembered from steps that it took before.
    virtual void start_from(const Moment& moment) = 0;
    /// Takes so many steps, as a run without a picture does; returns what they did in all.
    virtual sim::StepCounts advance(int steps) = 0;
    virtual void time_stages() = 0; ///< from now on; the sums start at zero
    virtual const sim::StageSeconds& stage_seconds() const = 0;
    virtual std::size_t memory_bytes() const = 0;
    /// Whether what a step finds is used by later ones: then only a run of many steps tells what one costs.
    virtual bool remembers() const = 0;
};

std::unique_ptr<Contestant> make_contestant(const sim::Description& description, sim::Precision precision,
                                            const sim::Execution& execution);
std::unique_ptr<Contestant> make_textbook_contestant(const sim::Description& description, CellMap cells);

} // namespace clothlab::experiments

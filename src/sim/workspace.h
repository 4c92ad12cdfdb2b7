// What a step needs besides model and state: scratch memory, kernels and threads. Nothing in it is part of the state: a
// step reads only what it wrote itself, or what it can prove to be still true.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "sim/collision/self_collision_work.h"
#include "sim/execution.h"
#include "sim/kernels/kernels.h"
#include "sim/limit_bands.h"
#include "sim/model.h"
#include "sim/pace.h"
#include "sim/slabs.h"
#include "sim/state.h"
#include "sim/thread_choice.h"
#include "sim/thread_pool.h"

namespace clothlab::sim {

template <class Real>
struct Workspace {
    InstructionSet instructions = InstructionSet::scalar;
    const Kernels<Real>* kernels = nullptr; ///< null: plain loops
    std::unique_ptr<ThreadPool> pool;
    ThreadChoice choice;
    Pace pace;

    Vec3Array<Real> force;               ///< N; empty until something needs it
    std::vector<Vec3Array<Real>> arrays; ///< the method's, as many as it asks for
    /// Step after which arrays[0] holds the accelerations of the state, so that the next step need not compute them;
    /// 0: it does not.
    std::uint64_t force_of_step = 0;
    std::shared_ptr<void> solver;           ///< what a method builds in its first step for a model
    std::size_t solver_bytes = 0;           ///< that it holds
    Vec3Array<Real> before_stages;          ///< m; positions before contacts and limit, of methods with velocities
    std::vector<AlignedVector<Real>> sweep; ///< per thread
    Slabs<Real> slabs;                      ///< for steps that are nothing but the sweep
    std::vector<std::array<Real, 3>> pin_previous; ///< m, of the pins, while the points are moved
    std::size_t last_shortened = 1;                ///< springs that the last sweep shortened; any but 0 at first
    LimitBands<Real> bands;                        ///< of the stretch limit, where they may pay
    SelfCollisionWork<Real> self_collision;
    std::vector<ProximityArguments<Real>> proximity; ///< per thread
    std::vector<std::size_t> counts;                 ///< two per thread

    StageSeconds seconds{}; ///< summed up over all steps when timed
    bool timed = false;
};

/// Sizes the memory for steps of a model, so that they allocate none. To be called again after a change of the model.
template <class Real>
void prepare(const Model<Real>& model, Workspace<Real>& work);

/// All memory that a workspace holds.
template <class Real>
std::size_t memory_bytes(const Workspace<Real>& work);

/// Whether a stage takes as long for each point, so that who is done last tells the threads' paces.
enum class Effort : std::uint8_t { even, uneven };

/// The ranges of points that threads get: they begin at multiples of sweep_grain.
struct Shares {
    std::size_t points, count;
    Pace pace;
    /// Where range `index` begins; the last ends where the one behind it would begin.
    std::size_t from(std::size_t index) const {
        const std::size_t even = pace.from(index, count, points);
        return std::min((even + sweep_grain - 1) / sweep_grain * sweep_grain, points);
    }
};

/// As many ranges as the steps use threads now, but long enough for a sweep each.
template <class Real>
Shares shares(const Model<Real>& model, const Workspace<Real>& work) {
    const std::size_t points = model.grid->points();
    const std::size_t least = std::max<std::size_t>(4 * static_cast<std::size_t>(model.grid->columns), 4 * sweep_grain);
    const auto wanted = static_cast<std::size_t>(work.pool ? work.choice.threads() : 1);
    return {points, std::clamp<std::size_t>(points / least, 1, wanted), work.pace};
}

/// Calls task(index, begin, end) for ranges that cover all points, each on a thread. Returns how many there were.
template <class Real, class Task>
int for_ranges(const Model<Real>& model, Workspace<Real>& work, Task task, Effort effort = Effort::uneven) {
    const Shares all = shares(model, work);
    const int count = static_cast<int>(all.count);
    if (count == 1) {
        task(0, std::size_t{0}, all.points);
        return 1;
    }
    const auto range = [all, task](int index) {
        task(index, all.from(static_cast<std::size_t>(index)), all.from(static_cast<std::size_t>(index) + 1));
    };
    const bool others_were_last = work.pool->run(count, range);
    if (effort == Effort::even)
        work.pace.learn(others_were_last);
    return count;
}

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template void prepare<Real>(const Model<Real>&, Workspace<Real>&);                                          \
    extern template std::size_t memory_bytes<Real>(const Workspace<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim

// Many steps at once on several threads, where a step is nothing but the sweep over springs and points: each thread
// works on a copy of its own rows (its slab) from the first step to the last, and after each step only the two rows
// at a border go over to the thread beside it, in a message: the exchange of halos of distributed solvers (W. Gropp, E.
// Lusk, A. Skjellum, "Using MPI", section 4.2).
//
// Threads that sweep over one array fetch what another has written a line at a time, when they come to it, and take it
// away from the other again when they write beside it: at 50 x 50 points that is a quarter to a half of their time. A
// message is fetched at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/aligned.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

template <class Real>
struct Workspace;

/// One thread's points with those of two rows before and behind them, and the messages to the threads beside it.
template <class Real>
struct Slab {
    AlignedVector<Real> points;   ///< m; three axes of positions, then three of previous positions
    AlignedVector<Real> messages; ///< m; to the thread before and the one behind, two of each, which take turns
};

/// How far a thread is, on a cache line of its own, and the one that is fetched with it.
struct alignas(128) SlabClock {
    std::atomic<std::uint64_t> sent{0}; ///< messages to each side
    /// How often since the first step it had to wait for messages from the thread before it; the first thread, from
    /// the one behind it.
    int waited = 0;
};

template <class Real>
struct Slabs {
    std::vector<Slab<Real>> of; ///< per thread; none where they are not used
    std::vector<SlabClock> clocks;
    std::uint64_t sent = 0; ///< messages of each thread to each side until now

    std::size_t bytes() const;
};

/// Steps that are worth to be taken in slabs at once: the points are copied before the first and after the last.
inline constexpr int least_slab_steps = 4;
/// So many at the most: then it is seen whether the threads are held up.
inline constexpr int most_slab_steps = 32;

/// Makes the memory for a model whose steps can be taken in slabs, and none for another. So that memory is not doubled
/// where much is needed, cloths of more than 2^19 points do without.
template <class Real>
void make_slabs(const Model<Real>& model, Workspace<Real>& work);

/// Whether the next steps can be taken in slabs: no stage but the sweep, slabs made, more than one thread in use.
template <class Real>
bool can_step_in_slabs(const Model<Real>& model, const Workspace<Real>& work);

/// Takes so many steps, from least_slab_steps to most_slab_steps, with the bits of as many calls of step(). Only where
/// can_step_in_slabs().
template <class Real>
void step_in_slabs(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, int steps);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template struct Slabs<Real>;                                                                                \
    extern template void make_slabs<Real>(const Model<Real>&, Workspace<Real>&);                                       \
    extern template bool can_step_in_slabs<Real>(const Model<Real>&, const Workspace<Real>&);                          \
    extern template void step_in_slabs<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&, int);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim

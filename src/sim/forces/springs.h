// Linear springs: force k (|d| - rest) along d, energy k/2 (|d| - rest)².
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Adds the force of every enabled spring to both of its ends, in N, in spring order. A spring of length zero has no
/// direction and pulls nowhere.
template <class Real>
void add_spring_forces(const Model<Real>& model, const Vec3Array<Real>& position, Vec3Array<Real>& force);

/// The energy of all enabled springs in J, summed in double precision.
template <class Real>
double spring_energy(const Model<Real>& model, const Vec3Array<Real>& position);

/// Whether sweep_springs can do what set_gravity_forces and add_spring_forces do.
template <class Real>
bool can_sweep(const Model<Real>& model, const Workspace<Real>& work);

/// A kernel for the springs of a model, and what it is called with but for points, a range of them and scratch memory.
template <class Real>
struct SweepKernel {
    void (*sweep)(const SweepArguments<Real>&);
    SweepArguments<Real> arguments;
};
template <class Real>
SweepKernel<Real> sweep_kernel(const Model<Real>& model, const Workspace<Real>& work, SweepSink sink);

/// What moves the points of a model by course Verlet in a sweep.
template <class Real>
SweepSink verlet_sink(const Model<Real>& model) {
    return model.keep == 1 ? SweepSink::verlet : SweepSink::verlet_damped;
}

/// Gravity and springs by the kernels, to the same bits: writes the forces to `out`, or, with one of the Verlet sinks,
/// moves the points of `position`, whose previous positions are in `out`, and writes where they go to `out`, pinned or
/// not.
template <class Real>
void sweep_springs(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work, SweepSink sink,
                   Vec3Array<Real>& out);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template void add_spring_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, Vec3Array<Real>&);        \
    extern template double spring_energy<Real>(const Model<Real>&, const Vec3Array<Real>&);                            \
    extern template bool can_sweep<Real>(const Model<Real>&, const Workspace<Real>&);                                  \
    extern template SweepKernel<Real> sweep_kernel<Real>(const Model<Real>&, const Workspace<Real>&, SweepSink);       \
    extern template void sweep_springs<Real>(const Model<Real>&, const Vec3Array<Real>&, Workspace<Real>&, SweepSink,  \
                                             Vec3Array<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim

#include "sim/workspace.h"

#include "sim/collision/self_collision.h"
#include "sim/integrators/integrator.h"

namespace clothlab::sim {
namespace {

template <class T, class Allocator>
std::size_t bytes_of(const std::vector<T, Allocator>& v) {
    return v.capacity() * sizeof(T);
}

} // namespace

template <class Real>
void prepare(const Model<Real>& model, Workspace<Real>& work) {
    const std::size_t points = model.grid->points();
    const auto threads = static_cast<std::size_t>(work.pool ? work.pool->threads() : 1);
    if (!work.kernels || model.wind.kind != WindKind::none)
        work.force.resize(points);
    if (work.kernels) {
        work.sweep.resize(threads);
        for (AlignedVector<Real>& scratch : work.sweep)
            scratch.resize(sweep_scratch(static_cast<std::size_t>(model.grid->columns)));
        work.pin_previous.resize(model.pins.size());
        work.proximity.resize(threads);
        work.counts.resize(2 * threads);
        make_slabs(model, work);
        if (model.rules.limit == LimitRule::cs184)
            make_bands(model, work.bands);
    }
    if (model.rules.self_collision != SelfCollisionRule::none)
        prepare_self_collision(model, work);
    const IntegratorTraits& method = traits(model.integrator);
    work.arrays.resize(static_cast<std::size_t>(method.arrays));
    for (Vec3Array<Real>& array : work.arrays)
        array.resize(points);
    if (method.velocity)
        work.before_stages.resize(points);
    work.force_of_step = 0;
    work.solver.reset();
    work.solver_bytes = 0;
    work.choice.restart();
}

template <class Real>
std::size_t memory_bytes(const Workspace<Real>& work) {
    const SelfCollisionWork<Real>& s = work.self_collision;
    std::size_t bytes = work.solver_bytes + work.force.bytes() + work.before_stages.bytes() +
                        bytes_of(work.pin_previous) + bytes_of(work.proximity) + bytes_of(work.counts) +
                        s.cell.bytes() + bytes_of(s.lists.first) + bytes_of(s.lists.next) + s.anchor.bytes() +
                        bytes_of(s.far_pairs) + bytes_of(s.pairs) + bytes_of(s.cursor) + bytes_of(s.active) +
                        bytes_of(s.partners) + bytes_of(s.key) + bytes_of(s.order) + bytes_of(s.cell_end) +
                        bytes_of(s.sorted) + bytes_of(s.run_end) + bytes_of(s.buckets) + s.tree.bytes() +
                        s.blocks.bytes() + work.bands.bytes() + work.slabs.bytes();
    for (const Vec3Array<Real>& array : work.arrays)
        bytes += array.bytes();
    for (const AlignedVector<Real>& scratch : work.sweep)
        bytes += bytes_of(scratch);
    return bytes;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template void prepare<Real>(const Model<Real>&, Workspace<Real>&);                                                 \
    template std::size_t memory_bytes<Real>(const Workspace<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim

#include "sim/forces/springs.h"

#include <cmath>

namespace clothlab::sim {

template <class Real>
void add_spring_forces(const Model<Real>& model, const Vec3Array<Real>& position, Vec3Array<Real>& force) {
    const Real *x = position.x.data(), *y = position.y.data(), *z = position.z.data();
    Real *fx = force.x.data(), *fy = force.y.data(), *fz = force.z.data();
    const Grid<Real>& grid = *model.grid;
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t spring) {
        if (!model.pulls(spring))
            return;
        const Real dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const Real pull = model.spring_constant(spring) * (length - grid.rest_length(spring, a)) / length;
        const Real s = length > 0 ? pull : Real(0);
        fx[a] += s * dx;
        fy[a] += s * dy;
        fz[a] += s * dz;
        fx[b] -= s * dx;
        fy[b] -= s * dy;
        fz[b] -= s * dz;
    });
}

template <class Real>
double spring_energy(const Model<Real>& model, const Vec3Array<Real>& position) {
    double energy = 0;
    const Grid<Real>& grid = *model.grid;
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t spring) {
        if (!model.pulls(spring))
            return;
        const double dx = static_cast<double>(position.x[b]) - static_cast<double>(position.x[a]);
        const double dy = static_cast<double>(position.y[b]) - static_cast<double>(position.y[a]);
        const double dz = static_cast<double>(position.z[b]) - static_cast<double>(position.z[a]);
        const double stretch =
            std::sqrt(dx * dx + dy * dy + dz * dz) - static_cast<double>(grid.rest_length(spring, a));
        energy += 0.5 * static_cast<double>(model.spring_constant(spring)) * stretch * stretch;
    });
    return energy;
}

template <class Real>
bool can_sweep(const Model<Real>& model, const Workspace<Real>& work) {
    // A border's missing spring adds +0, which would turn a -0 into +0.
    const auto minus_zero = [](Real v) { return v == 0 && std::signbit(v); };
    return work.kernels && !minus_zero(model.mass * model.gx) && !minus_zero(model.mass * model.gy) &&
           !minus_zero(model.mass * model.gz);
}

template <class Real>
SweepKernel<Real> sweep_kernel(const Model<Real>& model, const Workspace<Real>& work, SweepSink sink) {
    std::size_t kinds = 0;
    for (std::size_t kind = 0; kind < model.enabled.size(); ++kind)
        kinds |= model.enabled[kind] ? std::size_t{1} << kind : 0;
    const Real dt = static_cast<Real>(model.dt), dt2 = dt * dt;
    SweepArguments<Real> all{};
    all.points = model.grid->points();
    all.columns = static_cast<std::size_t>(model.grid->columns);
    all.rest = rest_lengths(*model.grid);
    all.k = model.k[static_cast<std::size_t>(SpringKind::structural)];
    all.bending_k = model.k[static_cast<std::size_t>(SpringKind::bending)];
    all.gravity = {model.mass * model.gx, model.mass * model.gy, model.mass * model.gz};
    all.keep = model.keep;
    all.c = model.force_share * dt2 / model.mass;
    return {work.kernels->sweep[kinds][static_cast<std::size_t>(sink)], all};
}

template <class Real>
void sweep_springs(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work, SweepSink sink,
                   Vec3Array<Real>& out) {
    SweepKernel<Real> kernel = sweep_kernel(model, work, sink);
    kernel.arguments.x = position.axes();
    kernel.arguments.out = out.axes();
    for_ranges(
        model, work,
        [kernel, scratch = work.sweep.data()](int index, std::size_t begin, std::size_t end) {
            SweepArguments<Real> arguments = kernel.arguments;
            arguments.begin = begin;
            arguments.end = end;
            arguments.scratch = scratch[index].data();
            kernel.sweep(arguments);
        },
        Effort::even);
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template void add_spring_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, Vec3Array<Real>&);               \
    template double spring_energy<Real>(const Model<Real>&, const Vec3Array<Real>&);                                   \
    template bool can_sweep<Real>(const Model<Real>&, const Workspace<Real>&);                                         \
    template SweepKernel<Real> sweep_kernel<Real>(const Model<Real>&, const Workspace<Real>&, SweepSink);              \
    template void sweep_springs<Real>(const Model<Real>&, const Vec3Array<Real>&, Workspace<Real>&, SweepSink,         \
                                      Vec3Array<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim

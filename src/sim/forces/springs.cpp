#include "sim/forces/springs.h"

#include <cmath>

namespace clothlab::sim {

template <class Real>
void add_spring_forces(const Model<Real>& model, const Vec3Array<Real>& position, Vec3Array<Real>& force) {
    const Real *x = position.x.data(), *y = position.y.data(), *z = position.z.data();
    Real *fx = force.x.data(), *fy = force.y.data(), *fz = force.z.data();
    for (std::size_t i = 0; i < model.spring_a.size(); ++i) {
        const std::uint32_t a = model.spring_a[i], b = model.spring_b[i];
        const Real dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const Real pull = model.spring_k[i] * (length - model.spring_rest[i]) / length;
        const Real s = length > 0 ? pull : Real(0);
        fx[a] += s * dx;
        fy[a] += s * dy;
        fz[a] += s * dz;
        fx[b] -= s * dx;
        fy[b] -= s * dy;
        fz[b] -= s * dz;
    }
}

template <class Real>
double spring_energy(const Model<Real>& model, const Vec3Array<Real>& position) {
    double energy = 0;
    for (std::size_t i = 0; i < model.spring_a.size(); ++i) {
        const std::uint32_t a = model.spring_a[i], b = model.spring_b[i];
        const double dx = static_cast<double>(position.x[b]) - static_cast<double>(position.x[a]);
        const double dy = static_cast<double>(position.y[b]) - static_cast<double>(position.y[a]);
        const double dz = static_cast<double>(position.z[b]) - static_cast<double>(position.z[a]);
        const double stretch = std::sqrt(dx * dx + dy * dy + dz * dz) - static_cast<double>(model.spring_rest[i]);
        energy += 0.5 * static_cast<double>(model.spring_k[i]) * stretch * stretch;
    }
    return energy;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template void add_spring_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, Vec3Array<Real>&);               \
    template double spring_energy<Real>(const Model<Real>&, const Vec3Array<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim

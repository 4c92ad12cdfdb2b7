#include "sim/diagnostics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>

#include "sim/forces/gravity.h"
#include "sim/forces/springs.h"
#include "sim/random.h"
#include "sim/velocity_of.h"

namespace clothlab::sim {
namespace {

std::string sentence(const char* format, auto... arguments) {
    char text[256];
    std::snprintf(text, sizeof text, format, arguments...);
    return text;
}

/// Why a run of course Verlet diverged: the flat grid's stiffest mode, omega² = 8 ks/m (4 ks/m without shear springs),
/// against the method's limit 2 sqrt(1 - d/2).
template <class Real>
std::string divergence_cause(const Model<Real>& model, const char* what) {
    double k = 0;
    for (std::size_t kind = 0; kind < model.k.size(); ++kind)
        if (model.enabled[kind])
            k = std::max(k, static_cast<double>(model.k[kind]));
    const double mass = static_cast<double>(model.mass);
    if (mass < 0)
        return sentence("%s: the density is negative, so springs push where they should pull", what);
    const double damping = 1 - static_cast<double>(model.keep);
    const double y = std::sqrt(8 * k / mass) * model.dt;
    const double limit = 2 * std::sqrt(std::max(0.0, 1 - damping / 2));
    if (y > limit)
        return sentence("%s: omega dt = %.3g > %.3g, ks is too stiff for %d substeps; %.0f would do for a flat cloth",
                        what, y, limit, model.substeps, std::ceil(model.substeps * y / limit));
    return sentence("%s: not by stiffness (omega dt = %.3g < %.3g); look at wind, damping and accelerations", what, y,
                    limit);
}

} // namespace

template <class Real>
Diagnostics diagnose(const Model<Real>& model, const State<Real>& state) {
    Diagnostics result;
    const Vec3Array<Real>& x = state.position;
    const auto d = [](Real v) { return static_cast<double>(v); };

    const VelocityOf velocity(model, state);
    double square_speed = 0;
    constexpr double inf = std::numeric_limits<double>::infinity();
    Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3 v = velocity(i);
        square_speed += v.x * v.x + v.y * v.y + v.z * v.z;
        low = {std::min(low.x, d(x.x[i])), std::min(low.y, d(x.y[i])), std::min(low.z, d(x.z[i]))};
        high = {std::max(high.x, d(x.x[i])), std::max(high.y, d(x.y[i])), std::max(high.z, d(x.z[i]))};
    }
    result.energy.kinetic = 0.5 * d(model.mass) * square_speed;
    result.energy.spring = spring_energy(model, x);
    result.energy.gravity = gravity_energy(model, x);
    result.rms_speed = std::sqrt(square_speed / static_cast<double>(x.size()));

    const Grid<Real>& grid = *model.grid;
    double longest = 0;
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t spring) {
        const double dx = d(x.x[b]) - d(x.x[a]), dy = d(x.y[b]) - d(x.y[a]), dz = d(x.z[b]) - d(x.z[a]);
        const double rest = d(grid.rest_length(spring, a));
        const double ratio = (dx * dx + dy * dy + dz * dz) / (rest * rest);
        longest = std::max(longest, ratio);
    });
    result.max_strain = std::max(0.0, std::sqrt(longest) - 1);

    const double extent = std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
    if (!std::isfinite(square_speed) || !std::isfinite(extent)) {
        result.status = Status::diverged;
        result.cause = divergence_cause(model, "positions are no longer finite");
    } else if (extent > blown_up * grid.diagonal) {
        result.status = Status::diverged;
        result.cause = divergence_cause(model, "the cloth is over 100 times its own size");
    }
    return result;
}

template <class Real>
Momentum momentum(const Model<Real>& model, const State<Real>& state) {
    const Vec3Array<Real>& x = state.position;
    const auto d = [](Real v) { return static_cast<double>(v); };
    const VelocityOf velocity(model, state);
    Momentum sum;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double mass = d(model.mass);
        const Vec3 v = velocity(i), q{mass * v.x, mass * v.y, mass * v.z};
        sum.linear = {sum.linear.x + q.x, sum.linear.y + q.y, sum.linear.z + q.z};
        sum.angular = {sum.angular.x + d(x.y[i]) * q.z - d(x.z[i]) * q.y,
                       sum.angular.y + d(x.z[i]) * q.x - d(x.x[i]) * q.z,
                       sum.angular.z + d(x.x[i]) * q.y - d(x.y[i]) * q.x};
    }
    return sum;
}

template <class Real>
std::uint64_t hash(const State<Real>& state) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    std::uint64_t h = SplitMix64::mix(state.steps ^ SplitMix64::mix(std::bit_cast<std::uint64_t>(state.time)));
    if (state.history != 0 || state.solver_step != 0)
        h = SplitMix64::mix(h ^ state.history ^ SplitMix64::mix(std::bit_cast<std::uint64_t>(state.solver_step)));
    for (const Vec3Array<Real>* array : {&state.position, &state.previous, &state.velocity, &state.previous_velocity})
        for (const AlignedVector<Real>* axis : {&array->x, &array->y, &array->z})
            for (const Real v : *axis) // every NaN is the same: which one it is, IEEE 754 leaves open
                h = SplitMix64::mix(h ^ std::bit_cast<Bits>(v == v ? v : std::numeric_limits<Real>::quiet_NaN()));
    return h;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template Diagnostics diagnose<Real>(const Model<Real>&, const State<Real>&);                                       \
    template Momentum momentum<Real>(const Model<Real>&, const State<Real>&);                                          \
    template std::uint64_t hash<Real>(const State<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim

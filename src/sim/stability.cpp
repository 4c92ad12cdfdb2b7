#include "sim/stability.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/integrators/integrator.h"
#include "sim/random.h"
#include "sim/spring_operator.h"

namespace clothlab::sim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Relative error at which the iteration stops, and after how many products it does anyway.
constexpr double accuracy = 1e-4;
constexpr int most_products = 160, check_every = 16;

/// No pose has a larger eigenvalue for ks = 1 N/m: the infinite grid's Laplacian with these springs, whose symbol is
/// 4 (sin²(p/2) + sin²(q/2)) + 4 (1 - cos p cos q) + 0.8 (sin² p + sin² q), is not below any grid's K.
double any_pose(const std::array<bool, spring_kinds>& enabled) {
    const auto [structural, shear, bending] = enabled;
    if (structural && shear)
        return 12;
    if (structural || shear)
        return 8;
    return bending ? 8 * bending_share : 0;
}

/// A start with much of the fastest modes: neighbours against each other along rows and along columns, and noise.
template <class Real>
std::vector<double> start_vector(const SpringOperator<Real>& k, int columns) {
    SplitMix64 random(1);
    std::vector<double> v(k.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
        const std::size_t point = i / 3, column = point % static_cast<std::size_t>(columns),
                          row = point / static_cast<std::size_t>(columns);
        const double noise = 2 * random.unit() - 1;
        const double along[3] = {column % 2 ? 1.0 : -1.0, (column + row) % 2 ? 0.5 : -0.5, row % 2 ? 1.0 : -1.0};
        v[i] = k.is_free(point) ? along[i % 3] + noise : 0;
    }
    return v;
}

/// The largest eigenvalue by C. Lanczos' method (Journal of Research of the National Bureau of Standards 45 (1950)),
/// as B. N. Parlett has it ("The symmetric eigenvalue problem", 1980, sections 13.1 and 13.2), without
/// reorthogonalisation: what that loses are copies of eigenvalues found already, which are never too large. To the
/// Ritz value comes its error bound, the residual or, once the next Ritz value is farther away, residual² / gap
/// (Parlett, theorem 11.7.1).
template <class Real>
double largest_eigenvalue(const SpringOperator<Real>& k, int columns) {
    std::vector<double> v = start_vector(k, columns), previous(v.size(), 0.0), w(v.size());
    const auto norm = [](const std::vector<double>& x) {
        double sum = 0;
        for (const double value : x)
            sum += value * value;
        return std::sqrt(sum);
    };
    double beta = norm(v);
    if (!(beta > 0))
        return 0;
    for (double& value : v)
        value /= beta;
    std::vector<double> diagonal, off;
    beta = 0;
    for (;;) {
        k.apply(v, w);
        double alpha = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            w[i] -= beta * previous[i];
            alpha += w[i] * v[i];
        }
        for (std::size_t i = 0; i < v.size(); ++i)
            w[i] -= alpha * v[i];
        diagonal.push_back(alpha);
        beta = norm(w);
        const auto n = static_cast<Eigen::Index>(diagonal.size());
        const bool exhausted = !(beta > 1e-13 * std::abs(alpha));
        if (exhausted || n % check_every == 0 || n == most_products) {
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
            ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                        Eigen::Map<const Eigen::VectorXd>(off.data(), n - 1));
            const double value = ritz.eigenvalues()[n - 1];
            const auto residual = [&](Eigen::Index i) { return std::abs(beta * ritz.eigenvectors()(n - 1, i)); };
            double error = residual(n - 1);
            if (n > 1) {
                const double gap = value - ritz.eigenvalues()[n - 2] - residual(n - 2);
                if (gap > error)
                    error *= error / gap;
            }
            if (exhausted || error <= accuracy * value || n >= most_products)
                return value + error;
        }
        off.push_back(beta);
        std::swap(previous, v);
        for (std::size_t i = 0; i < v.size(); ++i)
            v[i] = w[i] / beta;
    }
}

/// What a step of a given length makes of the springs: the share of the forces that it takes, as the factor of omega
/// dt, and the method's limit under the damping of such a step.
struct StepOf {
    double share, limit;
};
template <class Real>
StepOf step_of(const Model<Real>& model, double dt) {
    const IntegratorTraits& method = traits(model.integrator);
    if (method.divides_steps && model.tolerance > 0)
        return {1, no_limit};
    if (model.rules.damping == DampingRule::cs184)
        return {1, method.limit(1 - static_cast<double>(model.course_keep))};
    // -c v is a force like others, which damps and so widens the limit: it counts as none here.
    if (!method.exact_damping || model.damping_rate == 0)
        return {1, method.limit(0)};
    const double decay = model.damping_rate * dt;
    const double lost = -std::expm1(-decay);
    return {decay > 0 ? std::sqrt(lost / decay) : 1, method.limit(lost)};
}

/// The longest step with omega dt within the limit.
template <class Real>
double longest_step(const Model<Real>& model, double omega) {
    const auto within = [&](double dt) {
        const StepOf step = step_of(model, dt);
        return omega * dt * step.share <= step.limit;
    };
    double low = 0, high = 1 / omega;
    if (!(omega > 0) || step_of(model, high).limit == infinity)
        return infinity;
    while (within(high)) {
        low = high;
        high *= 2;
        if (high == infinity)
            return infinity;
    }
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (within(middle) ? low : high) = middle;
    }
    return low;
}

/// The margin for eigenvalues of K at ks = 1 N/m.
template <class Real>
StabilityMargin margin_of(const Model<Real>& model, double eigenvalue, double bound) {
    const double mass = static_cast<double>(model.mass), ks = static_cast<double>(model.k[0]);
    const StepOf step = step_of(model, model.dt);
    const double step_share = model.dt * step.share, frame = model.dt * model.substeps;
    const bool pushes = ks / mass < 0 && bound > 0;

    StabilityMargin margin;
    margin.limit = step.limit;
    if (ks != 0) {
        margin.omega_bound = pushes ? infinity : std::sqrt(bound * ks / mass);
        margin.omega = pushes ? infinity : std::sqrt(eigenvalue * ks / mass);
    }
    margin.omega_dt = margin.omega * step_share;
    margin.dt_max = longest_step(model, margin.omega);
    margin.substeps_min = margin.dt_max > 0 ? std::max(1.0, std::ceil(frame / margin.dt_max)) : infinity;
    // Of omega² = eigenvalue ks / m within (limit / step)².
    const double square = eigenvalue == 0 ? infinity : (margin.limit / step_share) * (margin.limit / step_share);
    margin.ks_max = square == infinity ? infinity : std::max(0.0, square * mass / eigenvalue);
    const double mass_min = ks <= 0 || square == infinity ? 0 : eigenvalue * ks / square;
    margin.density_min = mass_min == 0 ? 0 : mass_min * model.density / mass;
    return margin;
}

} // namespace

template <class Real>
StabilityMargin stability_margin(const Model<Real>& model, const Vec3Array<Real>& position) {
    for (const Real* axis : position.axes())
        if (!std::all_of(axis, axis + position.size(), [](Real v) { return std::isfinite(v); }))
            return margin_of(model, infinity, infinity);
    const SpringOperator<Real> k(model, position);
    const double bound = std::min(any_pose(model.enabled), k.bound());
    return margin_of(model, std::clamp(largest_eigenvalue(k, model.grid->columns), 0.0, bound), bound);
}

template StabilityMargin stability_margin<float>(const Model<float>&, const Vec3Array<float>&);
template StabilityMargin stability_margin<double>(const Model<double>&, const Vec3Array<double>&);

} // namespace clothlab::sim

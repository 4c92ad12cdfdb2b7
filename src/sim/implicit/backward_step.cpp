#include "sim/implicit/backward_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/forces/forces.h"
#include "sim/forces/springs.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {
namespace {

constexpr int most_newton_iterations = 50;
constexpr int most_halvings = 20;
/// Sums are taken over blocks of so many points, which no range divides, and then over the blocks: one order for any
/// number of threads.
constexpr std::size_t block = sweep_grain;
constexpr std::size_t sum_lanes = 16; // as many partial sums: the order is the same for every vector length

template <class Real>
Real stiffness(const Model<Real>& model, const BackwardStep<Real>& step) {
    const double c = step.with_damping ? model.damping_rate : 0;
    return static_cast<Real>(static_cast<double>(model.mass) * (1 + c * step.gamma) / (step.gamma * step.gamma));
}

/// The dot product of the points [begin, end).
template <class Real>
double dot_block(const Vec3Array<Real>& a, const Vec3Array<Real>& b, std::size_t begin, std::size_t end) {
    Real sums[sum_lanes] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real *u = a.axes()[axis], *v = b.axes()[axis];
        std::size_t i = begin;
        for (; i + sum_lanes <= end; i += sum_lanes)
            for (std::size_t l = 0; l < sum_lanes; ++l)
                sums[l] += u[i + l] * v[i + l];
        for (std::size_t l = 0; i + l < end; ++l)
            sums[l] += u[i + l] * v[i + l];
    }
    double sum = 0;
    for (const Real s : sums)
        sum += static_cast<double>(s);
    return sum;
}

/// a += f b
template <class Real>
void add_scaled(Vec3Array<Real>& a, Real f, const Vec3Array<Real>& b, std::size_t begin, std::size_t end) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real* __restrict u = a.axes()[axis];
        const Real* __restrict v = b.axes()[axis];
        for (std::size_t i = begin; i < end; ++i)
            u[i] += f * v[i];
    }
}

/// p = z + f p
template <class Real>
void turn(Vec3Array<Real>& p, const Vec3Array<Real>& z, Real f, std::size_t begin, std::size_t end) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real* __restrict u = p.axes()[axis];
        const Real* __restrict v = z.axes()[axis];
        for (std::size_t i = begin; i < end; ++i)
            u[i] = v[i] + f * u[i];
    }
}

template <class Real>
void precondition(const SpringHessian<Real>& hessian, const Vec3Array<Real>& r, Vec3Array<Real>& z, std::size_t begin,
                  std::size_t end) {
    const auto& d = hessian.inverse_diagonal;
    for (std::size_t i = begin; i < end; ++i) {
        const Real x = r.x[i], y = r.y[i], w = r.z[i];
        z.x[i] = d[0][i] * x + d[1][i] * y + d[2][i] * w;
        z.y[i] = d[1][i] * x + d[3][i] * y + d[4][i] * w;
        z.z[i] = d[2][i] * x + d[4][i] * y + d[5][i] * w;
    }
}

template <class Real>
double largest(const Vec3Array<Real>& v) {
    Real most = 0;
    for (const Real* axis : v.axes())
        for (std::size_t i = 0; i < v.size(); ++i)
            most = std::max(most, std::abs(axis[i]));
    return static_cast<double>(most);
}

} // namespace

template <class Real>
BackwardSolver<Real>::BackwardSolver(std::size_t points) : sums_((points + block - 1) / block) {
    hessian_.resize(points);
    for (Vec3Array<Real>* array : {&r_, &p_, &q_, &z_, &delta_, &trial_})
        array->resize(points);
}

template <class Real>
BackwardSolver<Real>& BackwardSolver<Real>::of(const Model<Real>& model, Workspace<Real>& work) {
    if (!work.solver) {
        work.solver = std::shared_ptr<BackwardSolver>(new BackwardSolver(model.grid->points()));
        const auto& solver = *static_cast<BackwardSolver*>(work.solver.get());
        work.solver_bytes = solver.hessian_.bytes() + 6 * solver.r_.bytes() + solver.sums_.capacity() * sizeof(double);
    }
    return *static_cast<BackwardSolver*>(work.solver.get());
}

template <class Real>
template <class Task>
double BackwardSolver<Real>::sum(const Model<Real>& model, Workspace<Real>& work, Task task) {
    for_ranges(model, work, [&](int, std::size_t begin, std::size_t end) {
        task(begin, end, [&](const Vec3Array<Real>& a, const Vec3Array<Real>& b) {
            for (std::size_t i = begin; i < end; i += block)
                sums_[i / block] = dot_block(a, b, i, std::min(i + block, end));
        });
    });
    double total = 0;
    for (const double s : sums_)
        total += s;
    return total;
}

/// Sets r to b + F(x) - a (x - x^), zero at pins, and returns its length.
template <class Real>
double BackwardSolver<Real>::residual(const Model<Real>& model, const BackwardStep<Real>& step,
                                      const Vec3Array<Real>& x, Workspace<Real>& work) {
    {
        const StageTimer timer(work, Stage::forces);
        evaluate_conservative_forces(model, x, work, r_);
    }
    const StageTimer timer(work, Stage::integrate);
    const Real a = stiffness(model, step);
    const Real per_step = static_cast<Real>(static_cast<double>(model.mass) / step.gamma);
    const std::array<Real, 3> gravity{model.mass * model.gx, model.mass * model.gy, model.mass * model.gz};
    const double square = sum(model, work, [&](std::size_t begin, std::size_t end, auto dot) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real* r = r_.axes()[axis];
            const Real *now = x.axes()[axis], *from = step.position->axes()[axis], *v = step.velocity->axes()[axis];
            for (std::size_t i = begin; i < end; ++i)
                r[i] += per_step * v[i] - a * (now[i] - from[i]);
            if (!step.with_gravity)
                for (std::size_t i = begin; i < end; ++i)
                    r[i] -= gravity[axis];
            if (step.further_forces)
                for (std::size_t i = begin; i < end; ++i)
                    r[i] += step.further_forces->axes()[axis][i];
            for (const std::uint32_t pin : model.pins)
                if (pin >= begin && pin < end)
                    r[pin] = 0;
        }
        dot(r_, r_);
    });
    return std::sqrt(square);
}

/// a/2 |x - x^|² - b (x - x^) + E(x), summed in double precision.
template <class Real>
auto BackwardSolver<Real>::energy(const Model<Real>& model, const BackwardStep<Real>& step,
                                  const Vec3Array<Real>& x) const -> Energy {
    const double a = static_cast<double>(stiffness(model, step)), m = static_cast<double>(model.mass);
    const std::array<double, 3> gravity{m * static_cast<double>(model.gx), m * static_cast<double>(model.gy),
                                        m * static_cast<double>(model.gz)};
    Energy total{spring_energy(model, x), 0};
    total.scale = total.value;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real *now = x.axes()[axis], *from = step.position->axes()[axis], *v = step.velocity->axes()[axis];
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double moved = static_cast<double>(now[i]) - static_cast<double>(from[i]);
            double b = m * static_cast<double>(v[i]) / step.gamma;
            if (step.with_gravity)
                b += gravity[axis];
            if (step.further_forces)
                b += static_cast<double>(step.further_forces->axes()[axis][i]);
            total.value += moved * (0.5 * a * moved - b);
            total.scale += std::abs(moved * b);
        }
    }
    return total;
}

/// Solves (a I + Hessian) delta = r with block-diagonal preconditioning, until what is left of r is `relative` of it:
/// Y. Saad, "Iterative Methods for Sparse Linear Systems", algorithm 9.1. Begins at delta, or at zero. r is used up.
template <class Real>
std::size_t BackwardSolver<Real>::conjugate_gradients(const Model<Real>& model, Real a, double relative, bool from_zero,
                                                      Workspace<Real>& work) {
    const std::size_t most = 3 * r_.size() + 10;
    const auto apply = [&](const Vec3Array<Real>& v) {
        return sum(model, work, [&](std::size_t begin, std::size_t end, auto dot) {
            multiply(model, hessian_, a, v, begin, end, q_);
            dot(v, q_);
        });
    };
    const auto update = [&](auto change) { // of r; then z = r preconditioned. Returns r z
        return sum(model, work, [&](std::size_t begin, std::size_t end, auto dot) {
            change(begin, end);
            precondition(hessian_, r_, z_, begin, end);
            dot(r_, z_);
        });
    };
    // The goal is relative to the right-hand side itself, in the preconditioner's norm, wherever the solver begins.
    const double whole = update([](std::size_t, std::size_t) {});
    double rz = whole;
    if (from_zero) {
        for (Real* axis : delta_.axes())
            std::fill(axis, axis + delta_.size(), Real(0));
    } else {
        apply(delta_);
        rz = update([&](std::size_t begin, std::size_t end) { add_scaled(r_, Real(-1), q_, begin, end); });
    }
    const double goal = relative * relative * whole;
    p_ = z_;
    std::size_t iterations = 0;
    while (rz > goal && iterations < most) {
        const double curvature = apply(p_);
        if (!(curvature > 0)) // a negative mass, or numbers that are none
            break;
        ++iterations;
        const Real step = static_cast<Real>(rz / curvature);
        const double next = update([&](std::size_t begin, std::size_t end) {
            add_scaled(delta_, step, p_, begin, end);
            add_scaled(r_, -step, q_, begin, end);
        });
        const Real ratio = static_cast<Real>(next / rz);
        for_ranges(model, work, [&](int, std::size_t begin, std::size_t end) { turn(p_, z_, ratio, begin, end); });
        rz = next;
    }
    return iterations;
}

template <class Real>
void BackwardSolver<Real>::newton(const Model<Real>& model, const BackwardStep<Real>& step, Vec3Array<Real>& x,
                                  Workspace<Real>& work, StepCounts& counts) {
    const Real a = stiffness(model, step);
    const double shortest = static_cast<double>(model.grid->shortest), enough = model.tolerance * shortest;
    constexpr double epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
    double last_size = std::numeric_limits<double>::infinity(), last_residual = 0;
    const double digit = epsilon * largest(x); // what a position can be wrong by
    Energy now = energy(model, step, x);
    for (int iteration = 0; iteration < most_newton_iterations; ++iteration) {
        const double size_of_residual = residual(model, step, x, work);
        ++counts.force_evaluations;
        const StageTimer timer(work, Stage::integrate);
        linearise(model, x, a, work, hessian_);
        // S. C. Eisenstat, H. F. Walker, "Choosing the forcing terms in an inexact Newton method" (1996), choice 2: no
        // more accurate than the linearisation is worth.
        const double ratio = iteration == 0 ? 1 : size_of_residual / last_residual;
        counts.solver_iterations +=
            conjugate_gradients(model, a, std::clamp(0.9 * ratio * ratio, 1e-5, 0.1), true, work);
        last_residual = size_of_residual;

        double size = largest(delta_), share = 1;
        Energy next;
        for (int halving = 0;; ++halving) {
            trial_ = x;
            add_scaled(trial_, static_cast<Real>(share), delta_, 0, x.size());
            next = energy(model, step, trial_);
            // Small steps change the energy by less than its own rounding.
            if (next.value <= now.value + 64 * epsilon * now.scale || halving == most_halvings ||
                !std::isfinite(now.value))
                break;
            share *= 0.5;
        }
        size *= share;
        std::swap(x, trial_);
        now = next;
        const bool resolved = size <= digit || (size >= 0.5 * last_size && size < 1e-3 * shortest);
        if (size <= enough || resolved || !std::isfinite(now.value))
            return;
        last_size = size;
    }
}

template <class Real>
void BackwardSolver<Real>::linearised(const Model<Real>& model, const BackwardStep<Real>& step, Vec3Array<Real>& x,
                                      const Vec3Array<Real>* guess, Workspace<Real>& work, StepCounts& counts) {
    const Real a = stiffness(model, step);
    residual(model, step, x, work);
    ++counts.force_evaluations;
    const StageTimer timer(work, Stage::integrate);
    linearise(model, x, a, work, hessian_);
    if (guess) {
        delta_ = *guess;
        add_scaled(delta_, Real(-1), x, 0, x.size());
    }
    constexpr double least = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    counts.solver_iterations += conjugate_gradients(model, a, std::max(model.tolerance, least), !guess, work);
    add_scaled(x, Real(1), delta_, 0, x.size());
}

template <class Real>
void BackwardSolver<Real>::velocity(const Model<Real>& model, const BackwardStep<Real>& step, const Vec3Array<Real>& x,
                                    Vec3Array<Real>& v) {
    const Real gamma = static_cast<Real>(step.gamma);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real *now = x.axes()[axis], *from = step.position->axes()[axis];
        Real* out = v.axes()[axis];
        for (std::size_t i = 0; i < x.size(); ++i)
            out[i] = (now[i] - from[i]) / gamma;
        for (const std::uint32_t pin : model.pins)
            out[pin] = 0;
    }
}

template class BackwardSolver<float>;
template class BackwardSolver<double>;

} // namespace clothlab::sim

// What all implicit methods solve: a step of backward Euler. With positions x^ and velocities v^ to start from and a
// step of gamma, find
//     x = x^ + gamma v,   v = v^ + gamma ( F(x) / m - c v )
// where F are springs and gravity, c is the physical rule's damping and further forces stand still. Without v that is
//     a (x - x^) - b - F(x) = 0   with   a = m (1 + c gamma) / gamma²,   b = m v^ / gamma + the further forces
// and its solution is a minimum of a/2 |x - x^|² - b x + E(x): S. Martin, B. Thomaszewski, E. Grinspun, M. Gross,
// "Example-based elastic materials", SIGGRAPH 2011, section 4.
#pragma once

#include "sim/implicit/spring_hessian.h"
#include "sim/step.h"

namespace clothlab::sim {

template <class Real>
struct BackwardStep {
    double gamma;                          ///< s
    const Vec3Array<Real>* position;       ///< x^, m
    const Vec3Array<Real>* velocity;       ///< v^, m/s
    const Vec3Array<Real>* further_forces; ///< N; null: none
    bool with_gravity = true;
    bool with_damping = true;
};

/// Memory and linear solver of implicit methods, built in their first step.
template <class Real>
class BackwardSolver {
public:
    /// The workspace's own, made when it has none.
    static BackwardSolver& of(const Model<Real>& model, Workspace<Real>& work);

    /// Newton's method with a line search, from where `x` is, until the largest correction is below the model's
    /// tolerance times the shortest rest length, or below what the precision can resolve. At most 50 iterations; one
    /// that ends without success leaves the best positions found.
    void newton(const Model<Real>& model, const BackwardStep<Real>& step, Vec3Array<Real>& x, Workspace<Real>& work,
                StepCounts& counts);

    /// One Newton iteration from where `x` is, solved to the model's tolerance relative to the right-hand side:
    /// D. Baraff, A. Witkin, SIGGRAPH 1998, equation 6. `guess` is where the solver begins, or null.
    void linearised(const Model<Real>& model, const BackwardStep<Real>& step, Vec3Array<Real>& x,
                    const Vec3Array<Real>* guess, Workspace<Real>& work, StepCounts& counts);

    /// v = (x - x^) / gamma, zero at pins.
    static void velocity(const Model<Real>& model, const BackwardStep<Real>& step, const Vec3Array<Real>& x,
                         Vec3Array<Real>& v);

private:
    explicit BackwardSolver(std::size_t points);
    double residual(const Model<Real>& model, const BackwardStep<Real>& step, const Vec3Array<Real>& x,
                    Workspace<Real>& work);
    struct Energy {
        double value = 0, scale = 0; ///< J; the scale is the size of what cancels in the value
    };
    Energy energy(const Model<Real>& model, const BackwardStep<Real>& step, const Vec3Array<Real>& x) const;
    std::size_t conjugate_gradients(const Model<Real>& model, Real a, double relative, bool from_zero,
                                    Workspace<Real>& work);
    /// Calls task(begin, end) for ranges of points, in which it returns sums per block; sums these in order.
    template <class Task>
    double sum(const Model<Real>& model, Workspace<Real>& work, Task task);

    SpringHessian<Real> hessian_;
    Vec3Array<Real> r_, p_, q_, z_, delta_, trial_;
    std::vector<double> sums_; ///< per block of points
};

extern template class BackwardSolver<float>;
extern template class BackwardSolver<double>;

} // namespace clothlab::sim

// Vertex block descent: A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, "Vertex block descent", SIGGRAPH 2024. A step of
// backward Euler,
//     A (x - x_n) - b - F(x) = 0   with   A = m (1 + c dt) / dt²,   b = m v_n / dt + gravity and wind,
// c the physical rule's damping, is solved point by point: one Newton step for the three coordinates of each point in
// turn while all others stand still (section 3), all points in an iteration.
//
// The Hessian of a spring of length L along n, k (n nT + (1 - rest/L) (I - n nT)), has a negative part across n when it
// is compressed. That part is taken as zero, so that every block is positive definite with A > 0 and every step goes
// downhill; the paper leaves it. The force is exact, so that the solution is the same.
//
// Points of one colour have no springs between them: (column + 2 row) mod 5 differs across every spring of the stencil.
// So they may be moved in any order, by any number of threads, to the same bits. Iterations begin at x_n + what the
// step is without springs, the paper's "inertia", or where its section 3.7 has them begin; section 3.8 accelerates
// them.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/forces/wind.h"
#include "sim/integrators/displacement.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {
namespace {

constexpr int colours = 5;
/// Whether no spring ties points of one colour.
constexpr bool separates_neighbours() {
    for (const SpringStencil& s : spring_stencil)
        if ((s.columns + 2 * s.rows) % colours == 0)
            return false;
    return true;
}
static_assert(separates_neighbours());
constexpr std::size_t neighbours = 2 * stencil_size;

/// The springs at a point: its own, and those of points after it.
template <class Real>
struct Neighbourhood {
    struct Spring {
        int columns, rows;     ///< to the other end
        std::ptrdiff_t offset; ///< of the other end
        bool own;              ///< whether the point owns the spring, so that its rest length is found there
        const Real* rest;
        Real k; ///< N/m; zero when the kind is off
    };
    std::array<Spring, neighbours> springs;

    explicit Neighbourhood(const Model<Real>& model) {
        const Grid<Real>& grid = *model.grid;
        for (std::size_t s = 0; s < stencil_size; ++s) {
            const SpringStencil& stencil = spring_stencil[s];
            const std::ptrdiff_t offset = std::ptrdiff_t{stencil.rows} * grid.columns + stencil.columns;
            const Real k = model.pulls(s) ? model.spring_constant(s) : Real(0);
            springs[2 * s] = {stencil.columns, stencil.rows, offset, true, grid.rest[s].data(), k};
            springs[2 * s + 1] = {-stencil.columns, -stencil.rows, -offset, false, grid.rest[s].data(), k};
        }
    }
};

/// What a point's springs are, gathered for loops without branches.
template <class Real>
struct Gathered {
    std::array<Real, neighbours> dx, dy, dz, rest, k;
};

template <class Real>
struct PointBlock {
    Triple<Real> force{};
    Real xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0; ///< the Hessian
};

/// Adds the forces of the springs on their point and their Hessian, its part across compressed springs left out.
template <class Real>
void add_springs(const Gathered<Real>& g, PointBlock<Real>& block) {
    std::array<Real, neighbours> pull, across, along;
    for (std::size_t n = 0; n < neighbours; ++n) {
        const Real square = g.dx[n] * g.dx[n] + g.dy[n] * g.dy[n] + g.dz[n] * g.dz[n];
        const Real length = std::sqrt(square);
        const Real tension = g.k[n] * (length - g.rest[n]) / length;
        const Real stretched = tension > 0 ? tension : Real(0);
        const Real rest = (g.k[n] - stretched) / square;
        const bool directed = square > 0;
        pull[n] = directed ? tension : Real(0);
        across[n] = directed ? stretched : Real(0);
        along[n] = directed ? rest : Real(0);
    }
    Real t = 0;
    for (std::size_t n = 0; n < neighbours; ++n) {
        const Real x = g.dx[n], y = g.dy[n], z = g.dz[n];
        block.force.x += pull[n] * x;
        block.force.y += pull[n] * y;
        block.force.z += pull[n] * z;
        t += across[n];
        const Real ax = along[n] * x, ay = along[n] * y, az = along[n] * z;
        block.xx += ax * x;
        block.xy += ax * y;
        block.xz += ax * z;
        block.yy += ay * y;
        block.yz += ay * z;
        block.zz += az * z;
    }
    block.xx += t;
    block.yy += t;
    block.zz += t;
}

/// The solution of Hessian * d = force, by L D LT.
template <class Real>
Triple<Real> solve(const PointBlock<Real>& b) {
    const Real l21 = b.xy / b.xx, l31 = b.xz / b.xx;
    const Real d2 = b.yy - l21 * b.xy;
    const Real u32 = b.yz - l31 * b.xy, l32 = u32 / d2;
    const Real d3 = b.zz - l31 * b.xz - l32 * u32;
    const Real y2 = b.force.y - l21 * b.force.x;
    const Real z = (b.force.z - l31 * b.force.x - l32 * y2) / d3;
    const Real y = y2 / d2 - l32 * z;
    return {b.force.x / b.xx - l21 * y - l31 * z, y, z};
}

/// The paper's section 3.7, after a step that can be looked back at: puts the points where they would go with their
/// velocities and as much of gravity as acted on them in that step, between none, for what lies or hangs still, and
/// all, for what falls freely.
template <class Real>
void guess(const Model<Real>& model, State<Real>& state) {
    const Real square = model.gx * model.gx + model.gy * model.gy + model.gz * model.gz;
    if (state.history == 0 || square == 0)
        return;
    const Real dt = static_cast<Real>(model.dt);
    const Vec3Array<Real>&p = state.previous, &v = state.velocity, &before = state.previous_velocity;
    Vec3Array<Real>& x = state.position;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (model.pinned[i])
            continue;
        const Real acted =
            (v.x[i] - before.x[i]) * model.gx + (v.y[i] - before.y[i]) * model.gy + (v.z[i] - before.z[i]) * model.gz;
        const Real fall = std::clamp(acted / (square * dt), Real(0), Real(1)) * dt * dt;
        x.x[i] = p.x[i] + dt * v.x[i] + fall * model.gx;
        x.y[i] = p.y[i] + dt * v.y[i] + fall * model.gy;
        x.z[i] = p.z[i] + dt * v.z[i] + fall * model.gz;
    }
}

/// The paper's section 3.8: with w_1 = 1, w_2 = 2 / (2 - rho²), w_n = 4 / (4 - rho² w_{n-1}), what an iteration made of
/// the positions becomes x = w (x - x_{n-2}) + x_{n-2}. It moves nothing from where the descent has ended.
template <class Real>
struct Accelerator {
    const double rho;
    Vec3Array<Real>&before, &two_before;
    double w = 1;
    int iteration = 0;

    void begin(const Vec3Array<Real>& x) {
        if (rho == 0)
            return;
        std::swap(before, two_before);
        before = x;
        ++iteration;
        w = iteration == 1 ? 1 : iteration == 2 ? 2 / (2 - rho * rho) : 4 / (4 - rho * rho * w);
    }
    void end(Vec3Array<Real>& x) const {
        if (rho == 0 || iteration == 1)
            return;
        const Real factor = static_cast<Real>(w);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real* now = x.axes()[axis];
            const Real* from = two_before.axes()[axis];
            for (std::size_t i = 0; i < x.size(); ++i)
                now[i] = factor * (now[i] - from[i]) + from[i];
        }
    }
};

} // namespace

template <class Real>
void vertex_block_descent(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    Vec3Array<Real>& constant = work.arrays[0];
    set_wind(model, state, work, constant);
    const StageTimer timer(work, Stage::integrate);
    predict(model, implicit_prediction(model), constant, state);
    if (model.first_guess == FirstGuess::adaptive)
        guess(model, state);
    const double mass = static_cast<double>(model.mass);
    const Real a = static_cast<Real>(mass * (1 + model.damping_rate * model.dt) / (model.dt * model.dt));
    const Real momentum = static_cast<Real>(mass / model.dt);
    const Triple<Real> weight{model.mass * model.gx, model.mass * model.gy, model.mass * model.gz};

    const Grid<Real>& grid = *model.grid;
    const Neighbourhood<Real> around(model);
    const int columns = grid.columns, rows = grid.rows;
    Real *x = state.position.x.data(), *y = state.position.y.data(), *z = state.position.z.data();
    const Real *px = state.previous.x.data(), *py = state.previous.y.data(), *pz = state.previous.z.data();
    const Real *vx = state.velocity.x.data(), *vy = state.velocity.y.data(), *vz = state.velocity.z.data();
    const auto move = [&](int column, int row) {
        const std::size_t i =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
        if (model.pinned[i])
            return;
        const bool inside = column >= 2 && column + 2 < columns && row >= 2 && row + 2 < rows;
        Gathered<Real> g;
        for (std::size_t n = 0; n < neighbours; ++n) {
            const auto& spring = around.springs[n];
            const int to_column = column + spring.columns, to_row = row + spring.rows;
            const bool there = inside || (to_column >= 0 && to_column < columns && to_row >= 0 && to_row < rows);
            const std::size_t to = there ? i + static_cast<std::size_t>(spring.offset) : i;
            g.dx[n] = x[to] - x[i];
            g.dy[n] = y[to] - y[i];
            g.dz[n] = z[to] - z[i];
            g.rest[n] = spring.rest[(spring.own ? i : to) & grid.rest_mask];
            g.k[n] = spring.k;
        }
        PointBlock<Real> block;
        block.force = {weight.x + constant.x[i] + momentum * vx[i] - a * (x[i] - px[i]),
                       weight.y + constant.y[i] + momentum * vy[i] - a * (y[i] - py[i]),
                       weight.z + constant.z[i] + momentum * vz[i] - a * (z[i] - pz[i])};
        block.xx = block.yy = block.zz = a;
        add_springs(g, block);
        const Triple<Real> d = solve(block);
        x[i] += d.x;
        y[i] += d.y;
        z[i] += d.z;
    };
    // The points of a colour among [begin, end).
    const auto move_colour = [&](int colour, std::size_t begin, std::size_t end) {
        const auto width = static_cast<std::size_t>(columns);
        for (std::size_t row = begin / width; row * width < end; ++row) {
            const int from = static_cast<int>(std::max(begin, row * width) - row * width);
            const int to = static_cast<int>(std::min(end, (row + 1) * width) - row * width);
            const int phase = (colour + 3 * static_cast<int>(row)) % colours; // -2 is 3 mod 5
            for (int column = from + (phase - from % colours + colours) % colours; column < to; column += colours)
                move(column, static_cast<int>(row));
        }
    };
    Accelerator<Real> accelerator{model.acceleration, work.arrays[1], work.arrays[2]};
    for (int iteration = 0; iteration < model.iterations; ++iteration) {
        accelerator.begin(state.position);
        for (int colour = 0; colour < colours; ++colour)
            for_ranges(model, work, [&](int, std::size_t begin, std::size_t end) { move_colour(colour, begin, end); });
        accelerator.end(state.position);
    }
    if (model.first_guess == FirstGuess::adaptive) {
        state.previous_velocity = state.velocity;
        state.history = 1;
    }
    velocities_from_displacements(model, state);
    counts.solver_iterations = static_cast<std::size_t>(model.iterations);
}

const IntegratorTraits vertex_block_descent_traits{
    .title = "Vertex block descent",
    .help = "Backward Euler point by point: never blows up, and needs no matrix. Motion that is shared by many points "
            "takes "
            "many iterations, so with few of them stiff cloth in long steps is too soft.",
    .family = Family::implicit_method,
    .order = 1,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "iterations sweeps over the points, 12 springs each",
    .source = "A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, \"Vertex block descent\", SIGGRAPH 2024, section 3",
    .velocity = true,
    .arrays = 3,
    .options = uses_iterations | uses_first_guess | uses_acceleration};

CLOTHLAB_DEFINE_INTEGRATOR(vertex_block_descent)

} // namespace clothlab::sim

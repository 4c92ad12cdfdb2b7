// Everything that stays the same while steps are taken: grid, masses, spring constants, pins, colliders, rules, with
// all derived constants computed once (docs/simulation.md). A parameter change makes a new model around the same grid.
#pragma once

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "sim/description.h"
#include "sim/grid.h"

namespace clothlab::sim {

template <class Real>
struct SphereModel {
    Real x, y, z, radius;
    Real slide;    ///< 1 - friction, of the course's rule
    Real friction; ///< Coulomb's mu, of the physical rule
};

template <class Real>
struct PlaneModel {
    Real px, py, pz;
    Real nx, ny, nz; ///< unit normal
    Real slide;      ///< 1 - friction, of the course's rule
    Real friction;   ///< Coulomb's mu, of the physical rule
};

/// How far above a plane the course puts a point that crossed it, in m.
inline constexpr double plane_offset = 1e-4;
/// The course's stretch limit, as a multiple of the rest length.
inline constexpr double stretch_limit = 1.1;

template <class Real>
struct Model {
    std::shared_ptr<const Grid<Real>> grid;
    std::vector<std::uint8_t> pinned; ///< 1 for masses that no stage moves
    std::vector<std::uint32_t> pins;  ///< those masses, ascending, each once

    std::array<bool, spring_kinds> enabled{}; ///< which kinds of springs pull
    std::array<Real, spring_kinds> k{};       ///< N/m, by kind

    Real spring_constant(std::size_t s) const { return k[static_cast<std::size_t>(spring_stencil[s].kind)]; }
    bool pulls(std::size_t s) const { return enabled[static_cast<std::size_t>(spring_stencil[s].kind)]; }

    double density = 0;          ///< kg/m²
    Real mass = 0;               ///< kg per point
    Real gx = 0, gy = 0, gz = 0; ///< m/s², gravity and all further accelerations
    double dt = 0;               ///< s
    double damping_rate = 0;     ///< 1/s, of the physical rule; 0 under the course's
    /// Damping, by what a method can make of it. Course: the share 1 - d of the motion survives each step, whatever its
    /// length. Physical: v' = a - c v, whose exact solution over a step with constant a is v exp(-c dt) + a dt share.
    Real keep = 1;                           ///< of the Verlet displacement: 1 - d, or exp(-c dt)
    Real force_share = 1;                    ///< of dt² a: 1, or (1 - exp(-c dt)) / (c dt)
    Real course_keep = 1;                    ///< 1 - d; 1 under the physical rule, where -c v is one of the forces
    int substeps = 1;                        ///< per frame
    Real thickness = 0;                      ///< m
    Real cell_x = 0, cell_y = 0, cell_z = 0; ///< m, cells of the course's self-collision
    Real spacing_x = 0, spacing_y = 0;       ///< m, between neighbours in the flat cloth
    std::vector<std::variant<SphereModel<Real>, PlaneModel<Real>>> colliders;
    Wind wind;
    Rules rules;
    IntegratorId integrator = IntegratorId::course_verlet;
    int iterations = 10;
    double tolerance = 1e-6;
    Real pbd_stiffness = 1;
    Real spring_damping = 0; ///< N s/m
    FirstGuess first_guess = FirstGuess::inertia;
    double acceleration = 0;
};

/// Builds the model of a description on a grid that was made for it. Throws std::invalid_argument for what has no
/// meaning (a pin outside the grid, density or substeps of zero, a plane without a normal).
template <class Real>
Model<Real> make_model(const Description& description, std::shared_ptr<const Grid<Real>> grid);

extern template Model<float> make_model<float>(const Description&, std::shared_ptr<const Grid<float>>);
extern template Model<double> make_model<double>(const Description&, std::shared_ptr<const Grid<double>>);

} // namespace clothlab::sim

// What is to be simulated, in double precision and in the units of the scene file: plain data that scenes are read
// into, panels edit and models are built from. Defaults are the course's.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace clothlab::sim {

struct Vec3 {
    double x = 0, y = 0, z = 0;
    bool operator==(const Vec3&) const = default;
};

/// Horizontal cloth lies in xz at y = 1, vertical cloth stands in xy with a random z offset within 1 mm.
enum class Orientation : std::uint8_t { horizontal = 0, vertical = 1 };

/// Column (along the width) and row of a mass.
using GridPoint = std::array<int, 2>;

struct Cloth {
    double width = 1;  ///< m
    double height = 1; ///< m
    int num_width_points = 50;
    int num_height_points = 50;
    double thickness = 0.0095; ///< m; self-collision keeps points twice this apart
    Orientation orientation = Orientation::horizontal;
    double ks = 5000;          ///< N/m
    double density = 150;      ///< kg/m²; may be negative, not zero
    double damping = 0.2;      ///< percent of the motion lost in each substep, by the course's rule
    double damping_rate = 5.4; ///< 1/s, c of the physical rule: motion decays as exp(-c t)
    bool enable_structural = true;
    bool enable_shearing = true;
    bool enable_bending = true;
    Vec3 offset;                   ///< m, added to every start position
    std::vector<GridPoint> pinned; ///< points that no stage moves
    bool operator==(const Cloth&) const = default;
};

struct Sphere {
    Vec3 origin;         ///< m
    double radius = 0.2; ///< m
    double friction = 0; ///< 0 to 1; course: the share of the way that is lost; physical: Coulomb's mu
    bool operator==(const Sphere&) const = default;
};

struct Plane {
    Vec3 point;           ///< m
    Vec3 normal{0, 1, 0}; ///< of any length but zero
    double friction = 0;  ///< 0 to 1, as a sphere's
    bool operator==(const Plane&) const = default;
};

using Collider = std::variant<Sphere, Plane>;

enum class WindKind : std::uint8_t { none, course, physical };
/// What the course's wind formula takes for its t: the length of a step, as in the original, or the simulated time.
enum class WindClock : std::uint8_t { step, time };

struct Wind {
    WindKind kind = WindKind::none;
    WindClock clock = WindClock::step; ///< course wind only
    Vec3 velocity{3, 0, 0};            ///< m/s, physical wind only, as all that follows
    double gust = 0.3;                 ///< share of the velocity that comes and goes
    double gust_period = 2;            ///< s
    double air_density = 1.2;          ///< kg/m³
    double drag = 1;                   ///< coefficient
    double lift = 1;                   ///< coefficient
    bool operator==(const Wind&) const = default;
};

/// The course's shortcuts, each with a name and, where one is built, an alternative. See rules.def.
enum class DampingRule : std::uint8_t { cs184, physical };
enum class StartRule : std::uint8_t { cs184, physical };
enum class LimitRule : std::uint8_t { cs184, off, iterated };
enum class FrictionRule : std::uint8_t { cs184, physical };
enum class PlaneRule : std::uint8_t { cs184, physical };
enum class SelfCollisionRule : std::uint8_t { cs184, none, neighbours, triangles };

struct Rules {
    DampingRule damping = DampingRule::cs184;
    StartRule start = StartRule::cs184;
    LimitRule limit = LimitRule::cs184;
    FrictionRule friction = FrictionRule::cs184;
    PlaneRule plane = PlaneRule::cs184;
    SelfCollisionRule self_collision = SelfCollisionRule::cs184;
    bool operator==(const Rules&) const = default;
};

enum class IntegratorId : std::uint8_t {
#define CLOTHLAB_INTEGRATOR(id, name) id,
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR
};

/// Where vertex block descent begins: where the points would be without springs, or with as much of gravity as acted on
/// each in the last step.
enum class FirstGuess : std::uint8_t { inertia, adaptive };

enum class Precision : std::uint8_t { single_precision, double_precision };

struct Stepping {
    IntegratorId integrator = IntegratorId::course_verlet;
    Precision precision = Precision::single_precision;
    double frames_per_second = 90;
    int substeps = 30;         ///< steps per frame
    int iterations = 10;       ///< of methods that sweep over springs or points, per step
    double tolerance = 1e-6;   ///< of methods that iterate or choose their step until they are accurate enough
    double pbd_stiffness = 1;  ///< k of position based dynamics, 0 to 1
    double spring_damping = 0; ///< N s/m, of XPBD: against the change of a spring's length
    FirstGuess first_guess = FirstGuess::inertia; ///< of vertex block descent
    double acceleration = 0;         ///< rho of vertex block descent's Chebyshev acceleration, 0 (none) to below 1
    double seed = 0;                 ///< of the vertical cloth's random offsets; a whole number below 2^53
    Vec3 gravity{0, -9.8, 0};        ///< m/s²
    std::vector<Vec3> accelerations; ///< m/s², further ones
    bool operator==(const Stepping&) const = default;
};

/// All that determines a run, to the last bit.
struct Description {
    Cloth cloth;
    std::vector<Collider> colliders;
    Wind wind;
    Rules rules;
    Stepping stepping;
    bool operator==(const Description&) const = default;
};

/// The length of one step in s.
double step_length(const Description& description);
/// The mass of one point in kg: the cloth's mass shared out evenly.
double point_mass(const Cloth& cloth);
/// Whether a running simulation of one can take over the other between two steps; if not (another grid, start or
/// precision) it has to start anew.
bool can_change_live(const Description& from, const Description& to);

} // namespace clothlab::sim

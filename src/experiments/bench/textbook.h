// The course's cloth simulator as its handout and most solutions of it have it: an array of structs in double
// precision, a list of springs that point to their ends, and a hash map of vectors for the self-collision. It computes
// what docs/simulation.md says, in the same order of operations, so its bits are those of sim::Simulation in double
// precision: what the bench compares is cost alone. Nothing in it is slower than that design makes it: no virtual calls
// and no copies in the loops, constants taken out of them, and the same compiler options as for all the rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "sim/description.h"
#include "sim/grid.h"
#include "sim/state.h"
#include "sim/step.h"

namespace clothlab::experiments {

class Textbook {
public:
    /// Starts a run at time 0. Throws std::invalid_argument for wind, for another integrator than the course's, and for
    /// what has no meaning.
    explicit Textbook(const sim::Description& description);
    Textbook(const Textbook&) = delete; // the springs point into it
    Textbook& operator=(const Textbook&) = delete;

    sim::StepCounts step();

    std::size_t points() const { return point_masses_.size(); }
    std::size_t springs() const { return springs_.size(); }
    sim::Vec3 position(std::size_t point) const;
    /// Puts all points at these places, moving as if they had been at `last` one step earlier.
    void place(std::span<const sim::Vec3> position, std::span<const sim::Vec3> last);

    /// Measures wall time per stage from now on; the sums start at zero.
    void time_stages(bool on);
    const sim::StageSeconds& stage_seconds() const { return seconds_; }

    /// Bytes that the run holds; of the map, what its nodes and vectors ask the allocator for.
    std::size_t memory_bytes() const;
    /// How many points share a cell of the self-collision with a point, itself included, on average over the points.
    double points_per_cell();

private:
    struct Vector3 {
        double x = 0, y = 0, z = 0;
        friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
        friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
        friend Vector3 operator*(double s, Vector3 v) { return {s * v.x, s * v.y, s * v.z}; }
        friend Vector3 operator/(Vector3 v, double s) { return {v.x / s, v.y / s, v.z / s}; }
        Vector3& operator+=(Vector3 v) { return *this = *this + v; }
        Vector3& operator-=(Vector3 v) { return *this = *this - v; }
    };
    struct PointMass {
        bool pinned = false;
        Vector3 start, position, last_position, forces;
    };
    struct Spring {
        PointMass *a, *b;
        double rest;
        sim::SpringKind kind;
    };
    struct Cell {
        double x, y, z; ///< whole numbers
        bool operator==(const Cell&) const = default;
    };
    struct CellHash {
        std::size_t operator()(const Cell& cell) const noexcept;
    };
    struct Plane {
        Vector3 point, normal; ///< of length one
        double friction;
    };

    static double length(Vector3 v);
    static double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    static Vector3 vector(const sim::Vec3& v) { return {v.x, v.y, v.z}; }
    void build_grid();
    void build_colliders();
    void add_forces();
    void integrate();
    void build_cells();
    Cell cell_of(Vector3 position) const;
    std::size_t collide_with_itself();
    bool collide(const sim::Sphere& sphere, PointMass& pm) const;
    bool collide(const Plane& plane, PointMass& pm) const;
    std::array<std::size_t, 2> collide_with_objects(); ///< contacts with spheres, planes
    std::size_t limit_stretch();

    sim::Description description_;
    std::vector<PointMass> point_masses_;
    std::vector<Spring> springs_;
    std::vector<std::variant<sim::Sphere, Plane>> objects_;
    std::unordered_map<Cell, std::vector<PointMass*>, CellHash> map_;
    double width_of_cell_, height_of_cell_, depth_of_cell_;
    sim::StageSeconds seconds_{};
    bool timed_ = false;
};

} // namespace clothlab::experiments

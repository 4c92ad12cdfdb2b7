// The course's cloth simulator as its handout and most solutions of it have it: an array of structs in double
// precision, a list of springs that point to their ends, and a hash map of vectors for the self-collision. It computes
// what docs/simulation.md says, in the same order of operations, so its bits are those of sim::Simulation in double
// precision: what the bench compares is cost alone. Nothing in it is slower than that design makes it: no virtual calls
// and no copies in the loops, constants taken out of them, and the same compiler options as for all the rest. The map
// alone, which takes most of a step, comes in two forms: the handout's and the fastest that we know for that design.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "sim/description.h"
#include "sim/grid.h"
#include "sim/state.h"
#include "sim/step.h"

namespace clothlab::experiments {

/// How the points of a cell are found.
enum class CellMap : std::uint8_t {
    fast, ///< by the cell, which is looked up once where a point is put in and once where it is pushed
    /// By a number that a cell is hashed to, in vectors that are allocated one by one: the types are those of the
    /// handout's skeleton, and the map is asked as often as most public solutions ask it. Cells that share a number are
    /// too far apart for their points to touch, unless cloth is thicker than 15 cells, or some 17000 cells away from
    /// the origin, where a float no longer tells neighbours apart.
    handout,
};

class Textbook {
public:
    /// Starts a run at time 0. Throws std::invalid_argument for wind, for another integrator than the course's, and for
    /// what has no meaning.
    explicit Textbook(const sim::Description& description, CellMap cells = CellMap::fast);
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
    class FastCells {
    public:
        void clear() { map_.clear(); }
        void add(const Cell& cell, PointMass* pm) { map_[cell].push_back(pm); }
        /// Null where there is none, as for a cell that is not a number: it equals none.
        const std::vector<PointMass*>* find(const Cell& cell) const;
        std::size_t memory_bytes() const;
        double sum_of_squares() const; ///< of the numbers of points in the cells

    private:
        std::unordered_map<Cell, std::vector<PointMass*>, CellHash> map_;
    };
    class HandoutCells {
    public:
        void clear() { map_.clear(); }
        void add(const Cell& cell, PointMass* pm);
        const std::vector<PointMass*>* find(const Cell& cell);
        std::size_t memory_bytes() const;

    private:
        static float key(const Cell& cell);
        std::unordered_map<float, std::unique_ptr<std::vector<PointMass*>>> map_;
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
    Cell cell_of(Vector3 position) const;
    template <class Cells>
    void sort_into(Cells& cells);
    template <class Cells>
    std::size_t collide_with_itself(Cells& cells);
    bool collide(const sim::Sphere& sphere, PointMass& pm) const;
    bool collide(const Plane& plane, PointMass& pm) const;
    std::array<std::size_t, 2> collide_with_objects(); ///< contacts with spheres, planes
    std::size_t limit_stretch();

    sim::Description description_;
    std::vector<PointMass> point_masses_;
    std::vector<Spring> springs_;
    std::vector<std::variant<sim::Sphere, Plane>> objects_;
    CellMap which_cells_;
    FastCells fast_cells_;
    HandoutCells handout_cells_;
    double width_of_cell_, height_of_cell_, depth_of_cell_;
    sim::StageSeconds seconds_{};
    bool timed_ = false;
};

} // namespace clothlab::experiments

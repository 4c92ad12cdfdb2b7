#include "experiments/bench/textbook.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "sim/random.h"

namespace clothlab::experiments {
namespace {

using Clock = std::chrono::steady_clock;

/// Runs a stage, and adds the time it takes to `seconds` where that is asked for.
template <class Work>
auto staged(sim::StageSeconds& seconds, bool timed, sim::Stage stage, Work work) {
    const Clock::time_point start = timed ? Clock::now() : Clock::time_point();
    const auto result = work();
    if (timed)
        seconds[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(Clock::now() - start).count();
    return result;
}

} // namespace

Textbook::Textbook(const sim::Description& description, CellMap cells)
    : description_(description), which_cells_(cells) {
    const sim::Cloth& cloth = description.cloth;
    if (description.wind.kind != sim::WindKind::none)
        throw std::invalid_argument("the textbook's simulator has no wind");
    if (description.stepping.integrator != sim::IntegratorId::course_verlet)
        throw std::invalid_argument("the textbook's simulator has the course's integrator only");
    if (cloth.num_width_points < 2 || cloth.num_height_points < 2 || !(cloth.width > 0) || !(cloth.height > 0))
        throw std::invalid_argument("a cloth needs a size and at least two points along its width and its height");
    if (cloth.density == 0 || description.stepping.substeps < 1 || !(description.stepping.frames_per_second > 0))
        throw std::invalid_argument("density, substeps and frame rate may not be zero");
    build_grid();
    build_colliders();
    width_of_cell_ = 3.0 * cloth.width / cloth.num_width_points;
    height_of_cell_ = 3.0 * cloth.height / cloth.num_height_points;
    depth_of_cell_ = std::max(width_of_cell_, height_of_cell_);
}

void Textbook::build_grid() {
    const sim::Cloth& cloth = description_.cloth;
    const int columns = cloth.num_width_points, rows = cloth.num_height_points;
    const double dx = cloth.width / (columns - 1), dy = cloth.height / (rows - 1);
    const bool vertical = cloth.orientation == sim::Orientation::vertical;
    const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);

    std::vector<double> wrinkle(count, 0.0);
    sim::SplitMix64 random(static_cast<std::uint64_t>(description_.stepping.seed));
    if (vertical)
        for (double& z : wrinkle)
            z = -0.001 + 0.002 * random.unit();

    point_masses_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double across = static_cast<double>(i % static_cast<std::size_t>(columns)) * dx;
        const double along = static_cast<double>(i / static_cast<std::size_t>(columns)) * dy;
        PointMass& pm = point_masses_[i];
        pm.start = Vector3{across, vertical ? along : 1.0, vertical ? wrinkle[i] : along} + vector(cloth.offset);
        pm.position = pm.last_position = pm.start;
    }
    for (const auto [column, row] : cloth.pinned) {
        if (column < 0 || column >= columns || row < 0 || row >= rows)
            throw std::invalid_argument("a pin is outside the grid");
        point_masses_[static_cast<std::size_t>(row * columns + column)].pinned = true;
    }

    const auto tie = [&](int column, int row, int to_column, int to_row, sim::SpringKind kind) {
        if (to_column < 0 || to_column >= columns || to_row < 0)
            return;
        const auto a = static_cast<std::size_t>(row * columns + column);
        const auto b = static_cast<std::size_t>(to_row * columns + to_column);
        const Vector3 apart{std::abs(column - to_column) * dx, std::abs(row - to_row) * dy, wrinkle[b] - wrinkle[a]};
        springs_.push_back({&point_masses_[a], &point_masses_[b], length(apart), kind});
    };
    springs_.reserve(6 * count);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            tie(column, row, column, row - 1, sim::SpringKind::structural);
            tie(column, row, column - 1, row, sim::SpringKind::structural);
            tie(column, row, column - 1, row - 1, sim::SpringKind::shear);
            tie(column, row, column + 1, row - 1, sim::SpringKind::shear);
            tie(column, row, column - 2, row, sim::SpringKind::bending);
            tie(column, row, column, row - 2, sim::SpringKind::bending);
        }
    }
}

void Textbook::build_colliders() {
    for (const sim::Collider& collider : description_.colliders) {
        if (const auto* sphere = std::get_if<sim::Sphere>(&collider)) {
            objects_.emplace_back(*sphere);
            continue;
        }
        const auto& plane = std::get<sim::Plane>(collider);
        // By its largest component first, as sim/model.cpp does it: a unit normal's last bit depends on it.
        const Vector3 n = vector(plane.normal);
        const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
        if (!(largest > 0))
            throw std::invalid_argument("a plane needs a normal that is not zero");
        const Vector3 scaled = n / largest;
        objects_.emplace_back(Plane{vector(plane.point), scaled / length(scaled), plane.friction});
    }
}

double Textbook::length(Vector3 v) {
    return std::sqrt(dot(v, v));
}

void Textbook::add_forces() {
    const sim::Cloth& cloth = description_.cloth;
    Vector3 acceleration = vector(description_.stepping.gravity);
    for (const sim::Vec3& further : description_.stepping.accelerations)
        acceleration += vector(further);
    const Vector3 external = sim::point_mass(cloth) * acceleration;
    for (PointMass& pm : point_masses_)
        pm.forces = external;

    const double ks = cloth.ks, bending_ks = sim::bending_share * cloth.ks;
    for (const Spring& spring : springs_) {
        double k = ks;
        switch (spring.kind) {
        case sim::SpringKind::structural:
            if (!cloth.enable_structural)
                continue;
            break;
        case sim::SpringKind::shear:
            if (!cloth.enable_shearing)
                continue;
            break;
        case sim::SpringKind::bending:
            if (!cloth.enable_bending)
                continue;
            k = bending_ks;
            break;
        }
        const Vector3 d = spring.b->position - spring.a->position;
        const double distance = length(d);
        if (!(distance > 0))
            continue;
        const Vector3 force = (k * (distance - spring.rest) / distance) * d;
        spring.a->forces += force;
        spring.b->forces -= force;
    }
}

void Textbook::integrate() {
    const double dt = sim::step_length(description_), c = dt * dt / sim::point_mass(description_.cloth);
    const double keep = 1.0 - description_.cloth.damping / 100.0;
    for (PointMass& pm : point_masses_) {
        if (pm.pinned)
            continue;
        const Vector3 next = pm.position + keep * (pm.position - pm.last_position) + c * pm.forces;
        pm.last_position = pm.position;
        pm.position = next;
    }
}

std::size_t Textbook::CellHash::operator()(const Cell& cell) const noexcept {
    // The lower halves of small whole numbers are zero. Of six hashes tried, those that give neighbouring cells near
    // buckets were the fastest.
    const auto upper = [](double v) { return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(v) >> 32); };
    return (upper(cell.x) * 31 + upper(cell.y)) * 31 + upper(cell.z);
}

Textbook::Cell Textbook::cell_of(Vector3 p) const {
    // Adding zero turns -0 into 0: they are the same cell but not the same bits.
    return {std::floor(p.x / width_of_cell_) + 0.0, std::floor(p.y / height_of_cell_) + 0.0,
            std::floor(p.z / depth_of_cell_) + 0.0};
}

const std::vector<Textbook::PointMass*>* Textbook::FastCells::find(const Cell& cell) const {
    const auto found = map_.find(cell);
    return found == map_.end() ? nullptr : &found->second;
}

std::size_t Textbook::FastCells::memory_bytes() const {
    std::size_t bytes = map_.bucket_count() * sizeof(void*);
    for (const auto& cell : map_) // a node: the next one, the hash, the cell and its vector
        bytes += 2 * sizeof(void*) + sizeof cell + cell.second.capacity() * sizeof(PointMass*);
    return bytes;
}

double Textbook::FastCells::sum_of_squares() const {
    std::size_t sum = 0;
    for (const auto& cell : map_)
        sum += cell.second.size() * cell.second.size();
    return static_cast<double>(sum);
}

float Textbook::HandoutCells::key(const Cell& cell) {
    return static_cast<float>((cell.x * 31 + cell.y) * 31 + cell.z);
}

void Textbook::HandoutCells::add(const Cell& cell, PointMass* pm) {
    const float number = key(cell);
    if (std::isnan(number)) // equals none, not even that which was just put in
        return;
    if (map_.find(number) == map_.end())
        map_[number] = std::make_unique<std::vector<PointMass*>>();
    map_[number]->push_back(pm);
}

const std::vector<Textbook::PointMass*>* Textbook::HandoutCells::find(const Cell& cell) {
    const float number = key(cell);
    return map_.find(number) == map_.end() ? nullptr : map_[number].get();
}

std::size_t Textbook::HandoutCells::memory_bytes() const {
    std::size_t bytes = map_.bucket_count() * sizeof(void*);
    for (const auto& cell : map_)
        bytes += 2 * sizeof(void*) + sizeof cell + sizeof *cell.second + cell.second->capacity() * sizeof(PointMass*);
    return bytes;
}

template <class Cells>
void Textbook::sort_into(Cells& cells) {
    cells.clear();
    for (PointMass& pm : point_masses_)
        cells.add(cell_of(pm.position), &pm);
}

template <class Cells>
std::size_t Textbook::collide_with_itself(Cells& cells) {
    sort_into(cells);
    const double apart = 2.0 * description_.cloth.thickness;
    std::size_t pairs = 0;
    for (PointMass& pm : point_masses_) {
        if (pm.pinned)
            continue;
        const std::vector<PointMass*>* cell = cells.find(cell_of(pm.position));
        if (!cell)
            continue;
        Vector3 sum;
        int count = 0;
        for (const PointMass* other : *cell) {
            if (other == &pm)
                continue;
            const Vector3 d = pm.position - other->position;
            const double distance = length(d);
            if (!(distance < apart) || distance == 0)
                continue;
            sum += ((apart - distance) / distance) * d;
            ++count;
        }
        if (count == 0)
            continue;
        pm.position += sum / (static_cast<double>(count) * description_.stepping.substeps);
        pairs += static_cast<std::size_t>(count);
    }
    return pairs;
}

bool Textbook::collide(const sim::Sphere& sphere, PointMass& pm) const {
    const Vector3 origin = vector(sphere.origin), d = pm.position - origin;
    const double distance = length(d);
    if (!(distance <= sphere.radius) || distance == 0)
        return false;
    const Vector3 surface = origin + (sphere.radius / distance) * d;
    pm.position = pm.last_position + (1.0 - sphere.friction) * (surface - pm.last_position);
    return true;
}

bool Textbook::collide(const Plane& plane, PointMass& pm) const {
    const double after = dot(pm.position - plane.point, plane.normal);
    const double before = dot(pm.last_position - plane.point, plane.normal);
    const bool from_above = before >= 0;
    if (from_above ? !(after <= 0) : !(after >= 0))
        return false;
    const double offset = from_above ? 1e-4 : -1e-4;
    const Vector3 target = (pm.position - after * plane.normal) + offset * plane.normal;
    pm.position = pm.last_position + (1.0 - plane.friction) * (target - pm.last_position);
    return true;
}

std::array<std::size_t, 2> Textbook::collide_with_objects() {
    std::array<std::size_t, 2> contacts{};
    for (const auto& object : objects_) {
        std::visit(
            [&](const auto& shape) {
                for (PointMass& pm : point_masses_)
                    if (!pm.pinned)
                        contacts[object.index()] += collide(shape, pm) ? 1u : 0u;
            },
            object);
    }
    return contacts;
}

std::size_t Textbook::limit_stretch() {
    std::size_t shortened = 0;
    for (const Spring& spring : springs_) {
        PointMass &a = *spring.a, &b = *spring.b;
        const Vector3 d = b.position - a.position;
        const double distance = length(d), longest = 1.1 * spring.rest;
        if (!(distance > longest) || (a.pinned && b.pinned))
            continue;
        const double s = (distance - longest) / distance;
        const Vector3 correction = (a.pinned || b.pinned ? s : 0.5 * s) * d;
        if (!a.pinned)
            a.position += correction;
        if (!b.pinned)
            b.position -= correction;
        ++shortened;
    }
    return shortened;
}

sim::StepCounts Textbook::step() {
    const auto run = [this](sim::Stage stage, auto work) { return staged(seconds_, timed_, stage, work); };
    sim::StepCounts counts;
    run(sim::Stage::forces, [this] { return add_forces(), 0; });
    run(sim::Stage::integrate, [this] { return integrate(), 0; });
    if (description_.rules.self_collision == sim::SelfCollisionRule::cs184)
        counts.self_contacts = run(sim::Stage::self_collision, [this] {
            return which_cells_ == CellMap::fast ? collide_with_itself(fast_cells_)
                                                 : collide_with_itself(handout_cells_);
        });
    if (!objects_.empty()) {
        const auto [spheres, planes] = run(sim::Stage::colliders, [this] { return collide_with_objects(); });
        counts.sphere_contacts = spheres;
        counts.plane_contacts = planes;
        counts.contacts = spheres + planes;
    }
    if (description_.rules.limit == sim::LimitRule::cs184)
        counts.shortened_springs = run(sim::Stage::limit, [this] { return limit_stretch(); });
    return counts;
}

sim::Vec3 Textbook::position(std::size_t point) const {
    const Vector3 p = point_masses_[point].position;
    return {p.x, p.y, p.z};
}

void Textbook::place(std::span<const sim::Vec3> position, std::span<const sim::Vec3> last) {
    if (position.size() != points() || last.size() != points())
        throw std::invalid_argument("as many places as points are needed");
    for (std::size_t i = 0; i < points(); ++i) {
        point_masses_[i].position = vector(position[i]);
        point_masses_[i].last_position = vector(last[i]);
    }
}

void Textbook::time_stages(bool on) {
    timed_ = on;
    seconds_ = {};
}

std::size_t Textbook::memory_bytes() const {
    return point_masses_.capacity() * sizeof(PointMass) + springs_.capacity() * sizeof(Spring) +
           fast_cells_.memory_bytes() + handout_cells_.memory_bytes();
}

double Textbook::points_per_cell() {
    FastCells cells;
    sort_into(cells);
    return cells.sum_of_squares() / static_cast<double>(points());
}

} // namespace clothlab::experiments

// The course's simulator a second time: plain, slow, written from docs/simulation.md and ../shared/DESIGN.md alone.
//
// It shares no code with src/, not even its structs, so that a misreading in one of the two shows as a difference
// in bits. Keep it that way: when docs/simulation.md changes, change this from the page, not from src/sim.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace reference {

template <class Real>
struct Vector {
    Real x{}, y{}, z{};

    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(Real s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
    friend Vector operator*(Vector a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Vector operator/(Vector a, Real s) { return {a.x / s, a.y / s, a.z / s}; }
    friend bool operator==(const Vector&, const Vector&) = default;
};

template <class Real>
Real dot(Vector<Real> a, Vector<Real> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Real length(Vector<Real> a) {
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}
template <class Real>
Vector<Real> cross(Vector<Real> a, Vector<Real> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Vector3 = Vector<double>;

/// Rounds each coordinate once.
template <class Real>
Vector<Real> rounded(Vector3 v) {
    return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

/// Sebastiano Vigna's SplitMix64, public domain (https://prng.di.unimi.it/splitmix64.c).
class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

private:
    std::uint64_t state_;
};

enum class Wind { none, course_with_step, course_with_time, physical };

struct Collider {
    bool is_sphere = true;
    Vector3 place;     // the sphere's origin or a point of the plane, m
    Vector3 normal;    // plane only, any length
    double radius = 0; // sphere only, m
    double friction = 0;
};

/// SI units but for damping, which is in percent per substep as the course has it.
struct Parameters {
    double width = 1, height = 1;
    int columns = 50, rows = 50;
    double thickness = 0.0095;
    bool vertical = false;
    double ks = 5000;
    double density = 150;
    double damping_percent = 0.2;
    bool structural = true, shear = true, bending = true;
    std::vector<std::array<int, 2>> pinned; // column, row
    Vector3 offset;
    std::uint64_t seed = 0;

    double frames_per_second = 90;
    int substeps = 30;
    Vector3 gravity{0, -9.8, 0};
    std::vector<Vector3> further_accelerations;
    bool self_collision = true;
    bool stretch_limit = true;
    std::vector<Collider> colliders;

    Wind wind = Wind::none;
    Vector3 wind_velocity;
    double air_density = 1.2, drag = 1, lift = 0, gust = 0, gust_period = 1;
};

template <class Real>
struct Mass {
    Vector<Real> x, previous, force;
    bool pinned = false;
};

enum class Kind { structural, shear, bending };

template <class Real>
struct Spring {
    Kind kind{};
    std::size_t a = 0, b = 0;
    Real rest{};
};

/// How often each stage did something since the start.
struct Acted {
    std::size_t self_contacts = 0;     // pairs, counted from both sides
    std::size_t contacts = 0;          // points put out of a collider
    std::size_t shortened_springs = 0; // by the stretch limit
};

template <class Real>
class Simulator {
public:
    explicit Simulator(const Parameters& p) : parameters(p) {
        place_masses();
        connect_springs();
    }

    void step() {
        gather_forces();
        verlet();
        if (parameters.self_collision)
            collide_with_itself();
        for (const Collider& collider : parameters.colliders) {
            for (Mass<Real>& mass : masses) {
                if (mass.pinned)
                    continue;
                if (collider.is_sphere) {
                    collide_with_sphere(mass, collider);
                } else {
                    collide_with_plane(mass, collider);
                }
            }
        }
        if (parameters.stretch_limit)
            limit_stretch();
        time_ += dt();
    }

    void frame() {
        for (int i = 0; i < parameters.substeps; ++i)
            step();
    }

    /// Parameters other than the grid's may be changed between steps.
    void change(const Parameters& p) {
        parameters = p;
        pin_masses();
    }

    double dt() const { return 1.0 / parameters.frames_per_second / parameters.substeps; }
    double time() const { return time_; }
    double mass_in_double() const {
        return parameters.width * parameters.height * parameters.density / (parameters.columns * parameters.rows);
    }

    Parameters parameters;
    std::vector<Mass<Real>> masses;
    std::vector<Spring<Real>> springs;
    Acted acted;

private:
    using V = Vector<Real>;

    void place_masses() {
        const Parameters& p = parameters;
        const double dx = p.width / (p.columns - 1);
        const double dy = p.height / (p.rows - 1);
        SplitMix64 random(p.seed);
        for (int j = 0; j < p.rows; ++j) {
            for (int i = 0; i < p.columns; ++i) {
                Vector3 place{i * dx, 1.0, j * dy};
                double z = 0;
                if (p.vertical) {
                    z = -0.001 + 0.002 * random.unit();
                    place = {i * dx, j * dy, z};
                }
                random_z_.push_back(z);
                Mass<Real> mass;
                mass.x = rounded<Real>(place + p.offset);
                mass.previous = mass.x;
                masses.push_back(mass);
            }
        }
        pin_masses();
    }

    void pin_masses() {
        for (Mass<Real>& mass : masses)
            mass.pinned = false;
        for (const auto& [column, row] : parameters.pinned)
            masses[index(column, row)].pinned = true;
    }

    void connect_springs() {
        for (int j = 0; j < parameters.rows; ++j) {
            for (int i = 0; i < parameters.columns; ++i) {
                connect(Kind::structural, i, j, i, j - 1);
                connect(Kind::structural, i, j, i - 1, j);
                connect(Kind::shear, i, j, i - 1, j - 1);
                connect(Kind::shear, i, j, i + 1, j - 1);
                connect(Kind::bending, i, j, i - 2, j);
                connect(Kind::bending, i, j, i, j - 2);
            }
        }
    }

    void connect(Kind kind, int i, int j, int other_i, int other_j) {
        if (other_i < 0 || other_i >= parameters.columns || other_j < 0)
            return;
        const std::size_t a = index(i, j);
        const std::size_t b = index(other_i, other_j);
        const double gx = std::abs(other_i - i) * (parameters.width / (parameters.columns - 1));
        const double gy = std::abs(other_j - j) * (parameters.height / (parameters.rows - 1));
        const double gz = random_z_[b] - random_z_[a];
        springs.push_back({kind, a, b, static_cast<Real>(std::sqrt(gx * gx + gy * gy + gz * gz))});
    }

public:
    void gather_forces() {
        const Parameters& p = parameters;
        Vector3 acceleration = p.gravity;
        for (const Vector3& further : p.further_accelerations)
            acceleration = acceleration + further;
        const V g = rounded<Real>(acceleration);
        const Real m = static_cast<Real>(mass_in_double());
        for (Mass<Real>& mass : masses)
            mass.force = m * g;

        for (const Spring<Real>& spring : springs) {
            const bool enabled = spring.kind == Kind::structural ? p.structural
                                 : spring.kind == Kind::shear    ? p.shear
                                                                 : p.bending;
            if (!enabled)
                continue;
            const Real k = static_cast<Real>(spring.kind == Kind::bending ? 0.2 * p.ks : p.ks);
            const V d = masses[spring.b].x - masses[spring.a].x;
            const Real len = length(d);
            if (!(len > 0))
                continue;
            const Real s = k * (len - spring.rest) / len;
            masses[spring.a].force = masses[spring.a].force + s * d;
            masses[spring.b].force = masses[spring.b].force - s * d;
        }
        if (p.wind == Wind::physical)
            blow_on_triangles();
    }

private:
    /// The page leaves the triangles open; these are quads cut from (i+1, j) to (i, j+1), as the course's mesh has
    /// them.
    void blow_on_triangles() {
        for (int j = 0; j + 1 < parameters.rows; ++j) {
            for (int i = 0; i + 1 < parameters.columns; ++i) {
                blow_on_triangle(index(i, j), index(i, j + 1), index(i + 1, j));
                blow_on_triangle(index(i + 1, j), index(i, j + 1), index(i + 1, j + 1));
            }
        }
    }

    void blow_on_triangle(std::size_t ia, std::size_t ib, std::size_t ic) {
        const Parameters& p = parameters;
        Mass<Real>&a = masses[ia], &b = masses[ib], &c = masses[ic];
        const V air = air_velocity();
        const Real step = static_cast<Real>(dt());
        const V corners = (a.x - a.previous) / step + (b.x - b.previous) / step + (c.x - c.previous) / step;
        const V u = air - corners / Real(3);
        const V doubled = cross(b.x - a.x, c.x - a.x);
        const Real speed = length(u);
        const Real area = length(doubled) / 2;
        if (!(speed > 0) || !(area > 0))
            return;
        const V u_hat = u / speed;
        V n = doubled / length(doubled);
        if (dot(n, u) < 0)
            n = Real(-1) * n;
        const Real pressure = Real(0.5) * static_cast<Real>(p.air_density) * area * dot(n, u_hat) * speed * speed;
        V force = static_cast<Real>(p.drag) * pressure * u_hat;
        const V l = cross(cross(u_hat, n), u_hat);
        force = force + static_cast<Real>(p.lift) * pressure * l;
        for (Mass<Real>* corner : {&a, &b, &c})
            corner->force = corner->force + force / Real(3);
    }

    V air_velocity() const {
        const double pi = 3.141592653589793;
        double s = 0;
        for (const double ratio : {1.0, 0.618, 0.377}) {
            s += std::sin(2 * pi * time() / (parameters.gust_period * ratio)) / 3;
        }
        return rounded<Real>(parameters.wind_velocity * (1 + parameters.gust * s));
    }

    void verlet() {
        const Real step = static_cast<Real>(dt());
        const Real dt2 = step * step;
        const Real c = dt2 / static_cast<Real>(mass_in_double());
        const Real keep = static_cast<Real>(1.0 - parameters.damping_percent / 100.0);
        for (Mass<Real>& mass : masses) {
            if (mass.pinned)
                continue;
            V moved = mass.x + keep * (mass.x - mass.previous) + mass.force * c;
            if (parameters.wind == Wind::course_with_step || parameters.wind == Wind::course_with_time) {
                const Real factor = Real(0.7) * dt2;
                moved = moved - factor * (course_wind(mass.x) + course_resistance(mass));
            }
            mass.previous = mass.x;
            mass.x = moved;
        }
    }

    V course_wind(V at) const {
        const Real t = static_cast<Real>(parameters.wind == Wind::course_with_step ? dt() : time());
        return {std::sin(at.x * at.y * t), Real(1.2) * std::cos(Real(5) * at.z * t),
                Real(1.5) * (std::sin(std::cos(Real(5) * at.x * at.y * at.z)) + at.y / Real(1.5))};
    }

    V course_resistance(const Mass<Real>& mass) const {
        const V v = (mass.x - mass.previous) / static_cast<Real>(dt());
        const Real m = static_cast<Real>(mass_in_double());
        return Real(0.5) * length(mass.force / m) * length(v) * v;
    }

    using Cell = std::array<long long, 3>;

public:
    void collide_with_itself() {
        const double width = 3 * parameters.width / parameters.columns;
        const double height = 3 * parameters.height / parameters.rows;
        const Real w = static_cast<Real>(width);
        const Real h = static_cast<Real>(height);
        const Real t = static_cast<Real>(std::max(width, height));
        const auto cell_of = [&](V at) {
            return Cell{static_cast<long long>(std::floor(at.x / w)), static_cast<long long>(std::floor(at.y / h)),
                        static_cast<long long>(std::floor(at.z / t))};
        };
        std::map<Cell, std::vector<std::size_t>> cells;
        for (std::size_t i = 0; i < masses.size(); ++i)
            cells[cell_of(masses[i].x)].push_back(i);

        const Real reach = Real(2) * static_cast<Real>(parameters.thickness);
        for (std::size_t i = 0; i < masses.size(); ++i) {
            if (masses[i].pinned)
                continue;
            V sum;
            long count = 0;
            for (const std::size_t q : cells.at(cell_of(masses[i].x))) {
                if (q == i)
                    continue;
                const V d = masses[i].x - masses[q].x;
                const Real len = length(d);
                if (!(len > 0 && len < reach))
                    continue;
                sum = sum + ((reach - len) / len) * d;
                ++count;
            }
            if (count == 0)
                continue;
            masses[i].x = masses[i].x + sum / static_cast<Real>(count * parameters.substeps);
            acted.self_contacts += static_cast<std::size_t>(count);
        }
    }

private:
    void collide_with_sphere(Mass<Real>& mass, const Collider& sphere) {
        const V origin = rounded<Real>(sphere.place);
        const Real radius = static_cast<Real>(sphere.radius);
        const V d = mass.x - origin;
        const Real len = length(d);
        if (!(len > 0 && len <= radius))
            return;
        const V surface = origin + (radius / len) * d;
        mass.x = mass.previous + static_cast<Real>(1.0 - sphere.friction) * (surface - mass.previous);
        ++acted.contacts;
    }

    void collide_with_plane(Mass<Real>& mass, const Collider& plane) {
        const V n = rounded<Real>(plane.normal / length(plane.normal));
        const V point = rounded<Real>(plane.place);
        const Real after = dot(mass.x - point, n);
        const Real before = dot(mass.previous - point, n);
        const bool from_above = before >= 0;
        const bool stays = from_above ? after > 0 : after < 0;
        if (stays)
            return;
        const Real e = static_cast<Real>(from_above ? 0.0001 : -0.0001);
        const V target = (mass.x - after * n) + e * n;
        mass.x = mass.previous + static_cast<Real>(1.0 - plane.friction) * (target - mass.previous);
        ++acted.contacts;
    }

    void limit_stretch() {
        for (const Spring<Real>& spring : springs) {
            Mass<Real>& a = masses[spring.a];
            Mass<Real>& b = masses[spring.b];
            const V d = b.x - a.x;
            const Real len = length(d);
            const Real longest = Real(1.1) * spring.rest;
            if (!(len > longest))
                continue;
            const Real s = (len - longest) / len;
            if (!a.pinned && !b.pinned) {
                a.x = a.x + (Real(0.5) * s) * d;
                b.x = b.x - (Real(0.5) * s) * d;
            } else if (!a.pinned) {
                a.x = a.x + s * d;
            } else if (!b.pinned) {
                b.x = b.x - s * d;
            }
            if (!a.pinned || !b.pinned)
                ++acted.shortened_springs;
        }
    }

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(parameters.columns) +
               static_cast<std::size_t>(column);
    }

    std::vector<double> random_z_;
    double time_ = 0;
};

} // namespace reference

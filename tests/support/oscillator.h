// An exact oscillator made of cloth: two columns and two rows, structural springs only, the first row pinned, the
// second moving along the columns, so that both columns are one linear spring with a mass at its end. The cloth is a
// kilometre wide: that the columns move apart by rounding stretches no spring between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/methods.h"

namespace clothlab::test {

/// `rows` masses below a pinned row, in two equal columns, and omega dt = y for a single one: ks = (y/dt)² m.
inline sim::Description column(int rows, double y, const sim::IntegratorInfo& method) {
    sim::Description description = bare_cloth(2, rows + 1);
    description.cloth.width = 1000;
    description.cloth.height = rows;
    description.cloth.enable_shearing = description.cloth.enable_bending = false;
    description.cloth.pinned = {{0, 0}, {1, 0}};
    description.stepping.frames_per_second = 64;
    description.stepping.substeps = 1;
    const double rate = y / sim::step_length(description);
    description.cloth.ks = rate * rate * sim::point_mass(description.cloth);
    solve_exactly(description, method);
    return description;
}

/// How far row `row` has moved along the columns, in rest lengths, in the mean of both columns.
inline double displacement(const Sheet<double>& sheet, int row) {
    const std::size_t a = sheet.at(0, row), b = sheet.at(1, row);
    return 0.5 * ((sheet.position(a).z - sheet.start.z[a]) + (sheet.position(b).z - sheet.start.z[b]));
}

/// Moves a row along the columns, at rest.
inline void displace(Sheet<double>& sheet, int row, double by) {
    for (const std::size_t i : {sheet.at(0, row), sheet.at(1, row)}) {
        const sim::Vec3 x = Sheet<double>::coordinates(sheet.start, i);
        sheet.place(i, {x.x, x.y, x.z + by});
    }
}

/// What a step does to an oscillation: the roots of x(n+1) = sum x(n) - product x(n-1).
struct Propagation {
    double half_sum, product, discriminant; ///< roots: half_sum +- sqrt(discriminant)

    double modulus() const {
        return discriminant < 0 ? std::sqrt(product) : std::abs(half_sum) + std::sqrt(discriminant);
    }
    double argument() const { return std::atan2(std::sqrt(std::max(0.0, -discriminant)), half_sum); }
};

/// Fits the recurrence to a series by least squares, as x(n+1) - 2 x(n) + x(n-1) = alpha x(n) + beta (x(n) - x(n-1)),
/// which loses no digits where the steps are small.
inline Propagation fit(const std::vector<double>& x) {
    double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
    for (std::size_t n = 1; n + 1 < x.size(); ++n) {
        const double a = x[n], b = x[n] - x[n - 1], c = (x[n + 1] - x[n]) - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ac += a * c;
        bc += b * c;
    }
    const double determinant = aa * bb - ab * ab;
    const double alpha = (ac * bb - bc * ab) / determinant, beta = (bc * aa - ac * ab) / determinant;
    return {1 + (alpha + beta) / 2, 1 + beta, alpha + (alpha + beta) * (alpha + beta) / 4};
}

/// Runs a series: `next` takes a step and gives the new displacement. The first steps of a method that looks back are
/// left out: its further root, 1/3 or less for BDF2, has to die out first. Stops where the motion has grown beyond what
/// a spring can follow or is lost in rounding.
template <class Next>
std::vector<double> series(const sim::IntegratorInfo& method, double start, int steps, Next next) {
    std::vector<double> x{start};
    double largest = std::abs(start);
    for (int n = 1, skip = method.history ? 36 : 0; n <= steps + skip; ++n) {
        const double value = next();
        if (n <= skip) {
            x[0] = value;
            largest = std::abs(value);
            continue;
        }
        x.push_back(value);
        largest = std::max(largest, std::abs(value));
        const double now = std::max(std::abs(value), std::abs(x[x.size() - 2]));
        if (x.size() > 3 && (now > 0.3 || now < 1e-3 * largest))
            break;
    }
    return x;
}

inline Propagation propagation(const sim::IntegratorInfo& method, double y, double course_damping = 0,
                               int steps = 400) {
    sim::Description description = column(1, y, method);
    description.cloth.damping = 100 * course_damping;
    Sheet<double> sheet(description);
    displace(sheet, 1, 0.01);
    return fit(series(method, 0.01, steps, [&] {
        sheet.step();
        return displacement(sheet, 1);
    }));
}

} // namespace clothlab::test

// Products with the springs' second derivative, against differences of their forces.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>

#include "sim/forces/springs.h"
#include "sim/implicit/spring_hessian.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

using Field = sim::Vec3Array<double>;

/// A cloth at random places, `larger` times its size.
Sheet<double> random_sheet(int set, double larger) {
    sim::Description description = bare_cloth(7, 6);
    description.cloth.enable_structural = (set & 1) != 0;
    description.cloth.enable_shearing = (set & 2) != 0;
    description.cloth.enable_bending = (set & 4) != 0;
    Sheet<double> sheet(description);
    sim::SplitMix64 random(static_cast<std::uint64_t>(set));
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -0.08, 0.08);
        sheet.place(i, {larger * x.x + r.x, larger * x.y + r.y, larger * x.z + r.z});
    }
    return sheet;
}

Field random_field(std::size_t points) {
    Field field;
    field.resize(points);
    sim::SplitMix64 random(11);
    for (std::size_t i = 0; i < points; ++i)
        Sheet<double>::put(field, i, uniform_point(random, -1, 1));
    return field;
}

/// (a I + Hessian) p.
Field product(Sheet<double>& sheet, double a, const Field& p) {
    sim::SpringHessian<double> hessian;
    hessian.resize(sheet.points());
    sim::linearise(sheet.model, sheet.state.position, a, sheet.work, hessian);
    Field out;
    out.resize(sheet.points());
    sim::multiply(sheet.model, hessian, a, p, 0, sheet.points(), out);
    return out;
}

/// Minus the change of the spring forces along p, by central differences.
Field difference(Sheet<double>& sheet, const Field& p) {
    const double h = 1e-6;
    Field forces[2], out;
    for (const int side : {0, 1}) {
        Field x = sheet.state.position;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < x.size(); ++i)
                x.axes()[axis][i] += (side == 0 ? -h : h) * p.axes()[axis][i];
        forces[side].resize(x.size());
        sim::add_spring_forces(sheet.model, x, forces[side]);
    }
    out.resize(p.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < p.size(); ++i)
            out.axes()[axis][i] = -(forces[1].axes()[axis][i] - forces[0].axes()[axis][i]) / (2 * h);
    return out;
}

double largest(const Field& a, const Field* less = nullptr) {
    double result = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < a.size(); ++i)
            result = std::max(result, std::abs(a.axes()[axis][i] - (less ? less->axes()[axis][i] : 0)));
    return result;
}

/// Adds what the Hessian leaves out: of compressed springs, k (1 - L0/L) (I - n nT).
void add_compressed_part(const Sheet<double>& sheet, const Field& p, Field& out) {
    sheet.for_each_pulling_spring([&](std::uint32_t a, std::uint32_t b, std::size_t s) {
        const sim::Vec3 d = minus(sheet.position(b), sheet.position(a));
        const sim::Vec3 u = minus(Sheet<double>::coordinates(p, b), Sheet<double>::coordinates(p, a));
        const double length = norm(d), rest = sheet.model.grid->rest_length(s, a);
        if (length >= rest)
            return;
        const double k = sheet.model.spring_constant(s) * (1 - rest / length), along = dot(u, d) / (length * length);
        const double f[3] = {k * (u.x - along * d.x), k * (u.y - along * d.y), k * (u.z - along * d.z)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            out.axes()[axis][b] += f[axis];
            out.axes()[axis][a] -= f[axis];
        }
    });
}

} // namespace

TEST_CASE("Hessian products are the second derivative of a stretched cloth's energy, for every set of kinds") {
    const int set = GENERATE(range(1, 8));
    Sheet<double> sheet = random_sheet(set, 3); // no spring is compressed
    const Field p = random_field(sheet.points()), exact = difference(sheet, p), found = product(sheet, 0, p);
    REQUIRE(largest(exact) > 100);
    REQUIRE(largest(found, &exact) < 1e-6 * largest(exact));
}

TEST_CASE("Of compressed springs the Hessian leaves out what would make it indefinite, and nothing else") {
    const int set = GENERATE(range(1, 8));
    Sheet<double> sheet = random_sheet(set, 0.8);
    const Field p = random_field(sheet.points()), exact = difference(sheet, p);
    Field found = product(sheet, 0, p);
    double curvature = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < p.size(); ++i)
            curvature += p.axes()[axis][i] * found.axes()[axis][i];
    REQUIRE(curvature > 0);
    REQUIRE(largest(found, &exact) > 1e-3 * largest(exact));
    add_compressed_part(sheet, p, found);
    REQUIRE(largest(found, &exact) < 1e-5 * largest(exact));
}

TEST_CASE("The product adds a multiple of the identity and holds pinned points") {
    Sheet<double> sheet = random_sheet(7, 1.5);
    Field p = random_field(sheet.points());
    const Field without = product(sheet, 0, p), with = product(sheet, 250, p);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double added = with.axes()[axis][i] - without.axes()[axis][i];
            REQUIRE(std::abs(added - 250 * p.axes()[axis][i]) < 1e-9);
        }
    sheet.model.pinned[9] = 1;
    sheet.model.pins = {9};
    REQUIRE(Sheet<double>::coordinates(product(sheet, 250, p), 9) == sim::Vec3{});
}

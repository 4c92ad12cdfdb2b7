// A chain of masses and linear springs hung by both ends in gravity: the discrete elastic catenary, solved by shooting.
// H. M. Irvine, "Cable Structures" (1981), section 1.5, has the continuous one.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>

#include "sim/forces/forces.h"
#include "support/oscillator.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

constexpr int hung_masses = 11;

struct Vec2 {
    double z = 0, y = 0;
};

/// Where the masses hang, from (0, 0) to `end`, and the tension of the first spring. At every mass the tensions and the
/// weight balance, so spring i pulls with (h, v + i weight), and as long as its tension asks for it is.
struct Catenary {
    std::vector<Vec2> points; ///< the last is the end
    double tension = 0;       ///< of the first spring, N

    Catenary(Vec2 end, double rest, double k, double weight) {
        double h = k * rest, v = -0.5 * hung_masses * weight;
        for (int i = 0; i < 100; ++i) { // Newton's method on where the last spring ends; it has a symmetric Jacobian
            double zz = 0, zy = 0, yy = 0;
            hang(h, v, rest, k, weight);
            for (int s = 0; s <= hung_masses; ++s) {
                const double vs = v + s * weight, t = std::hypot(h, vs), z = h / t, y = vs / t;
                zz += rest / t * (1 - z * z) + 1 / k;
                yy += rest / t * (1 - y * y) + 1 / k;
                zy -= rest / t * z * y;
            }
            const double dz = end.z - points.back().z, dy = end.y - points.back().y, d = zz * yy - zy * zy;
            h += (yy * dz - zy * dy) / d;
            v += (zz * dy - zy * dz) / d;
        }
        hang(h, v, rest, k, weight);
        tension = std::hypot(h, v);
    }

private:
    void hang(double h, double v, double rest, double k, double weight) {
        points.clear();
        Vec2 at;
        for (int s = 0; s <= hung_masses; ++s) {
            const double vs = v + s * weight, t = std::hypot(h, vs), length = rest + t / k;
            at = {at.z + length * h / t, at.y + length * vs / t};
            points.push_back(at);
        }
    }
};

/// A chain at its equilibrium; its ends are nearer than it is long, and one is higher.
struct Hanging {
    Sheet<double> sheet;
    Catenary catenary;

    Hanging(const sim::IntegratorInfo& method, double y)
        : sheet(description(method, y)),
          catenary({0.8 * (hung_masses + 1), 2.5}, 1, static_cast<double>(sheet.model.k[0]),
                   -sheet.model.mass * sheet.model.gy) {
        for (int row = 1; row <= hung_masses + 1; ++row)
            for (const std::size_t i : {sheet.at(0, row), sheet.at(1, row)}) {
                const Vec2 x = catenary.points[static_cast<std::size_t>(row - 1)];
                sheet.place(i, {sheet.start.x[i], sheet.start.y[i] + x.y, sheet.start.z[i] - row + x.z});
            }
    }

    static sim::Description description(const sim::IntegratorInfo& method, double y) {
        sim::Description result = column(hung_masses + 1, y, method);
        for (const int c : {0, 1})
            result.cloth.pinned.push_back({c, hung_masses + 1});
        result.stepping.gravity = {0, -0.02 * result.cloth.ks / sim::point_mass(result.cloth), 0};
        result.stepping.iterations = 200;
        return result;
    }
};

} // namespace

TEST_CASE("Forces balance on the discrete elastic catenary") {
    Hanging hanging(sim::integrators()[0], 0.3);
    Sheet<double>& sheet = hanging.sheet;
    sim::evaluate_conservative_forces(sheet.model, sheet.state.position, sheet.work, sheet.work.force);
    double residual = 0, sag = 0;
    for (int row = 1; row <= hung_masses; ++row)
        for (const std::size_t i : {sheet.at(0, row), sheet.at(1, row)}) {
            residual = std::max(residual, norm(Sheet<double>::coordinates(sheet.work.force, i)));
            sag = std::max(sag, sheet.start.y[i] - sheet.position(i).y);
        }
    REQUIRE(sag > 2);
    REQUIRE(hanging.catenary.tension > 0.05 * sheet.model.k[0]);
    INFO(residual / hanging.catenary.tension);
    REQUIRE(residual < 1e-13 * hanging.catenary.tension);
}

TEST_CASE("A chain that hangs in the discrete elastic catenary stays there under every method") {
    const sim::IntegratorInfo method = GENERATE(from_range(sim::integrators().begin(), sim::integrators().end()));
    if (method.order == 0) // its rods do not stretch
        return;
    INFO(method.name);
    const double y = GENERATE(0.02, 0.3);
    if (method.limit(0) == 0 && y > 0.1) // rounding outgrows the chain
        return;
    Hanging hanging(method, y);
    Sheet<double>& sheet = hanging.sheet;
    const sim::Vec3Array<double> before = sheet.state.position;
    for (int n = 0; n < 100; ++n)
        sheet.step();
    double moved = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i)
        moved = std::max(moved, norm(minus(sheet.position(i), Sheet<double>::coordinates(before, i))));
    // XPBD adds up forces along the directions that its iterations come through: it balances where these differ, by a
    // share of y² (xpbd.cpp).
    const bool adds_up = method.family == sim::Family::position_based;
    REQUIRE(moved < (adds_up ? 0.02 * y * y : 1e-11));
}

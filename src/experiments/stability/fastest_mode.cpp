#include "experiments/stability/fastest_mode.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/stability/start_displacement.h"
#include "sim/grid.h"
#include "sim/model.h"
#include "sim/spring_operator.h"

namespace clothlab::experiments {
namespace {

constexpr int most_products = 6000;
/// Of the residual |K v - lambda v| to lambda |v|, at which other modes have become as small.
constexpr double accuracy = 1e-7;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

} // namespace

std::optional<std::vector<sim::Vec3>> fastest_mode(const sim::Description& description) {
    const auto grid = std::make_shared<const sim::Grid<double>>(sim::make_grid<double>(description));
    const sim::Model<double> model = sim::make_model<double>(description, grid);
    const sim::Vec3Array<double> start = sim::start_positions<double>(description);
    const sim::SpringOperator<double> k(model, start);
    std::vector<double> v, w(k.size());
    for (const sim::Vec3& p : noise(description))
        v.insert(v.end(), {p.x, p.y, p.z});
    double length = std::sqrt(dot(v, v));
    for (int i = 0; i < most_products; ++i) {
        if (!(length > 0))
            return std::nullopt;
        for (double& x : v)
            x /= length;
        k.apply(v, w);
        const double eigenvalue = dot(v, w);
        double residual = 0;
        for (std::size_t j = 0; j < v.size(); ++j) {
            residual += (w[j] - eigenvalue * v[j]) * (w[j] - eigenvalue * v[j]);
            w[j] -=
                0.4 * eigenvalue * v[j]; // no eigenvalue is below zero here: those at zero shrink to 2/3 of the largest
        }
        if (eigenvalue > 0 && std::sqrt(residual) < accuracy * eigenvalue) {
            double largest = 0;
            for (const double x : v)
                largest = std::max(largest, std::abs(x));
            std::vector<sim::Vec3> shape(v.size() / 3);
            for (std::size_t j = 0; j < shape.size(); ++j)
                shape[j] = {v[3 * j] / largest, v[3 * j + 1] / largest, v[3 * j + 2] / largest};
            return shape;
        }
        std::swap(v, w);
        length = std::sqrt(dot(v, v));
    }
    return std::nullopt;
}

double growth_per_step(const std::vector<double>& x) {
    // As x(n+1) - 2 x(n) + x(n-1) = alpha x(n) + beta (x(n) - x(n-1)), which loses no digits where steps are small.
    double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
    for (std::size_t n = 1; n + 1 < x.size() && std::abs(x[n + 1]) < 1e3 * std::abs(x[0]); ++n) {
        const double a = x[n], b = x[n] - x[n - 1], c = (x[n + 1] - x[n]) - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ac += a * c;
        bc += b * c;
    }
    const double determinant = aa * bb - ab * ab;
    if (!(std::abs(determinant) > 0))
        return 1;
    const double alpha = (ac * bb - bc * ab) / determinant, beta = (bc * aa - ac * ab) / determinant;
    const double product = 1 + beta, half_sum = 1 + 0.5 * (alpha + beta);
    const double discriminant = alpha + 0.25 * (alpha + beta) * (alpha + beta);
    return discriminant < 0 ? std::sqrt(product) : std::abs(half_sum) + std::sqrt(discriminant);
}

} // namespace clothlab::experiments

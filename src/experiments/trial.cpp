#include "experiments/trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scene/io.h"

namespace clothlab::experiments {
namespace {

sim::Vec3 mixed(const sim::Vec3& a, const sim::Vec3& b, double share) {
    const auto mix = [share](double from, double to) {
        return share == 0 ? from : share == 1 ? to : from + share * (to - from);
    };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z)};
}

/// Where a place between points is: `column` and `row` count in points.
sim::Vec3 interpolated(const Shape& shape, double column, double row) {
    const int left = std::min(static_cast<int>(column), std::max(shape.columns - 2, 0));
    const int above = std::min(static_cast<int>(row), std::max(shape.rows - 2, 0));
    const auto at = [&](int c, int r) {
        return shape
            .points[static_cast<std::size_t>(std::min(r, shape.rows - 1)) * static_cast<std::size_t>(shape.columns) +
                    static_cast<std::size_t>(std::min(c, shape.columns - 1))];
    };
    const double x = column - left, y = row - above;
    return mixed(mixed(at(left, above), at(left + 1, above), x), mixed(at(left, above + 1), at(left + 1, above + 1), x),
                 y);
}

/// A place of one grid in the points of another of the same cloth.
double rescaled(int index, int from, int to) {
    return from == to ? index : from < 2 ? 0 : static_cast<double>(index) * (to - 1) / (from - 1);
}

} // namespace

scene::Scene with(const scene::Scene& scene, const Settings& settings) {
    scene::Scene changed = scene;
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos || equals == 0)
            throw scene::SceneError(setting + ": write KEY=VALUE");
        scene::set_parameter(changed, std::string_view(setting).substr(0, equals),
                             std::string_view(setting).substr(equals + 1));
    }
    scene::check(changed, "the scene");
    return changed;
}

Shape shape_of(const sim::Simulation& simulation) {
    const sim::Cloth& cloth = simulation.description().cloth;
    Shape shape{cloth.num_width_points, cloth.num_height_points, {}};
    shape.points.reserve(simulation.points());
    for (std::size_t i = 0; i < simulation.points(); ++i)
        shape.points.push_back(simulation.position(i));
    return shape;
}

Distance distance(const Shape& a, const Shape& b) {
    if (a.points.empty() || b.points.empty())
        throw std::invalid_argument("a shape without points has no distance");
    const bool a_is_coarser = a.points.size() <= b.points.size();
    const Shape &coarse = a_is_coarser ? a : b, &fine = a_is_coarser ? b : a;
    double sum = 0, largest = 0;
    bool finite = true;
    for (int row = 0; row < coarse.rows; ++row)
        for (int column = 0; column < coarse.columns; ++column) {
            const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(coarse.columns) +
                           static_cast<std::size_t>(column);
            const sim::Vec3& p = coarse.points[i];
            const sim::Vec3 q = interpolated(fine, rescaled(column, coarse.columns, fine.columns),
                                             rescaled(row, coarse.rows, fine.rows));
            const double square = (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
            finite = finite && std::isfinite(square);
            sum += square;
            largest = std::max(largest, square);
        }
    if (!finite)
        return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    return {std::sqrt(sum / static_cast<double>(coarse.points.size())), std::sqrt(largest)};
}

double mean_height(const Shape& shape) {
    double sum = 0;
    for (const sim::Vec3& p : shape.points)
        sum += p.y;
    return sum / static_cast<double>(shape.points.size());
}

double drape_height(const Shape& shape) {
    const auto [low, high] = std::minmax_element(shape.points.begin(), shape.points.end(),
                                                 [](const sim::Vec3& a, const sim::Vec3& b) { return a.y < b.y; });
    return low == shape.points.end() ? 0 : high->y - low->y;
}

bool run_frames(sim::Simulation& simulation, std::uint64_t frames) {
    for (std::uint64_t i = 0; i < frames; ++i) {
        simulation.step_frame();
        if (simulation.trouble() && simulation.trouble()->status == sim::Status::diverged)
            return false;
    }
    return true;
}

} // namespace clothlab::experiments

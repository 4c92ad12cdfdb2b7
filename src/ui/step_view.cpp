#include "ui/step_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clothlab::ui {
namespace {

sim::Vec3 point_of(std::span<const float> positions, std::size_t i) {
    return {static_cast<double>(positions[3 * i]), static_cast<double>(positions[3 * i + 1]),
            static_cast<double>(positions[3 * i + 2])};
}

sim::Vec3 minus(const sim::Vec3& a, const sim::Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double dot(const sim::Vec3& a, const sim::Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

const sim::StepTrace* shown_trace(const Lab& lab) {
    const sim::StepTrace* trace = lab.timeline.trace.get();
    if (!trace || !lab.snapshot || lab.playing || !lab.timeline.inspecting)
        return nullptr;
    const bool fits = trace->step == lab.snapshot->steps && trace->before == lab.snapshot->positions;
    return fits ? trace : nullptr;
}

sim::Vec3 effect(const sim::StepTrace& trace, sim::Stage stage, std::uint32_t point) {
    const auto s = static_cast<std::size_t>(stage);
    if (stage != sim::Stage::forces)
        return minus(point_of(trace.after[s], point), point_of(trace.after[s - 1], point));
    const sim::Vec3 f = point_of(trace.force, point);
    const double share = trace.dt * trace.dt / trace.mass;
    return {f.x * share, f.y * share, f.z * share};
}

double mean_spacing(int columns, int rows, std::span<const float> positions) {
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](int a, int b) {
        const sim::Vec3 d =
            minus(point_of(positions, static_cast<std::size_t>(a)), point_of(positions, static_cast<std::size_t>(b)));
        const double length = std::hypot(d.x, d.y, d.z);
        if (!std::isfinite(length))
            return;
        sum += length;
        ++count;
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int i = row * columns + column;
            if (column > 0)
                add(i, i - 1);
            if (row > 0)
                add(i, i - columns);
        }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

std::optional<float> fitting_scale(const sim::StepTrace& trace, sim::Stage stage, std::optional<std::uint32_t> point,
                                   double spacing) {
    const auto points = static_cast<std::uint32_t>(trace.before.size() / 3);
    double longest = 0, squares = 0, count = 0;
    for (std::uint32_t i = point.value_or(0); i < (point ? std::min(*point + 1, points) : points); ++i) {
        const sim::Vec3 d = effect(trace, stage, i);
        const double length = std::hypot(d.x, d.y, d.z);
        if (!(length > 0) || !std::isfinite(length))
            continue;
        longest = std::max(longest, length);
        squares += length * length;
        ++count;
    }
    if (count == 0)
        return std::nullopt;
    const double scale =
        point ? 5 * spacing / longest : std::min(1.5 * spacing / std::sqrt(squares / count), 6 * spacing / longest);
    const auto result = static_cast<float>(scale);
    return std::isfinite(result) && result > 0 ? std::optional(result) : std::nullopt;
}

int next_stage(const sim::StepTrace& trace, int stage, int direction) {
    for (int s = stage + direction; s >= 0 && s < sim::stage_count; s += direction)
        if (trace.active[static_cast<std::size_t>(s)])
            return s;
    return direction < 0 ? -1 : stage;
}

std::optional<std::uint32_t> pick_point(const scene::Camera& camera, float width, float height,
                                        std::span<const float> positions, float x, float y, float reach) {
    const scene::CameraFrame frame = scene::frame(camera);
    const sim::Vec3 to_target = minus(camera.target, frame.eye);
    const bool orthographic = camera.projection == scene::Projection::orthographic;
    const double from_middle_x = static_cast<double>(x - width / 2),
                 from_middle_y = static_cast<double>(height / 2 - y);
    const double shorter = static_cast<double>(std::max(std::min(width, height), 1.f));
    const double per_depth = 2 * std::tan(camera.fov * std::numbers::pi / 360) / shorter;

    struct Candidate {
        std::uint32_t point;
        double px, depth;
    };
    std::vector<Candidate> candidates;
    double nearest = static_cast<double>(reach);
    constexpr double as_near = 3; // px
    for (std::uint32_t i = 0; i < positions.size() / 3; ++i) {
        const sim::Vec3 d = minus(point_of(positions, i), frame.eye);
        const double depth = dot(d, to_target) / std::max(camera.distance, 1e-9);
        const double metres = (orthographic ? camera.distance : depth) * per_depth; // that a pixel is wide there
        if (!(metres > 0))
            continue;
        const double px =
            std::hypot(dot(d, frame.right) / metres - from_middle_x, dot(d, frame.up) / metres - from_middle_y);
        if (!(px <= nearest + as_near) || !(px <= static_cast<double>(reach)))
            continue;
        nearest = std::min(nearest, px);
        candidates.push_back({i, px, depth});
    }
    std::optional<Candidate> best;
    for (const Candidate& c : candidates)
        if (c.px <= nearest + as_near && (!best || c.depth < best->depth))
            best = c;
    return best ? std::optional(best->point) : std::nullopt;
}

} // namespace clothlab::ui

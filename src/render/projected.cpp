#include "render/projected.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace clothlab::render {

namespace {

struct Pixel {
    float x, y;  ///< px
    float depth; ///< m, from the eye's plane
    bool inside; ///< else the other values mean nothing
};

struct Camera {
    glm::mat4 to_clip;
    glm::vec4 depth; ///< dot with (x, y, z, 1)
    float width, height;

    Camera(const View& view, int w, int h) : width(static_cast<float>(w)), height(static_cast<float>(h)) {
        const glm::mat4 to_camera = view_matrix(view);
        to_clip = projection_matrix(view, width / height) * to_camera;
        depth = -glm::vec4(to_camera[0][2], to_camera[1][2], to_camera[2][2], to_camera[3][2]);
    }
    // No branches: loops over it are vectorised.
    Pixel pixel(float x, float y, float z) const {
        const auto& m = to_clip;
        const float clip_x = m[0][0] * x + m[1][0] * y + m[2][0] * z + m[3][0];
        const float clip_y = m[0][1] * x + m[1][1] * y + m[2][1] * z + m[3][1];
        const float clip_z = m[0][2] * x + m[1][2] * y + m[2][2] * z + m[3][2];
        const float clip_w = m[0][3] * x + m[1][3] * y + m[2][3] * z + m[3][3];
        const bool inside =
            (std::abs(clip_x) <= clip_w) & (std::abs(clip_y) <= clip_w) & (std::abs(clip_z) <= clip_w) & (clip_w > 0);
        const float half = 0.5f / clip_w;
        return {(0.5f + half * clip_x) * width, (0.5f - half * clip_y) * height,
                depth.x * x + depth.y * y + depth.z * z + depth.w, inside};
    }
};

/// The box around the points inside. It is made of a few parts that are put together at the end, as many as points
/// are looked at a time: the compiler then makes vectors of them.
class Extent {
public:
    Extent(const Camera& camera, std::span<const float> positions, std::span<const std::uint8_t> drawn) {
        left.fill(beyond);
        top.fill(beyond);
        nearest.fill(beyond);
        right.fill(-beyond);
        bottom.fill(-beyond);
        furthest.fill(-beyond);
        for (std::size_t first = 0; first < drawn.size(); first += lanes) {
            const std::size_t count = std::min(lanes, drawn.size() - first);
            const float* at = &positions[3 * first];
            std::array<float, lanes> x{}, y{}, z{};
            std::array<std::uint32_t, lanes> counts{};
            for (std::size_t lane = 0; lane < count; ++lane) {
                x[lane] = at[3 * lane];
                y[lane] = at[3 * lane + 1];
                z[lane] = at[3 * lane + 2];
                counts[lane] = drawn[first + lane];
            }
            for (std::size_t lane = 0; lane < lanes; ++lane)
                include(camera.pixel(x[lane], y[lane], z[lane]), counts[lane], lane);
        }
    }
    void fill(ProjectedCloth& result, int width, int height) const {
        result.inside = std::accumulate(inside.begin(), inside.end(), std::size_t{0});
        if (result.inside == 0)
            return;
        const auto index = [](float value, int size) { return std::clamp(static_cast<int>(value), 0, size - 1); };
        result.min_x = index(*std::min_element(left.begin(), left.end()), width);
        result.max_x = index(*std::max_element(right.begin(), right.end()), width);
        result.min_y = index(*std::min_element(top.begin(), top.end()), height);
        result.max_y = index(*std::max_element(bottom.begin(), bottom.end()), height);
        result.nearest = *std::min_element(nearest.begin(), nearest.end());
        result.furthest = *std::max_element(furthest.begin(), furthest.end());
    }

private:
    void include(const Pixel& p, std::uint32_t drawn, std::size_t lane) {
        const bool counts = p.inside & (drawn != 0);
        const float x = counts ? p.x : beyond, y = counts ? p.y : beyond, depth = counts ? p.depth : beyond;
        left[lane] = x < left[lane] ? x : left[lane];
        top[lane] = y < top[lane] ? y : top[lane];
        nearest[lane] = depth < nearest[lane] ? depth : nearest[lane];
        const float x2 = counts ? p.x : -beyond, y2 = counts ? p.y : -beyond, depth2 = counts ? p.depth : -beyond;
        right[lane] = x2 > right[lane] ? x2 : right[lane];
        bottom[lane] = y2 > bottom[lane] ? y2 : bottom[lane];
        furthest[lane] = depth2 > furthest[lane] ? depth2 : furthest[lane];
        inside[lane] += counts ? 1u : 0u;
    }

    static constexpr std::size_t lanes = 16;
    static constexpr float beyond = 1e30f;
    std::array<float, lanes> left, top, right, bottom, nearest, furthest;
    std::array<std::uint32_t, lanes> inside{};
};

} // namespace

ProjectedCloth project(const sim::Snapshot* snapshot, std::span<const std::uint8_t> drawn, const View& view, int width,
                       int height) {
    ProjectedCloth result;
    if (snapshot == nullptr || 3 * drawn.size() != snapshot->positions.size())
        return result;
    const Camera camera(view, width, height);
    Extent(camera, snapshot->positions, drawn).fill(result, width, height);
    if (result.inside == 0)
        return result;

    const auto pixel = [&](std::size_t i) {
        const float* at = &snapshot->positions[3 * i];
        Pixel p = camera.pixel(at[0], at[1], at[2]);
        p.inside = p.inside && drawn[i] != 0;
        return p;
    };
    // Some hundred cells are enough for a mean.
    const auto columns = static_cast<std::size_t>(snapshot->columns), points = drawn.size();
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < points; i += std::max<std::size_t>(1, points / 501)) {
        const Pixel p = pixel(i);
        for (const std::size_t other : {i + 1, i + columns}) {
            if (other >= points || (other == i + 1 && other % columns == 0))
                continue;
            const Pixel q = pixel(other);
            if (!p.inside || !q.inside)
                continue;
            sum += static_cast<double>(std::hypot(p.x - q.x, p.y - q.y));
            ++count;
        }
    }
    if (count > 0)
        result.cell = static_cast<float>(sum / static_cast<double>(count));
    return result;
}

} // namespace clothlab::render

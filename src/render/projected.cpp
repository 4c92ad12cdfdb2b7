#include "render/projected.h"

#include <algorithm>
#include <cmath>

namespace clothlab::render {

namespace {

struct Pixel {
    float x = 0, y = 0, depth = 0;
    bool inside = false;
};

} // namespace

ProjectedCloth project(const sim::Snapshot* snapshot, std::span<const std::uint8_t> drawn, const View& view, int width,
                       int height) {
    ProjectedCloth result;
    if (snapshot == nullptr || 3 * drawn.size() != snapshot->positions.size())
        return result;
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    const glm::mat4 m = projection_matrix(view, w / h) * view_matrix(view);
    const auto pixel = [&](std::size_t i) {
        Pixel p;
        if (drawn[i] == 0)
            return p;
        const float* at = &snapshot->positions[3 * i];
        const glm::vec4 clip = m[0] * at[0] + m[1] * at[1] + m[2] * at[2] + m[3];
        p.inside = std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && std::abs(clip.z) <= clip.w && clip.w > 0;
        if (!p.inside)
            return p;
        p.x = (0.5f + 0.5f * clip.x / clip.w) * w;
        p.y = (0.5f - 0.5f * clip.y / clip.w) * h;
        p.depth = clip.w;
        return p;
    };

    float left = w, top = h, right = -1, bottom = -1;
    result.nearest = 1e30f;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const Pixel p = pixel(i);
        if (!p.inside)
            continue;
        ++result.inside;
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
        result.nearest = std::min(result.nearest, p.depth);
        result.furthest = std::max(result.furthest, p.depth);
    }
    if (result.inside == 0)
        return {};
    const auto index = [](float value, int size) { return std::clamp(static_cast<int>(value), 0, size - 1); };
    result.min_x = index(left, width);
    result.max_x = index(right, width);
    result.min_y = index(top, height);
    result.max_y = index(bottom, height);

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

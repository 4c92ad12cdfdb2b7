#include "render/sorted_triangles.h"

#include <algorithm>

namespace clothlab::render {

std::size_t SortedTriangles::draw(const ClothMesh& cloth, const sim::Snapshot& snapshot, const View& view) {
    const std::span<const std::uint8_t> drawn = cloth.drawn();
    if (drawn.empty())
        return 0;
    const glm::vec3 forward = view.target - view.eye;
    const auto distance = [&](std::uint32_t i) {
        const float* p = &snapshot.positions[3 * static_cast<std::size_t>(i)];
        return p[0] * forward.x + p[1] * forward.y + p[2] * forward.z;
    };
    triangles_.clear();
    sim::for_each_triangle(snapshot.columns, snapshot.rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (drawn[a] != 0 && drawn[b] != 0 && drawn[c] != 0)
            triangles_.push_back({distance(a) + distance(b) + distance(c), a, c, b});
    });
    // Equal distances in the order of the grid, so that the same picture comes out everywhere.
    std::stable_sort(triangles_.begin(), triangles_.end(),
                     [](const Triangle& x, const Triangle& y) { return x.distance > y.distance; });
    indices_.clear();
    for (const Triangle& t : triangles_)
        indices_.insert(indices_.end(), {t.a, t.b, t.c});

    cloth.bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices_.size() * sizeof(std::uint32_t)),
                 indices_.data(), GL_STREAM_DRAW);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
    return triangles_.size();
}

} // namespace clothlab::render

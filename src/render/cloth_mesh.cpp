#include "render/cloth_mesh.h"

#include <algorithm>
#include <utility>

#include "render/cloth_normals.h"
#include "render/shader_library.h"

namespace clothlab::render {

namespace {

/// New contents for a buffer. The whole store is given anew, so that the driver need not wait until the last frame's
/// has been drawn.
template <class T>
void fill(const Buffer& buffer, std::span<const T> data, GLenum usage) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), usage);
}

void attribute(const Buffer& buffer, GLuint place, GLint size) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, 0, nullptr);
}

} // namespace

ClothMesh::ClothMesh() {
    glBindVertexArray(vertices_.id());
    attribute(position_, ShaderLibrary::position, 3);
    attribute(normal_, ShaderLibrary::normal, 3);
    attribute(uv_, ShaderLibrary::uv, 2);
    attribute(tangent_, ShaderLibrary::tangent, 3);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void ClothMesh::clear() {
    columns_ = rows_ = 0;
    not_drawable_ = 0;
    usable_.clear();
    triangles_.count = points_.count = 0;
    for (Indices& springs : springs_)
        springs.count = 0;
}

void ClothMesh::update(const sim::Snapshot& snapshot) {
    const std::span<const float> positions = snapshot.positions;
    const bool whole =
        snapshot.columns > 0 && snapshot.rows > 0 &&
        positions.size() == 3 * static_cast<std::size_t>(snapshot.columns) * static_cast<std::size_t>(snapshot.rows);
    if (!whole)
        return clear();

    const bool new_grid = snapshot.columns != columns_ || snapshot.rows != rows_;
    columns_ = snapshot.columns;
    rows_ = snapshot.rows;
    not_drawable_ = find_drawable(positions, usable_);
    if (new_grid) {
        std::vector<float> uv;
        uv.reserve(2 * usable_.size());
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) {
                uv.push_back(static_cast<float>(column) / static_cast<float>(std::max(1, columns_ - 1)));
                uv.push_back(static_cast<float>(row) / static_cast<float>(std::max(1, rows_ - 1)));
            }
        }
        fill<float>(uv_, uv, GL_STATIC_DRAW);
    }
    if (new_grid || partial_ || not_drawable_ > 0)
        make_indices();

    if (not_drawable_ == 0) {
        cloth_normals(columns_, rows_, positions, {}, normals_);
        cloth_tangents(columns_, rows_, positions, {}, tangents_);
        fill(position_, positions, GL_STREAM_DRAW);
    } else {
        cloth_normals(columns_, rows_, positions, usable_, normals_);
        cloth_tangents(columns_, rows_, positions, usable_, tangents_);
        positions_.assign(positions.begin(), positions.end());
        for (std::size_t i = 0; i < usable_.size(); ++i)
            if (usable_[i] == 0)
                std::fill_n(positions_.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 0.f);
        fill<float>(position_, positions_, GL_STREAM_DRAW);
    }
    fill<float>(normal_, normals_, GL_STREAM_DRAW);
    fill<float>(tangent_, tangents_, GL_STREAM_DRAW);
    upload_quantity(snapshot.quantity);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void ClothMesh::upload_quantity(std::span<const float> quantity) {
    glBindVertexArray(vertices_.id());
    if (quantity.size() == usable_.size()) {
        fill(quantity_, quantity, GL_STREAM_DRAW);
        attribute(quantity_, ShaderLibrary::quantity, 1);
    } else { // shaders then see the attribute's constant value
        glDisableVertexAttribArray(ShaderLibrary::quantity);
        glVertexAttrib1f(ShaderLibrary::quantity, 0);
    }
    glBindVertexArray(0);
}

void ClothMesh::upload(Indices& indices) {
    // Not as an element array: that binding belongs to whichever vertex array is bound.
    fill<std::uint32_t>(indices.buffer, scratch_, GL_DYNAMIC_DRAW);
    indices.count = static_cast<GLsizei>(scratch_.size());
    scratch_.clear();
}

void ClothMesh::make_indices() {
    partial_ = not_drawable_ > 0;
    scratch_.clear();
    const auto good = [this](std::uint32_t i) { return usable_[i] != 0; };
    sim::for_each_triangle(columns_, rows_, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (good(a) && good(b) && good(c))
            scratch_.insert(scratch_.end(), {a, c, b});
    });
    upload(triangles_);

    std::array<std::vector<std::uint32_t>, sim::spring_kinds> ends;
    const auto columns = static_cast<std::uint32_t>(columns_);
    sim::for_each_spring(columns_, rows_, [&](std::uint32_t a, std::uint32_t b, std::size_t spring) {
        if (!good(a) || !good(b))
            return;
        const sim::SpringKind kind = sim::spring_stencil[spring].kind;
        if (kind == sim::SpringKind::bending) {
            const std::uint32_t along = a - b == 2 ? a % columns : a / columns;
            if (along % 2 == 1)
                std::swap(a, b);
        }
        ends[static_cast<std::size_t>(kind)].insert(ends[static_cast<std::size_t>(kind)].end(), {a, b});
    });
    for (std::size_t kind = 0; kind < ends.size(); ++kind) {
        scratch_.swap(ends[kind]);
        upload(springs_[kind]);
    }
}

std::size_t ClothMesh::draw_surface() const {
    if (triangles_.count == 0)
        return 0;
    glBindVertexArray(vertices_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.buffer.id());
    glDrawElements(GL_TRIANGLES, triangles_.count, GL_UNSIGNED_INT, nullptr);
    return static_cast<std::size_t>(triangles_.count) / 3;
}

std::size_t ClothMesh::draw_springs(sim::SpringKind kind) const {
    const Indices& springs = springs_[static_cast<std::size_t>(kind)];
    if (springs.count == 0)
        return 0;
    glBindVertexArray(vertices_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, springs.buffer.id());
    glDrawElements(GL_LINES, springs.count, GL_UNSIGNED_INT, nullptr);
    return static_cast<std::size_t>(springs.count) / 2;
}

std::size_t ClothMesh::draw_points(std::span<const sim::GridPoint> points) {
    scratch_.clear();
    for (const auto& [column, row] : points) {
        if (column < 0 || column >= columns_ || row < 0 || row >= rows_)
            continue;
        const auto i =
            static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns_) + static_cast<std::uint32_t>(column);
        if (usable_[i] != 0)
            scratch_.push_back(i);
    }
    upload(points_);
    if (points_.count == 0)
        return 0;
    glBindVertexArray(vertices_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, points_.buffer.id());
    glDrawElements(GL_POINTS, points_.count, GL_UNSIGNED_INT, nullptr);
    return static_cast<std::size_t>(points_.count);
}

} // namespace clothlab::render

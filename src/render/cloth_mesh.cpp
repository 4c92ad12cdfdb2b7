#include "render/cloth_mesh.h"

#include <algorithm>
#include <cstring>
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

/// The same for a buffer of that size that nothing is drawn with any more. A new store, which a driver also gives for
/// contents that are said to be of no use, would cost as much as all the rest of a draw: its pages are new to the
/// process. False when the driver has lost it.
bool refill(const Buffer& buffer, std::span<const float> data) {
    const auto size = static_cast<GLsizeiptr>(data.size_bytes());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    void* const store = glMapBufferRange(GL_ARRAY_BUFFER, 0, size, GL_MAP_WRITE_BIT);
    if (store == nullptr)
        return false;
    std::memcpy(store, data.data(), data.size_bytes());
    return glUnmapBuffer(GL_ARRAY_BUFFER) == GL_TRUE;
}

/// Of the buffer and the vertex array that are bound: an attribute that begins after so many floats.
void attribute(GLuint place, GLint size, std::size_t begin) {
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, 0, reinterpret_cast<const void*>(begin * sizeof(float)));
}

} // namespace

ClothMesh::ClothMesh() {
    glBindVertexArray(vertices_.id());
    glBindBuffer(GL_ARRAY_BUFFER, uv_.id());
    attribute(ShaderLibrary::uv, 2, 0);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void ClothMesh::clear() {
    capture_ = 0;
    columns_ = rows_ = 0;
    not_drawable_ = 0;
    usable_.clear();
    triangles_.count = points_.count = 0;
    for (Indices& springs : springs_)
        springs.count = 0;
}

void ClothMesh::update(const sim::Snapshot& snapshot) {
    if (snapshot.capture != 0 && snapshot.capture == capture_)
        return;
    const bool whole = snapshot.columns > 0 && snapshot.rows > 0 &&
                       snapshot.positions.size() ==
                           3 * static_cast<std::size_t>(snapshot.columns) * static_cast<std::size_t>(snapshot.rows);
    if (!whole)
        return clear();

    capture_ = snapshot.capture;
    const bool new_grid = snapshot.columns != columns_ || snapshot.rows != rows_;
    columns_ = snapshot.columns;
    rows_ = snapshot.rows;
    not_drawable_ = find_drawable(snapshot.positions, usable_);
    if (new_grid)
        make_uv();
    if (new_grid || partial_ || not_drawable_ > 0)
        make_indices();
    make_vertices(snapshot);
}

void ClothMesh::make_uv() {
    std::vector<float> uv;
    uv.reserve(2 * usable_.size());
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            uv.push_back(static_cast<float>(column) / static_cast<float>(std::max(1, columns_ - 1)));
            uv.push_back(static_cast<float>(row) / static_cast<float>(std::max(1, rows_ - 1)));
        }
    }
    fill<float>(uv_, uv, GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void ClothMesh::make_vertices(const sim::Snapshot& snapshot) {
    const std::span<const float> positions = snapshot.positions;
    const std::size_t points = usable_.size(), vectors = positions.size();
    data_.resize(3 * vectors);
    quantity_at_ = {};
    for (std::size_t i = 0; i < 2; ++i) {
        const std::vector<float>& values = i == 0 ? snapshot.quantity : snapshot.second_quantity;
        if (values.size() != points)
            continue;
        quantity_at_[i] = data_.size();
        data_.insert(data_.end(), values.begin(), values.end());
    }
    const std::span<float> data = data_;
    std::copy(positions.begin(), positions.end(), data.begin());
    std::span<const std::uint8_t> usable; // all
    if (not_drawable_ > 0) {
        usable = usable_;
        for (std::size_t i = 0; i < points; ++i)
            if (usable_[i] == 0)
                std::fill_n(data.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 0.f);
    }
    cloth_normals(columns_, rows_, positions, usable, data.subspan(vectors, vectors));
    cloth_tangents(columns_, rows_, positions, usable, data.subspan(2 * vectors, vectors));

    current_ = (current_ + 1) % vertex_data_.size();
    Stream& stream = vertex_data_[current_];
    if (stream.size != data_.size() || !refill(stream.buffer, data_))
        fill<float>(stream.buffer, data_, GL_STREAM_DRAW);
    stream.size = data_.size();
    glBindVertexArray(vertices_.id());
    attribute(ShaderLibrary::position, 3, 0);
    attribute(ShaderLibrary::normal, 3, vectors);
    attribute(ShaderLibrary::tangent, 3, 2 * vectors);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    use_quantity(false);
}

void ClothMesh::use_quantity(bool second) {
    glBindVertexArray(vertices_.id());
    glBindBuffer(GL_ARRAY_BUFFER, vertex_data_[current_].buffer.id());
    if (const auto at = quantity_at_[second ? 1 : 0]) {
        attribute(ShaderLibrary::quantity, 1, *at);
    } else { // shaders then see the attribute's constant value
        glDisableVertexAttribArray(ShaderLibrary::quantity);
        glVertexAttrib1f(ShaderLibrary::quantity, 0);
    }
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
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

// The bytes of a mesh.
#include <cmath>
#include <vector>

#include "scene/number_text.h"
#include "sim/grid.h"
#include "sim/simulation.h"
#include "timeline/mesh_sequence.h"

namespace clothlab::timeline {
namespace {

struct Mesh {
    const sim::Simulation& simulation;
    int columns = simulation.description().cloth.num_width_points;
    int rows = simulation.description().cloth.num_height_points;
    bool single = simulation.description().stepping.precision == sim::Precision::single_precision;

    /// Texture coordinates of a point.
    double u(std::size_t point) const {
        return static_cast<double>(point % static_cast<std::size_t>(columns)) / (columns - 1);
    }
    double v(std::size_t point) const {
        return static_cast<double>(point / static_cast<std::size_t>(columns)) / (rows - 1);
    }
};

std::string obj(const Mesh& mesh, const std::string& title) {
    std::string text = "# clothlab: " + title + "\no cloth\n";
    const std::size_t points = mesh.simulation.points();
    for (std::size_t i = 0; i < points; ++i) {
        const sim::Vec3 p = mesh.simulation.position(i);
        text += "v";
        for (const double x : {p.x, p.y, p.z}) {
            text += " ";
            scene::append_number(text, x, mesh.single);
        }
        text += "\n";
    }
    for (std::size_t i = 0; i < points; ++i) {
        text += "vt ";
        scene::append_number(text, mesh.u(i), true);
        text += " ";
        scene::append_number(text, mesh.v(i), true);
        text += "\n";
    }
    sim::for_each_triangle(mesh.columns, mesh.rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        text += "f";
        for (const std::uint32_t corner : {a, b, c}) {
            const std::string index = std::to_string(corner + 1);
            text += " " + index + "/" + index;
        }
        text += "\n";
    });
    return text;
}

/// Of unit length, each the sum of its triangles' normals by their areas; zero where that has no direction.
std::vector<sim::Vec3> normals(const Mesh& mesh) {
    std::vector<sim::Vec3> sums(mesh.simulation.points());
    sim::for_each_triangle(mesh.columns, mesh.rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const sim::Vec3 p = mesh.simulation.position(a), q = mesh.simulation.position(b),
                        r = mesh.simulation.position(c);
        const sim::Vec3 e{q.x - p.x, q.y - p.y, q.z - p.z}, f{r.x - p.x, r.y - p.y, r.z - p.z};
        const sim::Vec3 n{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
        for (const std::uint32_t corner : {a, b, c})
            sums[corner] = {sums[corner].x + n.x, sums[corner].y + n.y, sums[corner].z + n.z};
    });
    for (sim::Vec3& n : sums) {
        const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        n = length > 0 && std::isfinite(length) ? sim::Vec3{n.x / length, n.y / length, n.z / length} : sim::Vec3{};
    }
    return sums;
}

template <class T>
void append_bytes(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string ply(const Mesh& mesh, const std::string& title) {
    const std::size_t points = mesh.simulation.points();
    const std::string real = mesh.single ? "float" : "double";
    std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment clothlab: " + title + "\nelement vertex " +
                        std::to_string(points) + "\n";
    for (const char* axis : {"x", "y", "z"})
        bytes += "property " + real + " " + axis + "\n";
    for (const char* property : {"nx", "ny", "nz", "s", "t"})
        bytes += std::string("property float ") + property + "\n";
    bytes += "element face " + std::to_string(2 * (mesh.columns - 1) * (mesh.rows - 1)) +
             "\nproperty list uchar int vertex_indices\nend_header\n";
    const std::vector<sim::Vec3> normal = normals(mesh);
    for (std::size_t i = 0; i < points; ++i) {
        const sim::Vec3 p = mesh.simulation.position(i), n = normal[i];
        for (const double x : {p.x, p.y, p.z})
            mesh.single ? append_bytes(bytes, static_cast<float>(x)) : append_bytes(bytes, x);
        for (const double x : {n.x, n.y, n.z, mesh.u(i), mesh.v(i)})
            append_bytes(bytes, static_cast<float>(x));
    }
    sim::for_each_triangle(mesh.columns, mesh.rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        append_bytes(bytes, std::uint8_t{3});
        for (const std::uint32_t corner : {a, b, c})
            append_bytes(bytes, static_cast<std::int32_t>(corner));
    });
    return bytes;
}

} // namespace

const char* name_of(MeshFormat format) {
    return format == MeshFormat::obj ? "obj" : "ply";
}

std::string mesh_text(const sim::Simulation& simulation, MeshFormat format, const std::string& title) {
    std::string line = title;
    for (char& c : line)
        if (static_cast<unsigned char>(c) < ' ')
            c = ' '; // both formats have comments of one line
    return format == MeshFormat::obj ? obj({simulation}, line) : ply({simulation}, line);
}

} // namespace clothlab::timeline

// From a scene to text, and both to and from files.
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/fields.h"
#include "scene/io.h"

namespace clothlab::scene {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t max_file_size = 64u << 20;

Json to_json(const sim::Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json to_json(const sim::Collider& collider) {
    if (const auto* s = std::get_if<sim::Sphere>(&collider))
        return {{"type", "sphere"}, {"origin", to_json(s->origin)}, {"radius", s->radius}, {"friction", s->friction}};
    const auto& p = std::get<sim::Plane>(collider);
    return {{"type", "plane"}, {"point", to_json(p.point)}, {"normal", to_json(p.normal)}, {"friction", p.friction}};
}

Json value_of(const Field& f, const Scene& scene) {
    switch (f.type) {
        case FieldType::text: return f.get_text(scene);
        case FieldType::vector: return to_json(f.get_vector(scene));
        case FieldType::boolean: return f.get(scene) != 0;
        case FieldType::integer: return static_cast<std::int64_t>(f.get(scene));
        case FieldType::number: return f.get(scene);
        case FieldType::choice: break;
    }
    const auto index = static_cast<std::size_t>(f.get(scene));
    if (f.choice_as_integer) return index;
    return f.choices[index];
}

bool nested(const Json& json) {
    for (const Json& item : json)
        if (item.is_object()) return true;
    return false;
}

/// Indented as people write scenes: lists of numbers and pins stay on one line.
void write(std::ostream& out, const Json& json, int indent) {
    const std::string pad(static_cast<std::size_t>(indent) + 2, ' ');
    const bool object = json.is_object();
    if (!object && !(json.is_array() && nested(json))) {
        out << json.dump();
        return;
    }
    out << (object ? "{" : "[");
    bool first = true;
    for (auto it = json.begin(); it != json.end(); ++it, first = false) {
        out << (first ? "\n" : ",\n") << pad;
        if (object) out << Json(it.key()).dump() << ": ";
        write(out, *it, indent + 2);
    }
    out << "\n" << std::string(static_cast<std::size_t>(indent), ' ') << (object ? "}" : "]");
}

std::string reason() { return std::strerror(errno); }

}  // namespace

std::string write_scene(const Scene& scene) {
    Json json;
    json["clothlab"] = format_version;
    if (!scene.name.empty()) json["name"] = scene.name;
    if (!scene.description.empty()) json["description"] = scene.description;
    for (const Field& f : fields()) {
        const std::string section(f.section());
        if (section == "camera" && !scene.camera) continue;
        json[section][std::string(f.name())] = value_of(f, scene);
    }
    Json& pinned = json["cloth"]["pinned"] = Json::array();
    for (const auto& [column, row] : scene.simulation.cloth.pinned) pinned.push_back(Json::array({column, row}));
    Json& accelerations = json["simulation"]["accelerations"] = Json::array();
    for (const sim::Vec3& a : scene.simulation.stepping.accelerations) accelerations.push_back(to_json(a));
    Json& colliders = json["colliders"] = Json::array();
    for (const sim::Collider& c : scene.simulation.colliders) colliders.push_back(to_json(c));
    std::ostringstream out;
    write(out, json, 0);
    out << "\n";
    return out.str();
}

std::string read_text_file(const std::filesystem::path& file) {
    std::error_code error;
    const std::string name = file.string();
    if (std::filesystem::is_directory(file, error)) throw SceneError(name + ": this is a folder, not a scene file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw SceneError(name + ": cannot be read: " + reason());
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > max_file_size)
        throw SceneError(name + ": too large for a scene file; at most 64 MiB are read");
    std::ostringstream text;
    text << in.rdbuf();
    if (in.bad()) throw SceneError(name + ": cannot be read: " + reason());
    return std::move(text).str();
}

Scene load_scene(const std::filesystem::path& file) {
    Scene scene = read_scene(read_text_file(file), file.string());
    if (scene.name.empty()) scene.name = file.stem().string();
    return scene;
}

void save_scene(const Scene& scene, const std::filesystem::path& file) {
    std::filesystem::path partial = file;
    partial += ".part";
    const auto fail = [&](const std::string& why) {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        throw SceneError(file.string() + ": cannot be written: " + why);
    };
    {
        std::ofstream out(partial, std::ios::binary | std::ios::trunc);
        out << write_scene(scene);
        out.flush();
        if (!out) fail(reason());
    }
    std::error_code error;
    std::filesystem::rename(partial, file, error);
    if (error) fail(error.message());
}

}  // namespace clothlab::scene

// From a scene to text, and both to and from files.
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/fields.h"
#include "scene/io.h"
#include "scene/whole_file.h"

namespace clothlab::scene {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const sim::Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json to_json(const sim::Collider& collider) {
    if (const auto* s = std::get_if<sim::Sphere>(&collider))
        return {{"type", "sphere"}, {"origin", to_json(s->origin)}, {"radius", s->radius}, {"friction", s->friction}};
    const auto& p = std::get<sim::Plane>(collider);
    return {{"type", "plane"}, {"point", to_json(p.point)}, {"normal", to_json(p.normal)}, {"friction", p.friction}};
}

Json to_json(const ShaderValue& value) {
    return std::visit(
        [](const auto& v) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v)>, sim::Vec3>)
                return to_json(v);
            else
                return Json(v);
        },
        value);
}

Json value_of(const Field& f, const Scene& scene) {
    switch (f.type) {
    case FieldType::text:
        return f.get_text(scene);
    case FieldType::vector:
        return to_json(f.get_vector(scene));
    case FieldType::boolean:
        return f.get(scene) != 0;
    case FieldType::integer:
        return static_cast<std::int64_t>(f.get(scene));
    case FieldType::number:
        return f.get(scene);
    case FieldType::choice:
        break;
    }
    const auto index = static_cast<std::size_t>(f.get(scene));
    if (f.choice_as_integer)
        return index;
    return f.choices[index];
}

bool nested(const Json& json) {
    for (const Json& item : json)
        if (item.is_object())
            return true;
    return false;
}

/// On one line; bytes that are not UTF-8, as file names may have them, become replacement characters.
std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Indented as people write scenes: lists of numbers and pins stay on one line.
void write(std::ostream& out, const Json& json, int indent) {
    const std::string pad(static_cast<std::size_t>(indent) + 2, ' ');
    const bool object = json.is_object();
    if (!object && !(json.is_array() && nested(json))) {
        out << dump(json);
        return;
    }
    out << (object ? "{" : "[");
    bool first = true;
    for (auto it = json.begin(); it != json.end(); ++it, first = false) {
        out << (first ? "\n" : ",\n") << pad;
        if (object)
            out << dump(it.key()) << ": ";
        write(out, *it, indent + 2);
    }
    out << "\n" << std::string(static_cast<std::size_t>(indent), ' ') << (object ? "}" : "]");
}

std::string reason() {
    return std::strerror(errno);
}

} // namespace

std::string write_scene(const Scene& scene) {
    Json json;
    json["clothlab"] = format_version;
    if (!scene.name.empty())
        json["name"] = scene.name;
    if (!scene.description.empty())
        json["description"] = scene.description;
    for (const Field& f : fields()) {
        const std::string section(f.section());
        if (section == "camera" && !scene.camera)
            continue;
        json[section][std::string(f.name())] = value_of(f, scene);
    }
    Json& pinned = json["cloth"]["pinned"] = Json::array();
    for (const auto& [column, row] : scene.simulation.cloth.pinned)
        pinned.push_back(Json::array({column, row}));
    Json& accelerations = json["simulation"]["accelerations"] = Json::array();
    for (const sim::Vec3& a : scene.simulation.stepping.accelerations)
        accelerations.push_back(to_json(a));
    for (const auto& [shader, values] : scene.look.shaders)
        for (const auto& [parameter, value] : values)
            json["look"]["shaders"][shader][parameter] = to_json(value);
    Json& colliders = json["colliders"] = Json::array();
    for (const sim::Collider& c : scene.simulation.colliders)
        colliders.push_back(to_json(c));
    std::ostringstream out;
    write(out, json, 0);
    out << "\n";
    return out.str();
}

std::string write_camera(const Camera& camera) {
    Scene scene;
    scene.camera = camera;
    Json json;
    for (const Field& f : fields())
        if (f.section() == "camera")
            json[std::string(f.name())] = value_of(f, scene);
    std::ostringstream out;
    write(out, json, 0);
    out << "\n";
    return out.str();
}

std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_size) {
    std::error_code error;
    const std::string name = file.string();
    if (std::filesystem::is_directory(file, error))
        throw SceneError(name + ": this is a folder, not a file");
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw SceneError(name + ": cannot be read: " + reason());
    std::string text; // read in pieces: pipes and devices do not say how long they are
    for (std::string piece(1u << 16, '\0'); in && text.size() <= max_size;) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        text.append(piece, 0, static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad())
        throw SceneError(name + ": cannot be read: " + reason());
    if (text.size() > max_size)
        throw SceneError(name + ": too large; at most " + std::to_string(max_size >> 20) + " MiB are read");
    return text;
}

Scene load_scene(const std::filesystem::path& file) {
    Scene scene = read_scene(read_text_file(file), file.string());
    if (scene.name.empty())
        scene.name = file.stem().string();
    return scene;
}

void write_text_file(const std::string& text, const std::filesystem::path& file) {
    try {
        WholeFile out(file);
        out.write(text);
        out.commit();
    } catch (const FileError& e) {
        throw SceneError(e.what());
    }
}

void save_scene(const Scene& scene, const std::filesystem::path& file) {
    write_text_file(write_scene(scene), file);
}

} // namespace clothlab::scene

// `clothlab list`: everything that is registered, for people and, with --json, for programs.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/core/data_folder.h"
#include "cli/command_line.h"
#include "scene/fields.h"
#include "scene/io.h"
#include "sim/integrators/integrator.h"

namespace clothlab::cli {
namespace {

using Json = nlohmann::ordered_json;

Json integrators() {
    Json rows = Json::array();
    for (const sim::IntegratorInfo& i : sim::integrators()) {
        const double limit = i.limit(0); // JSON has no infinity: null is no limit
        rows.push_back({{"name", i.name},
                        {"family", sim::family_names[static_cast<std::size_t>(i.family)]},
                        {"order", i.order},
                        {"limit", i.limit_formula},
                        {"limit_omega_dt", std::isfinite(limit) ? Json(limit) : Json()},
                        {"cost", i.cost},
                        {"title", i.title},
                        {"source", i.source},
                        {"help", i.help}});
    }
    return rows;
}

Json shaders() {
    Json rows = Json::array();
    for (const std::string& name : app::known_shaders())
        rows.push_back({{"name", name}});
    return rows;
}

Json textures(const GuiCommands& gui) {
    if (!gui.list_textures)
        throw std::runtime_error("this clothlab was built without its GUI and has no textures");
    Json rows = Json::array();
    for (const TextureRow& texture : gui.list_textures())
        rows.push_back({{"name", texture.name}, {"usage", texture.usage}, {"title", texture.title}});
    return rows;
}

Json rules() {
    Json rows = Json::array();
    for (const scene::Field& f : scene::fields())
        if (f.section() == "rules")
            rows.push_back({{"name", f.name()}, {"values", f.choices}, {"help", f.help}});
    return rows;
}

Json scenes() {
    Json rows = Json::array();
    for (const auto& file : app::shipped_scenes())
        rows.push_back(
            {{"name", file.stem().string()}, {"help", scene::load_scene(file).description}, {"file", file.string()}});
    return rows;
}

Json default_value(const scene::Field& f) {
    const scene::Scene scene;
    switch (f.type) {
    case scene::FieldType::text:
        return f.get_text(scene);
    case scene::FieldType::vector: {
        const sim::Vec3 v = f.get_vector(scene);
        return Json::array({v.x, v.y, v.z});
    }
    case scene::FieldType::boolean:
        return f.get(scene) != 0;
    case scene::FieldType::choice: {
        const auto index = static_cast<std::size_t>(f.get(scene));
        if (f.choice_as_integer)
            return index;
        return f.choices[index];
    }
    case scene::FieldType::integer:
        return static_cast<std::int64_t>(f.get(scene));
    case scene::FieldType::number:
        break;
    }
    return f.get(scene);
}

Json parameters() {
    static constexpr const char* effects[] = {"live", "restart", "look"};
    Json rows = Json::array();
    for (const scene::Field& f : scene::fields())
        rows.push_back({{"name", f.key},
                        {"unit", f.unit},
                        {"default", default_value(f)},
                        {"allowed", scene::allowed_values(f)},
                        {"effect", effects[static_cast<std::size_t>(f.effect)]},
                        {"help", f.help}});
    return rows;
}

std::string cell(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Characters of a UTF-8 text: its bytes but those that continue one.
std::size_t width(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Columns as wide as their widest cell; the last, the help text, runs on.
void print_table(const Json& rows) {
    std::vector<std::size_t> widths;
    for (const Json& row : rows) {
        std::size_t i = 0;
        for (const auto& item : row.items()) {
            widths.resize(std::max(widths.size(), i + 1));
            widths[i] = std::max(widths[i], width(cell(item.value())));
            ++i;
        }
    }
    for (const Json& row : rows) {
        std::string line;
        std::size_t i = 0;
        for (const auto& item : row.items()) {
            std::string text = cell(item.value());
            if (i + 1 < widths.size())
                text.append(widths[i] + 2 - width(text), ' ');
            line += text;
            ++i;
        }
        std::cout << line << "\n";
    }
}

} // namespace

int list(const std::string& what, bool json, const GuiCommands& gui) {
    const Json rows = what == "integrators" ? integrators()
                      : what == "shaders"   ? shaders()
                      : what == "textures"  ? textures(gui)
                      : what == "rules"     ? rules()
                      : what == "scenes"    ? scenes()
                                            : parameters();
    if (json)
        std::cout << rows.dump(2, ' ', false, Json::error_handler_t::replace) << "\n"; // file names need not be UTF-8
    else
        print_table(rows);
    return 0;
}

} // namespace clothlab::cli

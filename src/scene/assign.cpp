// Single parameters from text: the command line's --set KEY=VALUE.
#include <charconv>
#include <optional>
#include <utility>
#include <variant>

#include "scene/reader.h"

namespace clothlab::scene {
namespace {

/// The text of --set as JSON: itself when it is JSON, a list without its brackets, or a bare word.
Document value_document(std::string_view value, const std::string& source) {
    const std::string text(value);
    const char first = text[std::min(text.find_first_not_of(" \t"), text.size() - 1)];
    if (text.find(',') != std::string::npos && first != '[' && first != '"')
        return Document::parse("[" + text + "]", source);
    try {
        return Document::parse(text, source);
    } catch (const SceneError&) {
        Document word{source, {}};
        word.root.type = Node::Type::string;
        word.root.text = text;
        word.root.line = 1;
        return word;
    }
}

/// What `rules = physical` stands for, by rule.
std::string_view physical_value(std::string_view rule) {
#define CLOTHLAB_RULE(field, type, label, physical, help, ...)                                                         \
    if (rule == #field)                                                                                                \
        return physical;
#include "sim/rules.def"
#undef CLOTHLAB_RULE
    return "";
}

void set_rules(Scene& scene, const Document& value) {
    Scene changed = scene;
    for (const Field& f : fields()) {
        if (f.section() != "rules")
            continue;
        const std::string_view wanted =
            value.root.text == "physical" ? physical_value(f.name()) : std::string_view(value.root.text);
        const auto choice = std::find(f.choices.begin(), f.choices.end(), wanted);
        if (choice == f.choices.end())
            value.fail(value.root, "rules",
                       "it must be \"cs184\" or \"physical\", or set one rule as in rules.limit=off");
        f.set(changed, static_cast<double>(choice - f.choices.begin()));
    }
    scene = std::move(changed);
}

void set_collider(Scene& scene, std::size_t index, std::string_view member, const Document& value,
                  const std::string& key) {
    // The collider goes through the reader again with one member replaced, so that the same rules hold.
    const auto vector = [](const sim::Vec3& v) {
        Node n;
        n.type = Node::Type::array;
        for (const double x : {v.x, v.y, v.z}) {
            Node item;
            item.type = Node::Type::number;
            item.number = x;
            n.items.push_back(item);
        }
        return n;
    };
    const auto scalar = [](double x) {
        Node n;
        n.type = Node::Type::number;
        n.number = x;
        return n;
    };
    Node object;
    object.type = Node::Type::object;
    sim::Collider& collider = scene.simulation.colliders[index];
    if (const auto* s = std::get_if<sim::Sphere>(&collider))
        object.members = {
            {"origin", vector(s->origin)}, {"radius", scalar(s->radius)}, {"friction", scalar(s->friction)}};
    else if (const auto* p = std::get_if<sim::Plane>(&collider))
        object.members = {
            {"point", vector(p->point)}, {"normal", vector(p->normal)}, {"friction", scalar(p->friction)}};
    Names allowed;
    bool found = false;
    for (auto& [name, node] : object.members) {
        allowed.push_back(name);
        if (name != member)
            continue;
        node = value.root;
        found = true;
    }
    if (!found)
        value.fail(value.root, key, unknown(member, allowed));
    Reader reader(value);
    const std::string prefix = key.substr(0, key.size() - member.size() - 1);
    if (std::holds_alternative<sim::Sphere>(collider))
        collider = reader.sphere(object, prefix);
    else
        collider = reader.plane(object, prefix);
}

/// The collider that a key of --set means, and the rest of the key; nothing when the key means none.
std::optional<std::pair<std::size_t, std::string_view>> collider_key(const Scene& scene, std::string_view key,
                                                                     const Document& value) {
    const auto& colliders = scene.simulation.colliders;
    const std::size_t dot = key.find('.');
    const std::string_view head = key.substr(0, dot);
    if (dot == std::string_view::npos)
        return std::nullopt;
    if (head == "sphere" || head == "plane") {
        for (std::size_t i = 0; i < colliders.size(); ++i)
            if (std::holds_alternative<sim::Sphere>(colliders[i]) == (head == "sphere"))
                return std::pair{i, key.substr(dot + 1)};
        value.fail(value.root, std::string(key), "the scene has no " + std::string(head));
    }
    if (head != "colliders")
        return std::nullopt;
    const std::string_view rest = key.substr(dot + 1);
    const std::size_t second = rest.find('.');
    std::size_t index = colliders.size();
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
    if (error != std::errc{} || second == std::string_view::npos || end != rest.data() + second ||
        index >= colliders.size())
        value.fail(value.root, std::string(key),
                   "the scene has " + std::to_string(colliders.size()) + " colliders; write colliders.0.radius");
    return std::pair{index, rest.substr(second + 1)};
}

/// The collider N of the key `colliders.N` with the value `none`: it is to go.
std::optional<std::size_t> collider_to_remove(const Scene& scene, std::string_view key, const Document& value) {
    constexpr std::string_view prefix = "colliders.";
    if (!key.starts_with(prefix) || value.root.type != Node::Type::string || value.root.text != "none")
        return std::nullopt;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data() + prefix.size(), key.data() + key.size(), index);
    if (error != std::errc{} || end != key.data() + key.size() || index >= scene.simulation.colliders.size())
        return std::nullopt;
    return index;
}

/// Shader and parameter of `look.shaders.SHADER.PARAMETER`; nothing for another key.
std::optional<std::pair<std::string, std::string>> shader_key(std::string_view key) {
    constexpr std::string_view prefix = "look.shaders.";
    if (!key.starts_with(prefix))
        return std::nullopt;
    const std::string_view rest = key.substr(prefix.size());
    const std::size_t dot = rest.find('.');
    if (dot == std::string_view::npos || dot == 0 || dot + 1 == rest.size())
        throw SceneError(std::string(key) + ": write look.shaders.SHADER.PARAMETER");
    return std::pair{std::string(rest.substr(0, dot)), std::string(rest.substr(dot + 1))};
}

} // namespace

void set_parameter(Scene& scene, std::string_view key, std::string_view value) {
    const std::string name(key);
    const std::string source = "--set " + name + "=" + std::string(value);
    if (value.empty())
        throw SceneError(source + ": no value; write KEY=VALUE");
    if (key == "name")
        return void(scene.name = std::string(value));
    if (key == "description")
        return void(scene.description = std::string(value));
    try {
        const Document document = value_document(value, source);
        Reader reader(document);
        if (key == "rules")
            return set_rules(scene, document);
        if (key == "cloth.pinned")
            return void(scene.simulation.cloth.pinned = reader.pinned(document.root, name));
        if (key == "simulation.accelerations")
            return void(scene.simulation.stepping.accelerations = reader.vectors(document.root, name));
        if (const auto parts = shader_key(key))
            return void(scene.look.shaders[parts->first][parts->second] = reader.shader_value(document.root, name));
        if (const auto index = collider_to_remove(scene, key, document)) {
            auto& colliders = scene.simulation.colliders;
            colliders.erase(colliders.begin() + static_cast<std::ptrdiff_t>(*index));
            return;
        }
        if (const auto collider = collider_key(scene, key, document))
            return set_collider(scene, collider->first, collider->second, document, name);
        if (const Field* f = find_field(key))
            return reader.value(document.root, *f, scene);
        Names allowed;
        for (const Field& f : fields())
            allowed.push_back(f.key);
        const auto meant = nearest(key, allowed);
        throw SceneError(source + ": unknown parameter" +
                         (meant ? "; did you mean " + std::string(*meant) + "?" : std::string()) +
                         " See `clothlab list parameters`");
    } catch (const SceneError& e) {
        // A line number means nothing in one argument.
        std::string what = e.what();
        const std::string numbered = source + ":1:";
        if (what.rfind(numbered, 0) == 0)
            what.replace(0, numbered.size(), source + ":");
        throw SceneError(what);
    }
}

} // namespace clothlab::scene

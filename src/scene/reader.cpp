// From JSON to a scene. Strict: whatever is not understood is an error, because a misspelt stiffness must not default
// silently.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>

#include "scene/document.h"
#include "scene/fields.h"
#include "scene/io.h"

namespace clothlab::scene {
namespace {

using Names = std::vector<std::string_view>;

std::string list(const Names& names) {
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

std::string unknown(std::string_view name, const Names& allowed) {
    std::string text = "unknown key";
    if (const auto meant = nearest(name, allowed)) text += "; did you mean \"" + std::string(*meant) + "\"?";
    return text + (text.back() == '?' ? " Allowed are " : "; allowed are ") + list(allowed);
}

class Reader {
public:
    explicit Reader(const Document& document) : document_(document) {}

    Scene scene() {
        const Node& root = document_.root;
        if (root.type != Node::Type::object)
            document_.fail(root, "", "a scene is one JSON object, this is " + std::string(describe(root.type)));
        own_format_ = root.find("clothlab") != nullptr;
        if (!root.find("cloth") && !own_format_)
            document_.fail(root, "cloth", "missing; a scene needs a cloth");
        const Names allowed = own_format_ ? Names{"clothlab", "name", "description", "cloth", "colliders", "sphere", "plane",
                                                  "simulation", "wind", "rules", "camera", "look"}
                                          : Names{"cloth", "sphere", "plane"};
        Scene result;
        for (const auto& [name, node] : root.members) {
            if (name == "clothlab") version(node);
            else if (own_format_ && name == "name") result.name = text(node, name);
            else if (own_format_ && name == "description") result.description = text(node, name);
            else if (name == "sphere") result.simulation.colliders.emplace_back(sphere(node, name));
            else if (name == "plane") result.simulation.colliders.emplace_back(plane(node, name));
            else if (own_format_ && name == "colliders") colliders(node, result);
            else if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) section(node, name, result);
            else
                document_.fail(node, name,
                               unknown(name, allowed) +
                                   (own_format_ ? "" : " in a course scene; our own format starts with \"clothlab\": 1"));
        }
        return result;
    }

    /// The fields of a section, and what goes with them.
    void section(const Node& node, const std::string& name, Scene& result) {
        expect(node, name, Node::Type::object);
        Names allowed;
        for (const Field& f : fields())
            if (f.section() == name) allowed.push_back(f.name());
        if (name == "cloth") allowed.push_back("pinned");
        if (name == "simulation") allowed.push_back("accelerations");
        for (const auto& [member, value] : node.members) {
            const std::string key = name + "." + member;
            if (key == "cloth.pinned") result.simulation.cloth.pinned = pinned(value, key);
            else if (key == "simulation.accelerations") result.simulation.stepping.accelerations = vectors(value, key);
            else if (const Field* f = find_field(key)) this->value(value, *f, result);
            else document_.fail(value, key, unknown(member, allowed));
        }
        if (own_format_) return;
        for (const Field& f : fields())
            if (f.section() == name && f.required == Required::in_course_files && !node.find(f.name()))
                document_.fail(node, std::string(f.key), "missing; it must be " + allowed_values(f));
    }

    void value(const Node& node, const Field& f, Scene& result) {
        const std::string key(f.key);
        switch (f.type) {
            case FieldType::text: return f.set_text(result, text(node, key));
            case FieldType::vector: return f.set_vector(result, vector(node, key));
            case FieldType::boolean:
                if (node.type != Node::Type::boolean) wrong_type(node, f);
                return f.set(result, node.boolean ? 1 : 0);
            case FieldType::choice:
                if (!f.choice_as_integer) return choice(node, f, result);
                [[fallthrough]];
            case FieldType::number:
            case FieldType::integer:
                if (node.type != Node::Type::number) wrong_type(node, f);
                if (const auto why = objection(f, node.number)) document_.fail(node, key, *why);
                return f.set(result, node.number);
        }
    }

    sim::Sphere sphere(const Node& node, const std::string& key, Names allowed = {"origin", "radius", "friction"}) {
        Members members(*this, node, key, allowed);
        sim::Sphere s;
        s.origin = vector(members.required("origin"), key + ".origin");
        const Node& radius = members.required("radius");
        s.radius = number(radius, key + ".radius");
        if (!(s.radius > 0)) document_.fail(radius, key + ".radius", "it must be a number above 0, in m");
        s.friction = friction(members, key);
        return s;
    }

    sim::Plane plane(const Node& node, const std::string& key, Names allowed = {"point", "normal", "friction"}) {
        Members members(*this, node, key, allowed);
        sim::Plane p;
        p.point = vector(members.required("point"), key + ".point");
        const Node& normal = members.required("normal");
        p.normal = vector(normal, key + ".normal");
        const double length = std::hypot(p.normal.x, p.normal.y, p.normal.z);
        if (!(length > 0) || !std::isfinite(length))
            document_.fail(normal, key + ".normal", "the zero vector has no direction; any other length will do");
        p.friction = friction(members, key);
        return p;
    }

    std::vector<sim::GridPoint> pinned(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::array);
        std::vector<sim::GridPoint> points;
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            const Node& pair = node.items[i];
            const std::string at = key + "[" + std::to_string(i) + "]";
            if (pair.type != Node::Type::array || pair.items.size() != 2)
                document_.fail(pair, at, "a pin is a list of two whole numbers, [column, row]");
            sim::GridPoint point{};
            for (std::size_t k = 0; k < 2; ++k) {
                const double v = number(pair.items[k], at);
                if (v != std::floor(v) || !(std::abs(v) < 1e9))
                    document_.fail(pair, at, "a pin is a list of two whole numbers, [column, row]");
                point[k] = static_cast<int>(v);
            }
            points.push_back(point);
            pins.push_back(&pair);
        }
        return points;
    }

    std::vector<sim::Vec3> vectors(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::array);
        std::vector<sim::Vec3> result;
        for (const Node& item : node.items) result.push_back(vector(item, key + "[" + std::to_string(result.size()) + "]"));
        return result;
    }

    sim::Vec3 vector(const Node& node, const std::string& key) {
        if (node.type != Node::Type::array || node.items.size() != 3)
            document_.fail(node, key,
                           "it must be a list of three numbers, this is " + std::string(describe(node.type)) +
                               (node.items.empty() ? "" : " of " + std::to_string(node.items.size())));
        std::array<double, 3> v{};
        for (std::size_t k = 0; k < 3; ++k) v[k] = number(node.items[k], key + "[" + std::to_string(k) + "]");
        return {v[0], v[1], v[2]};
    }

    std::string text(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::string);
        return node.text;
    }

    std::vector<const Node*> pins;  ///< where the pins stand, for errors that need the grid

private:
    /// An object with a fixed set of keys.
    class Members {
    public:
        Members(Reader& reader, const Node& node, std::string key, const Names& allowed)
            : reader_(reader), node_(node), key_(std::move(key)) {
            reader.expect(node, key_, Node::Type::object);
            for (const auto& [name, value] : node.members)
                if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
                    reader.document_.fail(value, key_ + "." + name, unknown(name, allowed));
        }
        const Node& required(std::string_view name) const {
            if (const Node* n = node_.find(name)) return *n;
            reader_.document_.fail(node_, key_ + "." + std::string(name), "missing");
        }
        const Node* optional(std::string_view name) const { return node_.find(name); }

    private:
        Reader& reader_;
        const Node& node_;
        std::string key_;
    };

    void version(const Node& node) {
        if (node.type != Node::Type::number || node.number != format_version)
            document_.fail(node, "clothlab",
                           "this program reads version " + std::to_string(format_version) + " of the scene format");
    }

    void colliders(const Node& node, Scene& result) {
        expect(node, "colliders", Node::Type::array);
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            const Node& item = node.items[i];
            const std::string key = "colliders[" + std::to_string(i) + "]";
            expect(item, key, Node::Type::object);
            const Node* type = item.find("type");
            if (!type) document_.fail(item, key + ".type", "missing; it must be \"sphere\" or \"plane\"");
            if (type->text == "sphere") result.simulation.colliders.emplace_back(sphere(item, key, {"type", "origin", "radius", "friction"}));
            else if (type->text == "plane") result.simulation.colliders.emplace_back(plane(item, key, {"type", "point", "normal", "friction"}));
            else document_.fail(*type, key + ".type", "it must be \"sphere\" or \"plane\"");
        }
    }

    double friction(const Members& members, const std::string& key) {
        const Node* node = own_format_ ? members.optional("friction") : &members.required("friction");
        if (!node) return 0;
        const double f = number(*node, key + ".friction");
        if (!(f >= 0 && f <= 1))
            document_.fail(*node, key + ".friction", "it must be a number from 0 (slides freely) to 1 (sticks)");
        return f;
    }

    void choice(const Node& node, const Field& f, Scene& result) {
        if (node.type != Node::Type::string) wrong_type(node, f);
        for (std::size_t i = 0; i < f.choices.size(); ++i)
            if (f.choices[i] == node.text) return f.set(result, static_cast<double>(i));
        document_.fail(node, std::string(f.key), "\"" + node.text + "\" is not allowed; it must be " + allowed_values(f));
    }

    double number(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::number);
        return node.number;
    }

    void expect(const Node& node, const std::string& key, Node::Type type) {
        if (node.type != type)
            document_.fail(node, key,
                           "it must be " + std::string(describe(type)) + ", this is " + std::string(describe(node.type)));
    }

    [[noreturn]] void wrong_type(const Node& node, const Field& f) {
        document_.fail(node, std::string(f.key),
                       "it must be " + allowed_values(f) + ", this is " + std::string(describe(node.type)));
    }

    const Document& document_;
    bool own_format_ = true;
};

void check_at(const Scene& scene, const std::function<void(std::size_t pin, const std::string&)>& fail_pin,
              const std::function<void(const std::string&)>& fail) {
    const sim::Cloth& cloth = scene.simulation.cloth;
    const double points = static_cast<double>(cloth.num_width_points) * cloth.num_height_points;
    if (points > max_points) {
        char text[160];
        std::snprintf(text, sizeof text, "cloth: %d x %d points are %.0f; at most %.0f are allowed",
                      cloth.num_width_points, cloth.num_height_points, points, max_points);
        fail(text);
    }
    for (std::size_t i = 0; i < cloth.pinned.size(); ++i) {
        const auto [column, row] = cloth.pinned[i];
        if (column >= 0 && column < cloth.num_width_points && row >= 0 && row < cloth.num_height_points) continue;
        fail_pin(i, "cloth.pinned[" + std::to_string(i) + "]: [" + std::to_string(column) + ", " + std::to_string(row) +
                        "] is outside the grid; columns are 0 to " + std::to_string(cloth.num_width_points - 1) +
                        " and rows 0 to " + std::to_string(cloth.num_height_points - 1));
    }
}

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

void set_rules(Scene& scene, const Document& value) {
    Scene changed = scene;
    for (const Field& f : fields()) {
        if (f.section() != "rules") continue;
        const auto choice = std::find(f.choices.begin(), f.choices.end(), value.root.text);
        if (choice == f.choices.end())
            value.fail(value.root, "rules", "it must be \"cs184\", or set one rule as in rules.limit=off");
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
        object.members = {{"origin", vector(s->origin)}, {"radius", scalar(s->radius)}, {"friction", scalar(s->friction)}};
    else if (const auto* p = std::get_if<sim::Plane>(&collider))
        object.members = {{"point", vector(p->point)}, {"normal", vector(p->normal)}, {"friction", scalar(p->friction)}};
    Names allowed;
    bool found = false;
    for (auto& [name, node] : object.members) {
        allowed.push_back(name);
        if (name != member) continue;
        node = value.root;
        found = true;
    }
    if (!found) value.fail(value.root, key, unknown(member, allowed));
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
    if (dot == std::string_view::npos) return std::nullopt;
    if (head == "sphere" || head == "plane") {
        for (std::size_t i = 0; i < colliders.size(); ++i)
            if (std::holds_alternative<sim::Sphere>(colliders[i]) == (head == "sphere"))
                return std::pair{i, key.substr(dot + 1)};
        value.fail(value.root, std::string(key), "the scene has no " + std::string(head));
    }
    if (head != "colliders") return std::nullopt;
    const std::string_view rest = key.substr(dot + 1);
    const std::size_t second = rest.find('.');
    std::size_t index = colliders.size();
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
    if (error != std::errc{} || second == std::string_view::npos || end != rest.data() + second || index >= colliders.size())
        value.fail(value.root, std::string(key),
                   "the scene has " + std::to_string(colliders.size()) + " colliders; write colliders.0.radius");
    return std::pair{index, rest.substr(second + 1)};
}

}  // namespace

Scene read_scene(std::string_view text, const std::string& source) {
    const Document document = Document::parse(text, source);
    Reader reader(document);
    Scene scene = reader.scene();
    const auto fail_pin = [&](std::size_t pin, const std::string& what) { document.fail(*reader.pins[pin], "", what); };
    check_at(scene, fail_pin, [&](const std::string& what) {
        const Node* cloth = document.root.find("cloth");
        document.fail(cloth ? *cloth : document.root, "", what);
    });
    return scene;
}

void check(const Scene& scene, const std::string& source) {
    const auto fail = [&](const std::string& what) { throw SceneError(source + ": " + what); };
    check_at(scene, [&](std::size_t, const std::string& what) { fail(what); }, fail);
}

Camera read_camera(std::string_view text, const std::string& source) {
    const Document document = Document::parse(text, source);
    Scene scene;
    scene.camera.emplace();
    Reader(document).section(document.root, "camera", scene);
    return *scene.camera;
}

void set_parameter(Scene& scene, std::string_view key, std::string_view value) {
    const std::string name(key);
    const std::string source = "--set " + name + "=" + std::string(value);
    if (value.empty()) throw SceneError(source + ": no value; write KEY=VALUE");
    if (key == "name") return void(scene.name = std::string(value));
    if (key == "description") return void(scene.description = std::string(value));
    try {
        const Document document = value_document(value, source);
        Reader reader(document);
        if (key == "rules") return set_rules(scene, document);
        if (key == "cloth.pinned") return void(scene.simulation.cloth.pinned = reader.pinned(document.root, name));
        if (key == "simulation.accelerations")
            return void(scene.simulation.stepping.accelerations = reader.vectors(document.root, name));
        if (const auto collider = collider_key(scene, key, document))
            return set_collider(scene, collider->first, collider->second, document, name);
        if (const Field* f = find_field(key)) return reader.value(document.root, *f, scene);
        Names allowed;
        for (const Field& f : fields()) allowed.push_back(f.key);
        const auto meant = nearest(key, allowed);
        throw SceneError(source + ": unknown parameter" +
                         (meant ? "; did you mean " + std::string(*meant) + "?" : std::string()) +
                         " See `clothlab list parameters`");
    } catch (const SceneError& e) {
        // A line number means nothing in one argument.
        std::string what = e.what();
        const std::string numbered = source + ":1:";
        if (what.rfind(numbered, 0) == 0) what.replace(0, numbered.size(), source + ":");
        throw SceneError(what);
    }
}

}  // namespace clothlab::scene

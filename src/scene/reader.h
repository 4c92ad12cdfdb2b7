// From JSON to a scene, shared by whole files (reader.cpp) and single parameters (assign.cpp). Strict: whatever is not
// understood is an error, because a misspelt stiffness must not default silently.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.h"
#include "scene/fields.h"
#include "scene/io.h"

namespace clothlab::scene {

using Names = std::vector<std::string_view>;

inline std::string joined(const Names& names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

inline std::string unknown(std::string_view name, const Names& allowed) {
    std::string text = "unknown key";
    if (const auto meant = nearest(name, allowed))
        text += "; did you mean \"" + std::string(*meant) + "\"?";
    return text + (text.back() == '?' ? " Allowed are " : "; allowed are ") + joined(allowed);
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
        const Names allowed = own_format_
                                  ? Names{"clothlab", "name",       "description", "cloth", "colliders", "sphere",
                                          "plane",    "simulation", "wind",        "rules", "camera",    "look"}
                                  : Names{"cloth", "sphere", "plane"};
        Scene result;
        for (const auto& [name, node] : root.members) {
            if (name == "clothlab")
                version(node);
            else if (own_format_ && name == "name")
                result.name = text(node, name);
            else if (own_format_ && name == "description")
                result.description = text(node, name);
            else if (name == "sphere")
                result.simulation.colliders.emplace_back(sphere(node, name));
            else if (name == "plane")
                result.simulation.colliders.emplace_back(plane(node, name));
            else if (own_format_ && name == "colliders")
                colliders(node, result);
            else if (std::find(allowed.begin(), allowed.end(), name) != allowed.end())
                section(node, name, result);
            else
                document_.fail(
                    node, name,
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
            if (f.section() == name)
                allowed.push_back(f.name());
        if (name == "cloth")
            allowed.push_back("pinned");
        if (name == "simulation")
            allowed.push_back("accelerations");
        if (name == "look")
            allowed.push_back("shaders");
        for (const auto& [member, value] : node.members) {
            const std::string key = name + "." + member;
            if (key == "cloth.pinned")
                result.simulation.cloth.pinned = pinned(value, key);
            else if (key == "simulation.accelerations")
                result.simulation.stepping.accelerations = vectors(value, key);
            else if (key == "look.shaders")
                result.look.shaders = shaders(value, key);
            else if (const Field* f = find_field(key))
                this->value(value, *f, result);
            else
                document_.fail(value, key, unknown(member, allowed));
        }
        if (own_format_)
            return;
        for (const Field& f : fields())
            if (f.section() == name && f.required == Required::in_course_files && !node.find(f.name()))
                document_.fail(node, std::string(f.key), "missing; it must be " + allowed_values(f));
    }

    void value(const Node& node, const Field& f, Scene& result) {
        const std::string key(f.key);
        switch (f.type) {
        case FieldType::text:
            return f.set_text(result, text(node, key));
        case FieldType::vector:
            return f.set_vector(result, vector(node, key));
        case FieldType::boolean:
            if (node.type != Node::Type::boolean)
                wrong_type(node, f);
            return f.set(result, node.boolean ? 1 : 0);
        case FieldType::choice:
            if (!f.choice_as_integer)
                return choice(node, f, result);
            [[fallthrough]];
        case FieldType::number:
        case FieldType::integer:
            if (node.type != Node::Type::number)
                wrong_type(node, f);
            if (const auto why = objection(f, node.number))
                document_.fail(node, key, *why);
            return f.set(result, node.number);
        }
    }

    sim::Sphere sphere(const Node& node, const std::string& key, Names allowed = {"origin", "radius", "friction"}) {
        Members members(*this, node, key, allowed);
        sim::Sphere s;
        s.origin = vector(members.required("origin"), key + ".origin");
        const Node& radius = members.required("radius");
        s.radius = number(radius, key + ".radius");
        if (!(s.radius > 0))
            document_.fail(radius, key + ".radius", "it must be a number above 0, in m");
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
        for (const Node& item : node.items)
            result.push_back(vector(item, key + "[" + std::to_string(result.size()) + "]"));
        return result;
    }

    std::map<std::string, ShaderValues> shaders(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::object);
        std::map<std::string, ShaderValues> result;
        for (const auto& [shader, values] : node.members) {
            expect(values, key + "." + shader, Node::Type::object);
            for (const auto& [parameter, value] : values.members)
                result[shader][parameter] = shader_value(value, key + "." + shader + "." + parameter);
        }
        return result;
    }

    /// Which type a shader wants, only the shader knows: see check_shader_values.
    ShaderValue shader_value(const Node& node, const std::string& key) {
        switch (node.type) {
        case Node::Type::number:
            return node.number;
        case Node::Type::boolean:
            return node.boolean;
        case Node::Type::string:
            return node.text;
        case Node::Type::array:
            return vector(node, key);
        default:
            document_.fail(node, key, "it must be a number, true or false, a text, or a list of three numbers");
        }
    }

    sim::Vec3 vector(const Node& node, const std::string& key) {
        if (node.type != Node::Type::array || node.items.size() != 3)
            document_.fail(node, key,
                           "it must be a list of three numbers, this is " + std::string(describe(node.type)) +
                               (node.items.empty() ? "" : " of " + std::to_string(node.items.size())));
        std::array<double, 3> v{};
        for (std::size_t k = 0; k < 3; ++k)
            v[k] = number(node.items[k], key + "[" + std::to_string(k) + "]");
        return {v[0], v[1], v[2]};
    }

    std::string text(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::string);
        return node.text;
    }

    std::vector<const Node*> pins; ///< where the pins stand, for errors that need the grid

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
            if (const Node* n = node_.find(name))
                return *n;
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
            if (!type)
                document_.fail(item, key + ".type", "missing; it must be \"sphere\" or \"plane\"");
            if (type->text == "sphere")
                result.simulation.colliders.emplace_back(sphere(item, key, {"type", "origin", "radius", "friction"}));
            else if (type->text == "plane")
                result.simulation.colliders.emplace_back(plane(item, key, {"type", "point", "normal", "friction"}));
            else
                document_.fail(*type, key + ".type", "it must be \"sphere\" or \"plane\"");
        }
    }

    double friction(const Members& members, const std::string& key) {
        const Node* node = own_format_ ? members.optional("friction") : &members.required("friction");
        if (!node)
            return 0;
        const double f = number(*node, key + ".friction");
        if (!(f >= 0 && f <= 1))
            document_.fail(*node, key + ".friction", "it must be a number from 0 (slides freely) to 1 (sticks)");
        return f;
    }

    void choice(const Node& node, const Field& f, Scene& result) {
        if (node.type != Node::Type::string)
            wrong_type(node, f);
        for (std::size_t i = 0; i < f.choices.size(); ++i)
            if (f.choices[i] == node.text)
                return f.set(result, static_cast<double>(i));
        document_.fail(node, std::string(f.key),
                       "\"" + node.text + "\" is not allowed; it must be " + allowed_values(f));
    }

    double number(const Node& node, const std::string& key) {
        expect(node, key, Node::Type::number);
        return node.number;
    }

    void expect(const Node& node, const std::string& key, Node::Type type) {
        if (node.type != type)
            document_.fail(node, key,
                           "it must be " + std::string(describe(type)) + ", this is " +
                               std::string(describe(node.type)));
    }

    [[noreturn]] void wrong_type(const Node& node, const Field& f) {
        document_.fail(node, std::string(f.key),
                       "it must be " + allowed_values(f) + ", this is " + std::string(describe(node.type)));
    }

    const Document& document_;
    bool own_format_ = true;
};

} // namespace clothlab::scene

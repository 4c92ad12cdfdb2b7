#include "scene/shader_parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>

#include "scene/error.h"
#include "scene/fields.h"
#include "sim/point_quantities.h"

namespace clothlab::scene {
namespace {

using Attributes = std::map<std::string, std::string>;

[[noreturn]] void fail(int line, const std::string& what) {
    throw ShaderDeclarationError(what, line);
}

/// `word`, `key=value` and `key="some value"`, separated by blanks.
Attributes attributes(const std::string& text, int line) {
    static const std::regex item(R"re(\s*(\w+)(?:=(?:"([^"]*)"|([^\s"]+)))?(?=\s|$))re");
    Attributes result;
    auto at = text.cbegin();
    while (std::any_of(at, text.cend(), [](char c) { return c != ' ' && c != '\t'; })) {
        std::smatch match;
        if (!std::regex_search(at, text.cend(), match, item, std::regex_constants::match_continuous))
            fail(line, "not a list of key=value after //@: \"" + std::string(at, text.cend()) + "\"");
        result[match[1]] = match[2].matched ? match[2].str() : match[3].str();
        at = match[0].second;
    }
    return result;
}

std::string take(Attributes& from, const std::string& key, const std::string& otherwise = "") {
    const auto found = from.find(key);
    if (found == from.end())
        return otherwise;
    std::string value = std::move(found->second);
    from.erase(found);
    return value;
}

bool take_word(Attributes& from, const std::string& key) {
    return from.erase(key) > 0;
}

void nothing_left(const Attributes& rest, const std::string& of, const std::string& allowed, int line) {
    if (!rest.empty())
        fail(line, "\"" + rest.begin()->first + "\" means nothing for " + of + "; allowed are " + allowed);
}

double number(const std::string& text, const std::string& what, int line) {
    std::string_view digits = text;
    while (!digits.empty() && (digits.back() == ' ' || digits.back() == 'f' || digits.back() == 'F'))
        digits.remove_suffix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
        fail(line, what + " must be a number, not \"" + text + "\"");
    return value;
}

TextureUsage usage(const std::string& text, int line) {
    if (text == "colour")
        return TextureUsage::colour;
    if (text == "height")
        return TextureUsage::height;
    if (text == "ramp")
        return TextureUsage::ramp;
    fail(line, "texture must be colour, height or ramp, not \"" + text + "\"");
}

ShaderParameter parameter(const std::string& type, const std::string& name, const std::string& initialiser,
                          Attributes a, int line) {
    ShaderParameter p;
    p.name = name;
    p.label = take(a, "label", name);
    p.help = take(a, "help");
    const bool integer = type == "int";
    if (type == "float" || integer) {
        p.type = integer ? ShaderParameterType::integer : ShaderParameterType::number;
        p.unit = take(a, "unit");
        p.min = number(take(a, "min", "0"), "min", line);
        p.max = number(take(a, "max", "1"), "max", line);
        p.logarithmic = take_word(a, "log");
        nothing_left(a, "a number", "label, help, unit, min, max and log", line);
        if (!(p.min < p.max) || (p.logarithmic && !(p.min > 0)))
            fail(line, "the slider of " + name + " needs min below max, and for log min above 0");
        p.value = number(initialiser, "the initial value of " + name, line);
    } else if (type == "bool") {
        p.type = ShaderParameterType::flag;
        nothing_left(a, "a switch", "label and help", line);
        if (initialiser != "true" && initialiser != "false")
            fail(line, "the initial value of " + name + " must be true or false, not \"" + initialiser + "\"");
        p.value = initialiser == "true";
    } else if (type == "vec3") {
        p.type = ShaderParameterType::colour;
        const std::string text = take(a, "colour");
        nothing_left(a, "a colour", "label, help and colour", line);
        const auto value = colour_of(text);
        if (!value)
            fail(line, name + " needs a colour=\"#RRGGBB\", not \"" + text + "\"");
        p.value = *value;
    } else if (type == "sampler2D" || type == "samplerCube") {
        p.type = ShaderParameterType::texture;
        p.usage = type == "samplerCube" ? TextureUsage::environment : usage(take(a, "texture", "colour"), line);
        p.value = take(a, "default");
        nothing_left(a, "a texture", "label, help, texture and default", line);
    } else {
        fail(line, "a " + type + " cannot be a parameter; it must be float, int, bool, vec3, sampler2D or samplerCube");
    }
    return p;
}

/// A comment on a line of its own: about the shader as a whole.
void about(ShaderDeclaration& shader, const std::string& text, int line) {
    Attributes a = attributes(text, line);
    if (take_word(a, "shader")) {
        shader.title = take(a, "title", shader.title);
        shader.help = take(a, "help", shader.help);
        shader.lines = take_word(a, "lines") || shader.lines;
        shader.translucent = take_word(a, "translucent") || shader.translucent;
        shader.quantity = take(a, "quantity", shader.quantity);
        if (!shader.quantity.empty() && !sim::find_point_quantity(shader.quantity))
            fail(line, "no such quantity as \"" + shader.quantity +
                           "\"; there are strain, speed, gap, curvature and distance");
        nothing_left(a, "a shader", "title, help, lines, translucent and quantity", line);
    } else if (take_word(a, "legend")) {
        ShaderLegend legend{take(a, "title"), take(a, "unit"), take(a, "low"), take(a, "high"), take(a, "map")};
        nothing_left(a, "a legend", "title, unit, low, high and map", line);
        shader.legend = std::move(legend);
    } else {
        fail(line, "//@ on a line of its own starts with \"shader\" or \"legend\"");
    }
}

std::string kind_of(const ShaderParameter& p) {
    switch (p.type) {
    case ShaderParameterType::flag:
        return "true or false";
    case ShaderParameterType::colour:
        return "a colour, \"#RRGGBB\" or a list of three numbers from 0 to 1";
    case ShaderParameterType::texture:
        return "a text, the name of a texture or of a file";
    case ShaderParameterType::integer:
        return "a whole number";
    case ShaderParameterType::number:
        break;
    }
    return "a number";
}

} // namespace

const ShaderParameter* ShaderDeclaration::find(std::string_view parameter) const {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const ShaderParameter& p) { return p.name == parameter; });
    return found == parameters.end() ? nullptr : &*found;
}

ShaderDeclaration read_shader_declaration(const std::string& name, std::string_view text) {
    static const std::regex declared(R"(^\s*uniform\s+(\w+)\s+(\w+)\s*(?:=\s*([^;]*?)\s*)?;\s*$)");
    ShaderDeclaration shader;
    shader.name = shader.title = name;
    int legend_line = 0, n = 0;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) {
        ++n;
        const std::size_t mark = line.find("//@");
        if (mark == std::string::npos)
            continue;
        const std::string before = line.substr(0, mark), after = line.substr(mark + 3);
        std::smatch match;
        if (before.find_first_not_of(" \t") == std::string::npos) {
            about(shader, after, n);
            if (shader.legend && legend_line == 0)
                legend_line = n;
        } else if (std::regex_match(before, match, declared)) {
            if (!shader.find(match[2].str()))
                shader.parameters.push_back(parameter(match[1], match[2], match[3], attributes(after, n), n));
        } else {
            fail(n,
                 "//@ belongs behind a uniform's declaration, `uniform TYPE NAME = VALUE;`, or on a line of its own");
        }
    }
    if (shader.legend) {
        for (const std::string& end : {shader.legend->low, shader.legend->high})
            if (const ShaderParameter* p = shader.find(end); !p || p->type != ShaderParameterType::number)
                fail(legend_line,
                     "the legend's low and high must name parameters that are numbers, not \"" + end + "\"");
        if (const ShaderParameter* p = shader.find(shader.legend->map);
            !p || p->type != ShaderParameterType::texture || p->usage != TextureUsage::ramp)
            fail(legend_line, "the legend's map must name a texture=ramp, not \"" + shader.legend->map + "\"");
    }
    return shader;
}

std::optional<std::string> objection(const ShaderParameter& p, const ShaderValue& value) {
    bool right = false;
    switch (p.type) {
    case ShaderParameterType::number:
        right = std::holds_alternative<double>(value);
        break;
    case ShaderParameterType::integer:
        right = std::holds_alternative<double>(value) &&
                std::floor(std::get<double>(value)) == std::get<double>(value) &&
                std::abs(std::get<double>(value)) < 1e9;
        break;
    case ShaderParameterType::flag:
        right = std::holds_alternative<bool>(value);
        break;
    case ShaderParameterType::colour:
        if (const auto* text = std::get_if<std::string>(&value))
            right = colour_of(*text).has_value();
        else if (const auto* v = std::get_if<sim::Vec3>(&value))
            right = std::min({v->x, v->y, v->z}) >= 0 && std::max({v->x, v->y, v->z}) <= 1;
        break;
    case ShaderParameterType::texture:
        right = std::holds_alternative<std::string>(value);
        break;
    }
    if (right)
        return std::nullopt;
    return "it must be " + kind_of(p);
}

ShaderValue value_of(const Look& look, const ShaderDeclaration& shader, const ShaderParameter& parameter) {
    const auto values = look.shaders.find(shader.name);
    if (values == look.shaders.end())
        return parameter.value;
    const auto found = values->second.find(parameter.name);
    if (found == values->second.end() || objection(parameter, found->second))
        return parameter.value;
    if (const auto* text = std::get_if<std::string>(&found->second);
        text && parameter.type == ShaderParameterType::colour)
        return *colour_of(*text);
    return found->second;
}

void set_value(Look& look, const ShaderDeclaration& shader, const ShaderParameter& parameter,
               const ShaderValue& value) {
    if (value != parameter.value) {
        look.shaders[shader.name][parameter.name] = value;
        return;
    }
    const auto values = look.shaders.find(shader.name);
    if (values == look.shaders.end())
        return;
    values->second.erase(parameter.name);
    if (values->second.empty())
        look.shaders.erase(values);
}

double number_of(const Look& look, const ShaderDeclaration& shader, std::string_view parameter) {
    const ShaderParameter* p = shader.find(parameter);
    if (!p)
        return 0;
    const ShaderValue value = value_of(look, shader, *p);
    const auto* number = std::get_if<double>(&value);
    return number ? *number : 0;
}

void check_shader_values(const Look& look, const std::vector<ShaderDeclaration>& shaders, const std::string& source) {
    for (const auto& [name, values] : look.shaders) {
        const auto shader = std::find_if(shaders.begin(), shaders.end(),
                                         [&name = name](const ShaderDeclaration& s) { return s.name == name; });
        if (shader == shaders.end() || !shader->error.empty())
            continue;
        for (const auto& [parameter, value] : values) {
            const std::string key = source + ": look.shaders." + name + "." + parameter + ": ";
            const ShaderParameter* p = shader->find(parameter);
            if (!p) {
                std::vector<std::string_view> names;
                for (const ShaderParameter& other : shader->parameters)
                    names.push_back(other.name);
                std::string allowed;
                for (const std::string_view other : names)
                    allowed += (allowed.empty() ? "" : ", ") + std::string(other);
                const auto meant = nearest(parameter, names);
                throw SceneError(key + "the shader has no such parameter" +
                                 (meant ? "; did you mean \"" + std::string(*meant) + "\"?" : "") +
                                 (allowed.empty() ? "; it has none" : "; it has " + allowed));
            }
            if (const auto why = objection(*p, value))
                throw SceneError(key + *why);
        }
    }
}

std::optional<sim::Vec3> colour_of(std::string_view text) {
    unsigned rgb = 0;
    if (text.size() != 7 || text.front() != '#')
        return std::nullopt;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
    if (error != std::errc() || end != text.data() + 7)
        return std::nullopt;
    return sim::Vec3{(rgb >> 16) / 255.0, (rgb >> 8 & 255u) / 255.0, (rgb & 255u) / 255.0};
}

} // namespace clothlab::scene

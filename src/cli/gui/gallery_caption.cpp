#include "cli/gui/gallery_caption.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <variant>

#include "scene/fields.h"
#include "sim/intersections.h"
#include "sim/model.h"

namespace clothlab::cli {
namespace {

using Shaders = std::vector<scene::ShaderDeclaration>;

/// m/s: slower than the first is at rest to the eye, slower than the second shifts or trembles without going anywhere.
constexpr double rest_speed = 0.01, slow_speed = 0.1;
/// Said of every run, changed or not; in this order.
constexpr std::array usual{"cloth.ks", "cloth.density", "cloth.damping"};

/// Between a number's groups and before its unit: no line is broken there.
const std::string unbroken_space = "\u00a0";

std::string text(const char* format, auto... arguments) {
    char buffer[320];
    std::snprintf(buffer, sizeof buffer, format, arguments...);
    return buffer;
}

std::string value_of(const scene::Field& f, const scene::Scene& scene) {
    const std::string unit = f.shown.unit.empty() ? "" : unbroken_space + std::string(f.shown.unit);
    switch (f.type) {
    case scene::FieldType::boolean:
        return f.get(scene) != 0 ? "on" : "off";
    case scene::FieldType::choice:
        return std::string(f.choices[static_cast<std::size_t>(f.get(scene))]);
    case scene::FieldType::text:
        return f.get_text(scene);
    case scene::FieldType::vector: {
        const sim::Vec3 v = f.get_vector(scene);
        return "(" + readable(v.x * f.shown.factor) + ", " + readable(v.y * f.shown.factor) + ", " +
               readable(v.z * f.shown.factor) + ")" + unit;
    }
    case scene::FieldType::number:
    case scene::FieldType::integer:
        break;
    }
    return readable(f.get(scene) * f.shown.factor) + unit;
}

/// Two digits, and no exponent as long as it can be read without.
std::string rough(double value) {
    const double unit = value == 0 ? 1 : std::pow(10.0, std::floor(std::log10(std::abs(value))) - 1);
    return readable(std::round(value / unit) * unit);
}

/// "Stiffness" within a sentence; "XPBD" stays.
std::string lower(std::string_view label) {
    std::string word(label);
    if (word.size() > 1 && word[0] >= 'A' && word[0] <= 'Z' && !(word[1] >= 'A' && word[1] <= 'Z'))
        word[0] = static_cast<char>(word[0] - 'A' + 'a');
    return word;
}

bool begins(const std::string& key, const char* what) {
    return key.rfind(what, 0) == 0;
}

/// The parameter of a shader that the key "look.shaders.SHADER.PARAMETER" means, with its value; nothing for any other.
std::string shader_value(const std::string& key, const scene::Scene& scene, const Shaders& shaders) {
    const std::string beginning = "look.shaders.";
    const std::size_t dot = key.rfind('.');
    if (!begins(key, beginning.c_str()) || dot <= beginning.size())
        return "";
    const std::string name = key.substr(beginning.size(), dot - beginning.size());
    for (const scene::ShaderDeclaration& shader : shaders)
        if (const scene::ShaderParameter* p = shader.name == name ? shader.find(key.substr(dot + 1)) : nullptr) {
            const scene::ShaderValue value = scene::value_of(scene.look, shader, *p);
            std::string shown;
            if (const double* number = std::get_if<double>(&value))
                shown = readable(*number) + (p->unit.empty() ? "" : unbroken_space + p->unit);
            else if (const bool* on = std::get_if<bool>(&value))
                shown = *on ? "on" : "off";
            else if (const std::string* word = std::get_if<std::string>(&value))
                shown = *word;
            return lower(p->label) + (shown.empty() ? "" : " " + shown);
        }
    return "";
}

/// "shear springs off", "density 15 g/cm²"; a key that is no parameter with a name, such as "sphere.radius", as it was
/// written.
std::string described(const std::string& setting, const scene::Scene& scene, const Shaders& shaders) {
    const std::string key = setting.substr(0, setting.find('='));
    if (const std::string shown = shader_value(key, scene, shaders); !shown.empty())
        return shown;
    if (key == "cloth.pinned")
        return text("%zu pins", scene.simulation.cloth.pinned.size());
    if (const scene::Field* f = scene::find_field(key))
        return lower(f->label) + " " + value_of(*f, scene);
    return key + " " + setting.substr(std::min(setting.size(), key.size() + 1));
}

/// Points that lie below a plane, by more than contact leaves them.
std::size_t points_below_planes(const scene::Scene& scene, const sim::Snapshot& snapshot) {
    std::size_t count = 0;
    const std::vector<float>& x = snapshot.positions;
    for (std::size_t i = 0; i + 2 < x.size(); i += 3) {
        const std::array<double, 3> at{static_cast<double>(x[i]), static_cast<double>(x[i + 1]),
                                       static_cast<double>(x[i + 2])};
        count += std::any_of(scene.simulation.colliders.begin(), scene.simulation.colliders.end(), [&](const auto& c) {
            const auto* plane = std::get_if<sim::Plane>(&c);
            if (!plane)
                return false;
            const sim::Vec3 &n = plane->normal, &p = plane->point;
            const double height =
                ((at[0] - p.x) * n.x + (at[1] - p.y) * n.y + (at[2] - p.z) * n.z) / std::hypot(n.x, n.y, n.z);
            return height < -sim::plane_offset;
        });
    }
    return count;
}

/// m/s, root mean square over all points.
double mean_speed(const sim::Snapshot& now, const sim::Snapshot& before) {
    double sum = 0;
    for (std::size_t i = 0; i < now.positions.size(); ++i) {
        const double moved = static_cast<double>(now.positions[i]) - static_cast<double>(before.positions[i]);
        sum += moved * moved;
    }
    return std::sqrt(3 * sum / static_cast<double>(now.positions.size())) / (now.time - before.time);
}

std::string stability(const scene::Scene& scene, const sim::StabilityMargin& margin) {
    if (margin.stable())
        return std::isinf(margin.limit) ? text("stable at any step (omega dt %.3g)", margin.omega_dt)
                                        : text("omega dt %.3g, stable up to %.3g", margin.omega_dt, margin.limit);
    if (scene.simulation.cloth.density < 0)
        return "unstable whatever the step: the mass is negative, so springs push where they should pull";
    return text("omega dt %.3g > %.3g: unstable; ks up to ", margin.omega_dt, margin.limit) + readable(margin.ks_max) +
           " N/m or " + readable(margin.substeps_min) + " substeps would be stable";
}

/// How the run is doing: its trouble, else its stability margin, speed, strain, and where the cloth passes through a
/// plane or itself.
void describe_outcome(const scene::Scene& scene, const sim::Snapshot& snapshot, const sim::Snapshot& before,
                      Caption& caption) {
    const sim::Diagnostics& d = snapshot.diagnostics;
    caption.trouble = d.status != sim::Status::ok;
    if (caption.trouble)
        caption.outcome = (d.status == sim::Status::jitter ? "Jitter: " : "Blown up: ") + d.cause + ".";
    if (d.status == sim::Status::diverged)
        return; // there is no cloth left to speak of
    std::string& s = caption.outcome;
    s += s.empty() ? "" : " ";
    if (snapshot.steps == 0)
        return void(s += "At the start, before the first step.");
    const double speed = mean_speed(snapshot, before);
    s += speed < rest_speed   ? "At rest (" + rough(1000 * speed) + unbroken_space + "mm/s)"
         : speed < slow_speed ? "Nearly at rest (" + rough(1000 * speed) + unbroken_space + "mm/s)"
                              : "In motion (" + rough(speed) + unbroken_space + "m/s)";
    s += d.max_strain < 1e-4 ? ", strain below 0.01 %"
                             : ", largest strain " + rough(100 * d.max_strain) + unbroken_space + "%";
    if (scene.simulation.rules.limit == sim::LimitRule::cs184 && d.max_strain > sim::stretch_limit - 1 - 1e-4)
        s += (d.max_strain < 1.05 * (sim::stretch_limit - 1) ? " at" : " beyond") +
             text(" the stretch limit of %.2g %%", 100 * (sim::stretch_limit - 1));
    if (!caption.trouble && snapshot.stability) {
        s += "; " + stability(scene, *snapshot.stability);
        caption.trouble = !snapshot.stability->stable();
    }
    s += ".";
    if (const std::size_t below = points_below_planes(scene, snapshot); below > 0) {
        s += " " + readable(static_cast<double>(below)) + " points are below the plane";
        s += scene.simulation.rules.plane == sim::PlaneRule::cs184
                 ? ": the course's contact stops only what crosses the plane within a step, and leaves below it what "
                   "begins a step there."
                 : ".";
        caption.trouble = true;
    }
    if (const std::size_t crossings = sim::count_intersections(snapshot.columns, snapshot.rows, snapshot.positions);
        crossings > 0)
        s += " The cloth passes through itself in " + readable(static_cast<double>(crossings)) + " places.";
}

} // namespace

std::string readable(double value) {
    if (!std::isfinite(value))
        return std::isnan(value) ? "not a number" : value > 0 ? "infinite" : "-infinite";
    const double whole = std::round(value);
    if (std::abs(value) < 1000 || std::abs(value) >= 1e12)
        return text("%.4g", value);
    std::string digits = text("%.0f", whole);
    const std::size_t sign = value < 0 ? 1 : 0;
    for (std::size_t end = digits.size(); end > 3 + sign; end -= 3)
        digits.insert(end - 3, unbroken_space);
    return digits;
}

Caption caption(const scene::Scene& scene, const Shaders& shaders, const std::vector<std::string>& settings,
                const sim::Snapshot& snapshot, const sim::Snapshot& before) {
    Caption result;
    const sim::Description& d = scene.simulation;
    std::string& p = result.parameters;
    p = scene.name + ":";
    for (const char* key : usual) {
        const scene::Field& f = *scene::find_field(key);
        const bool ks = std::string_view(key) == "cloth.ks"; // "Stiffness ks" is long where it stands on every picture
        p += (p.back() == ':' ? " " : ", ") + (ks ? "ks" : lower(f.label)) + " " + value_of(f, scene);
    }
    p += text(", %d × %d points", d.cloth.num_width_points, d.cloth.num_height_points);
    const auto shader =
        std::find_if(shaders.begin(), shaders.end(), [&](const auto& s) { return s.name == scene.look.shader; });
    result.look = "Shader " + (shader == shaders.end() ? scene.look.shader : shader->title);
    for (const std::string& setting : settings) {
        const std::string key = setting.substr(0, setting.find('='));
        const bool said = std::find(usual.begin(), usual.end(), key) != usual.end() || key == "look.shader" ||
                          begins(key, "camera.") || begins(key, "cloth.num_");
        if (said)
            continue;
        (begins(key, "look.") ? result.look : p) += ", " + described(setting, scene, shaders);
    }
    p += text("; frame %llu, %.3g s", static_cast<unsigned long long>(snapshot.frame), snapshot.time);
    describe_outcome(scene, snapshot, before, result);
    return result;
}

} // namespace clothlab::cli

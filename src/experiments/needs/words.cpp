#include "experiments/needs/words.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sim/integrators/integrator.h"

namespace clothlab::experiments::needs::words {
namespace {

std::string place(const sim::Vec3& p) {
    return "(" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ") m";
}

bool has_friction(const sim::Description& of) {
    for (const sim::Collider& collider : of.colliders)
        if (std::visit([](const auto& shape) { return shape.friction; }, collider) != 0)
            return true;
    return false;
}

/// Collects what is gone.
class Differences {
public:
    std::vector<std::string> list;
    void gone(bool in_full, bool in_model, const std::string& what) {
        if (in_full && !in_model)
            list.push_back("no " + what);
    }
    void changed(bool differs, const std::string& what) {
        if (differs)
            list.push_back(what);
    }
};

} // namespace

std::string number(double value, int digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::abs(value) >= 1000 && std::abs(value) < 1e6) // 1230, not 1.23e+03
        std::snprintf(text, sizeof text, "%.0f", std::strtod(text, nullptr));
    return text;
}

std::string counted(int n, std::string_view thing) {
    return std::to_string(n) + " " + std::string(thing) + (n == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& list) {
    std::string text;
    for (std::size_t i = 0; i < list.size(); ++i)
        text += (i == 0 ? "" : i + 1 < list.size() ? ", " : " and ") + list[i];
    return text;
}

std::string grid(const sim::Cloth& cloth) {
    return std::to_string(cloth.num_width_points) + " x " + std::to_string(cloth.num_height_points) + " points";
}

std::string pins(const std::vector<sim::GridPoint>& pins) {
    std::string text = "[";
    for (const auto& [column, row] : pins)
        text += (text.size() > 1 ? ",[" : "[") + std::to_string(column) + "," + std::to_string(row) + "]";
    return text + "]";
}

std::string collider(const sim::Collider& collider) {
    if (const auto* sphere = std::get_if<sim::Sphere>(&collider))
        return "the sphere at " + place(sphere->origin);
    return "the plane at " + place(std::get<sim::Plane>(collider).point);
}

std::string self_collision(sim::SelfCollisionRule rule) {
    switch (rule) {
    case sim::SelfCollisionRule::none:
        return "no self-collision";
    case sim::SelfCollisionRule::neighbours:
        return "self-collision of points, in all cells";
    case sim::SelfCollisionRule::triangles:
        return "self-collision of triangles";
    case sim::SelfCollisionRule::cs184:
        break;
    }
    return "self-collision by the course's rule";
}

std::string difference(const sim::Description& model, const sim::Description& full) {
    const sim::Stepping& stepping = model.stepping;
    Differences d;
    d.list.push_back(counted(stepping.substeps, "substep") + " of " +
                     std::string(sim::traits(stepping.integrator).title));
    d.changed(model.stepping.iterations != full.stepping.iterations, counted(stepping.iterations, "iteration"));
    d.changed(model.stepping.tolerance != full.stepping.tolerance, "solver tolerance " + number(stepping.tolerance));
    d.changed(model.cloth.num_width_points != full.cloth.num_width_points ||
                  model.cloth.num_height_points != full.cloth.num_height_points,
              grid(model.cloth));
    d.changed(model.stepping.precision != full.stepping.precision, "single precision");
    d.gone(full.cloth.enable_structural, model.cloth.enable_structural, "structural springs");
    d.gone(full.cloth.enable_shearing, model.cloth.enable_shearing, "shear springs");
    d.gone(full.cloth.enable_bending, model.cloth.enable_bending, "bending springs");
    d.changed(model.rules.self_collision != full.rules.self_collision, self_collision(model.rules.self_collision));
    const bool limit_differs = model.rules.limit != full.rules.limit;
    d.changed(limit_differs && model.rules.limit == sim::LimitRule::off, "no stretch limit");
    d.changed(limit_differs && model.rules.limit == sim::LimitRule::cs184, "one sweep of the stretch limit");
    const bool windy = model.wind.kind != sim::WindKind::none;
    d.gone(full.wind.kind != sim::WindKind::none, windy, "wind");
    d.gone(windy && full.wind.lift != 0, model.wind.lift != 0, "lift");
    d.gone(windy && full.wind.drag != 0, model.wind.drag != 0, "drag");
    d.gone(windy && full.wind.gust != 0, model.wind.gust != 0, "gusts");
    const bool course = full.rules.damping == sim::DampingRule::cs184;
    d.gone((course ? full.cloth.damping : full.cloth.damping_rate) != 0,
           (course ? model.cloth.damping : model.cloth.damping_rate) != 0, "damping");
    d.gone(full.stepping.spring_damping != 0, stepping.spring_damping != 0, "spring damping");
    const std::size_t gone = full.colliders.size() - model.colliders.size();
    d.gone(has_friction(full), has_friction(model) || model.colliders.empty(), "friction");
    if (gone > 0)
        d.list.push_back(model.colliders.empty() ? "no colliders"
                                                 : "without " + counted(static_cast<int>(gone), "collider"));
    std::string text;
    for (const std::string& one : d.list)
        text += (text.empty() ? "" : ", ") + one;
    return text;
}

} // namespace clothlab::experiments::needs::words

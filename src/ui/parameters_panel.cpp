// Live sliders for everything that the simulation depends on.
#include <cstdio>
#include <imgui.h>
#include <vector>

#include "sim/integrators/integrator.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

void group(Lab& lab, const char* title, std::initializer_list<std::string_view> keys, bool open = true) {
    if (!ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0))
        return;
    if (!begin_fields((std::string(title) + "##fields").c_str()))
        return;
    for (const std::string_view key : keys)
        field_row(lab, key);
    end_fields();
}

/// Every method with what is known of it.
std::span<const ChoiceText> method_texts() {
    static const std::vector<ChoiceText> texts = [] {
        std::vector<ChoiceText> list;
        for (const sim::IntegratorInfo& i : sim::integrators())
            list.push_back(
                {std::string(i.title), std::string(i.help) + "\n\nOrder " + std::to_string(i.order) + ", " +
                                           std::string(sim::family_names[static_cast<std::size_t>(i.family)]) +
                                           ".\nLargest omega dt: " + std::string(i.limit_formula) + ".\nA step costs " +
                                           std::string(i.cost) + ".\n" + std::string(i.source) + "."});
        return list;
    }();
    return texts;
}

/// The method, and those parameters that it has.
void method(Lab& lab) {
    if (!ImGui::CollapsingHeader("Method", ImGuiTreeNodeFlags_DefaultOpen) || !begin_fields("method##fields"))
        return;
    field_row(lab, "simulation.integrator", method_texts());
    const sim::IntegratorTraits& traits = sim::traits(lab.scene.simulation.stepping.integrator);
    if (traits.options & sim::uses_iterations)
        field_row(lab, "simulation.iterations");
    if (traits.options & sim::uses_tolerance)
        field_row(lab, "simulation.tolerance");
    if (traits.options & sim::uses_pbd_stiffness)
        field_row(lab, "simulation.pbd_stiffness");
    if (traits.options & sim::uses_spring_damping)
        field_row(lab, "simulation.spring_damping");
    if (traits.options & sim::uses_first_guess)
        field_row(lab, "simulation.first_guess");
    if (traits.options & sim::uses_acceleration)
        field_row(lab, "simulation.acceleration");
    field_row(lab, "simulation.substeps");
    field_row(lab, "simulation.frames_per_second");
    end_fields();
}

/// Ways to do what the course's simulator does by a shortcut.
void rules(Lab& lab) {
    if (!ImGui::CollapsingHeader("Rules") || !begin_fields("rules##fields"))
        return;
    for (const char* key :
         {"rules.damping", "rules.start", "rules.limit", "rules.friction", "rules.plane", "rules.self_collision"})
        field_row(lab, key);
    end_fields();
}

void sphere_rows(sim::Sphere& s, const sim::Sphere& loaded) {
    vector_row("Origin", "The sphere's centre, in m.", s.origin, loaded.origin, -2, 2, "%.3g m");
    number_row("Radius", "In m.", s.radius, loaded.radius, 0.01, 1, "%.3g m");
    number_row("Friction", "0 slides freely, 1 sticks. In the course's rule cloth creeps at anything below 1.",
               s.friction, loaded.friction, 0, 1, "%.2f");
}

void plane_rows(sim::Plane& p, const sim::Plane& loaded) {
    vector_row("Point", "A point of the plane, in m.", p.point, loaded.point, -2, 2, "%.3g m");
    const sim::Vec3 before = p.normal;
    vector_row("Normal", "The direction that the plane faces; its length does not matter.", p.normal, loaded.normal, -1,
               1, "%.2f");
    if (p.normal == sim::Vec3{})
        p.normal = before; // no direction at all
    number_row("Friction", "0 slides freely, 1 sticks. In the course's rule cloth creeps at anything below 1.",
               p.friction, loaded.friction, 0, 1, "%.2f");
}

void colliders(Lab& lab) {
    auto& list = lab.scene.simulation.colliders;
    const auto& loaded = lab.loaded.simulation.colliders;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const bool sphere = std::holds_alternative<sim::Sphere>(list[i]);
        char title[64];
        std::snprintf(title, sizeof title, "%s  %s %zu###collider%zu", sphere ? ICON_FA_CIRCLE : ICON_FA_SQUARE,
                      sphere ? "Sphere" : "Plane", i + 1, i);
        if (!ImGui::CollapsingHeader(title) || !begin_fields((std::string(title) + "##fields").c_str()))
            continue;
        ImGui::PushID(static_cast<int>(i));
        const bool same_kind = i < loaded.size() && loaded[i].index() == list[i].index();
        const sim::Collider& reference = same_kind ? loaded[i] : list[i];
        if (auto* s = std::get_if<sim::Sphere>(&list[i]))
            sphere_rows(*s, std::get<sim::Sphere>(reference));
        else
            plane_rows(std::get<sim::Plane>(list[i]), std::get<sim::Plane>(reference));
        ImGui::PopID();
        end_fields();
    }
}

void wind(Lab& lab) {
    if (!ImGui::CollapsingHeader("Wind"))
        return;
    if (!begin_fields("wind##fields"))
        return;
    field_row(lab, "wind.kind");
    switch (lab.scene.simulation.wind.kind) {
    case sim::WindKind::none:
        break;
    case sim::WindKind::course:
        field_row(lab, "wind.clock");
        break;
    case sim::WindKind::physical:
        for (const char* key :
             {"wind.velocity", "wind.gust", "wind.gust_period", "wind.air_density", "wind.drag", "wind.lift"})
            field_row(lab, key);
        break;
    }
    end_fields();
}

} // namespace

void draw_parameters(Lab& lab) {
    const bool rate = lab.scene.simulation.rules.damping == sim::DampingRule::physical;
    group(lab, "Cloth",
          {"cloth.ks", "cloth.density", rate ? "cloth.damping_rate" : "cloth.damping", "cloth.thickness"});
    group(lab, "Springs", {"cloth.enable_structural", "cloth.enable_shearing", "cloth.enable_bending"});
    method(lab);
    rules(lab);
    group(lab, "Gravity", {"simulation.gravity"});
    wind(lab);
    colliders(lab);
    group(lab, "Grid and precision",
          {"cloth.num_width_points", "cloth.num_height_points", "cloth.width", "cloth.height", "cloth.orientation",
           "cloth.offset", "simulation.precision", "simulation.seed"},
          false);
}

} // namespace clothlab::ui

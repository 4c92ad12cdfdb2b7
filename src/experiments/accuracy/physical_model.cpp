#include "experiments/accuracy/physical_model.h"

#include <algorithm>
#include <cmath>

#include "experiments/formatted.h"
#include "scene/number_text.h"

namespace clothlab::experiments {
namespace {

/// A rule that is the course's, and has a part in the scene.
struct Shortcut {
    const char *rule, *physical;
    bool here;
};

std::vector<Shortcut> shortcuts(const scene::Scene& scene) {
    const sim::Description& d = scene.simulation;
    const sim::Rules& rules = d.rules;
    const bool planes = std::any_of(d.colliders.begin(), d.colliders.end(), [](const sim::Collider& collider) {
        return std::holds_alternative<sim::Plane>(collider);
    });
    return {{"damping", "physical", rules.damping == sim::DampingRule::cs184},
            {"start", "physical", rules.start == sim::StartRule::cs184},
            {"limit", "off", rules.limit == sim::LimitRule::cs184},
            {"friction", "physical", rules.friction == sim::FrictionRule::cs184 && !d.colliders.empty()},
            {"plane", "physical", rules.plane == sim::PlaneRule::cs184 && planes},
            {"self_collision", "neighbours", rules.self_collision == sim::SelfCollisionRule::cs184}};
}

} // namespace

std::string setting(const std::string& key, double value) {
    std::string text = key + "=";
    scene::append_number(text, value, false);
    return text;
}

PhysicalModel physical_model(const scene::Scene& scene) {
    const sim::Description& d = scene.simulation;
    PhysicalModel model;
    std::string switched;
    for (const Shortcut& shortcut : shortcuts(scene)) {
        if (!shortcut.here)
            continue;
        const std::string change = std::string(shortcut.rule) + "=" + shortcut.physical;
        model.settings.push_back("rules." + change);
        switched += (switched.empty() ? "" : ", ") + change;
    }
    if (!switched.empty())
        model.notes.push_back("All runs follow rules that do not depend on the step: " + switched + ".");
    if (d.rules.damping == sim::DampingRule::cs184) {
        if (d.cloth.damping >= 100)
            throw Refusal(
                "a damping of 100 % per substep stops all motion and is no rate in 1/s: set cloth.damping lower");
        const double rate = -std::log1p(-d.cloth.damping / 100) / sim::step_length(d);
        model.settings.push_back(setting("cloth.damping_rate", rate));
        if (rate > 0)
            model.notes.push_back(
                formatted("The damping of %g %% per substep is %.4g /s, its rate at the scene's own %d "
                          "substeps of %g frames per second.",
                          d.cloth.damping, rate, d.stepping.substeps, d.stepping.frames_per_second));
    }
    if (d.rules.limit == sim::LimitRule::iterated)
        model.notes.push_back(
            "The iterated stretch limit stays on: where it acts, no method is of more than first order.");
    if (d.wind.kind == sim::WindKind::course && d.wind.clock == sim::WindClock::step)
        model.notes.push_back("The course's wind takes the length of a step for its time (wind.clock=step): no method "
                              "is of more than first order.");
    return model;
}

std::vector<RuleChange> course_rules(const scene::Scene& scene) {
    std::vector<RuleChange> changes;
    for (const Shortcut& shortcut : shortcuts(scene)) {
        const bool acts = std::string(shortcut.rule) != "start" ||
                          scene.simulation.stepping.integrator == sim::IntegratorId::course_verlet;
        if (shortcut.here && acts)
            changes.push_back(
                {std::string(shortcut.rule) + "=cs184", {"rules." + std::string(shortcut.rule) + "=cs184"}});
    }
    return changes;
}

} // namespace clothlab::experiments

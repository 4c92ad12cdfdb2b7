#include "experiments/needs/proofs.h"

#include "experiments/needs/words.h"

namespace clothlab::experiments::needs {
namespace {

bool is_sphere(const sim::Collider& collider) {
    return std::holds_alternative<sim::Sphere>(collider);
}

bool has_friction(const sim::Collider& collider) {
    return std::visit([](const auto& shape) { return shape.friction != 0; }, collider);
}

/// Whether no point touched a collider of this kind.
bool untouched(const sim::Collider& collider, const Deeds& deeds) {
    return (is_sphere(collider) ? deeds.sphere_contacts : deeds.plane_contacts) == 0;
}

bool friction_never_acted(const sim::Description& model, const Deeds& deeds) {
    for (const sim::Collider& collider : model.colliders)
        if (has_friction(collider) && !untouched(collider, deeds))
            return false;
    return true;
}

} // namespace

void Deeds::add(const sim::StepCounts& counts) {
    steps += 1;
    self_contacts += counts.self_contacts;
    sphere_contacts += counts.sphere_contacts;
    plane_contacts += counts.plane_contacts;
    shortened_springs += counts.shortened_springs;
}

std::optional<std::string> proof(const Alternative& alternative, const sim::Description& model, const Deeds& deeds) {
    if (!alternative.omission)
        return std::nullopt;
    const std::string in_any = " in any of its " + std::to_string(deeds.steps) + " steps";
    switch (alternative.part) {
    case Part::self_collision:
        if (deeds.self_contacts == 0)
            return "self-collision pushed no pair of points apart" + in_any;
        break;
    case Part::limit:
        if (deeds.shortened_springs == 0)
            return "the stretch limit shortened no spring" + in_any;
        break;
    case Part::collider: {
        const sim::Collider& collider = model.colliders.at(alternative.collider);
        if (untouched(collider, deeds))
            return "no point touched " + words::collider(collider) + in_any;
        break;
    }
    case Part::friction:
        if (friction_never_acted(model, deeds))
            return "no point touched a collider that has friction" + in_any;
        break;
    default:
        break;
    }
    return std::nullopt;
}

} // namespace clothlab::experiments::needs

#include "ui/change_text.h"

#include <cstdio>
#include <vector>

#include "scene/fields.h"

namespace clothlab::ui {
namespace {

using scene::Field;
using scene::FieldType;

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string value_of(const Field& f, const scene::Scene& scene) {
    switch (f.type) {
    case FieldType::boolean:
        return f.get(scene) != 0 ? "on" : "off";
    case FieldType::choice:
        return std::string(f.choices[static_cast<std::size_t>(f.get(scene))]);
    case FieldType::vector: {
        const sim::Vec3 v = f.get_vector(scene);
        return "(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")";
    }
    case FieldType::number:
    case FieldType::integer:
        return number(f.get(scene) * f.shown.factor);
    case FieldType::text:
        break;
    }
    return f.get_text(scene);
}

bool same(const Field& f, const scene::Scene& a, const scene::Scene& b) {
    return f.type == FieldType::vector ? f.get_vector(a) == f.get_vector(b)
           : f.type == FieldType::text ? f.get_text(a) == f.get_text(b)
                                       : f.get(a) == f.get(b);
}

std::string from_to(const std::string& what, const std::string& before, const std::string& after,
                    std::string_view unit = "") {
    return what + " " + before + " -> " + after + (unit.empty() ? "" : " " + std::string(unit));
}

void add_colliders(const sim::Description& before, const sim::Description& after, std::vector<std::string>& texts) {
    if (before.colliders.size() != after.colliders.size()) {
        texts.push_back(
            from_to("Colliders", std::to_string(before.colliders.size()), std::to_string(after.colliders.size())));
        return;
    }
    for (std::size_t i = 0; i < after.colliders.size(); ++i)
        if (before.colliders[i] != after.colliders[i])
            texts.push_back((std::holds_alternative<sim::Sphere>(after.colliders[i]) ? "Sphere" : "Plane") +
                            std::string(" (collider ") + std::to_string(i + 1) + ") changed");
}

} // namespace

std::string describe_change(const sim::Description& before, const sim::Description& after, std::size_t most) {
    scene::Scene a, b;
    a.simulation = before;
    b.simulation = after;
    std::vector<std::string> texts;
    for (const Field& f : scene::fields())
        if (f.effect != scene::Effect::look && !same(f, a, b))
            texts.push_back(from_to(std::string(f.label), value_of(f, a), value_of(f, b), f.shown.unit));
    if (before.cloth.pinned != after.cloth.pinned)
        texts.push_back(from_to("Pins", std::to_string(before.cloth.pinned.size()),
                                std::to_string(after.cloth.pinned.size()), "points"));
    add_colliders(before, after, texts);
    if (before.stepping.accelerations != after.stepping.accelerations)
        texts.push_back("Further accelerations changed");
    if (texts.empty())
        return "nothing";
    std::string all;
    for (std::size_t i = 0; i < texts.size() && i < most; ++i)
        all += (i > 0 ? "; " : "") + texts[i];
    if (texts.size() > most)
        all += "; and " + std::to_string(texts.size() - most) + " more";
    return all;
}

} // namespace clothlab::ui

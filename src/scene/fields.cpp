#include "scene/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/integrators/integrator.h"
#include "sim/units.h"

namespace clothlab::scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr Allowed any() {
    return {-infinity, infinity};
}
constexpr Allowed at_least(double min) {
    return {min, infinity};
}
constexpr Allowed above(double min) {
    return {min, infinity, true};
}
constexpr Allowed between(double min, double max) {
    return {min, max};
}
constexpr Allowed not_zero() {
    return {-infinity, infinity, false, false};
}

constexpr Shown linear(std::string_view unit, double min, double max) {
    return {unit, min, max};
}
constexpr Shown logarithmic(std::string_view unit, double min, double max) {
    return {unit, min, max, Scale::logarithmic};
}
constexpr Shown scaled(std::string_view unit, double min, double max, Scale scale, double factor) {
    return {unit, min, max, scale, factor};
}

/// A camera is made when one of its values is first set; until then its defaults are shown.
Camera& camera(Scene& s) {
    return s.camera ? *s.camera : s.camera.emplace();
}
Camera camera(const Scene& s) {
    return s.camera.value_or(Camera{});
}

std::span<const std::string_view> integrator_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> list;
        for (const sim::IntegratorInfo& info : sim::integrators())
            list.push_back(info.name);
        return list;
    }();
    return names;
}

std::vector<Field> make_fields() {
    using enum Effect;
    using enum Required;
    std::vector<Field> list;

#define GET_SET(member)                                                                                                \
    f.get = [](const Scene& s) { return static_cast<double>(member); };                                                \
    f.set = [](Scene& s, double value) { member = static_cast<std::remove_reference_t<decltype(member)>>(value); };
#define ADD(...)                                                                                                       \
    {                                                                                                                  \
        Field f{__VA_ARGS__, {}, false, {}, {}, {}, {}, {}, {}};
#define NUMBER(key, member, label, unit, allowed, shown, effect, required, help)                                       \
    ADD(key, FieldType::number, label, unit, allowed, shown, effect, required, help)                                   \
    GET_SET(member) list.push_back(f);                                                                                 \
    }
#define INTEGER(key, member, label, unit, allowed, shown, effect, required, help)                                      \
    ADD(key, FieldType::integer, label, unit, allowed, shown, effect, required, help)                                  \
    GET_SET(member) list.push_back(f);                                                                                 \
    }
#define FLAG(key, member, label, effect, required, help)                                                               \
    ADD(key, FieldType::boolean, label, "", between(0, 1), Shown{}, effect, required, help)                            \
    GET_SET(member) list.push_back(f);                                                                                 \
    }
#define CHOICE_OF(key, member, label, effect, required, help, names)                                                   \
    ADD(key, FieldType::choice, label, "", between(0, static_cast<double>((names).size()) - 1), Shown{}, effect,       \
        required, help)                                                                                                \
    f.choices = names;                                                                                                 \
    GET_SET(member) list.push_back(f);                                                                                 \
    }
#define CHOICE(key, member, label, effect, required, help, ...)                                                        \
    {                                                                                                                  \
        static constexpr std::string_view names[] = {__VA_ARGS__};                                                     \
        CHOICE_OF(key, member, label, effect, required, help, std::span<const std::string_view>(names))                \
    }
#define VECTOR(key, member, label, unit, shown, effect, help)                                                          \
    ADD(key, FieldType::vector, label, unit, any(), shown, effect, no, help)                                           \
    f.get_vector = [](const Scene& s) { return member; };                                                              \
    f.set_vector = [](Scene& s, const sim::Vec3& value) { member = value; };                                           \
    list.push_back(f);                                                                                                 \
    }
#define TEXT(key, member, label, help)                                                                                 \
    ADD(key, FieldType::text, label, "", any(), Shown{}, look, no, help)                                               \
    f.get_text = [](const Scene& s) -> std::string { return member; };                                                 \
    f.set_text = [](Scene& s, const std::string& value) { member = value; };                                           \
    list.push_back(f);                                                                                                 \
    }
#include "scene/fields.def"
#undef GET_SET
#undef ADD
#undef NUMBER
#undef INTEGER
#undef FLAG
#undef CHOICE_OF
#undef CHOICE
#undef VECTOR
#undef TEXT

    for (Field& f : list)
        f.choice_as_integer = f.key == "cloth.orientation";
    return list;
}

std::string plain(double value) {
    const bool whole = value == std::floor(value) && std::abs(value) < 1e16; // with all its digits
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", whole ? 17 : 15, value);
    return text;
}

} // namespace

std::span<const Field> fields() {
    static const std::vector<Field> list = make_fields();
    return list;
}

const Field* find_field(std::string_view key) {
    for (const Field& f : fields())
        if (f.key == key)
            return &f;
    return nullptr;
}

std::string allowed_values(const Field& f) {
    switch (f.type) {
    case FieldType::boolean:
        return "true or false";
    case FieldType::vector:
        return "a list of three numbers";
    case FieldType::text:
        return "a text";
    case FieldType::choice: {
        std::string text;
        for (std::size_t i = 0; i < f.choices.size(); ++i) {
            if (i > 0)
                text += i + 1 == f.choices.size() ? " or " : ", ";
            text += f.choice_as_integer ? std::to_string(i) + " (" + std::string(f.choices[i]) + ")"
                                        : "\"" + std::string(f.choices[i]) + "\"";
        }
        return text;
    }
    case FieldType::number:
    case FieldType::integer:
        break;
    }
    std::string text = f.type == FieldType::integer ? "a whole number" : "a number";
    const Allowed& a = f.allowed;
    if (std::isfinite(a.min) && std::isfinite(a.max))
        text += " from " + plain(a.min) + " to " + plain(a.max);
    else if (std::isfinite(a.min))
        text += (a.above_min ? " above " : " of at least ") + plain(a.min);
    if (!a.zero)
        text += " other than 0";
    if (!f.unit.empty())
        text += ", in " + std::string(f.unit);
    return text;
}

std::optional<std::string> objection(const Field& f, double value) {
    const Allowed& a = f.allowed;
    const bool whole = f.type == FieldType::number || value == std::floor(value);
    const bool inside = value >= a.min && value <= a.max && !(a.above_min && value == a.min);
    if (std::isfinite(value) && inside && whole && (a.zero || value != 0))
        return std::nullopt;
    return plain(value) + " is not allowed; it must be " + allowed_values(f);
}

std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates) {
    // Levenshtein's distance, with two letters swapped as one change; a word is meant when at most a third of its
    // letters differ.
    std::optional<std::string_view> best;
    std::size_t best_distance = std::max<std::size_t>(word.size() / 3, 1) + 1;
    for (const std::string_view candidate : candidates) {
        std::vector<std::size_t> row(candidate.size() + 1), last, before_last;
        for (std::size_t j = 0; j < row.size(); ++j)
            row[j] = j;
        for (std::size_t i = 1; i <= word.size(); ++i) {
            before_last = std::exchange(last, row);
            row[0] = i;
            for (std::size_t j = 1; j < row.size(); ++j) {
                const std::size_t change = last[j - 1] + (word[i - 1] == candidate[j - 1] ? 0u : 1u);
                row[j] = std::min({change, last[j] + 1, row[j - 1] + 1});
                if (i > 1 && j > 1 && word[i - 1] == candidate[j - 2] && word[i - 2] == candidate[j - 1])
                    row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        if (row.back() < best_distance) {
            best_distance = row.back();
            best = candidate;
        }
    }
    return best;
}

} // namespace clothlab::scene

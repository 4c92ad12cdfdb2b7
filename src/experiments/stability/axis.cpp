#include "experiments/stability/axis.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "experiments/trial.h"
#include "scene/fields.h"
#include "scene/number_text.h"

namespace clothlab::experiments {
namespace {

constexpr std::size_t most_values = 1025;

/// Short names of what is varied often; of the scene's own keys, the section may be left out.
std::string full_key(std::string_view key, const scene::Scene& scene) {
    if (key == "damping")
        return scene.simulation.rules.damping == sim::DampingRule::physical ? "cloth.damping_rate" : "cloth.damping";
    if (key == "limiter")
        return "rules.limit";
    if (key == "method")
        return "simulation.integrator";
    for (const char* section : {"cloth.", "simulation.", "rules."})
        if (scene::find_field(section + std::string(key)))
            return section + std::string(key);
    return std::string(key);
}

const scene::Field& field_of(const std::string& key, const scene::Scene& scene) {
    const scene::Field* field = scene::find_field(key);
    if (!field)
        throw Refusal(key + ": there is no such parameter; see `clothlab list parameters`");
    if (field->effect == scene::Effect::look)
        throw Refusal(key + ": changes the picture only, not the run");
    const bool physical = scene.simulation.rules.damping == sim::DampingRule::physical;
    if (key == (physical ? "cloth.damping" : "cloth.damping_rate"))
        throw Refusal(key + ": the scene's damping rule does not read it; vary " +
                      (physical ? "cloth.damping_rate" : "cloth.damping") + ", or set rules.damping");
    return *field;
}

/// "N/m" -> "n_m": what a column's name may hold.
std::string column_name(std::string_view name, std::string_view unit) {
    std::string column(name);
    if (unit.empty())
        return column;
    column += '_';
    for (const char c : unit == "kg/m²" ? "kg_m2" : unit == "%" ? "percent" : unit)
        column += c == '/' || c == ' ' ? '_' : static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return column;
}

std::string with_unit(std::string_view label, std::string_view unit) {
    return unit.empty() ? std::string(label) : std::string(label) + " (" + std::string(unit) + ")";
}

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(at);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos)
            return parts;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value) ? std::optional(value)
                                                                                            : std::nullopt;
}

struct Springs {
    std::string name;
    std::array<bool, 3> on;
};

/// All subsets that have any, the whole first.
std::vector<Springs> spring_sets() {
    static constexpr std::array<const char*, 3> kinds{"structural", "shear", "bending"};
    std::vector<Springs> sets;
    for (unsigned bits = 7; bits > 0; --bits) {
        Springs set{bits == 7 ? "all" : "", {(bits & 4) != 0, (bits & 2) != 0, (bits & 1) != 0}};
        for (std::size_t kind = 0; kind < kinds.size() && bits != 7; ++kind)
            if (set.on[kind])
                set.name += (set.name.empty() ? "" : "+") + std::string(kinds[kind]);
        sets.push_back(std::move(set));
    }
    return sets;
}

AxisValue spring_value(const Springs& set) {
    const auto flag = [](bool on) { return on ? "true" : "false"; };
    return {0,
            set.name,
            {std::string("cloth.enable_structural=") + flag(set.on[0]),
             std::string("cloth.enable_shearing=") + flag(set.on[1]),
             std::string("cloth.enable_bending=") + flag(set.on[2])}};
}

/// All values of a list, in its own order.
std::vector<AxisValue> all_of(const std::string& key, const scene::Scene& scene) {
    std::vector<AxisValue> values;
    if (key == "springs") {
        for (const Springs& set : spring_sets())
            values.push_back(spring_value(set));
        return values;
    }
    const scene::Field& field = field_of(key, scene);
    const auto add = [&](std::string_view name, const std::string& value) {
        values.push_back({0, std::string(name), {key + "=" + value}});
    };
    if (field.type == scene::FieldType::boolean) {
        add("true", "true");
        add("false", "false");
    }
    for (std::size_t i = 0; i < field.choices.size(); ++i)
        add(field.choices[i], field.choice_as_integer ? std::to_string(i) : std::string(field.choices[i]));
    return values;
}

bool is_list(const std::string& key, const scene::Scene& scene) {
    if (key == "springs")
        return true;
    if (key == "grid")
        return false;
    const scene::FieldType type = field_of(key, scene).type;
    return type == scene::FieldType::choice || type == scene::FieldType::boolean;
}

VariedAxis list_axis(const std::string& key, std::optional<std::string_view> wanted, const scene::Scene& scene) {
    VariedAxis axis;
    axis.categorical = true;
    const std::vector<AxisValue> known = all_of(key, scene);
    axis.quantity.key = key;
    axis.quantity.label = key == "springs" ? "Springs" : std::string(field_of(key, scene).label);
    axis.quantity.column = key == "springs" ? key : std::string(field_of(key, scene).name());
    if (!wanted)
        axis.values = known;
    for (const std::string_view name : wanted ? split(*wanted, ',') : std::vector<std::string_view>{}) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const AxisValue& v) { return v.text == name; });
        if (found == known.end()) {
            std::string names;
            for (const AxisValue& value : known)
                names += (names.empty() ? "" : ", ") + value.text;
            throw Refusal(key + "=" + std::string(*wanted) + ": \"" + std::string(name) + "\" is none of " + names);
        }
        axis.values.push_back(*found);
    }
    for (std::size_t i = 0; i < axis.values.size(); ++i)
        axis.values[i].at = static_cast<double>(i);
    return axis;
}

/// a:b[:n][log], with or without a colon before log.
VariedAxis range_axis(const std::string& key, std::string_view range, std::size_t resolution,
                      const scene::Scene& scene) {
    VariedAxis axis;
    axis.quantity = quantity_of(key, scene);
    const auto refuse = [&](const std::string& why) { return Refusal(key + "=" + std::string(range) + ": " + why); };
    std::string_view numbers = range;
    if (numbers.ends_with("log")) {
        axis.log = true;
        numbers.remove_suffix(3);
        if (numbers.ends_with(":"))
            numbers.remove_suffix(1);
    }
    const std::vector<std::string_view> parts = split(numbers, ':');
    if (parts.size() < 2 || parts.size() > 3)
        throw refuse("write FROM:TO, FROM:TO:COUNT or FROM:TO:COUNTlog");
    const std::optional<double> from = number(parts[0]), to = number(parts[1]);
    const std::optional<double> count =
        parts.size() == 3 ? number(parts[2]) : std::optional(static_cast<double>(resolution));
    if (!from || !to || !count)
        throw refuse("write FROM:TO, FROM:TO:COUNT or FROM:TO:COUNTlog, with plain numbers");
    if (!(*from < *to))
        throw refuse("the first value has to be below the second");
    if (axis.log && !(*from > 0))
        throw refuse("a logarithmic axis begins above 0");
    if (*count != std::floor(*count) || *count < 2 || *count > static_cast<double>(most_values))
        throw refuse("an axis has 2 to " + std::to_string(most_values) + " values");
    const auto n = static_cast<std::size_t>(*count);
    for (std::size_t i = 0; i < n; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(n - 1);
        double value = i == 0       ? *from
                       : i == n - 1 ? *to
                       : axis.log   ? *from * std::pow(*to / *from, share)
                                    : *from + (*to - *from) * share;
        if (axis.quantity.whole)
            value = std::round(value);
        if (axis.values.empty() || value > axis.values.back().at)
            axis.values.push_back({value, scene::shortest_text(value), settings_of(axis.quantity, value, scene)});
    }
    return axis;
}

} // namespace

Quantity quantity_of(std::string_view name, const scene::Scene& scene) {
    const std::string key = full_key(name, scene);
    if (key == "grid")
        return {key, "grid_points", "Points a side", "", true, 2, 2048};
    if (key == "springs")
        throw Refusal(key + ": is not a number");
    const scene::Field& field = field_of(key, scene);
    if (field.type != scene::FieldType::number && field.type != scene::FieldType::integer)
        throw Refusal(key + ": is not a number");
    return {key,
            column_name(field.name(), field.unit),
            with_unit(field.label, field.unit),
            std::string(field.unit),
            field.type == scene::FieldType::integer,
            field.allowed.min,
            field.allowed.max};
}

double value_of(const Quantity& quantity, const scene::Scene& scene) {
    return quantity.key == "grid" ? scene.simulation.cloth.num_width_points
                                  : scene::find_field(quantity.key)->get(scene);
}

Settings settings_of(const Quantity& quantity, double value, const scene::Scene& scene) {
    if (quantity.key != "grid")
        return {quantity.key + "=" + scene::shortest_text(value)};
    const sim::Cloth& cloth = scene.simulation.cloth;
    const std::string n = scene::shortest_text(value);
    std::string pins;
    const auto moved = [value](int index, int points) {
        return std::to_string(static_cast<int>(std::lround(index * (value - 1) / (points - 1))));
    };
    for (const auto& [column, row] : cloth.pinned)
        pins += (pins.empty() ? "[" : ",[") + moved(column, cloth.num_width_points) + "," +
                moved(row, cloth.num_height_points) + "]";
    Settings settings{"cloth.num_width_points=" + n, "cloth.num_height_points=" + n};
    if (!pins.empty())
        settings.push_back("cloth.pinned=[" + pins + "]");
    return settings;
}

Axis VariedAxis::chart_axis() const {
    Axis axis{quantity.label, log, {}};
    if (categorical)
        for (const AxisValue& value : values)
            axis.names.push_back(value.text);
    return axis;
}

double VariedAxis::border(std::size_t i) const {
    if (categorical)
        return static_cast<double>(i) - 0.5;
    const auto at = [&](std::size_t k) { return log ? std::log(values[k].at) : values[k].at; };
    const std::size_t last = values.size() - 1;
    const double between = i == 0     ? at(0) - 0.5 * (at(1) - at(0))
                           : i > last ? at(last) + 0.5 * (at(last) - at(last - 1))
                                      : 0.5 * (at(i - 1) + at(i));
    return log ? std::exp(between) : between;
}

VariedAxis read_axis(std::string_view text, std::size_t resolution, const scene::Scene& scene) {
    const std::size_t equals = text.find('=');
    const std::string key = full_key(text.substr(0, equals), scene);
    const std::optional<std::string_view> values =
        equals == std::string_view::npos ? std::nullopt : std::optional(text.substr(equals + 1));
    VariedAxis axis;
    if (is_list(key, scene))
        axis = list_axis(key, values, scene);
    else if (values)
        axis = range_axis(key, *values, resolution, scene);
    else
        throw Refusal(key + ": write " + key + "=FROM:TO");
    if (axis.values.size() < 2)
        throw Refusal(std::string(text) + ": an axis has at least two values");
    for (const AxisValue& value : axis.values)
        with(scene, value.settings);
    return axis;
}

} // namespace clothlab::experiments

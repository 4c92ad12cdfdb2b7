// Every parameter of a scene, described once: the key that files and --set use, unit, allowed values, slider, help
// text, and how to get and set it. Reading, writing, validation, `list parameters` and the panels all come from this
// table.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace clothlab::scene {

enum class FieldType : std::uint8_t { number, integer, boolean, choice, vector, text };

/// When a file in the course's own format must have the key; our own format has a default for everything.
enum class Required : std::uint8_t { no, in_course_files };
/// Whether a change reaches a run between two steps, needs a new start, or concerns only the picture.
enum class Effect : std::uint8_t { live, restart, look };
enum class Scale : std::uint8_t { linear, logarithmic };

struct Allowed {
    double min, max;
    bool above_min = false; ///< min itself is not allowed
    bool zero = true;       ///< 0 is allowed
};

struct Shown {
    std::string_view unit = ""; ///< as people read it
    double min = 0, max = 1;    ///< of the slider, in that unit; typing may go beyond
    Scale scale = Scale::linear;
    double factor = 1; ///< from the file's unit to the shown one
};

struct Field {
    std::string_view key; ///< "section.name"
    FieldType type;
    std::string_view label;
    std::string_view unit; ///< of the file
    Allowed allowed;
    Shown shown;
    Effect effect;
    Required required;
    std::string_view help;
    std::span<const std::string_view> choices; ///< for FieldType::choice, in the order of the values 0, 1, ...
    bool choice_as_integer = false;            ///< the file writes the value, not the name (the course's orientation)

    // Numbers, integers, booleans and choices are all exact in a double.
    double (*get)(const Scene&) = nullptr;
    void (*set)(Scene&, double) = nullptr;
    sim::Vec3 (*get_vector)(const Scene&) = nullptr;
    void (*set_vector)(Scene&, const sim::Vec3&) = nullptr;
    std::string (*get_text)(const Scene&) = nullptr;
    void (*set_text)(Scene&, const std::string&) = nullptr;

    std::string_view section() const { return key.substr(0, key.find('.')); }
    std::string_view name() const { return key.substr(key.find('.') + 1); }
};

/// All parameters, in the order in which files are written.
std::span<const Field> fields();
/// The field of a key, or nullptr.
const Field* find_field(std::string_view key);

/// Why a value is not allowed for a field, as the end of a sentence; nothing when it is.
std::optional<std::string> objection(const Field& field, double value);
/// "a number from 0 to 100" and the like.
std::string allowed_values(const Field& field);

/// The most points that a cloth may have; more would not fit into a common machine's memory.
inline constexpr double max_points = 4'194'304;

/// The candidate nearest to a misspelt word, if any is near enough to be meant.
std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates);

} // namespace clothlab::scene

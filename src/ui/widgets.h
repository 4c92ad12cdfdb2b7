// Widgets that several panels share.
#pragma once

#include <span>
#include <string>

#include "scene/fields.h"
#include "ui/lab.h"

namespace clothlab::ui {

/// Begins a table of rows for field_row: label, widget, reset. False when it is not visible.
bool begin_fields(const char* id);
void end_fields();

// What rows of such a table are made of.
/// A new row's label, coloured where the value was changed; the widget comes next.
void label_cell(const char* label, const std::string& help, bool changed);
/// The row's last cell: true when the reset button, which is there where the value was changed, is pressed.
bool reset_cell(bool changed);
/// "%.3g N/m" and the like for ImGui's sliders; a percent sign in the unit is doubled.
std::string format_with_unit(const char* number, std::string_view unit);
/// To three significant digits: all that a slider's pixels can mean.
double round_for_slider(double value);

/// How an entry of a list reads, and what its tooltip says.
struct ChoiceText {
    std::string title, help;
};

/// A row that edits one parameter of lab.scene: slider, switch or list as its type asks for, with unit and tooltip, and
/// a button that resets it to the loaded scene's value where it differs. A list shows `texts`, one for each value,
/// where there are any, and otherwise the names that files use.
void field_row(Lab& lab, std::string_view key, std::span<const ChoiceText> texts = {});

/// A row that edits one parameter of a shader, with a reset to the loaded scene's value or else the shader's own.
void shader_row(Lab& lab, const scene::ShaderDeclaration& shader, const scene::ShaderParameter& parameter);

/// A row for a number that is not in the table of fields (a collider's). True when it was changed.
bool number_row(const char* label, const char* help, double& value, double loaded, double min, double max,
                const char* format);
/// The same for three numbers.
bool vector_row(const char* label, const char* help, sim::Vec3& value, const sim::Vec3& loaded, double min, double max,
                const char* format);

/// Shows a wrapped text when the last item is hovered for a moment.
void tooltip(const std::string& text);

/// Whether the last item follows the mouse. Not yet in the frame of the press, whose motion is the way to the item: all
/// of it, where a pen is put down.
bool being_dragged();

/// A square button with an icon and a tooltip.
bool icon_button(const char* icon, const char* id, const char* help, bool enabled = true);

/// Text in the fixed-width font, so that changing digits do not dance.
void mono_text(const char* format, ...) __attribute__((format(printf, 1, 2)));

} // namespace clothlab::ui

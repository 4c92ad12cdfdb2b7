// What the forms of the Experiments panel are made of.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ui/lab.h"

namespace clothlab::ui {

/// Rows of settings. What has to be asked for to make the experiment with them, when the button for it is pressed;
/// `enabled`: whether it can be.
std::optional<RunExperiment> experiment_form(Lab& lab, ExperimentKind kind, bool enabled);

/// Begins a row: its label, with a tooltip; the widget comes next and fills the rest of the row.
void form_label(const char* label, const char* help);
/// A row for a number of at least `least`; what is typed below that is not taken.
void form_number(const char* label, const char* help, double& value, double least, const char* format);
void form_whole(const char* label, const char* help, int& value, int least, int most);
void form_choice(const char* label, const char* help, int& value, const std::vector<std::string>& names);
/// A row for a parameter; another one than before gets a range around what the scene has.
void form_axis_key(Lab& lab, const char* label, AxisChoice& axis, bool categorical);
/// Rows for a parameter and its values. `categorical`: whether things that are not numbers may be chosen; `count`:
/// whether it says how many values there are.
void form_axis(Lab& lab, const char* label, AxisChoice& axis, bool categorical, bool count);
/// KEY=FROM:TO..., as the command line has it.
std::string axis_text(const AxisChoice& axis, bool count);

/// The request for an experiment whose command has these options, each followed by its value or alone.
RunExperiment experiment_request(ExperimentKind kind, const std::vector<std::string>& options,
                                 std::function<experiments::Findings(const experiments::Progress&)> work);

} // namespace clothlab::ui

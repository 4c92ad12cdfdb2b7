// The panels' functions, from the list of panels; each draws the inside of its window.
#pragma once

#include <imgui.h>

#include "ui/lab.h"

namespace clothlab::ui {

#define CLOTHLAB_PANEL(id, title, icon, at_start) void draw_##id(Lab& lab);
#include "ui/panels.def"
#undef CLOTHLAB_PANEL

void draw_menu(Lab& lab);
void draw_status_bar(Lab& lab);
/// What is wrong with shaders, over the lower edge of a picture at `corner`, until it is mended.
void draw_shader_faults(Lab& lab, ImVec2 corner, ImVec2 size);
/// Asks what is to become of unsaved shaders when the lab is to be closed.
void draw_quit_question(Lab& lab);
/// The entries of the menu of experiments.
void experiments_menu(Lab& lab);
/// The windows that ask where findings and reports are to be written.
void draw_experiment_windows(Lab& lab);
/// Whether a key of the whole window is pressed, and nobody is typing.
bool window_key(ImGuiKeyChord chord, ImGuiInputFlags flags = 0);
/// Keys of the whole window: see shortcuts().
void handle_keys(Lab& lab);

struct Shortcut {
    const char* keys;
    const char* what;
};
/// All keys, for the help window and the documentation.
const std::vector<Shortcut>& shortcuts();

} // namespace clothlab::ui

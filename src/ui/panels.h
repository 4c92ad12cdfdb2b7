// The panels' functions, from the list of panels; each draws the inside of its window.
#pragma once

#include "ui/lab.h"

namespace clothlab::ui {

#define CLOTHLAB_PANEL(id, title, icon) void draw_##id(Lab& lab);
#include "ui/panels.def"
#undef CLOTHLAB_PANEL

void draw_menu(Lab& lab);
void draw_status_bar(Lab& lab);
/// Keys of the whole window: see shortcuts().
void handle_keys(Lab& lab);

struct Shortcut {
    const char* keys;
    const char* what;
};
/// All keys, for the help window and the documentation.
const std::vector<Shortcut>& shortcuts();

} // namespace clothlab::ui

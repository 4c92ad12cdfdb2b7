// The commands that draw: the lab, and `clothlab render`.
#pragma once

#include "cli/command_line.h"

namespace clothlab::cli {

GuiCommands gui_commands();

} // namespace clothlab::cli

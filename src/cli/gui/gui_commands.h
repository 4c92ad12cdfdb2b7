// The commands that draw: the lab, `clothlab render` and `clothlab textures`.
#pragma once

#include "cli/command_line.h"

namespace clothlab::cli {

GuiCommands gui_commands();

int textures(const TexturesArguments& arguments);
std::vector<TextureRow> list_textures();

} // namespace clothlab::cli

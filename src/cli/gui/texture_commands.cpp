#include <iostream>

#include "cli/gui/gui_commands.h"
#include "render/procedural.h"

namespace clothlab::cli {

int textures(const TexturesArguments& a) {
    render::write_built_in_textures(a.output);
    std::cout << a.output << "\n";
    return 0;
}

std::vector<TextureRow> list_textures() {
    std::vector<TextureRow> rows;
    for (const render::BuiltInTexture& texture : render::built_in_textures())
        rows.push_back({texture.name, render::usage_name(texture.usage), texture.title});
    return rows;
}

} // namespace clothlab::cli

#include <iostream>

#include "app/core/data_folder.h"
#include "cli/command_line.h"
#include "scene/io.h"

namespace clothlab::cli {

int validate(const std::vector<std::string>& files) {
    int status = 0;
    for (const std::string& file : files) {
        try {
            scene::load_scene(app::scene_path(file));
            std::cout << file << ": ok\n";
        } catch (const scene::SceneError& e) {
            std::cerr << e.what() << "\n";
            status = 2;
        }
    }
    return status;
}

} // namespace clothlab::cli

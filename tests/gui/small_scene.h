// A small cloth that falls on a sphere: quick to simulate and to draw, where the scene is not what is tested.
#pragma once

#include "app/core/data_folder.h"
#include "scene/io.h"
#include "support/files.h"

namespace clothlab::test {

inline constexpr int small_side = 12; ///< points

/// Written into a folder, as small.json.
inline std::filesystem::path small_scene(const TemporaryFolder& folder) {
    scene::Scene scene = scene::load_scene(app::scene_path("sphere-medium"));
    scene.simulation.cloth.num_width_points = scene.simulation.cloth.num_height_points = small_side;
    scene.simulation.stepping.substeps = 10;
    std::filesystem::path file = folder / "small.json";
    scene::save_scene(scene, file);
    return file;
}

} // namespace clothlab::test

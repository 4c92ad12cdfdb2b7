// Pictures of many runs in one, with labels: `clothlab experiment sweep --pictures`.
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "render/image.h"
#include "render/label.h"

namespace clothlab::cli {

/// Throws scene::SceneError for a scene whose look cannot be drawn: a shader or a parameter of one that does not exist.
void check_look(const scene::Scene& scene, const std::string& source);

/// Takes the runs and writes the picture of all of them, with a progress bar where standard error is a terminal. Throws
/// scene::SceneError as check_look does, std::runtime_error where nothing can be drawn or the file cannot be written.
void draw_scene_grid(const SceneGrid& grid);

/// The pictures of the cells, all of the grid's size, put together and labelled.
render::Image labelled_grid(const SceneGrid& grid, const std::vector<render::Image>& pictures,
                            const render::LabelFaces& faces);

} // namespace clothlab::cli

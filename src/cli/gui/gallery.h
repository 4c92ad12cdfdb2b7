// `clothlab gallery`: simulates and draws the figures of a table and writes the page that shows them.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/gui/gallery_figures.h"
#include "scene/shader_parameters.h"

namespace clothlab::cli {

struct GalleryOptions {
    std::filesystem::path folder;  ///< made where it is missing
    std::string only;              ///< regular expression, found in the figures' names; empty: all figures
    int width = 800, height = 600; ///< px, of the pictures without their labels
    int jobs = 0;                  ///< simulations at a time; 0: as many as the machine has cores
    bool progress_bar = false;
    std::function<bool()> interrupted; ///< asked often; true ends the command soon, with the page of what is drawn
};

/// The scene of a figure with its settings, and its section's before them. Throws SceneError where the scene, a
/// parameter or a shader does not exist.
scene::Scene load_figure(const Figure& figure, const std::vector<std::string>& settings,
                         const std::vector<scene::ShaderDeclaration>& shaders);

/// Draws figures as NAME.png, index.html and overview.png into the folder. Figures of an older index.html there that
/// are not drawn anew stay on the page. Prints the page's name to `out`, and to `err` each figure that failed, and why:
/// the others are drawn nevertheless. Returns the exit status: 1 where one failed or the command was interrupted.
/// Throws scene::SceneError for an `only` that is no expression or matches nothing, std::runtime_error for a folder
/// that cannot be written and where nothing can be drawn at all.
int draw_gallery(const std::vector<Section>& sections, const GalleryOptions& options, std::ostream& out,
                 std::ostream& err);

/// The command: all figures of gallery_sections(); Ctrl+C interrupts.
int gallery(const GalleryArguments& arguments);

} // namespace clothlab::cli

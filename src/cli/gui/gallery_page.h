// The gallery's page: all figures with their captions and the commands that draw each alone, in one HTML file that
// needs nothing but the pictures beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/gui/gallery_caption.h"
#include "cli/gui/gallery_figures.h"

namespace clothlab::cli {

/// What became of a figure in this run of the command.
struct FigureResult {
    bool wanted = false; ///< it was to be drawn
    bool drawn = false;  ///< its picture is complete
    std::string error;   ///< why it could not be drawn, or empty
    Caption caption;
    int width = 0, height = 0; ///< px, of the file
};

/// The shell command that draws a figure alone, without its label, `width` x `height` px.
std::string figure_command(const Section& section, const Figure& figure, int width, int height);

/// A figure as the page has it, from <figure id="name"> to </figure>.
std::string figure_html(const Section& section, const Figure& figure, const FigureResult& result, int width,
                        int height);

/// The part of an older page that shows a figure; nothing where it has none, or none with a picture.
std::optional<std::string> figure_of_page(const std::string& page, const std::string& name);

/// The page. `figures` has the HTML of every figure of every section in turn, empty for those that are left out.
std::string gallery_page(const std::vector<Section>& sections, const std::vector<std::string>& figures);

} // namespace clothlab::cli

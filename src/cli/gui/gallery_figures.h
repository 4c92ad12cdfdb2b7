// The figures of `clothlab gallery`, as data: gallery_figures.cpp is the table, and an entry in it is all that a figure
// needs.
#pragma once

#include <string>
#include <vector>

namespace clothlab::cli {

struct Figure {
    std::string name; ///< of the file, without .png; unlike all others
    std::string title;
    std::string scene;                 ///< a name of `clothlab list scenes`
    int frame = 0;                     ///< that is drawn
    std::vector<std::string> settings; ///< KEY=VALUE, on top of the section's
};

struct Section {
    std::string title;
    std::string text;                  ///< what to look for
    std::vector<std::string> settings; ///< KEY=VALUE, of all its figures
    std::vector<Figure> figures;
};

/// In the order of the page. Figures with the same simulation share one run.
const std::vector<Section>& gallery_sections();

} // namespace clothlab::cli

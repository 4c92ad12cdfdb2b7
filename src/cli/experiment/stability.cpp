// `clothlab experiment stability`.
#include <CLI/CLI.hpp>

#include "cli/experiment/experiment.h"

namespace clothlab::cli {

void add_stability(CLI::App& experiment, const GuiCommands&, int&) {
    experiment.add_subcommand("stability", "Find where methods fail, and compare with the predicted limit");
}

} // namespace clothlab::cli

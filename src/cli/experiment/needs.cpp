// `clothlab experiment needs`.
#include <CLI/CLI.hpp>

#include "cli/experiment/experiment.h"

namespace clothlab::cli {

void add_needs(CLI::App& experiment, const GuiCommands&, int&) {
    experiment.add_subcommand("needs", "Find the cheapest model that is good enough for a scene");
}

} // namespace clothlab::cli

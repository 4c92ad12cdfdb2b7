// `clothlab experiment sweep`.
#include <CLI/CLI.hpp>

#include "cli/experiment/experiment.h"

namespace clothlab::cli {

void add_sweep(CLI::App& experiment, const GuiCommands&, int&) {
    experiment.add_subcommand("sweep", "Run a scene for many values of its parameters");
}

} // namespace clothlab::cli

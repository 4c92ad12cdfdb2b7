// `clothlab experiment accuracy`.
#include <CLI/CLI.hpp>

#include "cli/experiment/experiment.h"

namespace clothlab::cli {

void add_accuracy(CLI::App& experiment, const GuiCommands&, int&) {
    experiment.add_subcommand("accuracy", "Chart every method's error against its cost");
}

} // namespace clothlab::cli

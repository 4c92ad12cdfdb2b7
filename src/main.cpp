// The program: the lab's window, and the headless subcommands.
#include "cli/command_line.h"
#ifdef CLOTHLAB_GUI
#include "cli/gui/gui_commands.h"
#endif

int main(int argc, char** argv) {
#ifdef CLOTHLAB_GUI
    return clothlab::cli::run_program(argc, argv, clothlab::cli::gui_commands());
#else
    return clothlab::cli::run_program(argc, argv, {});
#endif
}

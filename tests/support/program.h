// Runs the real program, without a shell, and keeps what it says.
#pragma once

#include <string>
#include <vector>

namespace clothlab::test {

struct Finished {
    int status = -1; ///< exit status; -1 when a signal ended it
    std::string out, err;
};

/// Runs clothlab with these arguments and waits for it. `out_file`, where given, takes its standard output instead.
Finished clothlab(const std::vector<std::string>& arguments, const std::string& out_file = "");

} // namespace clothlab::test

// How far a long command is, on a terminal.
#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace clothlab::cli {

class ProgressBar {
public:
    /// `total` in any unit of work. Nothing is ever written unless `shown`: into a file or a pipe, a bar is noise.
    ProgressBar(std::ostream& out, double total, bool shown);
    /// Wipes the bar away.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Draws the bar anew, with the time left at the pace so far, at most ten times a second.
    void show(double done, const std::string& note);

private:
    using Clock = std::chrono::steady_clock;
    std::ostream& out_;
    double total_;
    bool shown_;
    Clock::time_point start_ = Clock::now(), last_{};
};

/// The bar as it stands in the terminal: "[####------]  42 %  1:20 left  note". No time is given before a fiftieth of
/// the work is done.
std::string progress_line(double share, double elapsed_seconds, const std::string& note);

} // namespace clothlab::cli

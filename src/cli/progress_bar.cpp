#include "cli/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace clothlab::cli {

ProgressBar::ProgressBar(std::ostream& out, double total, bool shown) : out_(out), total_(total), shown_(shown) {}

ProgressBar::~ProgressBar() {
    if (shown_)
        out_ << "\r\x1b[K" << std::flush;
}

void ProgressBar::show(double done, const std::string& note) {
    const Clock::time_point now = Clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(100))
        return;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    out_ << "\r" << progress_line(total_ > 0 ? done / total_ : 1, elapsed, note) << "\x1b[K" << std::flush;
}

std::string progress_line(double share, double elapsed_seconds, const std::string& note) {
    constexpr int width = 30;
    share = std::clamp(share, 0.0, 1.0);
    const auto full = static_cast<std::size_t>(std::lround(share * width));
    char text[96];
    std::snprintf(text, sizeof text, "[%s%s] %3.0f %%", std::string(full, '#').c_str(),
                  std::string(width - full, '-').c_str(), std::floor(100 * share));
    std::string line = text;
    if (share >= 0.02) {
        const auto left = static_cast<long>(std::ceil(elapsed_seconds * (1 - share) / share));
        std::snprintf(text, sizeof text, "  %ld:%02ld left", left / 60, left % 60);
        line += text;
    }
    return line + "  " + note;
}

} // namespace clothlab::cli

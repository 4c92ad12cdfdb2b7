#include "ui/curve_data.h"

namespace clothlab::ui {

bool reachable_between(std::span<const timeline::FrameRange> reachable, std::uint64_t first, std::uint64_t last) {
    auto after = std::upper_bound(reachable.begin(), reachable.end(), first,
                                  [](std::uint64_t frame, const timeline::FrameRange& r) { return frame < r.first; });
    return after != reachable.begin() && (after - 1)->last >= last;
}

} // namespace clothlab::ui

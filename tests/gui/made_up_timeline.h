// A timeline that no simulation has run: three branches, changes, marks, bookmarks and curves, for tests of panels.
#pragma once

#include <memory>

#include "ui/lab.h"

namespace clothlab::test {

inline constexpr std::uint64_t made_up_frames = 2000;

/// The line shown is branch 2: 2000 frames of 30 substeps at 90 frames/s, from branch 1's at frame 400, where ks went
/// from 5000 to 8000 N/m. Branch 3 forked off it at frame 900. Frames 100 to 299 have been dropped.
std::shared_ptr<timeline::Overview> made_up_overview();

/// That overview with the playhead at a frame's end, a ghost with its curve, and two breakpoints.
void show_made_up_timeline(ui::Lab& lab, std::uint64_t frame = 700);

} // namespace clothlab::test

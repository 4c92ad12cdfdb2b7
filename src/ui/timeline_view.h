// What the timeline's panels remember from one picture to the next.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "timeline/overview.h"
#include "ui/curve_data.h"

namespace clothlab::ui {

/// Rows of curves under the track.
enum class CurveRow : std::uint8_t { energy, strain, contacts, stages, ghost };
inline constexpr std::size_t curve_rows = 5;

/// Which name is being edited, and how it reads so far.
struct Renaming {
    bool branch = false; ///< otherwise a bookmark
    std::uint32_t id = 0;
    std::string text;
    bool focused = false; ///< the text field has had the keyboard
};

struct TimelineView {
    double first = 0, last = 90;  ///< frames seen
    bool fit = true;              ///< sees the whole line, however long it becomes
    std::uint64_t shown_step = 0; ///< of the playhead, in the last picture

    enum class Drag : std::uint8_t { none, scrub, loop_first, loop_last, loop };
    Drag drag = Drag::none;
    double grabbed = 0;                             ///< frame
    std::optional<std::uint64_t> asked;             ///< the step that scrubbing asked for last
    std::optional<timeline::FrameRange> loop_drawn; ///< while it is being dragged
    std::optional<timeline::FrameRange> last_loop;  ///< to switch on again

    std::array<bool, curve_rows> rows{true, false, false, false, true};
    std::array<std::uint32_t, curve_rows> hidden{}; ///< a bit for each curve
    std::optional<double> hovered, hovering;        ///< frame under the mouse, in the last picture and in this one
    struct Drawn {
        const void* data = nullptr;
        std::size_t count = 0;
        std::uint64_t version = 0;
        double at = 0; ///< when, in ImGui's time
        CurveRange range;
        std::vector<Curve> curves;
    };
    std::array<Drawn, curve_rows> drawn; ///< what need not be computed again

    std::optional<Renaming> renaming;
    std::string bookmark_name;                         ///< typed for the next one
    int budget_mb = 0, disk_mb = 0, least_reach_s = 0; ///< while they are being edited

    struct Files {
        bool save = false, open = false, exporting = false; ///< a window is wanted
        std::string path, folder;
        bool ply = false, loop_only = false;
        int every = 1;
    } files;
};

} // namespace clothlab::ui

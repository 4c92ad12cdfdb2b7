// What is at places of the track: marks, bookmarks, changes and forks of the line shown.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "ui/frame_axis.h"

namespace clothlab::ui {

struct TrackPlace {
    enum class Kind : std::uint8_t { mark, bookmark, change, fork };
    Kind kind = Kind::mark;
    std::uint64_t step = 0;
    double frame = 0;
    std::string text; ///< a sentence or a name
    const char* icon = "";
    ImVec4 colour;
    std::optional<scene::Camera> camera; ///< a bookmark's
};

/// In the order in which they are drawn.
std::vector<TrackPlace> track_places(const timeline::Overview& overview, const FrameAxis& axis);

struct MarkLook {
    const char* icon;
    ImVec4 colour;
};
MarkLook look_of(timeline::MarkKind kind);

} // namespace clothlab::ui

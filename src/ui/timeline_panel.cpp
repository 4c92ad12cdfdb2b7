// Transport, track, curves.
#include <imgui.h>

#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"

namespace clothlab::ui {

void draw_timeline(Lab& lab) {
    draw_transport(lab);
    if (!lab.timeline.overview) {
        ImGui::TextColored(colour::faint, "The timeline begins with the first state.");
        return;
    }
    const std::shared_ptr<const timeline::Overview> overview = lab.timeline.overview;
    const FrameAxis axis(*overview, lab.timeline.playhead);
    lab.timeline_view.hovering.reset();
    const TrackScale scale = draw_track(lab, axis);
    draw_curves(lab, axis, scale);
    lab.timeline_view.hovered = lab.timeline_view.hovering;
}

} // namespace clothlab::ui

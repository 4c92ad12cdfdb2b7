// What the files of the timeline's panels share.
#pragma once

#include <imgui.h>

#include "ui/frame_axis.h"
#include "ui/lab.h"

namespace clothlab::ui {

inline void ask_timeline(Lab& lab, TimelineRequest request) {
    lab.ask(Request(std::move(request)));
}

// --- what buttons and keys do ----------------------------------------------------------------------------------------

/// Pauses what plays, and plays what is paused.
void toggle_play(Lab& lab);
void toggle_backwards(Lab& lab);
/// The loop off, or on again with the last range; the first time it is the whole line.
void toggle_loop(Lab& lab);
/// To a slower or faster speed of the list.
void change_speed(Lab& lab, bool faster);
/// To the previous or next mark or bookmark of the line shown.
void go_to_neighbour(Lab& lab, bool next);
/// Marks the loop's first or last frame at the playhead.
void set_loop_end(Lab& lab, bool last);
/// Keys of the whole window: see shortcuts().
void timeline_keys(Lab& lab);

// --- the panel's parts -----------------------------------------------------------------------------------------------

/// Frames across the track, as pixels of the screen.
struct TrackScale {
    float left = 0, right = 1;  ///< px
    double first = 0, last = 1; ///< frames
    float x_of(double frame) const {
        return left + static_cast<float>((frame - first) / (last - first)) * (right - left);
    }
    double frame_at(float x) const { return first + static_cast<double>((x - left) / (right - left)) * (last - first); }
    double pixels_per_frame() const { return static_cast<double>(right - left) / (last - first); }
};

void draw_transport(Lab& lab);
/// The track across the panel's width, and the scale that the curves share with it.
TrackScale draw_track(Lab& lab, const FrameAxis& axis);
void draw_curves(Lab& lab, const FrameAxis& axis, const TrackScale& scale);
/// Which curves are shown, in the room left of the track.
void curve_menu(Lab& lab);

/// The room left of the track and the curves.
float track_gutter();
/// Wheel and right drag: zoom and pan. To be called after the item that owns the mouse over track or curves.
void zoom_and_pan(Lab& lab, const FrameAxis& axis, const TrackScale& scale);
/// Dragging seeks, and snaps to what is near. The same.
void scrub(Lab& lab, const FrameAxis& axis, const TrackScale& scale);
/// The line at the present moment.
void draw_playhead(const Lab& lab, const FrameAxis& axis, const TrackScale& scale, float top, float bottom, bool head);

/// "12.3 MB".
std::string megabytes(std::size_t bytes);
/// A name that a double click or `rename` makes a text field. Says whether it was clicked; `done` gets the new name.
bool editable_name(Lab& lab, bool branch, std::uint32_t id, const std::string& name, bool selected, float width,
                   std::optional<std::string>& done);
void begin_renaming(Lab& lab, bool branch, std::uint32_t id, const std::string& name);

/// A window for each: saving and opening recordings, exporting meshes; and the strip that says how far a job is.
void draw_recording_windows(Lab& lab);
void draw_job(Lab& lab);

} // namespace clothlab::ui

// Pictures and films: what the Output window offers, and how far a recording is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace clothlab::ui {

/// How a recording gets on.
struct RecordingStatus {
    std::string file;
    int pictures = 0;
    int of = 0; ///< 0: until it is stopped
    bool paused = false;
};

/// What the user has chosen, and what the app says about it.
struct Output {
    bool open = false;
    bool as_viewport = true;         ///< of the viewport's size, whatever that is
    int width = 1920, height = 1080; ///< px, otherwise
    bool transparent = false;        ///< PNG only: no background
    bool with_panels = false;        ///< a picture of the whole window, of the window's size
    std::string picture_file;        ///< .png
    bool film = true;                ///< rather than numbered PNG pictures
    std::string film_file;           ///< .mp4
    std::string sequence_file;       ///< .png with a place for the number
    int fps = 30;                    ///< pictures per second of film that are wished for
    double speed = 1;                ///< simulated seconds per second of film
    double seconds = 5;              ///< of film; 0: until it is stopped
    bool from_start = true;          ///< rather than from now

    // Filled in by the app while the window is open.
    bool has_ffmpeg = true;
    std::string picture_objection, recording_objection; ///< files that would be replaced
    std::optional<RecordingStatus> recording;
    bool hidden = false; ///< while the whole window's picture is taken
};

/// How a recording takes the simulation's frames.
struct Pace {
    int every;    ///< simulated frames from one picture to the next
    double rate;  ///< pictures per second at which the film shows the chosen speed
    int pictures; ///< 0: until it is stopped
};
/// The pace for a run of so many simulated frames per second: as near to the wished pictures per second as whole
/// frames allow.
Pace pace(const Output& output, double frames_per_second);

struct Lab;
/// The window itself, while it is open.
void draw_output_window(Lab& lab);
/// A recording's state in the lower left corner of the viewport, with what ends it.
void draw_recording_badge(Lab& lab, float x, float bottom);
/// Keys of the whole window that concern pictures: see shortcuts().
void output_keys(Lab& lab);

} // namespace clothlab::ui

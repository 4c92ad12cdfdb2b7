// Takes the pictures and makes the recordings that the panels ask for, and tells the panels about them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/recorder.h"
#include "ui/lab.h"

namespace clothlab::app {

class Pictures {
public:
    /// All three must outlive this.
    Pictures(render::Renderer& renderer, SimulationThread& simulation, ui::Lab& lab);
    /// Completes a recording that is under way.
    ~Pictures();
    Pictures(const Pictures&) = delete;
    Pictures& operator=(const Pictures&) = delete;

    /// Before the panels are drawn: goes on with a recording, and fills in lab.output.
    void update();
    /// True for a request that has been dealt with here: one for pictures, or one that a recording takes for its own.
    bool handle(const ui::Request& request);
    bool recording() const { return recorder_ != nullptr; }

    /// Whether the whole window, as it has just been drawn, is the picture that was asked for; then take_window().
    bool wants_window() const { return lab_.output.hidden; }
    void take_window(const render::Image& window);

private:
    void take(const ui::TakePicture& wanted);
    void record(const ui::Record& wanted);
    void end(bool keep, const std::string& why);
    void describe();
    void keep(const render::Image& picture, const std::filesystem::path& file);
    PictureMaker maker(bool transparent) const;
    void say(bool error, std::string text) { lab_.messages.push_back({error, std::move(text)}); }

    render::Renderer& renderer_;
    SimulationThread& simulation_;
    ui::Lab& lab_;
    std::unique_ptr<Recorder> recorder_;
    std::filesystem::path recording_file_;
    std::optional<std::filesystem::path> window_file_; ///< for the whole window's picture
};

/// A file name like the wished one under which there is nothing yet: itself, or with another number before its ending.
/// A name with a place for a number is free when no picture has a name of that pattern.
std::string free_name(const std::string& wished);

} // namespace clothlab::app

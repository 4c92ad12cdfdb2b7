#include <filesystem>
#include <iostream>

#include "app/core/data_folder.h"
#include "cli/command_line.h"
#include "scene/io.h"
#include "timeline/recording.h"

namespace clothlab::cli {
namespace {

std::string plural(std::size_t number, const std::string& what) {
    return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

/// A line for each branch and bookmark.
void describe(const timeline::Recording& recording) {
    for (const timeline::Branch& branch : recording.timeline.branches()) {
        const timeline::FrameTime begin = frame_time(branch, branch.fork_step), end = frame_time(branch, branch.end);
        const sim::Cloth& cloth = branch.start->cloth;
        const bool single = branch.start->stepping.precision == sim::Precision::single_precision;
        std::cout << "  " << branch.name << ": frames " << begin.frame << " to " << end.frame << ", " << end.time
                  << " s, " << cloth.num_width_points << " x " << cloth.num_height_points << " points, "
                  << (single ? "single" : "double") << " precision";
        if (const timeline::Branch* parent = recording.timeline.find(branch.parent))
            std::cout << ", from " << parent->name;
        std::cout << ", " << plural(branch.keyframes.size(), "state") << ", " << plural(branch.changes.size(), "change")
                  << ", " << plural(branch.marks.size(), "mark") << "\n";
    }
    for (const timeline::Bookmark& bookmark : recording.timeline.bookmarks())
        std::cout << "  bookmark \"" << bookmark.name << "\": frame " << bookmark.frame << ", step " << bookmark.substep
                  << " of " << recording.timeline.find(bookmark.moment.branch)->name << "\n";
}

bool validate_recording(const std::string& file) {
    try {
        const timeline::Recording recording = timeline::load_recording(file);
        if (recording.damage.empty())
            std::cout << file << ": ok\n";
        else
            std::cerr << recording.damage << "\n";
        describe(recording);
        return recording.damage.empty();
    } catch (const timeline::RecordingError& e) {
        std::cerr << e.what() << "\n";
        return false;
    }
}

bool validate_scene(const std::string& file) {
    try {
        scene::load_scene(app::scene_path(file));
        std::cout << file << ": ok\n";
        return true;
    } catch (const scene::SceneError& e) {
        std::cerr << e.what() << "\n";
        return false;
    }
}

} // namespace

int validate(const std::vector<std::string>& files) {
    int status = 0;
    for (const std::string& file : files) {
        const bool recording =
            std::filesystem::path(file).extension() == timeline::recording_suffix || timeline::is_recording(file);
        if (!(recording ? validate_recording(file) : validate_scene(file)))
            status = 2;
    }
    return status;
}

} // namespace clothlab::cli

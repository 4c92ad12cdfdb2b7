// `clothlab export`: a recording's frames as meshes.
#include <charconv>
#include <iostream>
#include <limits>

#include "cli/command_line.h"
#include "scene/error.h"
#include "timeline/mesh_sequence.h"

namespace clothlab::cli {
namespace {

/// Of FIRST:LAST, where either may be left out.
timeline::FrameRange read_frames(const std::string& text) {
    const auto number = [&](std::string_view digits, std::uint64_t otherwise) {
        if (digits.empty())
            return otherwise;
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size())
            throw scene::SceneError("--frames " + text + ": write FIRST:LAST");
        return value;
    };
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (text.empty())
        return {0, most};
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
        throw scene::SceneError("--frames " + text + ": write FIRST:LAST");
    const timeline::FrameRange range{number(std::string_view(text).substr(0, colon), 0),
                                     number(std::string_view(text).substr(colon + 1), most)};
    if (range.first > range.last)
        throw scene::SceneError("--frames " + text + ": the first frame comes after the last");
    return range;
}

timeline::BranchId find_branch(const timeline::Recording& recording, const std::string& name) {
    if (name.empty())
        return recording.at.branch;
    std::string names;
    for (const timeline::Branch& branch : recording.timeline.branches()) {
        if (branch.name == name)
            return branch.id;
        names += (names.empty() ? "" : ", ") + branch.name;
    }
    throw scene::SceneError("--branch " + name + ": there is no such branch; the recording has: " + names);
}

timeline::Recording load(const std::string& file) {
    try {
        return timeline::load_recording(file);
    } catch (const timeline::RecordingError& e) {
        throw scene::SceneError(e.what());
    }
}

} // namespace

int export_meshes(const ExportArguments& arguments) {
    const timeline::FrameRange frames = read_frames(arguments.frames);
    const timeline::Recording recording = load(arguments.recording);
    if (!recording.damage.empty())
        std::cerr << "clothlab: " << recording.damage << "\n";
    timeline::MeshSequence sequence;
    sequence.folder = arguments.folder;
    sequence.format = arguments.format == "ply" ? timeline::MeshFormat::ply : timeline::MeshFormat::obj;
    sequence.line = find_branch(recording, arguments.branch);
    sequence.frames = frames;
    sequence.every = arguments.every;
    sequence.title = recording.scene.name;
    const timeline::Branch& branch = *recording.timeline.find(sequence.line);
    const std::uint64_t last = recording.timeline.frame_time({branch.id, branch.end}).frame;
    if (frames.first > last)
        throw scene::SceneError("--frames " + arguments.frames + ": the last frame of \"" + branch.name + "\" is " +
                                std::to_string(last));
    const timeline::MeshesWritten written = timeline::write_meshes(recording.timeline, sequence);
    std::cout << "wrote " << written.files << (written.files == 1 ? " mesh" : " meshes") << " to " << arguments.folder
              << "\n";
    if (written.missing > 0)
        std::cerr << "clothlab: " << arguments.recording << ": " << written.missing
                  << " of these frames are not in the recording\n";
    return 0;
}

} // namespace clothlab::cli

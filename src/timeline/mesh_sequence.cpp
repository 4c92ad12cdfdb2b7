#include "timeline/mesh_sequence.h"

#include <algorithm>
#include <string>

#include "scene/whole_file.h"
#include "timeline/reader.h"

namespace clothlab::timeline {
namespace {

/// With leading zeros, so that files are in order by their names.
std::string file_name(const MeshSequence& sequence, std::uint64_t frame, std::uint64_t last) {
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(last).size());
    std::string number = std::to_string(frame);
    number.insert(0, digits - std::min(digits, number.size()), '0');
    return sequence.name + "_" + number + "." + name_of(sequence.format);
}

} // namespace

MeshesWritten write_meshes(const Timeline& timeline, const MeshSequence& sequence, const sim::Execution& execution,
                           const Progress& progress) {
    const Branch* line = timeline.find(sequence.line);
    if (!line)
        throw RecordingError(sequence.folder.string() + ": there is no branch " + std::to_string(sequence.line));
    const std::uint64_t end = timeline.frame_time({line->id, line->end}).frame;
    const std::uint64_t first = sequence.frames.first, last = std::min(sequence.frames.last, end);
    if (first > last)
        throw RecordingError(sequence.folder.string() + ": there are no frames " + std::to_string(first) + " to " +
                             std::to_string(sequence.frames.last) + "; the last one of \"" + line->name + "\" is " +
                             std::to_string(end));
    const auto every = static_cast<std::uint64_t>(std::max(sequence.every, 1));
    MeshesWritten result;
    std::error_code error;
    std::filesystem::create_directories(sequence.folder, error);
    if (error)
        throw RecordingError(sequence.folder.string() + ": the folder cannot be made: " + error.message());
    try {
        Reader reader(execution);
        for (std::uint64_t frame = first; frame <= last; frame += every) {
            const Moment moment{line->id, timeline.step_of_frame(line->id, frame)};
            if (timeline.reachable(moment) && timeline.frame_time(moment).frame == frame) {
                reader.seek(timeline, moment);
                scene::WholeFile file(sequence.folder / file_name(sequence, frame, last));
                file.write(mesh_text(reader.simulation(), sequence.format,
                                     sequence.title + ", frame " + std::to_string(frame)));
                file.commit();
                ++result.files;
            } else {
                ++result.missing;
            }
            if (progress && !progress(static_cast<double>(frame - first + 1) / static_cast<double>(last - first + 1)))
                throw RecordingError(sequence.folder.string() + ": exporting was cancelled after " +
                                     std::to_string(result.files) + " files");
        }
    } catch (const RecordingError&) {
        throw;
    } catch (const scene::FileError& e) {
        throw RecordingError(e.what());
    } catch (const std::exception& e) {
        throw RecordingError(sequence.folder.string() + ": the meshes cannot be written: " + e.what());
    }
    if (result.files == 0)
        throw RecordingError(sequence.folder.string() + ": none of the frames " + std::to_string(first) + " to " +
                             std::to_string(last) + " is still in the cache");
    return result;
}

} // namespace clothlab::timeline

// A timeline as a file: everything of it, with the state of every frame's end, so that scrubbing needs no
// recomputation.
//
// A file is a header and a sequence of chunks, each with its length, its number and a checksum, in an order in which
// the beginning of it alone makes sense: what follows damage is lost, what comes before it is not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "scene/scene.h"
#include "sim/execution.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {

inline constexpr const char* recording_suffix = ".clothrec";
inline constexpr std::uint32_t recording_version = 1;

/// A sentence with the file's name.
struct RecordingError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Recording {
    scene::Scene scene; ///< as it was when it was saved
    Timeline timeline;
    Moment at; ///< where the playhead was
    /// What is missing and why, when the file is damaged; empty when it is whole.
    std::string damage;
};

/// Told the share done, 0 to 1; the work ends with RecordingError("... was cancelled") when it returns false.
using Progress = std::function<bool(double)>;

/// Saves a copy of a timeline, or of one line of it. The states of frames that are not in the cache are computed;
/// frames that were dropped stay missing. A crash at any moment leaves the old or the new file whole. Throws
/// RecordingError.
void save_recording(const Recording& recording, const std::filesystem::path& file, const sim::Execution& execution = {},
                    const Progress& progress = {});

/// Whether a file begins as recordings of any version do.
bool is_recording(const std::filesystem::path& file);

/// Reads a recording. States stay in the file until they are wanted: memory is a few dozen bytes per frame. Throws
/// RecordingError when nothing of it can be used; otherwise see Recording::damage.
Recording load_recording(const std::filesystem::path& file, const Progress& progress = {});

} // namespace clothlab::timeline

// Cloth as meshes for other programs: one file, or one for each frame of a range.
#pragma once

#include <filesystem>
#include <string>

#include "timeline/overview.h"
#include "timeline/recording.h"

namespace clothlab::timeline {

/// Wavefront's text format, or Stanford's in its binary form.
enum class MeshFormat : std::uint8_t { obj, ply };
/// "obj", "ply": as files end and the command line writes it.
const char* name_of(MeshFormat format);

/// The mesh of a state, all of the file: positions in m in the run's precision, to the last bit; texture coordinates,
/// 0 to 1 along the cloth's sides; triangles. PLY has normals as well.
std::string mesh_text(const sim::Simulation& simulation, MeshFormat format, const std::string& title);

struct MeshSequence {
    std::filesystem::path folder; ///< made where it is missing
    MeshFormat format = MeshFormat::obj;
    BranchId line = 0;
    FrameRange frames;          ///< both included; what lies after the line's last frame does not count
    int every = 1;              ///< frames from one file to the next
    std::string name = "cloth"; ///< files are called NAME_0042.obj: by their frames
    std::string title;          ///< in each file
};

struct MeshesWritten {
    std::size_t files = 0;
    std::size_t missing = 0; ///< frames that are no longer in the cache
};

/// Writes the files, each of them whole or not at all. Throws RecordingError, also when there is nothing to write.
MeshesWritten write_meshes(const Timeline& timeline, const MeshSequence& sequence, const sim::Execution& execution = {},
                           const Progress& progress = {});

} // namespace clothlab::timeline

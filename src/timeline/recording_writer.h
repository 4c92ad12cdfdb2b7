// Writes the chunks of a recording one after the other; what has been written takes no memory.
//
// The order of chunks in a file: scene; contents, playhead and bookmarks, where they are known beforehand; then each
// branch after its parent: its head and, in the order of steps, its changes, clocks, states and marks. A description
// stands before the first that refers to it. The end chunk comes last.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "scene/scene.h"
#include "timeline/chunks.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {

inline constexpr std::uint64_t recording_magic = 0x0a0d4345524c4389; // 0x89 "CLREC\r\n", as the file begins

namespace chunk {
inline constexpr ChunkKind scene{'S', 'C', 'N', 'E'};       // the scene's text
inline constexpr ChunkKind contents{'C', 'O', 'N', 'T'};    // what is to follow, so that damage can say what is missing
inline constexpr ChunkKind playhead{'P', 'L', 'A', 'Y'};    // branch, step
inline constexpr ChunkKind bookmark{'B', 'K', 'M', 'K'};    // branch, step, name, camera's text or nothing
inline constexpr ChunkKind description{'D', 'E', 'S', 'C'}; // a scene's text, by its number among these
inline constexpr ChunkKind branch{'B', 'R', 'C', 'H'};
inline constexpr ChunkKind change{'C', 'H', 'N', 'G'};
inline constexpr ChunkKind clock{'C', 'L', 'C', 'K'};
inline constexpr ChunkKind state{'S', 'T', 'A', 'T'};
inline constexpr ChunkKind mark{'M', 'A', 'R', 'K'};
inline constexpr ChunkKind trouble{'T', 'R', 'B', 'L'};
inline constexpr ChunkKind end{'D', 'O', 'N', 'E'};
} // namespace chunk

/// A state of the branch under way, and the frames that have ended since the one before it.
struct RecordedState {
    std::uint64_t step = 0;
    bool linked = false; ///< the steps since the state before are known, too
    DescriptionPtr description;
    std::span<const Sample> samples;
    /// compress_state's; empty: the start of a run, which follows from its description and the changes made there.
    std::vector<std::byte> compressed;
};

/// All throw scene::FileError.
class RecordingWriter {
public:
    explicit RecordingWriter(const std::filesystem::path& file);

    void write(const scene::Scene& scene);
    void write_contents(const Timeline& timeline);
    void write_playhead(const Moment& moment);
    void write(const Bookmark& bookmark);
    void begin(const Branch& branch);
    void write(const Change& change);
    void write(const FrameClock& clock);
    void write(const RecordedState& state);
    void write(const Mark& mark);
    void write(const sim::Trouble& trouble, std::uint64_t step);
    /// The last call: now the file takes the place of an older one.
    void finish();

private:
    /// Throws RecordingError for one that would not be read back as it is.
    std::uint32_t number_of(const DescriptionPtr& description);

    std::string name_;
    ChunkWriter chunks_;
    std::map<DescriptionPtr, std::uint32_t> descriptions_;
};

} // namespace clothlab::timeline

// States for which memory has no room: in a file that has no name and is gone with the program, however that ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "timeline/state_codec.h"

namespace clothlab::timeline {

/// Where large temporary files belong: the folder that TMPDIR names, /var/tmp (/tmp is often memory), or else the
/// system's.
std::filesystem::path scratch_folder();

/// May be used in several threads at once.
class ScratchFile : public std::enable_shared_from_this<ScratchFile> {
public:
    /// Throws std::system_error where none can be made.
    static std::shared_ptr<ScratchFile> make(const std::filesystem::path& folder);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    /// A compressed state that lies in the file; its place is free again when nobody holds it any more. Throws
    /// std::system_error, and keeps nothing, when the disk is full or fails.
    StoredStatePtr keep(std::span<const std::byte> compressed);
    /// Bytes from the first to the last that is in use.
    std::uint64_t size() const;

private:
    class OnDisk;
    ScratchFile(int descriptor, std::filesystem::path folder);
    std::uint64_t take(std::uint64_t count);
    void give_back(std::uint64_t at, std::uint64_t count);

    const int descriptor_;
    const std::filesystem::path folder_;
    mutable std::mutex mutex_;                      // of what follows
    std::map<std::uint64_t, std::uint64_t> unused_; // first byte and count of the gaps before the end
    std::uint64_t end_ = 0;
};

} // namespace clothlab::timeline

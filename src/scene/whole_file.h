// Files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace clothlab::scene {

/// A sentence: "FILE: cannot be written: why".
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that takes the place of an older one once it is complete: until then it is FILE.part beside it, which goes
/// again where it is not committed. A crash at any moment, of the program or of the machine, leaves the old or the new
/// file whole; it may leave the part behind, which the next one to write the file takes over. What is no regular file,
/// such as a pipe or a device, is written to as it is; a link stays, and what it leads to is replaced.
class WholeFile {
public:
    /// Throws FileError when it cannot be written, also because another program is writing it.
    explicit WholeFile(const std::filesystem::path& file);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Throw FileError.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
    /// The last call: waits until the bytes are on the disk, then puts the file in its place.
    void commit();

    std::uint64_t size() const { return size_; } ///< bytes so far

private:
    [[noreturn]] void fail(int error) const;
    void open_part();

    std::filesystem::path name_;   ///< as the caller calls it
    std::filesystem::path target_; ///< what is replaced
    std::filesystem::path part_;   ///< empty: written directly
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

} // namespace clothlab::scene

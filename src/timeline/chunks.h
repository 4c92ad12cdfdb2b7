// Files of chunks: a magic number and a version, then chunks of
//     kind (4 bytes), number (4), length of the payload (8), checksum of these 16 bytes (8),
//     payload, checksum of the payload and of all before it in the chunk (8)
// one after the other, numbered from 0. All in the byte order of x86 and ARM.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/whole_file.h"

namespace clothlab::timeline {

/// What is wrong with the bytes of a file, as the end of a sentence.
struct Damage : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class T>
concept Number = std::is_arithmetic_v<T>;

using ChunkKind = std::array<char, 4>;

/// A payload under construction.
class Packer {
public:
    template <Number T>
    Packer& put(T value) {
        return append(std::as_bytes(std::span(&value, 1)));
    }
    Packer& put(std::string_view text); ///< with its length
    /// To the payload's end.
    Packer& append(std::span<const std::byte> bytes);
    Packer& append(std::string_view text) { return append(std::as_bytes(std::span(text))); }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

/// Takes a payload apart. Throws Damage where it is too short.
class Unpacker {
public:
    explicit Unpacker(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <Number T>
    T get() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    template <Number T>
    void get(T& value) {
        value = get<T>();
    }
    std::string text();
    std::span<const std::byte> rest() const { return bytes_; }
    std::size_t left() const { return bytes_.size(); }
    void end() const; ///< throws Damage where something is left

private:
    std::span<const std::byte> take(std::size_t count);
    std::span<const std::byte> bytes_;
};

class ChunkWriter {
public:
    /// Throws scene::FileError, as all of it.
    ChunkWriter(const std::filesystem::path& file, std::uint64_t magic, std::uint32_t version);
    void write(const ChunkKind& kind, const Packer& payload);
    std::uint32_t chunks() const { return number_; }
    std::uint64_t size() const { return file_.size(); } ///< bytes so far
    void commit() { file_.commit(); }

private:
    scene::WholeFile file_;
    std::uint32_t number_ = 0;
};

/// An open file that many may read at once. Stays what it was when another takes its place.
class SharedFile {
public:
    /// Throws std::runtime_error with a sentence.
    explicit SharedFile(const std::filesystem::path& file);
    ~SharedFile();
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    /// As many bytes as there are, at most that many. Throws std::runtime_error with a sentence.
    std::vector<std::byte> read(std::uint64_t at, std::size_t count) const;
    std::uint64_t size() const { return size_; } ///< bytes, when it was opened
    const std::string& name() const { return name_; }

private:
    std::string name_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

struct Chunk {
    ChunkKind kind{};
    std::vector<std::byte> payload;
    std::uint64_t payload_at = 0; ///< in the file
};

class ChunkReader {
public:
    /// Throws std::runtime_error with a sentence when the file is not readable; Damage when it is none of this magic
    /// and version.
    ChunkReader(std::shared_ptr<const SharedFile> file, std::uint64_t magic, std::uint32_t version);
    /// The next chunk, or none at the file's very end. Throws Damage. Asks for no more memory than a chunk that is
    /// whole needs, or than there is file.
    std::optional<Chunk> next();

    const std::shared_ptr<const SharedFile>& file() const { return file_; }
    std::uint64_t at() const { return at_; }         ///< the last chunk's first byte in the file
    std::uint32_t number() const { return number_; } ///< the last chunk's
    std::uint64_t size() const { return file_->size(); }
    bool at_end() const { return next_ == size(); }

private:
    std::shared_ptr<const SharedFile> file_;
    std::uint64_t at_ = 0, next_ = 0;
    std::uint32_t number_ = 0, count_ = 0;
};

} // namespace clothlab::timeline

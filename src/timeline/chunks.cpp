#include "timeline/chunks.h"

#include <bit>
#include <cerrno>
#include <limits>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/saved_state.h"

namespace clothlab::timeline {
namespace {

static_assert(std::endian::native == std::endian::little, "files are in the machine's byte order");

struct Head {
    ChunkKind kind{};
    std::uint32_t number = 0;
    std::uint64_t length = 0;
    std::uint64_t checksum = 0; ///< of the above
};
static_assert(sizeof(Head) == 24);
constexpr std::size_t summed = sizeof(Head) - sizeof(std::uint64_t);
constexpr std::size_t file_head = sizeof(std::uint64_t) + sizeof(std::uint32_t);

std::span<const std::byte> bytes_of(const Head& head) {
    return std::as_bytes(std::span(&head, 1));
}

/// Of the payload and, by way of the head's, of the whole chunk.
std::uint64_t checksum(const Head& head, std::span<const std::byte> payload) {
    const std::array sums{head.checksum, sim::checksum(payload)};
    return sim::checksum(std::as_bytes(std::span(sums)));
}

} // namespace

Packer& Packer::put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    return append(text);
}

Packer& Packer::append(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
}

std::span<const std::byte> Unpacker::take(std::size_t count) {
    if (count > bytes_.size())
        throw Damage("a chunk is too short");
    const std::span<const std::byte> taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
}

std::string Unpacker::text() {
    const std::span<const std::byte> bytes = take(get<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void Unpacker::end() const {
    if (!bytes_.empty())
        throw Damage("a chunk is too long");
}

ChunkWriter::ChunkWriter(const std::filesystem::path& file, std::uint64_t magic, std::uint32_t version) : file_(file) {
    file_.write(Packer().put(magic).put(version).bytes());
}

void ChunkWriter::write(const ChunkKind& kind, const Packer& payload) {
    Head head{kind, number_++, payload.bytes().size(), 0};
    head.checksum = sim::checksum(bytes_of(head).first(summed));
    file_.write(bytes_of(head));
    file_.write(payload.bytes());
    file_.write(Packer().put(checksum(head, payload.bytes())).bytes());
}

SharedFile::SharedFile(const std::filesystem::path& file) : name_(file.string()) {
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0 && !S_ISREG(status.st_mode))
        errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    else if (descriptor_ >= 0) {
        size_ = static_cast<std::uint64_t>(status.st_size);
        return;
    }
    const int error = errno;
    if (descriptor_ >= 0)
        ::close(descriptor_);
    throw std::runtime_error(
        name_ + ": cannot be read: " + (error == EINVAL ? "this is no regular file" : std::strerror(error)));
}

SharedFile::~SharedFile() {
    ::close(descriptor_);
}

std::vector<std::byte> SharedFile::read(std::uint64_t at, std::size_t count) const {
    std::vector<std::byte> bytes(count);
    std::size_t have = 0;
    while (have < count) {
        const ssize_t got = ::pread(descriptor_, bytes.data() + have, count - have, static_cast<off_t>(at + have));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            throw std::runtime_error(name_ + ": cannot be read: " + std::strerror(errno));
        if (got == 0)
            break;
        have += static_cast<std::size_t>(got);
    }
    bytes.resize(have);
    return bytes;
}

ChunkReader::ChunkReader(std::shared_ptr<const SharedFile> file, std::uint64_t magic, std::uint32_t version)
    : file_(std::move(file)), next_(file_head) {
    const std::vector<std::byte> bytes = file_->read(0, file_head);
    Unpacker head(bytes);
    if (bytes.size() < file_head || head.get<std::uint64_t>() != magic)
        throw Damage("it is not a recording of clothlab");
    const auto found = head.get<std::uint32_t>();
    if (found != version)
        throw Damage("it is a recording of version " + std::to_string(found) + "; this program reads " +
                     std::to_string(version));
}

std::optional<Chunk> ChunkReader::next() {
    at_ = next_;
    number_ = count_;
    const std::uint64_t left = size() - std::min(size(), at_);
    if (left == 0)
        return std::nullopt;
    const std::vector<std::byte> head_bytes = file_->read(at_, sizeof(Head));
    if (head_bytes.size() < sizeof(Head))
        throw Damage("the file ends within a chunk");
    Head head;
    std::memcpy(&head, head_bytes.data(), sizeof head);
    if (head.checksum != sim::checksum(bytes_of(head).first(summed)))
        throw Damage("a chunk's head is damaged");
    if (head.number != count_)
        throw Damage("there is chunk " + std::to_string(head.number) + " in the place of another");
    constexpr std::uint64_t around = sizeof(Head) + sizeof(std::uint64_t);
    if (left < around || head.length > left - around)
        throw Damage("the file ends within a chunk");
    Chunk chunk{head.kind, file_->read(at_ + sizeof head, static_cast<std::size_t>(head.length)), at_ + sizeof head};
    const std::vector<std::byte> sum = file_->read(chunk.payload_at + head.length, sizeof(std::uint64_t));
    if (chunk.payload.size() != head.length || sum.size() != sizeof(std::uint64_t))
        throw Damage("the file ends within a chunk");
    if (Unpacker(sum).get<std::uint64_t>() != checksum(head, chunk.payload))
        throw Damage("a chunk does not match its checksum");
    next_ = at_ + around + head.length;
    ++count_;
    return chunk;
}

} // namespace clothlab::timeline

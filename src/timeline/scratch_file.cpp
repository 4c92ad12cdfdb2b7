#include "timeline/scratch_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "sim/saved_state.h"

namespace clothlab::timeline {
namespace {

/// Places are whole numbers of these.
constexpr std::uint64_t grain = 16;
/// Bytes that others find free on the disk when the file has taken its share.
constexpr std::uint64_t left_free = std::uint64_t{256} << 20;

[[noreturn]] void fail(int error, const std::filesystem::path& folder) {
    throw std::system_error(error, std::generic_category(), folder.string());
}

} // namespace

class ScratchFile::OnDisk final : public StoredState {
public:
    OnDisk(std::shared_ptr<ScratchFile> file, std::span<const std::byte> bytes)
        : file_(std::move(file)), size_(bytes.size()), checksum_(sim::checksum(bytes)), at_(file_->take(on_disk())) {
        try {
            write(bytes);
        } catch (...) {
            file_->give_back(at_, on_disk());
            throw;
        }
    }
    ~OnDisk() override { file_->give_back(at_, on_disk()); }
    OnDisk(const OnDisk&) = delete;
    OnDisk& operator=(const OnDisk&) = delete;

    std::vector<std::byte> compressed() const override {
        std::vector<std::byte> bytes(size_);
        for (std::size_t have = 0; have < size_;) {
            const ssize_t got =
                ::pread(file_->descriptor_, bytes.data() + have, size_ - have, static_cast<off_t>(at_ + have));
            if (got < 0 && errno == EINTR)
                continue;
            if (got <= 0)
                fail(got < 0 ? errno : EIO, file_->folder_);
            have += static_cast<std::size_t>(got);
        }
        if (sim::checksum(bytes) != checksum_)
            throw std::runtime_error(file_->folder_.string() + ": a state that was put on this disk is damaged");
        return bytes;
    }
    std::size_t memory() const override { return sizeof *this; }
    std::size_t on_disk() const override { return (size_ + grain - 1) / grain * grain; }

private:
    void write(std::span<const std::byte> bytes) const {
        for (std::size_t done = 0; done < size_;) {
            const ssize_t put =
                ::pwrite(file_->descriptor_, bytes.data() + done, size_ - done, static_cast<off_t>(at_ + done));
            if (put < 0 && errno == EINTR)
                continue;
            if (put <= 0)
                fail(put < 0 ? errno : ENOSPC, file_->folder_);
            done += static_cast<std::size_t>(put);
        }
    }

    std::shared_ptr<ScratchFile> file_;
    std::size_t size_;
    std::uint64_t checksum_;
    std::uint64_t at_;
};

std::filesystem::path scratch_folder() {
    const char* chosen = std::getenv("TMPDIR");
    if (chosen && *chosen)
        return chosen;
    const std::filesystem::path usual = "/var/tmp";
    return ::access(usual.c_str(), W_OK | X_OK) == 0 ? usual : std::filesystem::temp_directory_path();
}

std::shared_ptr<ScratchFile> ScratchFile::make(const std::filesystem::path& folder) {
    std::string name = (folder / "clothlab-XXXXXX").string();
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0)
        fail(errno, folder);
    ::unlink(name.c_str());
    return std::shared_ptr<ScratchFile>(new ScratchFile(descriptor, folder));
}

ScratchFile::ScratchFile(int descriptor, std::filesystem::path folder)
    : descriptor_(descriptor), folder_(std::move(folder)) {}

ScratchFile::~ScratchFile() {
    ::close(descriptor_);
}

StoredStatePtr ScratchFile::keep(std::span<const std::byte> compressed) {
    return std::make_shared<OnDisk>(shared_from_this(), compressed);
}

std::uint64_t ScratchFile::size() const {
    const std::lock_guard lock(mutex_);
    return end_;
}

std::uint64_t ScratchFile::take(std::uint64_t count) {
    const std::lock_guard lock(mutex_);
    const auto fits = [count](const auto& gap) { return gap.second >= count; };
    const auto gap = std::find_if(unused_.begin(), unused_.end(), fits);
    if (gap != unused_.end()) {
        const auto [at, size] = *gap;
        unused_.erase(gap);
        if (size > count)
            unused_.emplace(at + count, size - count);
        return at;
    }
    struct statvfs disk {};
    if (::fstatvfs(descriptor_, &disk) == 0 && disk.f_bavail * disk.f_frsize < left_free + count)
        fail(ENOSPC, folder_);
    return std::exchange(end_, end_ + count);
}

void ScratchFile::give_back(std::uint64_t at, std::uint64_t count) {
    const std::lock_guard lock(mutex_);
    auto next = unused_.lower_bound(at);
    if (next != unused_.end() && at + count == next->first) {
        count += next->second;
        next = unused_.erase(next);
    }
    if (next != unused_.begin())
        if (const auto before = std::prev(next); before->first + before->second == at) {
            at = before->first;
            count += before->second;
            unused_.erase(before);
        }
    if (at + count < end_) {
        unused_.emplace(at, count);
        return;
    }
    // What is left of the file is the disk's again. Should that fail, the next state is written over it.
    end_ = at;
    [[maybe_unused]] const int cut = ::ftruncate(descriptor_, static_cast<off_t>(end_));
}

} // namespace clothlab::timeline

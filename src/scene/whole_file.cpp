#include "scene/whole_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace clothlab::scene {
namespace fs = std::filesystem;
namespace {

constexpr int locked = EWOULDBLOCK;

/// Makes a rename last.
void flush_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return; // it may be written to but not read
    ::fsync(descriptor);
    ::close(descriptor);
}

} // namespace

WholeFile::WholeFile(const fs::path& file) : name_(file), target_(file) {
    std::error_code error;
    if (fs::is_symlink(file, error))
        if (fs::path leads_to = fs::weakly_canonical(file, error); !error)
            target_ = std::move(leads_to);
    const fs::file_status status = fs::status(target_, error);
    if (fs::is_directory(status))
        fail(EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0)
            fail(errno);
        return;
    }
    part_ = target_;
    part_ += ".part";
    open_part();
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0)
        static_cast<void>(::fchmod(descriptor_, old.st_mode & 07777)); // of somebody else's file it may not be allowed
}

void WholeFile::open_part() {
    for (;;) {
        descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor_ < 0)
            fail(errno);
        // Some file systems have no locks; then two programs at a time are not noticed.
        const bool busy = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        struct stat opened {
        }, named{};
        const bool same = !busy && ::fstat(descriptor_, &opened) == 0 && ::stat(part_.c_str(), &named) == 0 &&
                          opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
        if (same && ::ftruncate(descriptor_, 0) == 0)
            return;
        const int error = busy ? locked : errno;
        ::close(descriptor_);
        descriptor_ = -1;
        if (busy || same)
            fail(error);
        // Between the two calls another program put it in its place: that is no longer the part.
    }
}

WholeFile::~WholeFile() {
    if (descriptor_ < 0)
        return;
    if (!part_.empty())
        ::unlink(part_.c_str());
    ::close(descriptor_);
}

void WholeFile::fail(int error) const {
    throw FileError(name_.string() + ": cannot be written: " +
                    (error == locked ? "another program is writing it" : std::strerror(error)));
}

void WholeFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            fail(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        size_ += static_cast<std::uint64_t>(written);
    }
}

void WholeFile::commit() {
    if (!part_.empty() && ::fsync(descriptor_) != 0)
        fail(errno);
    if (!part_.empty() && ::rename(part_.c_str(), target_.c_str()) != 0)
        fail(errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 && part_.empty())
        fail(errno);
    if (!part_.empty())
        flush_folder(target_.parent_path());
}

} // namespace clothlab::scene

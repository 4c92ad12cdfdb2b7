#include "cli/experiment/sweep_journal.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "experiments/sweep/file.h"
#include "scene/io.h"
#include "scene/whole_file.h"

namespace clothlab::cli {
namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;
constexpr int locked = EWOULDBLOCK;

} // namespace

SweepJournal::SweepJournal(const experiments::Sweep& sweep, const std::filesystem::path& file, bool fresh)
    : sweep_(sweep), file_(file) {
    open();
    try {
        read(fresh);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

SweepJournal::~SweepJournal() {
    ::close(descriptor_);
}

void SweepJournal::open() {
    for (;;) {
        descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        if (descriptor_ < 0)
            fail(errno);
        // Some file systems have no locks; then two programs at a time are not noticed.
        const bool busy = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        struct stat opened {
        }, named{};
        const bool same = ::fstat(descriptor_, &opened) == 0 && ::stat(file_.c_str(), &named) == 0 &&
                          opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
        if (!busy && same)
            return;
        ::close(descriptor_);
        if (busy)
            fail(locked);
        // Between the two calls another program put its file in this one's place.
    }
}

void SweepJournal::read(bool fresh) {
    experiments::SweepFile there;
    if (!fresh)
        there = read_sweep_file(sweep_, scene::read_text_file(file_, most_bytes), file_.string());
    if (::ftruncate(descriptor_, static_cast<off_t>(there.whole_bytes)) != 0)
        fail(errno);
    if (there.whole_bytes == 0)
        append(sweep_header(sweep_));
    rows_ = std::move(there.rows);
}

void SweepJournal::fail(int error) const {
    throw scene::FileError(file_.string() + ": cannot be written: " +
                           (error == locked ? "another program is writing it" : std::strerror(error)));
}

void SweepJournal::append(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor_, text.data(), text.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            fail(errno);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void SweepJournal::add(std::size_t cell, std::vector<experiments::Value> row) {
    append(experiments::sweep_line(row));
    rows_[cell] = std::move(row);
    const auto now = std::chrono::steady_clock::now();
    if (now - flushed_ > std::chrono::seconds(1)) { // a disk may take longer than a small cell
        static_cast<void>(::fdatasync(descriptor_));
        flushed_ = now;
    }
}

void SweepJournal::finish() {
    std::string text = sweep_header(sweep_);
    for (const auto& [cell, row] : rows_)
        text += experiments::sweep_line(row);
    scene::WholeFile file(file_);
    file.write(text);
    file.commit();
}

} // namespace clothlab::cli

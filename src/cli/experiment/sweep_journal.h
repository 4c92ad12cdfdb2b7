// The CSV file that a sweep writes cell by cell, so that it can be stopped at any moment and go on from there.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "experiments/sweep/sweep.h"

namespace clothlab::cli {

class SweepJournal {
public:
    /// Opens the file, or makes it, for this program alone, and reads what is finished. `fresh` empties it first. A
    /// last line that is not whole is dropped. Throws scene::SceneError for a file that this sweep did not write, and
    /// scene::FileError when it cannot be written or another program is writing it.
    SweepJournal(const experiments::Sweep& sweep, const std::filesystem::path& file, bool fresh);
    ~SweepJournal();
    SweepJournal(const SweepJournal&) = delete;
    SweepJournal& operator=(const SweepJournal&) = delete;

    /// Of the cells that are finished, before and now.
    const experiments::SweepRows& rows() const { return rows_; }
    /// Adds a finished cell: from here on the end of this program does not lose it, from a second later on the end of
    /// the machine does not. Throws scene::FileError.
    void add(std::size_t cell, std::vector<experiments::Value> row);
    /// Puts the cells in order: at any moment the old or the new file is there, whole. The last call. Throws
    /// scene::FileError.
    void finish();

private:
    void open();
    void read(bool fresh);
    void append(std::string_view text);
    [[noreturn]] void fail(int error) const;

    const experiments::Sweep& sweep_;
    std::filesystem::path file_;
    int descriptor_ = -1;
    experiments::SweepRows rows_;
    std::chrono::steady_clock::time_point flushed_{};
};

} // namespace clothlab::cli

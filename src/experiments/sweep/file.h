// A sweep's CSV file as text. It is its own journal: the line of names, then a line for each finished cell, in the
// order in which they were finished; at the end in the cells' order. Every line says which sweep it is of
// (Sweep::identity), so that a sweep goes on with what is there, and shards are merged without anything beside them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/sweep/sweep.h"

namespace clothlab::experiments {

/// The line of names, with its end.
std::string sweep_header(const Sweep& sweep);
/// A row's line, with its end.
std::string sweep_line(const std::vector<Value>& row);
/// The row of such a line, without its end. Throws std::invalid_argument for anything else, and for one of another
/// sweep.
std::vector<Value> sweep_row(const Sweep& sweep, std::string_view line);

struct SweepFile {
    SweepRows rows;
    std::size_t whole_bytes = 0; ///< up to here the text has whole lines; behind it is one that was being written
};

/// Reads such a file, finished or not; an empty one has no rows. `file` begins errors. Throws scene::SceneError for
/// anything that this sweep did not write.
SweepFile read_sweep_file(const Sweep& sweep, std::string_view text, const std::string& file);

/// A shard's file and its text.
struct SweepShard {
    std::string file, text;
};

/// The file of the whole sweep: the bytes that one run of all cells would have written. Throws scene::SceneError when
/// the shards are of different sweeps or not whole, and when a cell is missing or is there twice.
std::string merge_shards(const std::vector<SweepShard>& shards);

} // namespace clothlab::experiments

// States in the cache and in files: lossless, and smaller than they are in memory.
//
// A position's coordinate is predicted from its neighbours in the grid (left + above - upper left), and so is a
// velocity's; the position and the velocity of one step earlier from the newer ones. What is left over is small where a
// cloth is smooth. Floats are compared as integers of the same order (M. Isenburg, P. Lindstrom, J. Snoeyink, "Lossless
// compression of predicted floating-point geometry", 2005, sections 3 and 4), their bytes sorted by weight, and the
// result compressed with LZ4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/saved_state.h"

namespace clothlab::timeline {

/// What Simulation::save_state gave, compressed. Throws std::invalid_argument for anything else.
std::vector<std::byte> compress_state(std::span<const std::byte> state);

/// The very same bytes again. Throws std::invalid_argument for damaged ones.
std::vector<std::byte> expand_state(std::span<const std::byte> compressed);

/// What a compressed state is a state of, without expanding it. Throws std::invalid_argument as far as damage shows.
sim::StateHeader compressed_header(std::span<const std::byte> compressed);

/// A compressed state that many may hold. It lies in memory or in a file.
class StoredState {
public:
    virtual ~StoredState() = default;
    /// The compressed bytes. Throws std::runtime_error when a file can no longer be read.
    virtual std::vector<std::byte> compressed() const = 0;
    /// Bytes of memory that it takes.
    virtual std::size_t memory() const = 0;
    /// Bytes of a disk that are free again when it goes (ScratchFile).
    virtual std::size_t on_disk() const { return 0; }
};
using StoredStatePtr = std::shared_ptr<const StoredState>;

/// One in memory.
StoredStatePtr keep_in_memory(std::vector<std::byte> compressed);

} // namespace clothlab::timeline

// What the bytes of Simulation::save_state are: a header, the state's arrays (x, y and z of the positions, of the
// previous positions, and of as many velocities as the method keeps), a checksum; in the machine's byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace clothlab::sim {

inline constexpr std::uint32_t state_magic = 0x534c4343; // "CCLS"
inline constexpr std::uint32_t state_version = 2;

struct StateHeader {
    std::uint32_t magic = state_magic, version = state_version;
    std::uint32_t real_size = 0; ///< bytes of a number: 4 or 8
    std::int32_t columns = 0, rows = 0, substep = 0;
    std::uint64_t frame = 0, steps = 0;
    double time = 0;        ///< s
    double dt = 0;          ///< s; of the step that it comes from
    double solver_step = 0; ///< s
    std::uint32_t history = 0;
    std::uint32_t velocities = 0; ///< arrays of velocities: 0 to 2

    std::size_t points() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
    /// Arrays of three numbers per point.
    std::size_t arrays() const { return 2 + std::size_t{velocities}; }
    /// Bytes of all of them.
    std::size_t array_bytes() const { return 3 * arrays() * points() * real_size; }
    /// Bytes of the whole state.
    std::size_t bytes() const { return sizeof(StateHeader) + array_bytes() + sizeof(std::uint64_t); }
};
static_assert(sizeof(StateHeader) == 72); // without padding: its bytes are compared and summed

/// A checksum of bytes: every bit of them changes every bit of it with probability 1/2.
std::uint64_t checksum(std::span<const std::byte> bytes);

/// The header that the bytes begin with. Throws std::invalid_argument with a sentence when they are too few or begin
/// with anything that save_state does not write.
StateHeader read_state_header(std::span<const std::byte> bytes);

/// Throws std::invalid_argument with a sentence when the bytes after the header are too few, too many or damaged.
void check_state(const StateHeader& header, std::span<const std::byte> bytes);

} // namespace clothlab::sim

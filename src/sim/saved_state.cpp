#include "sim/saved_state.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "sim/random.h"

namespace clothlab::sim {

std::uint64_t checksum(std::span<const std::byte> bytes) {
    std::uint64_t h = bytes.size();
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
        h = SplitMix64::mix(h ^ word);
    }
    return h;
}

StateHeader read_state_header(std::span<const std::byte> bytes) {
    constexpr std::int32_t most = 1 << 16; // so that no product overflows
    StateHeader header;
    if (bytes.size() < sizeof header)
        throw std::invalid_argument("too short to be a state");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != state_magic)
        throw std::invalid_argument("not a clothlab state");
    if (header.version != state_version)
        throw std::invalid_argument("a state of version " + std::to_string(header.version) + "; this program reads " +
                                    std::to_string(state_version));
    if ((header.real_size != 4 && header.real_size != 8) || header.columns < 1 || header.columns > most ||
        header.rows < 1 || header.rows > most || header.velocities > 2)
        throw std::invalid_argument("a damaged state: its header makes no sense");
    return header;
}

void check_state(const StateHeader& header, std::span<const std::byte> bytes) {
    if (bytes.size() != header.bytes())
        throw std::invalid_argument("a truncated or overlong state");
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    if (sum != checksum(bytes.first(bytes.size() - sizeof sum)))
        throw std::invalid_argument("a damaged state: its checksum does not match");
}

} // namespace clothlab::sim

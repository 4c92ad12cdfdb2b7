#include "timeline/state_codec.h"

#include <lz4.h>

#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace clothlab::timeline {
namespace {

/// What compressed states begin with; the state's header and checksum follow as they are.
constexpr std::uint32_t codec_magic = 0x315a4c43; // "CLZ1"
constexpr std::size_t head_size = sizeof codec_magic + sizeof(sim::StateHeader) + sizeof(std::uint64_t);

template <class Bits>
constexpr Bits sign_bit = Bits{1} << (std::numeric_limits<Bits>::digits - 1);

/// All ones where the highest bit is set.
template <class Bits>
Bits all_if_negative(Bits bits) {
    return static_cast<Bits>(static_cast<std::make_signed_t<Bits>>(bits) >> (std::numeric_limits<Bits>::digits - 1));
}

/// Floats as integers in the same order; every pattern of bits to one of its own.
template <class Bits>
Bits ordered(Bits bits) {
    return bits ^ (all_if_negative(bits) | sign_bit<Bits>);
}
template <class Bits>
Bits unordered(Bits bits) {
    return bits ^ (~all_if_negative(bits) | sign_bit<Bits>);
}

/// Small integers of either sign as small ones.
template <class Bits>
Bits zigzag(Bits bits) {
    return static_cast<Bits>(bits << 1) ^ all_if_negative(bits);
}
template <class Bits>
Bits unzigzag(Bits bits) {
    return (bits >> 1) ^ (Bits{0} - (bits & 1));
}

struct Shape {
    std::size_t columns, rows, arrays;
    std::size_t points() const { return columns * rows; }
    /// Of one array: x, y and z.
    std::size_t array() const { return 3 * points(); }
    std::size_t numbers() const { return arrays * array(); }
};

Shape shape_of(const sim::StateHeader& header) {
    return {static_cast<std::size_t>(header.columns), static_cast<std::size_t>(header.rows), header.arrays()};
}

/// The second array and the fourth are one step older than those before them, and near to them.
bool follows_the_one_before(std::size_t array) {
    return array % 2 == 1;
}

/// One axis: left + above - upper left is taken away from each number; outside the grid there are zeros.
template <class Bits>
void predict_from_neighbours(const Shape& shape, const Bits* from, Bits* to) {
    const std::size_t columns = shape.columns;
    for (std::size_t row = 0; row < shape.rows; ++row, from += columns, to += columns) {
        const auto down = [&](std::size_t i) { return row == 0 ? from[i] : from[i] - from[i - columns]; };
        to[0] = down(0);
        for (std::size_t i = 1; i < columns; ++i)
            to[i] = down(i) - down(i - 1);
    }
}

/// In place; the other way round.
template <class Bits>
void restore_from_neighbours(const Shape& shape, Bits* at) {
    const std::size_t columns = shape.columns;
    for (std::size_t row = 0; row < shape.rows; ++row, at += columns) {
        Bits sum = 0;
        for (std::size_t i = 0; i < columns; ++i)
            at[i] = sum += at[i];
        for (std::size_t i = 0; row != 0 && i < columns; ++i)
            at[i] += at[i - columns];
    }
}

/// The numbers' bytes after prediction, the lowest of all numbers first.
template <class Bits>
std::vector<std::byte> to_planes(const Shape& shape, const std::byte* numbers) {
    const std::size_t count = shape.numbers(), array = shape.array();
    std::vector<Bits> bits(count), rest(count);
    std::memcpy(bits.data(), numbers, count * sizeof(Bits));
    for (Bits& b : bits)
        b = ordered(b);
    for (std::size_t a = 0; a < shape.arrays; ++a) {
        const Bits* from = bits.data() + a * array;
        Bits* to = rest.data() + a * array;
        if (follows_the_one_before(a))
            for (std::size_t i = 0; i < array; ++i)
                to[i] = from[i] - from[i - array];
        else
            for (std::size_t axis = 0; axis < 3; ++axis)
                predict_from_neighbours(shape, from + axis * shape.points(), to + axis * shape.points());
    }
    std::vector<std::byte> planes(count * sizeof(Bits));
    for (Bits& r : rest)
        r = zigzag(r);
    for (std::size_t plane = 0; plane < sizeof(Bits); ++plane)
        for (std::size_t i = 0; i < count; ++i)
            planes[plane * count + i] = static_cast<std::byte>(rest[i] >> (8 * plane));
    return planes;
}

template <class Bits>
void from_planes(const Shape& shape, const std::byte* planes, std::byte* numbers) {
    const std::size_t count = shape.numbers(), array = shape.array();
    std::vector<Bits> bits(count);
    for (std::size_t plane = 0; plane < sizeof(Bits); ++plane)
        for (std::size_t i = 0; i < count; ++i)
            bits[i] |= static_cast<Bits>(static_cast<Bits>(planes[plane * count + i]) << (8 * plane));
    for (Bits& b : bits)
        b = unzigzag(b);
    for (std::size_t a = 0; a < shape.arrays; ++a) {
        Bits* at = bits.data() + a * array;
        if (follows_the_one_before(a))
            for (std::size_t i = 0; i < array; ++i)
                at[i] += at[i - array];
        else
            for (std::size_t axis = 0; axis < 3; ++axis)
                restore_from_neighbours(shape, at + axis * shape.points());
    }
    for (Bits& b : bits)
        b = unordered(b);
    std::memcpy(numbers, bits.data(), count * sizeof(Bits));
}

struct InMemory final : StoredState {
    explicit InMemory(std::vector<std::byte> all) : bytes(std::move(all)) { bytes.shrink_to_fit(); }
    std::vector<std::byte> compressed() const override { return bytes; }
    std::size_t memory() const override { return sizeof *this + bytes.capacity(); }
    std::vector<std::byte> bytes;
};

} // namespace

std::vector<std::byte> compress_state(std::span<const std::byte> state) {
    const sim::StateHeader header = sim::read_state_header(state);
    sim::check_state(header, state);
    const Shape shape = shape_of(header);
    const std::size_t size = header.array_bytes();
    if (size > LZ4_MAX_INPUT_SIZE)
        throw std::invalid_argument("a state too large to compress");
    const std::byte* numbers = state.data() + sizeof header;
    const std::vector<std::byte> planes =
        header.real_size == 4 ? to_planes<std::uint32_t>(shape, numbers) : to_planes<std::uint64_t>(shape, numbers);
    const int bound = LZ4_compressBound(static_cast<int>(size));
    std::vector<std::byte> out(head_size + static_cast<std::size_t>(bound));
    std::byte* to = out.data();
    const auto put = [&](const void* from, std::size_t bytes) {
        std::memcpy(to, from, bytes);
        to += bytes;
    };
    put(&codec_magic, sizeof codec_magic);
    put(&header, sizeof header);
    put(numbers + size, sizeof(std::uint64_t));
    const int written = LZ4_compress_default(reinterpret_cast<const char*>(planes.data()), reinterpret_cast<char*>(to),
                                             static_cast<int>(size), bound);
    out.resize(head_size + static_cast<std::size_t>(written));
    return out;
}

sim::StateHeader compressed_header(std::span<const std::byte> compressed) {
    std::uint32_t magic = 0;
    if (compressed.size() < head_size)
        throw std::invalid_argument("too short to be a compressed state");
    std::memcpy(&magic, compressed.data(), sizeof magic);
    if (magic != codec_magic)
        throw std::invalid_argument("not a compressed state");
    return sim::read_state_header(compressed.subspan(sizeof magic));
}

std::vector<std::byte> expand_state(std::span<const std::byte> compressed) {
    const sim::StateHeader header = compressed_header(compressed);
    const std::byte* head = compressed.data() + sizeof codec_magic;
    const std::span<const std::byte> packed = compressed.subspan(head_size);
    const std::size_t size = header.array_bytes();
    // LZ4 makes 255 bytes of one at most; a damaged header does not make us ask for more memory.
    if (size > LZ4_MAX_INPUT_SIZE || packed.size() > LZ4_MAX_INPUT_SIZE || size / 255 > packed.size())
        throw std::invalid_argument("a damaged compressed state: its length does not fit");
    std::vector<std::byte> planes(size);
    const int read =
        LZ4_decompress_safe(reinterpret_cast<const char*>(packed.data()), reinterpret_cast<char*>(planes.data()),
                            static_cast<int>(packed.size()), static_cast<int>(size));
    if (read < 0 || static_cast<std::size_t>(read) != size)
        throw std::invalid_argument("a damaged compressed state: it does not expand");
    std::vector<std::byte> state(header.bytes());
    std::memcpy(state.data(), head, sizeof header);
    std::byte* numbers = state.data() + sizeof header;
    if (header.real_size == 4)
        from_planes<std::uint32_t>(shape_of(header), planes.data(), numbers);
    else
        from_planes<std::uint64_t>(shape_of(header), planes.data(), numbers);
    std::memcpy(numbers + size, head + sizeof header, sizeof(std::uint64_t));
    sim::check_state(header, state);
    return state;
}

StoredStatePtr keep_in_memory(std::vector<std::byte> compressed) {
    return std::make_shared<InMemory>(std::move(compressed));
}

} // namespace clothlab::timeline

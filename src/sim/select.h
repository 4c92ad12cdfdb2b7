// Choosing between two values without a branch, where it is as good as random which is taken: contacts and springs rest
// right at their limits. A mispredicted branch costs more than the arithmetic it saves.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace clothlab::sim {

/// The bits of `yes` or of `no`.
template <class Real>
inline Real select(bool condition, Real yes, Real no) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    const Bits mask = static_cast<Bits>(0) - static_cast<Bits>(condition);
    return std::bit_cast<Real>((std::bit_cast<Bits>(yes) & mask) | (std::bit_cast<Bits>(no) & ~mask));
}

} // namespace clothlab::sim

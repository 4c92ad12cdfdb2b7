// Numbers in text files.
#pragma once

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string>

namespace clothlab::scene {

/// Appends the fewest digits that read back as the same bits, in the precision of the run.
inline void append_number(std::string& text, double value, bool single) {
    char digits[32];
    const auto result = single ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(value))
                               : std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, result.ptr);
}

/// The fewest digits that read back as the same double.
inline std::string shortest_text(double value) {
    std::string text;
    append_number(text, value, false);
    return text;
}

/// A hash as it is printed everywhere: 16 hexadecimal digits.
inline std::string hash_text(std::uint64_t hash) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

} // namespace clothlab::scene

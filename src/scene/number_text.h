// Numbers in text files.
#pragma once

#include <charconv>
#include <string>

namespace clothlab::scene {

/// Appends the fewest digits that read back as the same bits, in the precision of the run.
inline void append_number(std::string& text, double value, bool single) {
    char digits[32];
    const auto result = single ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(value))
                               : std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, result.ptr);
}

} // namespace clothlab::scene

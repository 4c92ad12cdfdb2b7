// Sentences with numbers in them.
#pragma once

#include <cstdio>
#include <string>

namespace clothlab::experiments {

/// As std::printf writes it.
std::string formatted(const char* format, auto... values) {
    const int size = std::snprintf(nullptr, 0, format, values...);
    std::string text(static_cast<std::size_t>(size) + 1, '\0');
    std::snprintf(text.data(), text.size(), format, values...);
    text.pop_back();
    return text;
}

} // namespace clothlab::experiments

#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace clothlab::cli {

/// What is wrong with a text that is to be a finite number for which `fits` holds; empty when nothing is.
template <class Fits>
std::string wrong_with(const std::string& text, const char* wanted, Fits fits) {
    double value = 0;
    const bool read = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
    return read && fits(value) ? std::string() : "'" + text + "' is not " + wanted;
}

// CLI11's own ranges hold NaN.
inline const CLI::Validator finite{
    [](std::string& text) { return wrong_with(text, "a finite number", [](double) { return true; }); }, ""};
inline const CLI::Validator finite_positive{
    [](std::string& text) { return wrong_with(text, "a number above zero", [](double v) { return v > 0; }); },
    "POSITIVE"};
inline const CLI::Validator finite_non_negative{
    [](std::string& text) { return wrong_with(text, "a number from zero on", [](double v) { return v >= 0; }); },
    "NONNEGATIVE"};

} // namespace clothlab::cli

// What a sweep varies: a parameter of the scene and its values, from text such as `cloth.ks=100:100000:7log`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clothlab::experiments {

struct SweepAxis {
    std::string key;                 ///< of scene::set_parameter
    std::vector<std::string> values; ///< as scene::set_parameter takes them; no two are the same
    bool numeric = false;            ///< all values are finite numbers
    bool log = false;                ///< they are spread by factors, not by differences

    double number(std::size_t value) const; ///< of a numeric axis
};

/// Reads `KEY=FIRST:LAST:COUNT`, evenly spread; `KEY=FIRST:LAST:COUNTlog`, from each to the next the same factor; or
/// `KEY=VALUE,VALUE,...`, whose numbers are spread by factors where they are positive and span two decades or more.
///
/// Both ends are taken as they are, values between them rounded to 12 significant digits: 0.3, not 0.30000000000000004,
/// on every machine. A parameter that takes whole numbers gets the nearest ones. Commas within brackets and quotes
/// belong to the value. Throws scene::SceneError, which begins with "--vary" and the text.
SweepAxis parse_axis(std::string_view text);

/// A number in the fewest digits that are read back as the same; whole ones without an exponent up to 1e15.
std::string number_text(double value);

} // namespace clothlab::experiments

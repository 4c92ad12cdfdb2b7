#include "experiments/sweep/axis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "scene/error.h"
#include "scene/fields.h"

namespace clothlab::experiments {
namespace {

/// A range of more values is a slip of the finger.
constexpr int most_values = 100'000;

/// The whole text as a finite number.
std::optional<double> number_of(std::string_view text) {
    if (!text.empty() && text.front() == '+')
        text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

double rounded(double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.12g", value);
    return *number_of(digits);
}

/// Reads one axis; remembers its text for errors.
class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    SweepAxis parse() const {
        const std::size_t equals = text_.find('=');
        if (equals == std::string_view::npos || equals == 0 || equals + 1 == text_.size())
            fail("write KEY=FIRST:LAST:COUNT, KEY=FIRST:LAST:COUNTlog or KEY=VALUE,VALUE,...");
        if (std::any_of(text_.begin(), text_.end(), [](unsigned char c) { return c < ' '; }))
            fail("a value cannot have line breaks or other control characters");
        SweepAxis axis;
        axis.key = text_.substr(0, equals);
        const scene::Field* field = scene::find_field(axis.key);
        const bool takes_text = field && field->type == scene::FieldType::text;
        const std::vector<std::string_view> parts = split(text_.substr(equals + 1), ':');
        if (!takes_text && parts.size() > 1 && number_of(parts[0]))
            read_range(axis, parts, field && field->type == scene::FieldType::integer);
        else
            read_list(axis, split(text_.substr(equals + 1), ','), takes_text);
        return axis;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw scene::SceneError("--vary " + std::string(text_) + ": " + what);
    }

    /// At separators outside of brackets and quotes.
    static std::vector<std::string_view> split(std::string_view text, char separator) {
        std::vector<std::string_view> parts;
        int depth = 0;
        bool quoted = false;
        std::size_t begin = 0;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            if (c == '"')
                quoted = !quoted;
            else if (!quoted && c == '[')
                ++depth;
            else if (!quoted && c == ']')
                --depth;
            else if (!quoted && depth == 0 && c == separator) {
                parts.push_back(text.substr(begin, i - begin));
                begin = i + 1;
            }
        }
        parts.push_back(text.substr(begin));
        return parts;
    }

    void read_range(SweepAxis& axis, const std::vector<std::string_view>& parts, bool whole) const {
        if (parts.size() != 3)
            fail("a range is FIRST:LAST:COUNT, such as 100:100000:7log");
        std::string_view counted = parts[2];
        axis.log = counted.ends_with("log");
        if (axis.log)
            counted.remove_suffix(3);
        const std::optional<double> first = number_of(parts[0]), last = number_of(parts[1]), count = number_of(counted);
        if (!last)
            fail("'" + std::string(parts[1]) + "' is not a number");
        if (!count || *count != std::floor(*count) || *count < 2 || *count > most_values)
            fail("'" + std::string(parts[2]) +
                 "' is not how many values there are to be; write a whole number from 2 to " +
                 std::to_string(most_values) + ", or the same with log behind it");
        if (axis.log && (*first <= 0 || *last <= 0))
            fail("a range by factors has two positive ends");
        axis.numeric = true;
        std::set<double> seen;
        for (int i = 0; i < static_cast<int>(*count); ++i)
            if (const double value = at(*first, *last, i, static_cast<int>(*count) - 1, axis.log, whole);
                seen.insert(value).second)
                axis.values.push_back(number_text(value));
        if (static_cast<double>(seen.size()) < *count)
            fail("only " + std::to_string(seen.size()) + " of the " + std::to_string(static_cast<int>(*count)) +
                 " values are different" + (whole ? ", as this parameter takes whole numbers" : "") +
                 "; ask for fewer, or list them");
    }

    static double at(double first, double last, int i, int intervals, bool log, bool whole) {
        double value = i == 0 ? first : last;
        if (i > 0 && i < intervals) {
            const double share = static_cast<double>(i) / intervals;
            value = rounded(log ? first * std::pow(last / first, share) : first + (last - first) * share);
        }
        return whole ? std::round(value) : value;
    }

    void read_list(SweepAxis& axis, const std::vector<std::string_view>& values, bool takes_text) const {
        double least = INFINITY, most = -INFINITY;
        axis.numeric = !takes_text;
        std::set<std::string> seen;
        for (const std::string_view value : values) {
            const std::optional<double> number = takes_text ? std::nullopt : number_of(value);
            axis.numeric = axis.numeric && number;
            if (number) {
                least = std::min(least, *number);
                most = std::max(most, *number);
            }
            axis.values.push_back(number ? number_text(*number) : std::string(value));
            if (axis.values.back().empty())
                fail("a value is missing");
            if (!seen.insert(axis.values.back()).second)
                fail("has " + axis.values.back() + " twice");
        }
        axis.log = axis.numeric && least > 0 && most >= 100 * least;
    }

    std::string_view text_;
};

} // namespace

double SweepAxis::number(std::size_t value) const {
    return number_of(values.at(value)).value_or(std::nan(""));
}

SweepAxis parse_axis(std::string_view text) {
    return Parser(text).parse();
}

std::string number_text(double value) {
    char digits[32];
    value = value == 0 ? 0 : value; // not -0
    const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
    const auto end = whole ? std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed).ptr
                           : std::to_chars(digits, digits + sizeof digits, value).ptr;
    return {digits, end};
}

} // namespace clothlab::experiments

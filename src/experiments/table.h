// What experiments end in: numbers in columns with units, as text and as CSV.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clothlab::experiments {

struct Column {
    std::string
        name; ///< as in the CSV file's first line: lower case, words joined by _, the unit last ("rms_error_mm")
    std::string title; ///< as people read it, with the unit ("RMS error (mm)")
    int digits = 4;    ///< significant ones where people read it; CSV has all
};

/// A number, a text, or nothing: what was not measured.
using Value = std::variant<std::monostate, double, std::string>;

struct Table {
    std::vector<Column> columns;
    std::vector<std::vector<Value>> rows; ///< each as long as `columns`

    /// Throws std::out_of_range.
    std::size_t column(std::string_view name) const;
    /// NaN for anything but a number.
    double number(std::size_t row, std::string_view name) const;
    std::string text(std::size_t row, std::string_view name) const; ///< as people read it
};

/// As people read it: numbers with the column's digits, nothing as "".
std::string shown(const Value& value, const Column& column);

/// RFC 4180: a line of names, then the rows; numbers so that they are read back to the last bit, nothing is empty.
std::string to_csv(const Table& table);
/// What to_csv wrote; titles and digits are not in it. What reads as a number, as a whole, is one. Throws
/// std::invalid_argument with the line for rows of another length than the first and for quotes that do not close.
Table from_csv(std::string_view text);

/// The cells of one line of such a text as they are written, without quotes: digits stay text. Throws
/// std::invalid_argument for quotes that do not close.
std::vector<std::string> csv_cells(std::string_view line);

/// Columns padded with spaces, numbers to the right, for a terminal.
std::string to_text(const Table& table);
/// A Markdown table.
std::string to_markdown(const Table& table);

} // namespace clothlab::experiments

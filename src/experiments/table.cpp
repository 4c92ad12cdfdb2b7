#include "experiments/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace clothlab::experiments {
namespace {

std::string exact(double value) {
    if (std::isnan(value))
        return "nan";
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    return {digits, end};
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string result = "\"";
    for (const char c : text)
        result.append(c == '"' ? 2 : 1, c);
    return result + '"';
}

Value value_of(std::string text) {
    if (text.empty())
        return {};
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size())
        return number;
    return text;
}

/// Cells of one record of a CSV text, from `at` on, which moves behind it.
std::vector<std::string> record(std::string_view text, std::size_t& at, std::size_t& line) {
    std::vector<std::string> cells(1);
    const std::size_t first_line = line;
    bool within_quotes = false;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        line += c == '\n';
        if (within_quotes) {
            if (c != '"')
                cells.back() += c;
            else if (at + 1 < text.size() && text[at + 1] == '"')
                cells.back() += text[++at];
            else
                within_quotes = false;
        } else if (c == '"') {
            within_quotes = true;
        } else if (c == ',') {
            cells.emplace_back();
        } else if (c == '\n') {
            ++at;
            return cells;
        } else if (c != '\r') {
            cells.back() += c;
        }
    }
    if (within_quotes)
        throw std::invalid_argument("line " + std::to_string(first_line) + ": a quote does not close");
    return cells;
}

bool is_text(const Value& value) {
    return std::holds_alternative<std::string>(value);
}

} // namespace

std::size_t Table::column(std::string_view name) const {
    for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i].name == name)
            return i;
    throw std::out_of_range("no column " + std::string(name));
}

double Table::number(std::size_t row, std::string_view name) const {
    const double* number = std::get_if<double>(&rows.at(row).at(column(name)));
    return number ? *number : std::numeric_limits<double>::quiet_NaN();
}

std::string Table::text(std::size_t row, std::string_view name) const {
    const std::size_t i = column(name);
    return shown(rows.at(row).at(i), columns[i]);
}

std::string shown(const Value& value, const Column& column) {
    if (const auto* text = std::get_if<std::string>(&value))
        return *text;
    const auto* number = std::get_if<double>(&value);
    if (!number)
        return "";
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.*g", column.digits, *number);
    return digits;
}

std::string to_csv(const Table& table) {
    std::string csv;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        csv += (i ? "," : "") + quoted(table.columns[i].name);
    csv += '\n';
    for (const std::vector<Value>& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            csv += i ? "," : "";
            if (const auto* number = std::get_if<double>(&row[i]))
                csv += exact(*number);
            else if (const auto* text = std::get_if<std::string>(&row[i]))
                csv += quoted(*text);
        }
        csv += '\n';
    }
    return csv;
}

Table from_csv(std::string_view text) {
    Table table;
    std::size_t at = 0, line = 1;
    for (std::string& name : record(text, at, line))
        table.columns.push_back({name, name});
    while (at < text.size()) {
        const std::size_t here = line;
        std::vector<std::string> cells = record(text, at, line);
        if (cells.size() != table.columns.size())
            throw std::invalid_argument("line " + std::to_string(here) + ": " + std::to_string(cells.size()) +
                                        " cells, where the first line has " + std::to_string(table.columns.size()));
        table.rows.emplace_back();
        for (std::string& cell : cells)
            table.rows.back().push_back(value_of(std::move(cell)));
    }
    return table;
}

std::vector<std::string> csv_cells(std::string_view text) {
    std::size_t at = 0, line = 1;
    return record(text, at, line);
}

std::string to_text(const Table& table) {
    std::string text;
    std::vector<std::size_t> width;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        width.push_back(table.columns[i].title.size());
        for (const auto& row : table.rows)
            width[i] = std::max(width[i], shown(row[i], table.columns[i]).size());
    }
    const auto add = [&](std::size_t i, const std::string& cell, bool to_the_right) {
        const std::string space(width[i] - std::min(width[i], cell.size()), ' ');
        text += (i ? "  " : "") + (to_the_right ? space + cell : cell + space);
    };
    const auto end_line = [&] {
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    };
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        add(i, table.columns[i].title,
            std::none_of(table.rows.begin(), table.rows.end(), [i](const auto& row) { return is_text(row[i]); }));
    end_line();
    for (const auto& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            add(i, shown(row[i], table.columns[i]), !is_text(row[i]));
        end_line();
    }
    return text;
}

std::string to_markdown(const Table& table) {
    std::string text = "|", rule = "|";
    for (const Column& column : table.columns) {
        text += " " + column.title + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const auto& row : table.rows) {
        text += "|";
        for (std::size_t i = 0; i < row.size(); ++i) {
            text += " ";
            for (const char c : shown(row[i], table.columns[i])) {
                if (c == '|')
                    text += '\\';
                text += c == '\n' ? ' ' : c;
            }
            text += " |";
        }
        text += "\n";
    }
    return text;
}

} // namespace clothlab::experiments

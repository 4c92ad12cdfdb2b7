#include "experiments/sweep/file.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>
#include <utility>

#include "scene/error.h"

namespace clothlab::experiments {
namespace {

constexpr const char* replace_it = "; name another file, or replace this one with --fresh";

Value number_of(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        throw std::invalid_argument("'" + text + "' is not a number");
    return number;
}

bool holds_text(const Sweep& sweep, const std::string& column) {
    if (column == "status" || column == "hash" || column == "cause" || column == "sweep")
        return true;
    const auto& axes = sweep.config().axes;
    return std::any_of(axes.begin(), axes.end(),
                       [&](const SweepAxis& axis) { return axis.key == column && !axis.numeric; });
}

constexpr const char* damaged = "the line is damaged";

/// None where it cannot be read.
std::vector<std::string> cells_of(std::string_view line) {
    try {
        return csv_cells(line);
    } catch (const std::invalid_argument&) {
        return {};
    }
}

/// Calls visit(number, line) for every whole line; returns how many bytes they are.
template <class Visit>
std::size_t for_each_line(std::string_view text, const Visit& visit) {
    std::size_t begin = 0, number = 1;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', begin)) {
        visit(number++, text.substr(begin, end - begin));
        begin = end + 1;
    }
    return begin;
}

std::size_t column_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// "3, 5 to 9"
std::string listed(const std::vector<std::size_t>& numbers) {
    std::string text;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1)
            ++last;
        text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
        if (last > i)
            text += (last == i + 1 ? ", " : " to ") + std::to_string(numbers[last]);
        i = last + 1;
    }
    return text;
}

/// Collects the lines of shards.
class Merger {
public:
    void add(const SweepShard& shard) {
        const std::size_t whole = for_each_line(shard.text, [&](std::size_t number, std::string_view line) {
            if (number == 1)
                add_header(shard.file, line);
            else
                add_line(shard.file, number, line);
        });
        if (whole == 0)
            fail(shard.file + ": is not the table of a sweep");
        if (whole < shard.text.size())
            fail(shard.file + ": the last line is not complete: that shard was stopped; let it go on to its end");
    }

    std::string text() const {
        if (lines_.empty())
            fail("there is no finished cell in these files");
        std::vector<std::size_t> missing;
        for (std::size_t cell = 0; cell < cells_; ++cell)
            if (!lines_.contains(cell))
                missing.push_back(cell);
        if (!missing.empty())
            fail(std::to_string(missing.size()) + " of the sweep's " + std::to_string(cells_) +
                 " cells are in none of the files: " + listed(missing));
        std::string text = header_ + "\n";
        for (const auto& [cell, line] : lines_)
            text.append(line.text).append("\n");
        return text;
    }

private:
    struct Line {
        std::string_view text;
        std::string file;
    };

    [[noreturn]] static void fail(const std::string& what) { throw scene::SceneError(what); }

    void add_header(const std::string& file, std::string_view line) {
        if (header_.empty()) {
            header_ = line;
            header_file_ = file;
            names_ = cells_of(line);
            if (column_of(names_, "cell") == names_.size() || column_of(names_, "sweep") == names_.size())
                fail(file + ": is not the table of a sweep");
        } else if (line != header_) {
            fail(file + ": has other columns than " + header_file_ + "; it is of another sweep");
        }
    }

    void add_line(const std::string& file, std::size_t number, std::string_view line) {
        const std::string place = file + ":" + std::to_string(number) + ": ";
        const std::vector<std::string> cells = cells_of(line);
        std::size_t cell = 0, total = 0;
        if (cells.size() != names_.size() || !read(cells[column_of(names_, "cell")], cell))
            fail(place + damaged);
        const std::string& identity = cells[column_of(names_, "sweep")];
        if (!read(identity.substr(0, identity.find('-')), total) || cell >= total)
            fail(place + damaged);
        if (identity_.empty()) {
            identity_ = identity;
            identity_file_ = file;
            cells_ = total;
        } else if (identity != identity_) {
            fail(place + "a cell of another sweep than those of " + identity_file_ +
                 ": the scene, --set, --vary, --frames or --seconds differ");
        }
        if (const auto [there, added] = lines_.try_emplace(cell, Line{line, file}); !added)
            fail("cell " + std::to_string(cell) + " is there twice: in " + there->second.file + " and in " + file);
    }

    static bool read(const std::string& text, std::size_t& number) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        return error == std::errc() && end == text.data() + text.size();
    }

    std::string header_, header_file_, identity_, identity_file_;
    std::vector<std::string> names_;
    std::size_t cells_ = 0;
    std::map<std::size_t, Line> lines_;
};

} // namespace

std::string sweep_header(const Sweep& sweep) {
    return to_csv({sweep.columns(), {}});
}

std::string sweep_line(const std::vector<Value>& row) {
    return to_csv({{}, {row}}).substr(1); // without the line of no names
}

std::vector<Value> sweep_row(const Sweep& sweep, std::string_view line) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != sweep.columns().size())
        throw std::invalid_argument(damaged);
    std::vector<Value> row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string& name = sweep.columns()[i].name;
        if (name == "sweep" && cells[i] != sweep.identity())
            throw std::invalid_argument(
                "a cell of another sweep: its scene, --set, --vary, --frames or --seconds differ");
        row.push_back(cells[i].empty() ? Value{} : holds_text(sweep, name) ? Value(cells[i]) : number_of(cells[i]));
    }
    const double* cell = std::get_if<double>(&row.front());
    if (!cell || !(*cell >= 0 && *cell < static_cast<double>(sweep.cells())) ||
        sweep_line(row) != std::string(line) + "\n")
        throw std::invalid_argument(damaged);
    return row;
}

SweepFile read_sweep_file(const Sweep& sweep, std::string_view text, const std::string& file) {
    SweepFile result;
    const std::string header = sweep_header(sweep);
    if (header.starts_with(text)) // empty, or stopped while it was begun
        return result;
    if (!text.starts_with(header))
        throw scene::SceneError(file + ": is there and is no table of this sweep" + replace_it);
    result.whole_bytes = for_each_line(text, [&](std::size_t number, std::string_view line) {
        if (number == 1)
            return;
        const auto fail = [&](const std::string& what) {
            throw scene::SceneError(file + ":" + std::to_string(number) + ": " + what + replace_it);
        };
        try {
            std::vector<Value> row = sweep_row(sweep, line);
            const auto cell = static_cast<std::size_t>(std::get<double>(row.front()));
            if (!result.rows.emplace(cell, std::move(row)).second)
                fail("cell " + std::to_string(cell) + " is there twice");
        } catch (const std::invalid_argument& e) {
            fail(e.what());
        }
    });
    return result;
}

std::string merge_shards(const std::vector<SweepShard>& shards) {
    Merger merger;
    for (const SweepShard& shard : shards)
        merger.add(shard);
    return merger.text();
}

} // namespace clothlab::experiments

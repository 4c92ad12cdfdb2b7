#include "experiments/sweep/sweep.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "experiments/sweep/chart.h"
#include "experiments/trial.h"
#include "scene/fields.h"
#include "scene/io.h"
#include "scene/number_text.h"

namespace clothlab::experiments {
namespace {

/// Of what identity() is a hash; another one where rows mean something else than before.
constexpr const char* format = "clothlab sweep 1";
constexpr std::size_t most_cells = 100'000;

Column column_of(const SweepAxis& axis) {
    Column column{axis.key, axis.key, 6};
    if (const scene::Field* field = scene::find_field(axis.key)) {
        column.title = field->label;
        if (!field->unit.empty())
            column.title += " (" + std::string(field->unit) + ")";
    }
    return column;
}

/// FNV-1a, 64 bits.
class Hash {
public:
    /// A text and that it ends here.
    void add(std::string_view text) {
        for (const char c : text)
            add_byte(static_cast<unsigned char>(c));
        add_byte(0);
    }
    std::string hex() const { return scene::hash_text(value_); }

private:
    void add_byte(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::string identity_of(const SweepConfig& config, std::size_t cells, const std::vector<Column>& columns) {
    Hash hash;
    hash.add(format);
    hash.add(scene::write_scene(config.scene));
    for (const SweepAxis& axis : config.axes) {
        hash.add(axis.key);
        for (const std::string& value : axis.values)
            hash.add(value);
        hash.add("");
    }
    hash.add(config.length.seconds ? number_text(*config.length.seconds) + " s"
                                   : std::to_string(config.length.frames) + " frames");
    for (const Column& column : columns)
        hash.add(column.name);
    return std::to_string(cells) + "-" + hash.hex();
}

/// What set_parameter says of --set was said of a value of --vary.
[[noreturn]] void fail_of_axis(const std::string& what) {
    constexpr std::string_view set = "--set ";
    throw scene::SceneError(what.starts_with(set) ? "--vary " + what.substr(set.size()) : what);
}

} // namespace

Sweep::Sweep(SweepConfig config) : config_(std::move(config)) {
    if (config_.axes.empty())
        throw scene::SceneError("--vary: name a parameter to vary, such as --vary cloth.ks=100:100000:7log");
    std::set<std::string> keys;
    columns_ = {{"cell", "Cell", 9}};
    for (const SweepAxis& axis : config_.axes) {
        if (!keys.insert(axis.key).second)
            throw scene::SceneError("--vary: " + axis.key + " is varied twice");
        if (axis.values.size() > most_cells / cells_)
            throw scene::SceneError("--vary: a sweep has at most " + std::to_string(most_cells) + " cells");
        cells_ *= axis.values.size();
        columns_.push_back(column_of(axis));
        for (const std::string& value : axis.values) {
            scene::Scene changed = config_.scene;
            try {
                scene::set_parameter(changed, axis.key, value);
            } catch (const scene::SceneError& e) {
                fail_of_axis(e.what());
            }
        }
    }
    const std::vector<Column> results = cell_columns(config_.times);
    columns_.insert(columns_.end(), results.begin(), results.end());
    columns_.insert(columns_.end() - 1, {"sweep", "Sweep"});
    check_plot();
    identity_ = identity_of(config_, cells_, columns_);
    for (std::size_t cell = 0; cell < cells_; ++cell) {
        const sim::Description description = scene(cell).simulation;
        const double steps =
            static_cast<double>(frames_of(config_.length, description)) * description.stepping.substeps;
        work_.push_back((steps + 1) * description.cloth.num_width_points * description.cloth.num_height_points);
    }
}

void Sweep::check_plot() const {
    std::string names;
    const std::vector<Column> results = cell_columns(config_.times);
    for (const Column& column : results) {
        if (column.name == "status" || column.name == "hash" || column.name == "cause")
            continue;
        if (column.name == config_.plot)
            return;
        names += (names.empty() ? "" : ", ") + column.name;
    }
    throw scene::SceneError("--plot " + config_.plot + ": there is no such number; there are " + names);
}

std::size_t Sweep::value(std::size_t cell, std::size_t axis) const {
    for (std::size_t i = config_.axes.size() - 1; i > axis; --i)
        cell /= config_.axes[i].values.size();
    return cell % config_.axes[axis].values.size();
}

Settings Sweep::settings(std::size_t cell) const {
    Settings settings;
    for (std::size_t i = 0; i < config_.axes.size(); ++i)
        settings.push_back(config_.axes[i].key + "=" + config_.axes[i].values[value(cell, i)]);
    return settings;
}

scene::Scene Sweep::scene(std::size_t cell) const {
    try {
        return with(config_.scene, settings(cell));
    } catch (const scene::SceneError& e) {
        throw scene::SceneError("--vary: " + cell_name(*this, cell) + " makes no scene: " + e.what());
    }
}

std::uint64_t Sweep::frames(std::size_t cell) const {
    return frames_of(config_.length, scene(cell).simulation);
}

std::vector<Value> Sweep::run(std::size_t cell, const std::function<bool(double share)>& go_on) const {
    const sim::Description description = scene(cell).simulation;
    std::vector<Value> row{static_cast<double>(cell)};
    for (std::size_t i = 0; i < config_.axes.size(); ++i) {
        const SweepAxis& axis = config_.axes[i];
        const std::size_t at = value(cell, i);
        row.push_back(axis.numeric ? Value(axis.number(at)) : Value(axis.values[at]));
    }
    const std::vector<Value> results =
        run_cell(description, frames_of(config_.length, description), config_.times, go_on);
    row.insert(row.end(), results.begin(), results.end());
    row.insert(row.end() - 1, identity_);
    return row;
}

Findings Sweep::findings(const SweepRows& rows) const {
    Findings findings;
    findings.title = "Sweep of " + config_.name;
    const sim::Description& own = config_.scene.simulation;
    findings.seconds = static_cast<double>(frames_of(config_.length, own)) / own.stepping.frames_per_second;
    findings.table.columns = columns_;
    std::vector<std::size_t> cells;
    for (const auto& [cell, row] : rows) {
        findings.table.rows.push_back(row);
        findings.settings.push_back(settings(cell));
        cells.push_back(cell);
    }
    findings.charts.push_back(sweep_chart(config_.axes, config_.plot, findings.table));
    findings.sentences = sweep_sentences(config_, cells_, findings.table);
    findings.notes = sweep_notes(config_, findings.table);
    return findings;
}

std::string cell_name(const Sweep& sweep, std::size_t cell) {
    std::string name = "cell " + std::to_string(cell) + " (";
    for (const std::string& setting : sweep.settings(cell))
        name += (name.back() == '(' ? "" : ", ") + setting;
    return name + ")";
}

Findings run_sweep(const SweepConfig& config, const Progress& progress) {
    const Sweep sweep(config);
    const std::size_t cells = sweep.cells();
    std::vector<std::atomic<double>> shares(cells);
    double total = 0;
    for (std::size_t cell = 0; cell < cells; ++cell)
        total += sweep.work(cell);

    std::mutex mutex;
    std::condition_variable changed;
    SweepRows rows;
    std::map<std::size_t, std::string> failed;
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> stop = false;
    const auto work = [&] {
        for (std::size_t cell = next++; cell < cells && !stop; cell = next++) {
            std::vector<Value> row;
            std::string why;
            try {
                row = sweep.run(cell, [&](double share) {
                    shares[cell] = share;
                    return !stop;
                });
            } catch (const Cancelled&) {
                return;
            } catch (const std::exception& e) {
                why = e.what();
            }
            shares[cell] = 1;
            const std::lock_guard lock(mutex);
            if (why.empty())
                rows[cell] = std::move(row);
            else
                failed[cell] = why;
            changed.notify_one();
        }
    };

    {
        struct Stop {
            std::atomic<bool>& flag;
            ~Stop() { flag = true; }
        };
        std::vector<std::jthread> threads; // which end before what they use
        const Stop end{stop};
        const std::size_t jobs =
            config.jobs > 0 ? static_cast<std::size_t>(config.jobs) : std::max(1u, std::thread::hardware_concurrency());
        for (std::size_t i = 0; i < std::min(jobs, cells); ++i)
            threads.emplace_back(work);
        for (std::unique_lock lock(mutex); rows.size() + failed.size() < cells;) {
            changed.wait_for(lock, std::chrono::milliseconds(100));
            const std::size_t done = rows.size() + failed.size();
            lock.unlock();
            double share = 0;
            for (std::size_t cell = 0; cell < cells; ++cell)
                share += shares[cell] * sweep.work(cell);
            progress.tell(share / total, std::to_string(done) + " of " + std::to_string(cells) + " cells");
            lock.lock();
        }
    }

    Findings findings = sweep.findings(rows);
    for (const auto& [cell, why] : failed)
        findings.notes.insert(findings.notes.begin(), cell_name(sweep, cell) + " could not be run: " + why);
    return findings;
}

} // namespace clothlab::experiments

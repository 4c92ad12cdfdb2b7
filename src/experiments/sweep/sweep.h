// A sweep: a scene run for every combination of values of some of its parameters, and a row of numbers for each.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/findings.h"
#include "experiments/sweep/axis.h"
#include "experiments/sweep/cell.h"
#include "scene/scene.h"

namespace clothlab::experiments {

struct SweepConfig {
    std::string name;   ///< the scene's, for people
    scene::Scene scene; ///< what is not varied
    std::vector<SweepAxis> axes;
    SweepLength length;
    bool times = false;              ///< also wall times, which no two runs have in common
    std::string plot = "max_strain"; ///< the column that is charted
    int jobs = 0;                    ///< cells at a time in run_sweep, a thread each; 0: as many as there are cores
};

/// What is left to do and what is done: rows of the sweep's table by cell.
using SweepRows = std::map<std::size_t, std::vector<Value>>;

/// A sweep that can be run. Cells are numbered from 0, and the last axis changes fastest.
class Sweep {
public:
    /// Makes every cell's scene once, to see that it can be. Throws scene::SceneError with the place of a cell that
    /// makes no scene, of a parameter that is varied twice and of a column that cannot be charted.
    explicit Sweep(SweepConfig config);

    const SweepConfig& config() const { return config_; }
    std::size_t cells() const { return cells_; }
    Settings settings(std::size_t cell) const;
    scene::Scene scene(std::size_t cell) const;
    std::uint64_t frames(std::size_t cell) const;
    /// Of every cell, about in proportion to what it takes: steps times points.
    double work(std::size_t cell) const { return work_[cell]; }

    /// What every row carries in its last column but one: how many cells the sweep has, and a hash of its scene, axes,
    /// length and columns, such as "40-9f86d081884c7d65". Sweeps with one identity make the same table.
    const std::string& identity() const { return identity_; }
    const std::vector<Column>& columns() const { return columns_; }

    /// Runs a cell: its row. Throws Cancelled when `go_on` says so (run_cell), and what the simulation throws.
    std::vector<Value> run(std::size_t cell, const std::function<bool(double share)>& go_on = {}) const;

    /// The table of these rows in the cells' order, with its chart and sentences.
    Findings findings(const SweepRows& rows) const;

private:
    std::size_t value(std::size_t cell, std::size_t axis) const;
    void check_plot() const;

    SweepConfig config_;
    std::size_t cells_ = 1;
    std::vector<double> work_;
    std::vector<Column> columns_;
    std::string identity_;
};

/// "cell 7 (cloth.ks=500, cloth.density=15)".
std::string cell_name(const Sweep& sweep, std::size_t cell);

/// Runs all cells in this process. A cell that cannot be run has no row but a note. Throws scene::SceneError,
/// Cancelled.
Findings run_sweep(const SweepConfig& config, const Progress& progress = {});

} // namespace clothlab::experiments

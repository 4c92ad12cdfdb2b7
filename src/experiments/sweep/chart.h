// What a sweep's table says, as a chart and in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/chart.h"
#include "experiments/sweep/sweep.h"

namespace clothlab::experiments {

/// A column against the first varied parameter, a series for every combination of the others' values. Runs that
/// diverged, and numbers that are not finite, have no point.
Chart sweep_chart(const std::vector<SweepAxis>& axes, const std::string& plot, const Table& table);

/// How the runs ended, and between what the charted column lies.
std::vector<std::string> sweep_sentences(const SweepConfig& config, std::size_t cells, const Table& table);

std::vector<std::string> sweep_notes(const SweepConfig& config, const Table& table);

} // namespace clothlab::experiments

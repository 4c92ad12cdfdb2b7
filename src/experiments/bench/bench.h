// What a step costs: the textbook's algorithm against every kernel, in one process and interleaved.
//
// All runs of a case start from the same state and take the same steps, round by round: A B C ... A B C ... What else
// the machine does meanwhile hits all of them alike, and of the rounds the median counts. The cases have their turns,
// too, in three passes. A step's time is the wall time of a run of steps divided by their number; the stage timers are
// on (some 50 ns per stage, a few percent of the very smallest cloths' steps). A run whose steps remember nothing may
// take fewer steps in a round than the others, if it is slow: always the first ones.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/bench/machine_peak.h"
#include "experiments/measured.h"
#include "sim/description.h"
#include "sim/state.h"

namespace clothlab::experiments {

struct BenchConfig {
    sim::Description pinned;  ///< a square cloth, held by pins: the scene "two-pins"
    sim::Description falling; ///< one that falls onto a plane and itself: "self-collision"
    std::vector<int> sizes;   ///< points along width and height
    std::vector<int> threads;
    /// Only runs with a match of this regular expression in their name, CASE/SIZE/PRECISION/KERNEL/THREADS, and those
    /// of the handout and the textbook of the same case and size. Where AVX2 is supported, `vec128` has to be named
    /// here to be timed.
    std::string filter;
    bool quick = false; ///< fewer rounds, and the machine's peaks measured once only
    /// Told what is timed next.
    std::function<void(const std::string&)> progress;
};

/// The textbook's algorithm with the fastest map for its cells (CellMap::fast), to which all is compared that does not
/// say otherwise, and with the handout's, for cases with self-collision: the same but for that.
inline constexpr const char* textbook_name = "textbook";
inline constexpr const char* handout_name = "handout";

struct BenchRow {
    std::string kernel; ///< an instruction set's name, textbook_name or handout_name
    sim::Precision precision = sim::Precision::double_precision;
    int threads = 1;
    int rounds = 0, steps = 0; ///< steps per round
    int alone = 0;             ///< rounds in which no thread shared its core: only these count
    bool disturbed = false;    ///< they are fewer than three (one, if quick): those least disturbed count

    Measured step; ///< seconds per step over the rounds that count, as all that follow: all stages and what is between
    Measured forces_and_verlet;
    std::array<Measured, sim::stage_count> stages;

    double self_contacts = 0, contacts = 0, shortened_springs = 0; ///< per point and step
    double bytes_per_point = 0;                                    ///< of memory that the run holds

    double speedup = 0;                        ///< of the step over the textbook's
    double forces_speedup = 0;                 ///< of forces and Verlet over the textbook's
    std::optional<double> forces_to_full_step; ///< the textbook's full step of `pinned` at this size over the same
    std::optional<double> handout_speedup;     ///< of the step over the handout's
    std::optional<double> forces_to_handout;   ///< the handout's full step of `pinned` over forces and Verlet
    double ns_per_point = 0;                   ///< of the step
    double springs_per_s = 0;                  ///< in forces and Verlet, each of the cloth's springs counted once
    std::optional<double> cycles_per_spring;   ///< of wall time in forces and Verlet; empty where the clock is unknown
    double fma_share = 0;                      ///< of the machine's peak, of the operations that the stage needs
    double bandwidth_share = 0;  ///< of the bandwidth of bandwidth_level, of the bytes that it has to move
    std::string bandwidth_level; ///< the level that those bytes fit in
    double steps_per_s() const { return 1 / step.median; }
};

/// All runs of one case at one size.
struct BenchGroup {
    std::string name;
    int n = 0;
    std::size_t points = 0, springs = 0;
    int frames = 0;              ///< taken before
    double steps_per_second = 0; ///< that real time needs
    double points_per_cell = 0;  ///< how many share a cell of the self-collision, on average over the points
    std::vector<BenchRow> rows;  ///< the textbook's first

    const BenchRow& textbook() const { return rows.front(); }
    const BenchRow* handout() const { return find(handout_name, sim::Precision::double_precision, 1); }
    const BenchRow* find(const std::string& kernel, sim::Precision precision, int threads) const;
};

/// A number that speed is judged by.
struct BenchFigure {
    std::string name;
    double value = 0;
    double fastest = 0; ///< the same of the fastest round instead of the median one: other work disturbs it least
    std::string unit;
    bool disturbed = false; ///< one of the runs that this is about was
    std::optional<double> at_least = {}, at_most = {}, aim = {};
};

struct BenchTable {
    MachinePeak machine;
    std::string best_kernel; ///< what "auto" stands for
    std::vector<BenchGroup> groups;
    std::vector<BenchFigure> summary;
};

/// A filter that is no regular expression or that matches no run.
class BenchFilterError : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// Throws BenchFilterError.
BenchTable run_bench(const BenchConfig& config);

/// Those of the figures that the measured rows allow.
std::vector<BenchFigure> summarise(const BenchTable& table);

} // namespace clothlab::experiments

// What this machine can do at best, measured: the yardsticks that `clothlab bench` holds its numbers against. Takes
// some tenths of a second.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace clothlab::experiments {

/// A level of the memory hierarchy, down to main memory.
struct MemoryLevel {
    std::string name;         ///< L1, L2, L3, memory
    std::size_t capacity = 0; ///< bytes, as the system tells; for memory, 0
    bool per_core = false;    ///< whether every core has one of its own
};

inline constexpr std::size_t memory_levels = 4;

/// What a number of threads reach together.
struct ThreadPeak {
    int threads = 1;
    double single_gflops = 0, double_gflops = 0; ///< GFLOP/s of fused multiply-adds, which count as two
    /// GB/s by level of the loop y[i] = s * y[i] + x[i]: two values read and one written, as in the sweep that computes
    /// forces and moves the points.
    std::array<double, memory_levels> bandwidth{};
};

struct MachinePeak {
    std::string processor; ///< as the system names it; empty where it does not
    std::string vectors;   ///< Highway's name of the vectors that the peaks were reached with
    int hardware_threads = 1;
    double clock_ghz = 0; ///< of the core under load, by a chain of additions of one cycle each; 0: not known
    std::array<MemoryLevel, memory_levels> levels;
    std::vector<ThreadPeak> by_threads;
    /// How much of the best peak all measurements of it reached: near 1, unless other work took cores away.
    double steadiness = 1;

    /// The entry for a number of threads that was measured.
    const ThreadPeak& with(int threads) const;
    /// The index of the innermost level that holds so many bytes, shared out among threads.
    std::size_t level_of(std::size_t bytes, int threads) const;
};

/// Measures the peaks for these numbers of threads.
MachinePeak measure_machine(std::span<const int> threads);

/// The better of two measurements of the same machine and numbers of threads.
MachinePeak best_of(const MachinePeak& one, const MachinePeak& other);

} // namespace clothlab::experiments

// The loops are compiled for the same instruction sets as the simulation's kernels, and the best is chosen at run time.
// They do no more than it takes to keep the arithmetic units, or the path to a level of memory, busy.

// Highway wants this before its first header: of x86's targets only the baseline, SSE4, AVX2 and AVX3, as in
// sim/kernels/kernels-inl.h.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (0x34FFLL | (0xFLL << 24))
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "experiments/bench/machine_peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace clothlab::experiments::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Fused multiply-adds in 12 independent chains: enough to hide a latency of six cycles on two units, and few enough
/// for 16 registers. `values` is the factor, the summand and a start for each chain: the compiler, which does not know
/// them, can neither leave out a chain nor compute one for another. Returns the number of floating-point operations.
template <class Real>
double multiply_add(std::size_t rounds, Real* values) {
    const hn::ScalableTag<Real> d;
    const auto s = hn::Set(d, values[0]), t = hn::Set(d, values[1]);
    auto a = hn::Set(d, values[2]), b = hn::Set(d, values[3]), c = hn::Set(d, values[4]), e = hn::Set(d, values[5]),
         f = hn::Set(d, values[6]), g = hn::Set(d, values[7]), h = hn::Set(d, values[8]), i = hn::Set(d, values[9]),
         j = hn::Set(d, values[10]), k = hn::Set(d, values[11]), l = hn::Set(d, values[12]), m = hn::Set(d, values[13]);
    for (std::size_t n = 0; n < rounds; ++n) {
        a = hn::MulAdd(a, s, t);
        b = hn::MulAdd(b, s, t);
        c = hn::MulAdd(c, s, t);
        e = hn::MulAdd(e, s, t);
        f = hn::MulAdd(f, s, t);
        g = hn::MulAdd(g, s, t);
        h = hn::MulAdd(h, s, t);
        i = hn::MulAdd(i, s, t);
        j = hn::MulAdd(j, s, t);
        k = hn::MulAdd(k, s, t);
        l = hn::MulAdd(l, s, t);
        m = hn::MulAdd(m, s, t);
    }
    const auto sum = hn::Add(hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(hn::Add(f, g), hn::Add(h, i))),
                             hn::Add(hn::Add(j, k), hn::Add(l, m)));
    values[2] = hn::GetLane(sum) / Real(12);
    return 2.0 * 12 * static_cast<double>(hn::Lanes(d)) * static_cast<double>(rounds);
}

double multiply_add_single(std::size_t rounds, float* values) {
    return multiply_add(rounds, values);
}
double multiply_add_double(std::size_t rounds, double* values) {
    return multiply_add(rounds, values);
}

/// y = s y + x; count is a multiple of 64, x and y are aligned to vectors.
void scale_and_add(float factor, const float* x, float* y, std::size_t count) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    const auto s = hn::Set(d, factor);
    for (std::size_t n = 0; n < count; n += 4 * lanes) {
        const auto a = hn::MulAdd(hn::Load(d, y + n), s, hn::Load(d, x + n));
        const auto b = hn::MulAdd(hn::Load(d, y + n + lanes), s, hn::Load(d, x + n + lanes));
        const auto c = hn::MulAdd(hn::Load(d, y + n + 2 * lanes), s, hn::Load(d, x + n + 2 * lanes));
        const auto e = hn::MulAdd(hn::Load(d, y + n + 3 * lanes), s, hn::Load(d, x + n + 3 * lanes));
        hn::Store(a, d, y + n);
        hn::Store(b, d, y + n + lanes);
        hn::Store(c, d, y + n + 2 * lanes);
        hn::Store(e, d, y + n + 3 * lanes);
    }
}

const char* vectors() {
    return hwy::TargetName(HWY_TARGET);
}

} // namespace clothlab::experiments::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include "experiments/bench/machine_peak.h"
#include "experiments/bench/rate.h"

namespace clothlab::experiments {
namespace {

HWY_EXPORT(multiply_add_single);
HWY_EXPORT(multiply_add_double);
HWY_EXPORT(scale_and_add);
HWY_EXPORT(vectors);

template <class Real>
double multiply_add_rate(int threads, double (*multiply_add)(std::size_t, Real*)) {
    return best_rate(threads, 6, [=] {
        std::array<Real, 14> values{Real(0.5), Real(1)}; // x / 2 + 1 stays near 2: no overflow, no denormal numbers
        for (std::size_t i = 2; i < values.size(); ++i)
            values[i] = Real(1) + static_cast<Real>(i) / Real(16);
        return [=]() mutable { return multiply_add(std::size_t{1} << 20, values.data()); };
    });
}

/// Bytes per second of scale_and_add on arrays of so many bytes together, of each thread its own.
double bandwidth(int threads, std::size_t bytes) {
    const std::size_t count = std::max<std::size_t>(bytes / (2 * sizeof(float)) / 64, 1) * 64;
    const std::size_t moved = 3 * count * sizeof(float);
    const std::size_t enough = std::size_t{256} << 20; // some milliseconds
    const std::size_t sweeps = std::max<std::size_t>(enough / moved, 1);
    return best_rate(threads, sweeps > 1 ? 5 : 3, [=] {
        const auto x = std::make_shared<hwy::AlignedFreeUniquePtr<float[]>>(hwy::AllocateAligned<float>(count));
        const auto y = std::make_shared<hwy::AlignedFreeUniquePtr<float[]>>(hwy::AllocateAligned<float>(count));
        std::fill_n(x->get(), count, 1.0f);
        std::fill_n(y->get(), count, 1.0f);
        return [=] {
            for (std::size_t n = 0; n < sweeps; ++n)
                HWY_DYNAMIC_DISPATCH(scale_and_add)(0.5f, x->get(), y->get(), count);
            return static_cast<double>(moved) * static_cast<double>(sweeps);
        };
    });
}

/// The size in bytes of a data cache, as Linux tells; glibc's sysconf adds up the last caches of a whole package.
std::size_t cache_size(int level, std::size_t otherwise) {
    for (int index = 0; index < 8; ++index) {
        const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/";
        int its_level = 0;
        std::size_t kibibytes = 0;
        std::string type, unit;
        std::ifstream(folder + "level") >> its_level;
        std::ifstream(folder + "type") >> type;
        std::ifstream(folder + "size") >> kibibytes >> unit;
        if (its_level == level && type != "Instruction" && kibibytes > 0 && unit == "K")
            return kibibytes * 1024;
    }
    return otherwise;
}

std::array<MemoryLevel, memory_levels> memory_hierarchy() {
    constexpr std::size_t kib = 1024;
    return {MemoryLevel{"L1", cache_size(1, 32 * kib), true}, MemoryLevel{"L2", cache_size(2, 512 * kib), true},
            MemoryLevel{"L3", cache_size(3, 8192 * kib), false}, MemoryLevel{"memory", 0, false}};
}

/// How much memory a thread should sweep to be served by a level: half of it, or four times the last cache.
std::size_t swept_bytes(const MachinePeak& machine, std::size_t level, int threads) {
    constexpr std::size_t most = std::size_t{512} << 20; // however large a server's cache is
    const MemoryLevel& l = machine.levels[level];
    const bool memory = level + 1 == memory_levels;
    const std::size_t bytes = memory ? std::min(4 * machine.levels[level - 1].capacity, most) : l.capacity / 2;
    return l.per_core ? bytes : bytes / static_cast<std::size_t>(threads);
}

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const std::size_t colon = line.find(": "); line.rfind("model name", 0) == 0 && colon != std::string::npos)
            return line.substr(colon + 2);
    return "";
}

} // namespace

const ThreadPeak& MachinePeak::with(int threads) const {
    for (const ThreadPeak& peak : by_threads)
        if (peak.threads == threads)
            return peak;
    throw std::out_of_range("no peak was measured for so many threads");
}

std::size_t MachinePeak::level_of(std::size_t bytes, int threads) const {
    for (std::size_t i = 0; i + 1 < memory_levels; ++i)
        if (bytes <= levels[i].capacity * (levels[i].per_core ? static_cast<std::size_t>(threads) : 1))
            return i;
    return memory_levels - 1;
}

MachinePeak measure_machine(std::span<const int> threads) {
    MachinePeak machine;
    machine.processor = processor_name();
    machine.vectors = HWY_DYNAMIC_DISPATCH(vectors)();
    machine.hardware_threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    machine.clock_ghz = clock_rate() * 1e-9;
    machine.levels = memory_hierarchy();
    for (const int count : threads) {
        ThreadPeak peak;
        peak.threads = count;
        peak.single_gflops = multiply_add_rate<float>(count, HWY_DYNAMIC_DISPATCH(multiply_add_single)) * 1e-9;
        peak.double_gflops = multiply_add_rate<double>(count, HWY_DYNAMIC_DISPATCH(multiply_add_double)) * 1e-9;
        for (std::size_t level = 0; level < memory_levels; ++level)
            peak.bandwidth[level] = bandwidth(count, swept_bytes(machine, level, count)) * 1e-9;
        machine.by_threads.push_back(peak);
    }
    return machine;
}

MachinePeak best_of(const MachinePeak& one, const MachinePeak& other) {
    MachinePeak best = one;
    best.clock_ghz = std::max(one.clock_ghz, other.clock_ghz);
    for (ThreadPeak& peak : best.by_threads) {
        const ThreadPeak& its = other.with(peak.threads);
        const auto [less, more] = std::minmax(peak.single_gflops, its.single_gflops);
        best.steadiness = std::min(best.steadiness, less / more);
        peak.single_gflops = more;
        peak.double_gflops = std::max(peak.double_gflops, its.double_gflops);
        for (std::size_t level = 0; level < memory_levels; ++level)
            peak.bandwidth[level] = std::max(peak.bandwidth[level], its.bandwidth[level]);
    }
    return best;
}

} // namespace clothlab::experiments

#endif // HWY_ONCE

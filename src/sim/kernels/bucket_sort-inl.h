// Counting sort of points by bucket. Neighbours along a row mostly share a cell: such runs are counted and placed as
// one.
#if defined(CLOTHLAB_SIM_KERNELS_BUCKET_SORT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_BUCKET_SORT_INL_H
#undef CLOTHLAB_SIM_KERNELS_BUCKET_SORT_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_BUCKET_SORT_INL_H
#endif

#include <algorithm>
#include <bit>
#include <utility>

#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// Writes where runs of equal keys of a span end and returns how many there are. No branch depends on a key.
HWY_INLINE std::size_t find_runs(const std::uint32_t* key, PointSpan span, std::uint32_t* run_end) {
    const hn::ScalableTag<std::uint32_t> d;
    constexpr std::size_t step = HWY_LANES(std::uint32_t);
    std::size_t runs = 0;
    for (std::size_t i = span.begin; i + 1 < span.end; i += step) {
        const auto ends = hn::And(hn::Ne(hn::LoadU(d, key + i), hn::LoadU(d, key + i + 1)),
                                  hn::FirstN(d, HWY_MIN(span.end - 1 - i, step)));
        const auto after = hn::Set(d, static_cast<std::uint32_t>(i + 1));
#if HWY_TARGET == HWY_AVX3
        hn::StoreU(hn::Compress(hn::Add(hn::Iota(d, 0), after), ends), d, run_end + runs);
        runs += static_cast<std::size_t>(std::popcount(static_cast<std::uint32_t>(ends.raw)));
#elif HWY_TARGET == HWY_AVX2
        const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(ends.raw)));
        const std::uint64_t bytes = _pdep_u64(bits, 0x0101010101010101u) * 0xff;
        const auto lanes = static_cast<long long>(_pext_u64(0x0706050403020100u, bytes));
        hn::StoreU(hn::Add(hn::Vec<decltype(d)>{_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(lanes))}, after), d,
                   run_end + runs);
        runs += static_cast<std::size_t>(std::popcount(bits));
#else
        (void)after;
        std::uint8_t bits[8] = {}; // the function may write as many
        hn::StoreMaskBits(d, ends, bits);
        for (std::size_t l = 0; l < step; ++l) {
            run_end[runs] = static_cast<std::uint32_t>(i + l + 1);
            runs += bits[0] >> l & 1u;
        }
#endif
    }
    run_end[runs] = span.end;
    return runs + 1;
}

/// Writes the points i, i + 1, ... before `end`.
HWY_INLINE void write_run(std::uint32_t i, std::uint32_t end, std::uint32_t* order) {
#if HWY_TARGET == HWY_AVX3
    const hn::FixedTag<std::uint32_t, 8> d; // few runs are longer
    const auto lane = hn::Iota(d, 0);
    do {
        hn::BlendedStore(hn::Add(lane, hn::Set(d, i)), hn::FirstN(d, end - i), d, order);
        order += 8;
        i += 8;
    } while (HWY_UNLIKELY(static_cast<std::int32_t>(end - i) > 0));
#else
    do
        *order++ = i;
    while (++i < end);
#endif
}

inline BucketList sort_by_bucket(const BucketSortArguments& arguments) {
    const BucketSortArguments a = arguments; // what is stored is none of them: they stay in registers
    const std::size_t buckets = std::size_t{a.mask} + 1;
    std::size_t runs = 0;
    for (const PointSpan span : a.points)
        runs += find_runs(a.key, span, a.run_end + runs);
    // Calls visit(first, end) for each run.
    const auto for_runs = [&](auto visit) {
        const std::uint32_t* run = a.run_end;
        for (const PointSpan span : a.points)
            for (std::uint32_t first = span.begin; first != span.end; first = *run++)
                visit(first, *run);
    };
    std::fill_n(a.next, buckets, 0u);
    for_runs([&](std::uint32_t first, std::uint32_t end) { a.next[a.key[first] & a.mask] += end - first; });
    BucketList list{0, 0, 0};
    std::uint32_t begin = 0, largest = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        const std::uint32_t size = std::exchange(a.next[b], begin);
        a.buckets[list.count] = {begin, begin + size};
        list.count += size > 1 ? 1 : 0;
        list.pairs += std::uint64_t{size} * size - size;
        begin += size;
        largest = HWY_MAX(largest, size);
    }
    list.largest = largest;
    for_runs([&](std::uint32_t first, std::uint32_t end) HWY_ATTR {
        std::uint32_t& next = a.next[a.key[first] & a.mask];
        write_run(first, end, a.order + std::exchange(next, next + end - first));
    });
    return list;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

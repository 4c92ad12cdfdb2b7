// The course's self-collision rule, cell by cell.
#if defined(CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H
#undef CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "sim/collision/push_sum.h"
#include "sim/kernels/dense_cells-inl.h"
#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// Vectors of places: of 16 at most, as most buckets have no more points, and one of 32 takes as long as two of 16.
using PlaceTag = hn::CappedTag<std::int16_t, 16>;
using PlaceLane = hn::Vec<PlaceTag>;
constexpr std::size_t place_lanes = HWY_MIN(HWY_LANES(std::int16_t), 16);

/// One bit per lane of a mask.
HWY_INLINE std::uint64_t place_bits(hn::Mask<PlaceTag> mask) {
#if HWY_TARGET == HWY_AVX3
    return mask.raw;
#elif HWY_TARGET == HWY_AVX2
    return _pext_u32(static_cast<std::uint32_t>(_mm256_movemask_epi8(mask.raw)), 0xaaaaaaaau);
#else
    std::uint64_t bits = 0;
    std::uint8_t bytes[8] = {}; // the function may write as many
    hn::StoreMaskBits(PlaceTag(), mask, bytes);
    std::memcpy(&bits, bytes, sizeof bits);
    return bits & ((std::uint64_t{1} << place_lanes) - 1);
#endif
}

/// Points that are gone through together, whole buckets of them. Index: the place in the batch.
template <class Real>
struct Batch {
    static constexpr std::size_t most_points = 512, most_words = 4096;
    /// Of each point those of its bucket that are near it, itself, too: bits, counted from the bucket's first point.
    std::array<std::uint64_t, most_words> near;
    /// Of CellPlace, a vector of padding behind each.
    alignas(64) std::array<std::array<std::int16_t, most_points + place_lanes>, 4> place;
    /// A point that is near others, and its bucket's first point.
    struct Active {
        std::uint16_t point, bucket;
    };
    std::array<Active, most_points + 1> active; ///< ascending
    /// x, y, z, 0 of the active ones, where they are by now.
    alignas(32) std::array<Real, 4 * most_points> x;
};

/// Fills in the places of `count` points, the next in order.
template <class Real>
HWY_INLINE void load_batch(const CellPlace* places, const std::uint32_t* order, std::size_t count, Batch<Real>& batch) {
    const PlaceTag d;
    HWY_ALIGN std::array<CellPlace, Batch<Real>::most_points + place_lanes> next;
    for (std::size_t k = 0; k < count; ++k)
        next[k] = places[order[k]];
    for (std::size_t k = 0; k < count; k += place_lanes) {
        PlaceLane v[4];
        hn::LoadInterleaved4(d, reinterpret_cast<const std::int16_t*>(&next[k]), v[0], v[1], v[2], v[3]);
        for (std::size_t i = 0; i < 4; ++i)
            hn::Store(v[i], d, &batch.place[i][k]);
    }
}

/// A vector of places of points.
struct PlaceVector {
    PlaceLane x, y, z, cell;
    HWY_INLINE PlaceVector(const PlaceLane& x_, const PlaceLane& y_, const PlaceLane& z_, const PlaceLane& cell_)
        : x(x_), y(y_), z(z_), cell(cell_) {}
    template <class Real>
    HWY_INLINE PlaceVector(const Batch<Real>& batch, std::size_t k)
        : PlaceVector(hn::LoadU(PlaceTag(), &batch.place[0][k]), hn::LoadU(PlaceTag(), &batch.place[1][k]),
                      hn::LoadU(PlaceTag(), &batch.place[2][k]), hn::LoadU(PlaceTag(), &batch.place[3][k])) {}
    /// All lanes are point k.
    template <class Real>
    static HWY_INLINE PlaceVector all(const Batch<Real>& batch, std::size_t k) {
        const PlaceTag d;
        return {hn::Set(d, batch.place[0][k]), hn::Set(d, batch.place[1][k]), hn::Set(d, batch.place[2][k]),
                hn::Set(d, batch.place[3][k])};
    }
};

/// Which of a vector of points are near another, a bit each.
HWY_INLINE std::uint64_t near_bits(const PlaceVector& a, const PlaceVector& b, PlaceLane most) {
    const auto square = [](PlaceLane p, PlaceLane q) HWY_ATTR {
        const auto v = hn::Sub(p, q);
        return hn::MulHigh(v, v);
    };
    const auto sum = hn::SaturatedAdd(hn::SaturatedAdd(square(a.x, b.x), square(a.y, b.y)), square(a.z, b.z));
    return place_bits(hn::AndNot(hn::Gt(sum, most), hn::Eq(a.cell, b.cell)));
}

/// Finds which points of a bucket are near each other before any is moved, the bucket being `size` points from `from`
/// on. Adds to the active ones and returns how many there are. The bucket fits into so many vectors; 0: it may not.
/// Without a branch for each point, of which few are near others.
template <std::size_t vectors, class Real>
HWY_INLINE std::size_t find_near(std::int16_t most_units, std::size_t from, std::size_t size, int word_bits,
                                 std::size_t active, Batch<Real>& batch) {
    const auto most = hn::Set(PlaceTag(), most_units);
    const PlaceVector low(batch, from), high(batch, from + (vectors == 2 ? place_lanes : 0));
    for (std::size_t k = from; k < from + size; ++k) {
        const auto own = PlaceVector::all(batch, k);
        std::uint64_t* words = &batch.near[k << word_bits];
        std::uint64_t others = 0;
        if constexpr (vectors != 0) {
            words[0] = near_bits(low, own, most);
            if constexpr (vectors == 2)
                words[0] |= near_bits(high, own, most) << place_lanes;
            words[0] &= ~std::uint64_t{0} >> (64 - size);
            others = words[0] & (words[0] - 1);
        } else {
            const std::size_t self = k - from;
            for (std::size_t first = 0; first < size; first += 64) {
                std::uint64_t word = 0;
                const std::size_t left = HWY_MIN(size - first, std::size_t{64});
                for (std::size_t l = 0; l < left; l += place_lanes)
                    word |= near_bits(PlaceVector(batch, from + first + l), own, most) << l;
                words[first / 64] = word & (~std::uint64_t{0} >> (64 - left));
                others |= words[first / 64] & ~(first == self / 64 * 64 ? std::uint64_t{1} << (self % 64) : 0);
            }
        }
        batch.active[active] = {static_cast<std::uint16_t>(k), static_cast<std::uint16_t>(from)};
        active += others != 0 ? 1 : 0;
    }
    return active;
}

/// What pushes the points of a pass, as PushSum has it: points are x, y, z, 0. Counts the pushes. Three coordinates fit
/// into a vector of four, which is faster where the machine has vectors so long and simple.
template <class Real>
class Pusher {
public:
    Pusher(Real apart, Real substeps) : apart_(apart), substeps_(substeps) {}
    /// Moves a point. Calls partners(add), which calls add(y) for every partner.
    template <class Partners>
    HWY_INLINE void push(Real* x, Partners partners) {
        PushSum<Real> sum;
        partners([&](const Real* y) { sum.add(x[0] - y[0], x[1] - y[1], x[2] - y[2], apart_); });
        sum.move(x[0], x[1], x[2], substeps_);
        count_ += sum.count();
    }
    std::size_t count() const { return count_; }

private:
    Real apart_, substeps_;
    std::size_t count_ = 0;
};

template <>
class Pusher<float> {
    using D = hn::FixedTag<float, 4>;
    using I = hn::FixedTag<std::int32_t, 4>;

public:
    HWY_INLINE Pusher(float apart, float substeps)
        : apart_(hn::Set(D(), apart)), substeps_(hn::Set(D(), substeps)), count_(hn::Zero(I())) {}
    template <class Partners>
    HWY_INLINE void push(float* at, Partners partners) {
        const D d;
        const auto x = hn::Load(d, at), zero = hn::Zero(d);
        auto sum = zero;
        auto count = hn::Zero(I());
        partners([&](const float* y) HWY_ATTR {
            const auto v = hn::Sub(x, hn::Load(d, y)), squares = hn::Mul(v, v);
            const auto length = hn::Sqrt(
                hn::Add(hn::Add(hn::Broadcast<0>(squares), hn::Broadcast<1>(squares)), hn::Broadcast<2>(squares)));
            const auto touching = hn::And(hn::Lt(length, apart_), hn::Gt(length, zero));
            const auto push = hn::Div(hn::Sub(apart_, length), length);
            sum = hn::Add(sum, hn::IfThenElseZero(touching, hn::Mul(push, v)));
            count = hn::Sub(count, hn::BitCast(I(), hn::VecFromMask(d, touching))); // a mask is -1
        });
        count_ = hn::Add(count_, count);
        const auto share = hn::Mul(hn::ConvertTo(d, count), substeps_);
        const auto pushed = hn::Gt(share, zero);
        hn::Store(hn::IfThenElse(pushed, hn::Add(x, hn::Div(sum, share)), x), d, at);
    }
    HWY_INLINE std::size_t count() const { return static_cast<std::size_t>(hn::GetLane(count_)); }

private:
    hn::Vec<D> apart_, substeps_;
    hn::Vec<I> count_;
};

template <class Real>
HWY_INLINE void load_point(const CellPassArguments<Real>& a, std::size_t i, Real* x) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        x[axis] = a.x[axis][i];
    x[3] = 0;
}

template <class Real>
HWY_INLINE void store_point(const CellPassArguments<Real>& a, std::size_t i, const Real* x) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        a.x[axis][i] = x[axis];
}

/// Moves the batch's points that are near others, those of a bucket one after the other, unless they are pinned.
/// Returns how many really were near enough.
template <bool one_word, class Real>
HWY_INLINE std::size_t apply_pushes(const CellPassArguments<Real>& a, std::size_t begin, std::size_t active,
                                    int word_bits, Batch<Real>& batch) {
    // Whoever is near an active point is one.
    std::size_t free = 0;
    for (std::size_t n = 0; n < active; ++n) {
        const auto point = batch.active[n];
        const std::uint32_t i = a.order[begin + point.point];
        load_point(a, i, &batch.x[4 * std::size_t{point.point}]);
        batch.active[free] = point;
        free += a.pinned[i] ? 0 : 1;
    }
    Pusher<Real> pusher(a.apart, a.substeps);
    // Points of different buckets by turns, from the beginning and from the middle on: a point mostly waits for the one
    // before it in its bucket.
    std::size_t half = free / 2;
    while (half < free && half > 0 && batch.active[half].bucket == batch.active[half - 1].bucket)
        ++half;
    for (std::size_t low = 0, high = half; low + high < half + free;) {
        const bool from_high = low == half || (high < free && high - half < low);
        const std::size_t n = from_high ? high : low;
        low += from_high ? 0 : 1;
        high += from_high ? 1 : 0;
        const std::size_t k = batch.active[n].point, first = batch.active[n].bucket;
        const Real* bucket = &batch.x[4 * first];
        const std::uint64_t* words = &batch.near[k << (one_word ? 0 : word_bits)];
        pusher.push(&batch.x[4 * k], [&](auto add) HWY_ATTR {
            if (one_word) {
                for (std::uint64_t left = words[0] & ~(std::uint64_t{1} << (k - first)); left != 0; left &= left - 1)
                    add(bucket + 4 * static_cast<std::size_t>(std::countr_zero(left)));
            } else {
                for (std::size_t w = 0; w < std::size_t{1} << word_bits; ++w)
                    for (std::uint64_t left = words[w]; left != 0; left &= left - 1)
                        if (const std::size_t q = first + 64 * w + static_cast<std::size_t>(std::countr_zero(left));
                            q != k)
                            add(batch.x.data() + 4 * q);
            }
        });
    }
    for (std::size_t n = 0; n < free; ++n) {
        const std::size_t k = batch.active[n].point;
        store_point(a, a.order[begin + k], &batch.x[4 * k]);
    }
    return pusher.count();
}

/// The rule as it is written, for buckets with very many points and for cells that places do not tell apart.
template <class Real>
HWY_NOINLINE std::size_t crowded_pass(const CellPassArguments<Real>& a) {
    Pusher<Real> pusher(a.apart, a.substeps);
    for (const PointSpan* bucket = a.buckets_begin; bucket != a.buckets_end; ++bucket) {
        for (std::size_t k = bucket->begin; k < bucket->end; ++k) {
            const std::size_t i = a.order[k];
            if (a.pinned[i])
                continue;
            alignas(32) Real x[4], y[4];
            load_point(a, i, x);
            if (!std::isfinite(x[0] + x[1] + x[2]))
                continue; // as far from everything as can be; after a blow-up that is so of most
            pusher.push(x, [&](auto add) HWY_ATTR {
                for (std::size_t q = bucket->begin; q < bucket->end; ++q) {
                    const std::size_t j = a.order[q];
                    Real square = 0;
                    bool same_cell = !a.exact || a.places[i].cell == a.places[j].cell;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const Real v = a.x[axis][j] - x[axis];
                        square += v * v;
                        same_cell = same_cell && (a.exact || a.cell[axis][i] == a.cell[axis][j]);
                    }
                    if (square < a.reach_squared && q != k && same_cell) {
                        load_point(a, j, y);
                        add(y);
                    }
                }
            });
            store_point(a, i, x);
        }
    }
    return pusher.count();
}

/// Buckets of which none is too large for a batch, batch by batch.
template <class Real>
HWY_INLINE std::size_t batch_pass(const CellPassArguments<Real>& a, const PointSpan* begin,
                                  const PointSpan* buckets_end, Batch<Real>& batch) {
    std::size_t total = 0;
    while (begin != buckets_end) {
        const std::size_t first = begin->begin;
        const PointSpan* end = begin;
        std::size_t largest = 0, last = first;
        for (; end != buckets_end && end->end - first <= Batch<Real>::most_points; ++end) {
            largest = HWY_MAX(largest, std::size_t{end->end} - end->begin);
            last = end->end;
        }
        load_batch(a.places, a.order + first, last - first, batch);
        // Words of bits for each point: a power of two.
        const int word_bits = largest <= 64 ? 0 : static_cast<int>(std::bit_width((largest - 1) / 64));
        if (word_bits != 0)
            std::fill_n(batch.near.begin(), (last - first) << word_bits, std::uint64_t{0});
        std::size_t active = 0;
        for (const PointSpan* bucket = begin; bucket != end; ++bucket) {
            const std::size_t from = bucket->begin - first, size = std::size_t{bucket->end} - bucket->begin;
            if (size <= place_lanes)
                active = find_near<1>(a.near, from, size, word_bits, active, batch);
            else if (size <= 2 * place_lanes)
                active = find_near<2>(a.near, from, size, word_bits, active, batch);
            else
                active = find_near<0>(a.near, from, size, word_bits, active, batch);
        }
        total += word_bits == 0 ? apply_pushes<true>(a, first, active, 0, batch)
                                : apply_pushes<false>(a, first, active, word_bits, batch);
        begin = end;
    }
    return total;
}

/// A bucket may hold several cells; only points of the same cell push each other, and so each pair counts once.
template <class Real>
std::size_t cell_pass(const CellPassArguments<Real>& a) {
    if (HWY_UNLIKELY(!a.exact || a.largest_bucket > Batch<Real>::most_points))
        return crowded_pass(a); // its bits do not fit into a batch
    Batch<Real> batch;
    if (a.dense)
        return dense_pass(a, [&](const PointSpan& bucket) { return batch_pass(a, &bucket, &bucket + 1, batch); });
    return batch_pass(a, a.buckets_begin, a.buckets_end, batch);
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

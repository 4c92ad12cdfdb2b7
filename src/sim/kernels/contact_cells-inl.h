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
#include <limits>

#include "sim/collision/push_sum.h"
#include "sim/kernels/near_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// Whole numbers as integers; what is out of range goes to some integer.
template <class Real>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, Tag<Real>>> whole(Lane<Real> cell) {
    const hn::Rebind<std::int32_t, Tag<Real>> di;
    if constexpr (sizeof(Real) == 4)
        return hn::ConvertTo(di, cell);
    else
        return hn::DemoteTo(di, cell);
}

/// Finds the cells of all points and their bounds. NaN is in no cell and bounds nothing.
template <class Real>
HWY_INLINE CellKeys<Real> find_cells(const CellArguments<Real>& a, const Axes<Real>& cell) {
    const Tag<Real> d;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Lane<Real> low[3], high[3], largest = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = hn::Set(d, infinity);
        high[axis] = hn::Set(d, -infinity);
    }
    for (std::size_t k = 0; k < a.count; k += HWY_LANES(Real)) {
        const auto inside = lanes_before<Real>(static_cast<std::ptrdiff_t>(a.count - k));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto x = hn::LoadU(d, a.x[axis] + k), c = cell_of<Real>(x, a.cell[axis]);
            hn::StoreU(c, d, cell[axis] + k);
            const auto counts = hn::And(inside, hn::Eq(x, x));
            low[axis] = hn::Min(low[axis], hn::IfThenElse(counts, c, low[axis]));
            high[axis] = hn::Max(high[axis], hn::IfThenElse(counts, c, high[axis]));
            largest = hn::Max(largest, hn::IfThenElseZero(counts, hn::Abs(x)));
        }
    }
    CellKeys<Real> keys{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        keys.low[axis] = hn::GetLane(hn::MinOfLanes(d, low[axis]));
        keys.high[axis] = hn::GetLane(hn::MaxOfLanes(d, high[axis]));
    }
    keys.largest = hn::GetLane(hn::MaxOfLanes(d, largest));
    return keys;
}

template <class Real>
CellKeys<Real> cell_keys(const CellArguments<Real>& a, const Axes<Real>& cell, std::uint32_t* key, float* fours) {
    const Tag<Real> d;
    const hn::Rebind<std::int32_t, Tag<Real>> di;
    CellKeys<Real> keys = find_cells(a, cell);
    // In a box that is not too large a cell's key is its place there, and otherwise some sum. Few enough along each
    // axis that a float tells them apart, few enough in all for an integer.
    std::array<double, 3> along;
    for (std::size_t axis = 0; axis < 3; ++axis)
        along[axis] = static_cast<double>(keys.high[axis]) - static_cast<double>(keys.low[axis]) + 1;
    keys.exact = along[0] < 8e6 && along[1] < 8e6 && along[2] < 8e6 && along[0] * along[1] * along[2] < 2e9;
    std::array<std::int32_t, 3> factor{73856093, 19349663, 83492791};
    if (keys.exact)
        factor = {1, static_cast<std::int32_t>(along[0]), static_cast<std::int32_t>(along[0] * along[1])};
    std::array<Real, 3> origin;
    for (std::size_t axis = 0; axis < 3; ++axis)
        origin[axis] = keys.exact ? keys.low[axis] * a.cell[axis] : Real(0);

    for (std::size_t k = 0; k < a.count; k += HWY_LANES(Real)) {
        auto sum = hn::Zero(di);
        const hn::Rebind<float, Tag<Real>> df;
        hn::Vec<decltype(df)> x[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto from = hn::Set(d, keys.exact ? keys.low[axis] : Real(0));
            const auto place = whole<Real>(hn::Sub(hn::LoadU(d, cell[axis] + k), from));
            sum = hn::Add(sum, hn::Mul(place, hn::Set(di, factor[axis])));
            const auto v = hn::Sub(hn::LoadU(d, a.x[axis] + k), hn::Set(d, origin[axis]));
            if constexpr (sizeof(Real) == sizeof(float))
                x[axis] = v;
            else
                x[axis] = hn::DemoteTo(df, v);
        }
        hn::StoreU(sum, di, reinterpret_cast<std::int32_t*>(key + k));
        hn::StoreInterleaved4(x[0], x[1], x[2], hn::BitCast(df, sum), df, fours + 4 * k);
    }
    return keys;
}

/// Points that are gone through together, whole buckets of them. Index: the place in the batch.
template <class Real>
struct Batch {
    static constexpr std::size_t most_points = 512, most_words = 4096;
    /// Of each point the others of its bucket that are near it: bits, counted from the bucket's first point.
    std::array<std::uint64_t, most_words> near;
    /// Where the points were, a vector of padding behind each axis, and the keys of their cells.
    alignas(64) std::array<std::array<float, most_points + HWY_LANES(float)>, 3> x;
    alignas(64) std::array<std::uint32_t, most_points + HWY_LANES(float)> key;
    std::array<std::uint32_t, most_points> bucket_begin; ///< of each point's bucket
    std::array<std::uint32_t, most_points> later;        ///< points behind it in its bucket
    std::array<std::uint32_t, most_points> left;         ///< points that are not done yet
    std::array<std::uint64_t, most_points> found;  ///< a point that is near others and, above, which of the next vector
    std::array<std::uint32_t, most_points> active; ///< points with a bit, ascending
    /// x, y, z, 0 of the active ones, where they are by now.
    alignas(32) std::array<Real, 4 * most_points> place;
};

template <class Real>
HWY_INLINE std::uint32_t key_of(const CellPassArguments<Real>& a, std::size_t k) {
    std::uint32_t key;
    std::memcpy(&key, a.sorted + 4 * k + 3, sizeof key);
    return key;
}

/// Whether two sorted points with these keys lie in the same cell.
template <class Real>
HWY_INLINE bool same_cell(const CellPassArguments<Real>& a, std::size_t k, std::size_t q, std::uint32_t key_of_k,
                          std::uint32_t key_of_q) {
    if (HWY_LIKELY(a.exact))
        return key_of_k == key_of_q;
    const std::size_t i = a.order[k], j = a.order[q];
    return a.cell[0][i] == a.cell[0][j] && a.cell[1][i] == a.cell[1][j] && a.cell[2][i] == a.cell[2][j];
}

/// Which of the vector of the batch's points from k + first on are near point k, that has `later` more in its bucket.
template <class Real>
HWY_INLINE std::uint64_t near_bits(const CellPassArguments<Real>& a, const Batch<Real>& batch, std::size_t k,
                                   std::size_t first, std::uint64_t later) {
    const hn::ScalableTag<float> d;
    const auto minus = [&](std::size_t axis) HWY_ATTR {
        return hn::Sub(hn::LoadU(d, &batch.x[axis][k + first]), hn::Set(d, batch.x[axis][k]));
    };
    const Lane3<float> v{minus(0), minus(1), minus(2)};
    const std::uint64_t others = HWY_MIN(later + 1 - first, std::uint64_t{32});
    return bits_of<float>(hn::Lt(dot3(v, v), hn::Set(d, a.reach_squared))) & ((std::uint64_t{1} << others) - 1);
}

/// Enters what was found of the vectors from `first` behind the points: for both points of each pair.
template <bool one_word, class Real>
HWY_INLINE void enter_found(const CellPassArguments<Real>& a, std::size_t begin, std::size_t found, std::size_t first,
                            int word_bits, Batch<Real>& batch) {
    for (std::size_t n = 0; n < found; ++n) {
        const std::size_t k = batch.found[n] & 0xffffffffu, bucket = batch.bucket_begin[k];
        std::uint64_t bits = batch.found[n] >> 32;
        do {
            const std::size_t q = k + first + static_cast<std::size_t>(std::countr_zero(bits));
            bits &= bits - 1;
            const std::uint64_t one = same_cell(a, begin + k, begin + q, batch.key[k], batch.key[q]) ? 1 : 0;
            const auto enter = [&](std::size_t of, std::size_t other) {
                const std::size_t word = one_word ? of : (of << word_bits) + (other - bucket) / 64;
                batch.near[word] |= one << ((other - bucket) % 64);
            };
            enter(k, q);
            enter(q, k);
        } while (bits != 0);
    }
}

/// Finds which points of each bucket are near each other before any is moved: sorted points from `begin` on. Returns
/// how many points have others near them. Without a branch for each point, of which few are near others.
template <bool one_word, class Real>
HWY_INLINE std::size_t find_near(const CellPassArguments<Real>& a, std::size_t begin, std::size_t count, int word_bits,
                                 Batch<Real>& batch) {
    constexpr std::size_t step = HWY_LANES(float);
    word_bits = one_word ? 0 : word_bits;
    std::fill_n(batch.near.begin(), count << word_bits, std::uint64_t{0});
    const hn::ScalableTag<float> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    for (std::size_t k = 0; k < count; k += step) {
        Lane<float> x, y, z, key;
        hn::LoadInterleaved4(d, a.sorted + 4 * (begin + k), x, y, z, key);
        hn::Store(x, d, &batch.x[0][k]);
        hn::Store(y, d, &batch.x[1][k]);
        hn::Store(z, d, &batch.x[2][k]);
        hn::Store(hn::BitCast(du, key), du, &batch.key[k]);
    }
    // Each point against the vector of points behind it, ...
    std::size_t found = 0, left = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t bucket = batch.key[k] & a.mask;
        const std::uint32_t later = a.bucket_begin[bucket + 1] - static_cast<std::uint32_t>(begin + k + 1);
        batch.bucket_begin[k] = a.bucket_begin[bucket] - static_cast<std::uint32_t>(begin);
        batch.later[k] = later;
        const std::uint64_t bits = near_bits(a, batch, k, 1, later);
        batch.found[found] = bits << 32 | k;
        found += bits != 0 ? 1 : 0;
        batch.left[left] = static_cast<std::uint32_t>(k);
        left += later > step ? 1 : 0;
    }
    enter_found<one_word>(a, begin, found, 1, word_bits, batch);
    // ... those that have more against the next vector, and so on.
    for (std::size_t first = 1 + step; left != 0; first += step) {
        std::size_t still_left = 0;
        found = 0;
        for (std::size_t n = 0; n < left; ++n) {
            const std::size_t k = batch.left[n];
            const std::uint64_t bits = near_bits(a, batch, k, first, batch.later[k]);
            batch.found[found] = bits << 32 | k;
            found += bits != 0 ? 1 : 0;
            batch.left[still_left] = static_cast<std::uint32_t>(k);
            still_left += batch.later[k] >= first + step ? 1 : 0;
        }
        left = still_left;
        enter_found<one_word>(a, begin, found, first, word_bits, batch);
    }
    std::size_t active = 0;
    for (std::size_t k = 0; k < count; ++k) {
        std::uint64_t any = 0;
        for (std::size_t w = 0; w < std::size_t{1} << word_bits; ++w)
            any |= batch.near[(k << word_bits) + w];
        batch.active[active] = static_cast<std::uint32_t>(k);
        active += any != 0 ? 1 : 0;
    }
    return active;
}

/// The pushes on one point, and where it goes, as PushSum has it: points are x, y, z, 0. Three coordinates fit into a
/// vector of four, which is faster where the machine has vectors so long and simple.
template <class Real>
class PointPush {
public:
    explicit PointPush(Real* x) : x_(x) {}
    HWY_INLINE void add(const Real* y, Real apart) { sum_.add(x_[0] - y[0], x_[1] - y[1], x_[2] - y[2], apart); }
    /// Moves the point and returns the number of pushes.
    HWY_INLINE std::size_t move(Real substeps) {
        sum_.move(x_[0], x_[1], x_[2], substeps);
        return sum_.count();
    }

private:
    Real* x_;
    PushSum<Real> sum_;
};

template <>
class PointPush<float> {
    using D = hn::FixedTag<float, 4>;

public:
    HWY_INLINE explicit PointPush(float* x)
        : at_(x), x_(hn::Load(D(), x)), sum_(hn::Zero(D())), count_(hn::Zero(D())) {}
    HWY_INLINE void add(const float* y, float most) {
        const D d;
        const auto v = hn::Sub(x_, hn::Load(d, y)), squares = hn::Mul(v, v);
        const auto length =
            hn::Sqrt(hn::Add(hn::Add(hn::Broadcast<0>(squares), hn::Broadcast<1>(squares)), hn::Broadcast<2>(squares)));
        const auto apart = hn::Set(d, most);
        const auto touching = hn::And(hn::Lt(length, apart), hn::Gt(length, hn::Zero(d)));
        const auto push = hn::IfThenElseZero(touching, hn::Div(hn::Sub(apart, length), length));
        sum_ = hn::Add(sum_, hn::Mul(push, v));
        count_ = hn::Add(count_, hn::IfThenElseZero(touching, hn::Set(d, 1.0f)));
    }
    HWY_INLINE std::size_t move(float substeps) {
        const D d;
        const auto share = hn::Mul(count_, hn::Set(d, substeps));
        hn::Store(hn::IfThenElse(hn::Gt(count_, hn::Zero(d)), hn::Add(x_, hn::Div(sum_, share)), x_), d, at_);
        return static_cast<std::size_t>(hn::GetLane(count_));
    }

private:
    float* at_;
    hn::Vec<D> x_, sum_, count_;
};

template <class Real>
HWY_INLINE void load_place(const CellPassArguments<Real>& a, std::size_t i, Real* place) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] = a.x[axis][i];
    place[3] = 0;
}

template <class Real>
HWY_INLINE void store_place(const CellPassArguments<Real>& a, std::size_t i, const Real* place) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        a.x[axis][i] = place[axis];
}

/// Moves the batch's points that are near others, one after the other, unless they are pinned. Returns how many really
/// were near enough.
template <class Real>
HWY_INLINE std::size_t apply_pushes(const CellPassArguments<Real>& a, std::size_t begin, std::size_t active,
                                    int word_bits, Batch<Real>& batch) {
    // Whoever is near an active point is one.
    for (std::size_t n = 0; n < active; ++n)
        load_place(a, a.order[begin + batch.active[n]], &batch.place[4 * batch.active[n]]);
    std::size_t total = 0;
    for (std::size_t n = 0; n < active; ++n) {
        const std::size_t k = batch.active[n], i = a.order[begin + k];
        if (a.pinned[i])
            continue;
        const Real* bucket = &batch.place[4 * batch.bucket_begin[k]];
        PointPush<Real> push(&batch.place[4 * k]);
        for (std::size_t w = 0; w < std::size_t{1} << word_bits; ++w)
            for (std::uint64_t left = batch.near[(k << word_bits) + w]; left != 0; left &= left - 1)
                push.add(bucket + 4 * (64 * w + static_cast<std::size_t>(std::countr_zero(left))), a.apart);
        total += push.move(a.substeps);
        store_place(a, i, &batch.place[4 * k]);
    }
    return total;
}

/// The rule as it is written, for buckets with very many points.
template <class Real>
HWY_NOINLINE std::size_t crowded_pass(const CellPassArguments<Real>& a) {
    std::size_t total = 0;
    for (std::size_t k = a.begin; k < a.end; ++k) {
        const std::uint32_t key = key_of(a, k), bucket = key & a.mask;
        if (a.pinned[a.order[k]])
            continue;
        alignas(32) Real x[4], y[4];
        load_place(a, a.order[k], x);
        PointPush<Real> push(x);
        for (std::size_t q = a.bucket_begin[bucket]; q < a.bucket_begin[bucket + 1]; ++q) {
            float square = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float v = a.sorted[4 * q + axis] - a.sorted[4 * k + axis];
                square += v * v;
            }
            if (square < a.reach_squared && q != k && same_cell(a, k, q, key, key_of(a, q))) {
                load_place(a, a.order[q], y);
                push.add(y, a.apart);
            }
        }
        total += push.move(a.substeps);
        store_place(a, a.order[k], x);
    }
    return total;
}

/// A bucket may hold several cells; only points of the same cell push each other, and so each pair counts once.
template <class Real>
std::size_t cell_pass(const CellPassArguments<Real>& a) {
    if (HWY_UNLIKELY(a.largest_bucket > Batch<Real>::most_points))
        return crowded_pass(a); // its bits do not fit into a batch
    // Words of bits for each point: a power of two.
    const int word_bits = a.largest_bucket <= 64 ? 0 : static_cast<int>(std::bit_width((a.largest_bucket - 1) / 64));
    Batch<Real> batch;
    std::size_t total = 0;
    for (std::size_t begin = a.begin; begin < a.end;) {
        std::size_t end = HWY_MIN(begin + Batch<Real>::most_points, a.end);
        if (end < a.end)
            end = a.bucket_begin[key_of(a, end) & a.mask];
        const std::size_t active = word_bits == 0 ? find_near<true>(a, begin, end - begin, 0, batch)
                                                  : find_near<false>(a, begin, end - begin, word_bits, batch);
        total += apply_pushes(a, begin, active, word_bits, batch);
        begin = end;
    }
    return total;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#include "sim/collision/contact_pairs.h"

#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace clothlab::sim {
namespace {

/// Calls visit(i) for every set bit, ascending, and clears them all.
template <class Visit>
void take_bits(std::vector<std::uint64_t>& bits, Visit visit) {
    for (std::size_t word = 0; word < bits.size(); ++word)
        for (std::uint64_t left = std::exchange(bits[word], 0); left != 0; left &= left - 1)
            visit(static_cast<std::uint32_t>(64 * word + static_cast<std::size_t>(std::countr_zero(left))));
}

/// Lists of a few indices, often in order already.
void sort_few(std::span<std::uint32_t> values) {
    for (std::size_t k = 1; k < values.size(); ++k) {
        const std::uint32_t value = values[k];
        std::size_t at = k;
        for (; at > 0 && values[at - 1] > value; --at)
            values[at] = values[at - 1];
        values[at] = value;
    }
}

template <class Real>
std::size_t push(Vec3Array<Real>& x, std::uint32_t i, std::span<const std::uint32_t> partners, Real apart,
                 Real substeps) {
    Real sum_x = 0, sum_y = 0, sum_z = 0;
    int count = 0;
    for (const std::uint32_t q : partners) {
        const Real dx = x.x[i] - x.x[q], dy = x.y[i] - x.y[q], dz = x.z[i] - x.z[q];
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        if (!(length < apart) || length == 0)
            continue;
        const Real share = (apart - length) / length;
        sum_x += share * dx;
        sum_y += share * dy;
        sum_z += share * dz;
        ++count;
    }
    if (count == 0)
        return 0;
    const Real share = static_cast<Real>(count) * substeps;
    x.x[i] += sum_x / share;
    x.y[i] += sum_y / share;
    x.z[i] += sum_z / share;
    return static_cast<std::size_t>(count);
}

} // namespace

template <class Real>
std::size_t resolve_pairs(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work) {
    // Partners by point: how many each has, ...
    for (const PointPair& pair : work.pairs)
        for (const std::uint32_t i : pair) {
            ++work.cursor[i];
            work.active[i / 64] |= std::uint64_t{1} << (i % 64);
        }
    // ... where its list begins, in index order, ...
    std::vector<std::uint32_t>& order = work.order;
    std::size_t points = 0;
    std::uint32_t begin = 0;
    take_bits(work.active, [&](std::uint32_t i) {
        order[points++] = i;
        begin += std::exchange(work.cursor[i], begin);
    });
    // ... and who they are, which moves each beginning to the list's end.
    for (const auto& [a, b] : work.pairs) {
        work.partners[work.cursor[a]++] = b;
        work.partners[work.cursor[b]++] = a;
    }

    const Real apart = Real(2) * model.thickness, substeps = static_cast<Real>(model.substeps);
    std::size_t pushes = 0;
    begin = 0;
    for (std::size_t k = 0; k < points; ++k) {
        const std::uint32_t i = order[k], end = std::exchange(work.cursor[i], 0);
        const std::span<std::uint32_t> partners(work.partners.data() + begin, end - begin);
        begin = end;
        if (model.pinned[i])
            continue;
        sort_few(partners);
        pushes += push<Real>(state.position, i, partners, apart, substeps);
    }
    return pushes;
}

template std::size_t resolve_pairs<float>(const Model<float>&, State<float>&, SelfCollisionWork<float>&);
template std::size_t resolve_pairs<double>(const Model<double>&, State<double>&, SelfCollisionWork<double>&);

} // namespace clothlab::sim

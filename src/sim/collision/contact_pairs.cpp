#include "sim/collision/contact_pairs.h"

#include <bit>
#include <span>
#include <utility>

#include "sim/collision/push_sum.h"

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

} // namespace

template <class Real>
std::size_t resolve_pairs(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work) {
    // Partners by point: how many each has, ...
    const std::span<const PointPair> pairs(work.pairs.data(), work.pair_count);
    for (const PointPair& pair : pairs)
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
    for (const auto& [a, b] : pairs) {
        work.partners[work.cursor[a]++] = b;
        work.partners[work.cursor[b]++] = a;
    }

    const Real apart = Real(2) * model.thickness, substeps = static_cast<Real>(model.substeps);
    Vec3Array<Real>& x = state.position;
    std::size_t pushes = 0;
    begin = 0;
    for (std::size_t k = 0; k < points; ++k) {
        const std::uint32_t i = order[k], end = std::exchange(work.cursor[i], 0);
        const std::span<std::uint32_t> partners(work.partners.data() + begin, end - begin);
        begin = end;
        if (model.pinned[i])
            continue;
        sort_few(partners);
        PushSum<Real> sum;
        for (const std::uint32_t q : partners)
            sum.add(x.x[i] - x.x[q], x.y[i] - x.y[q], x.z[i] - x.z[q], apart);
        sum.move(x.x[i], x.y[i], x.z[i], substeps);
        pushes += sum.count();
    }
    return pushes;
}

template std::size_t resolve_pairs<float>(const Model<float>&, State<float>&, SelfCollisionWork<float>&);
template std::size_t resolve_pairs<double>(const Model<double>&, State<double>&, SelfCollisionWork<double>&);

} // namespace clothlab::sim

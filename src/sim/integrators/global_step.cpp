#include "sim/integrators/global_step.h"

#include <algorithm>
#include <new>

namespace clothlab::sim {
namespace {

template <class Real>
double stiffness(const Model<Real>& model, std::size_t s) {
    return model.pulls(s) ? static_cast<double>(model.spring_constant(s)) : 0.0;
}

} // namespace

template <class Real>
bool GlobalStep::fits(const Key& key, const Model<Real>& model, double a) {
    for (std::size_t s = 0; s < stencil_size; ++s)
        if (key.k[s] != stiffness(model, s))
            return false;
    return key.a == a && key.pins == model.pins && key.columns == model.grid->columns && key.rows == model.grid->rows;
}

template <class Real>
GlobalStep& GlobalStep::of(const Model<Real>& model, double a, Workspace<Real>& work) {
    if (!work.solver)
        work.solver = std::make_shared<GlobalStep>();
    GlobalStep& step = *static_cast<GlobalStep*>(work.solver.get());
    if (step.place_.empty() || !fits(step.key_, model, a)) {
        for (std::size_t s = 0; s < stencil_size; ++s)
            step.key_.k[s] = stiffness(model, s);
        step.key_.a = a;
        step.key_.pins = model.pins;
        step.key_.columns = model.grid->columns;
        step.key_.rows = model.grid->rows;
        step.build(model.pinned);
        work.solver_bytes = step.bytes();
    }
    return step;
}

void GlobalStep::build(const std::vector<std::uint8_t>& pinned) {
    const std::size_t points = pinned.size();
    free_ = static_cast<std::size_t>(std::count(pinned.begin(), pinned.end(), std::uint8_t{0}));
    place_.assign(points, free_);
    values_.assign(free_ + 1, {});
    usable_ = false;
    try {
        for (std::size_t i = 0, next = 0; i < points; ++i)
            if (!pinned[i])
                place_[i] = next++;
        std::vector<double> diagonal(free_ + 1, key_.a);
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(free_ * (1 + stencil_size));
        for_each_spring(key_.columns, key_.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
            const double k = key_.k[s];
            diagonal[place_[a]] += k;
            diagonal[place_[b]] += k;
            if (k != 0 && !pinned[a] && !pinned[b]) // the lower triangle: a comes after b
                entries.emplace_back(static_cast<int>(place_[a]), static_cast<int>(place_[b]), -k);
        });
        for (std::size_t i = 0; i < free_; ++i)
            entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
        const auto size = static_cast<Eigen::Index>(free_);
        Eigen::SparseMatrix<double> matrix(size, size);
        matrix.setFromTriplets(entries.begin(), entries.end());
        factor_.compute(matrix);
        usable_ = factor_.info() == Eigen::Success;
        if (!usable_)
            return;
        pivot_ = factor_.vectorD();
        for (std::size_t i = 0; i < points; ++i)
            if (!pinned[i])
                place_[i] =
                    static_cast<std::size_t>(factor_.permutationP().indices()[static_cast<Eigen::Index>(place_[i])]);
    } catch (const std::bad_alloc&) { // not usable, then
    }
}

std::size_t GlobalStep::bytes() const {
    std::size_t bytes = place_.capacity() * sizeof(place_[0]) + values_.capacity() * sizeof(values_[0]);
    if (usable_) { // the factor, its pivots twice, and the order of elimination and its inverse
        const auto entries = static_cast<std::size_t>(factor_.matrixL().nestedExpression().nonZeros());
        bytes += entries * (sizeof(double) + sizeof(int)) + free_ * (2 * sizeof(double) + 2 * sizeof(int));
    }
    return bytes;
}

void GlobalStep::solve() {
    const auto& lower = factor_.matrixL().nestedExpression(); // its diagonal of ones is not stored
    const int *begin = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
    const double* value = lower.valuePtr();
    std::array<double, 4>* x = values_.data();
    for (std::size_t j = 0; j < free_; ++j) {
        const std::array<double, 4> known = x[j];
        for (int e = begin[j]; e < begin[j + 1]; ++e)
            for (std::size_t axis = 0; axis < 4; ++axis)
                x[row[e]][axis] -= value[e] * known[axis];
    }
    for (std::size_t j = free_; j-- > 0;) {
        std::array<double, 4> sum = x[j];
        for (double& v : sum)
            v /= pivot_[static_cast<Eigen::Index>(j)];
        for (int e = begin[j]; e < begin[j + 1]; ++e)
            for (std::size_t axis = 0; axis < 4; ++axis)
                sum[axis] -= value[e] * x[row[e]][axis];
        x[j] = sum;
    }
}

template GlobalStep& GlobalStep::of<float>(const Model<float>&, double, Workspace<float>&);
template GlobalStep& GlobalStep::of<double>(const Model<double>&, double, Workspace<double>&);

} // namespace clothlab::sim

// The global step of projective dynamics: A I + sum of k over springs, factorised once and solved in every iteration.
//
// One matrix for x, y and z, without the rows and columns of pinned points. Always in double precision: the factor of
// single precision would lose the digits of A wherever the springs are much stiffer than A, and the solve waits for
// memory, not for arithmetic. The triangular solves are plain loops of our own, since Eigen's allocate memory, and
// three coordinates at a time.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/model.h"
#include "sim/workspace.h"

namespace clothlab::sim {

class GlobalStep {
public:
    /// The workspace's own for the model and A in kg/s²; built when there is none or another one's.
    template <class Real>
    static GlobalStep& of(const Model<Real>& model, double a, Workspace<Real>& work);

    /// False when there is no memory for the factor or one of its pivots is zero, which only a negative mass can bring
    /// about. A matrix that is merely indefinite is factorised as it is.
    bool usable() const { return usable_; }

    /// The right-hand side of a point, to be set before and replaced by the solution in solve(); nothing for pinned
    /// points.
    std::array<double, 4>& operator[](std::size_t point) { return values_[place_[point]]; }
    void solve();

    /// All memory that it holds.
    std::size_t bytes() const;

private:
    /// All that the matrix depends on.
    struct Key {
        double a = 0;
        std::array<double, stencil_size> k{}; ///< zero where the kind is off
        std::vector<std::uint32_t> pins;
        int columns = 0, rows = 0;
        bool operator==(const Key&) const = default;
    };
    template <class Real>
    static bool fits(const Key& key, const Model<Real>& model, double a);
    void build(const std::vector<std::uint8_t>& pinned);

    Key key_;
    bool usable_ = false;
    std::size_t free_ = 0;
    std::vector<std::size_t> place_;            ///< of each point in values_; the last one for pinned points
    std::vector<std::array<double, 4>> values_; ///< in the order of elimination; the fourth one fills the vector
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
    Eigen::VectorXd pivot_; ///< D of L D LT
};

extern template GlobalStep& GlobalStep::of<float>(const Model<float>&, double, Workspace<float>&);
extern template GlobalStep& GlobalStep::of<double>(const Model<double>&, double, Workspace<double>&);

} // namespace clothlab::sim

// The springs' Hessian as a dense matrix, written down from its formula and nothing of the simulator's: for Eigen.
#pragma once

#include <Eigen/Eigenvalues>

#include "support/sheet.h"

namespace clothlab::test {

/// Of a compressed spring the part across its direction is negative.
enum class Compressed { whole, only_along };

/// K in N/m of all coordinates (x, y, z per point), rows and columns of pinned points zero.
template <class Real>
Eigen::MatrixXd spring_hessian(const Sheet<Real>& sheet, Compressed compressed = Compressed::whole) {
    const auto n = static_cast<Eigen::Index>(3 * sheet.points());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    sheet.for_each_pulling_spring([&](std::uint32_t a, std::uint32_t b, std::size_t s) {
        const sim::Vec3 d = minus(sheet.position(b), sheet.position(a));
        const Eigen::Vector3d along = Eigen::Vector3d(d.x, d.y, d.z);
        const double length = along.norm(), rest = static_cast<double>(sheet.model.grid->rest_length(s, a));
        const Eigen::Matrix3d nn = along * along.transpose() / (length * length);
        const double across = 1 - rest / length;
        const double kept = compressed == Compressed::whole ? across : std::max(0.0, across);
        const Eigen::Matrix3d block =
            static_cast<double>(sheet.model.spring_constant(s)) * (nn + kept * (Eigen::Matrix3d::Identity() - nn));
        const auto i = static_cast<Eigen::Index>(3 * a), j = static_cast<Eigen::Index>(3 * b);
        k.block<3, 3>(i, i) += block;
        k.block<3, 3>(j, j) += block;
        k.block<3, 3>(i, j) -= block;
        k.block<3, 3>(j, i) -= block;
    });
    for (const std::uint32_t pin : sheet.model.pins) {
        k.middleRows<3>(3 * static_cast<Eigen::Index>(pin)).setZero();
        k.middleCols<3>(3 * static_cast<Eigen::Index>(pin)).setZero();
    }
    return k;
}

/// Its largest eigenvalue; not negative, for pins leave zeros.
template <class Real>
double largest_eigenvalue(const Sheet<Real>& sheet) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(spring_hessian(sheet), Eigen::EigenvaluesOnly);
    return std::max(0.0, solver.eigenvalues().maxCoeff());
}

} // namespace clothlab::test

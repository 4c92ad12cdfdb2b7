// Numbers for each point of a cloth, for the eye to find where something happens: heat maps are drawn from them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

enum class PointQuantity : std::uint8_t {
    none,
    /// (length - rest) / rest of the structural or shear spring at the point, of those that pull, for which it is
    /// largest without its sign; 0 where none pulls. 0.01 is 1 % longer, -0.01 is 1 % shorter.
    strain,
    /// m/s; of methods that keep no velocity that of the last half step, as in Diagnostics.
    speed,
    /// m; see point_gaps.
    gap,
    /// 1/m; see point_curvatures.
    curvature,
    /// m, to the same point of another cloth. A simulation knows of no other and gives 0; who compares two (the app)
    /// puts the distances into the snapshot.
    distance
};
inline constexpr std::array<std::string_view, 6> point_quantity_names{"none", "strain",    "speed",
                                                                      "gap",  "curvature", "distance"};
std::optional<PointQuantity> find_point_quantity(std::string_view name);

/// The quantity of every point of a state; nothing for `none`. Where it is no number, springs and points that are not
/// finite, it is 0. `positions` are the state's, x, y, z per point.
template <class Real>
void point_quantity(PointQuantity which, const Model<Real>& model, const State<Real>& state,
                    std::span<const float> positions, std::vector<float>& values);

extern template void point_quantity<float>(PointQuantity, const Model<float>&, const State<float>&,
                                           std::span<const float>, std::vector<float>&);
extern template void point_quantity<double>(PointQuantity, const Model<double>&, const State<double>&,
                                            std::span<const float>, std::vector<float>&);

} // namespace clothlab::sim

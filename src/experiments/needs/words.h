// Models in words, as tables and sentences name them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/description.h"

namespace clothlab::experiments::needs::words {

std::string number(double value, int digits = 3);          ///< significant digits
std::string counted(int n, std::string_view thing);        ///< "1 substep", "2 substeps"
std::string listed(const std::vector<std::string>& list);  ///< "a, b and c"
std::string grid(const sim::Cloth& cloth);                 ///< "26 x 26 points"
std::string pins(const std::vector<sim::GridPoint>& pins); ///< as --set takes them
std::string collider(const sim::Collider& collider);       ///< "the sphere at (0.5, 0.2, 0.5) m"
std::string self_collision(sim::SelfCollisionRule rule);

/// A model as far as it differs from another: see in_words.
std::string difference(const sim::Description& model, const sim::Description& full);

} // namespace clothlab::experiments::needs::words

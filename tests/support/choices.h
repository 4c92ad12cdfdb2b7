// What tests go through one after the other.
#pragma once

#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>

#include "sim/integrators/integrator.h"

namespace clothlab::test {

inline constexpr auto both_precisions = {sim::Precision::single_precision, sim::Precision::double_precision};

/// Every method, one after the other.
inline sim::IntegratorInfo any_method() {
    return GENERATE(from_range(sim::integrators().begin(), sim::integrators().end()));
}

} // namespace clothlab::test

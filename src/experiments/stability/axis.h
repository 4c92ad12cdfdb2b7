// What a stability experiment varies: a parameter of the scene, or something that several of them make up.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/chart.h"
#include "experiments/findings.h"
#include "scene/scene.h"

namespace clothlab::experiments {

/// A number that can be varied: `KEY` of scene::fields(), or
/// - `grid`: points a side, both sides alike; pins move to the same places of the cloth,
/// - `damping`: cloth.damping or cloth.damping_rate, whichever the scene's damping rule reads.
struct Quantity {
    std::string key;                  ///< of the scene, or "grid"
    std::string column;               ///< for a table: the key's name with its unit ("ks_n_m")
    std::string label;                ///< for people, with the unit ("Stiffness ks (N/m)")
    std::string unit;                 ///< "N/m"; "" where there is none
    bool whole = false;               ///< only whole numbers
    double smallest = 0, largest = 0; ///< allowed
};

/// Throws Refusal for what is not a number, or is not of the simulation, or that the scene does not use.
Quantity quantity_of(std::string_view key, const scene::Scene& scene);
/// What the scene has.
double value_of(const Quantity& quantity, const scene::Scene& scene);
/// What gives a scene this value.
Settings settings_of(const Quantity& quantity, double value, const scene::Scene& scene);

struct AxisValue {
    double at = 0;    ///< on the chart: the number, or the place in the list
    std::string text; ///< as people read it
    Settings settings;
};

struct VariedAxis {
    Quantity quantity; ///< of a categorical one, only key, column and label
    bool log = false;
    bool categorical = false;      ///< a list of things without values between them
    std::vector<AxisValue> values; ///< ascending, at least two

    Axis chart_axis() const;
    /// Half way to a neighbour, or past the ends: where the cell of value `i` begins, and that of value i - 1 ends.
    double border(std::size_t i) const;
};

/// Reads an axis:
/// - KEY=a:b, with :n for the number of values (default: `resolution`) and log, as in cloth.ks=1e4:1e6:65log
/// - KEY=value,value,... for choices and switches; KEY alone is all of them
/// - springs=all,structural+shear,...; springs alone is all subsets that have any
/// The section of a key may be left out (ks); there are the names of Quantity, `limiter` for rules.limit and `method`
/// for simulation.integrator. Throws Refusal, and scene::SceneError for values that the scene does not allow.
VariedAxis read_axis(std::string_view text, std::size_t resolution, const scene::Scene& scene);

} // namespace clothlab::experiments

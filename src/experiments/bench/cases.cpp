#include "experiments/bench/cases.h"

#include <algorithm>
#include <cmath>

namespace clothlab::experiments {
namespace {

sim::Description with_points(sim::Description description, int n) {
    sim::Cloth& cloth = description.cloth;
    for (sim::GridPoint& pin : cloth.pinned) { // those at the last column or row stay there
        pin[0] = pin[0] == cloth.num_width_points - 1 ? n - 1 : std::min(pin[0], n - 1);
        pin[1] = pin[1] == cloth.num_height_points - 1 ? n - 1 : std::min(pin[1], n - 1);
    }
    cloth.num_width_points = cloth.num_height_points = n;
    return description;
}

sim::Description scaled(const sim::Description& description, int n) {
    const double finer = static_cast<double>(n) / description.cloth.num_width_points;
    sim::Description result = with_points(description, n);
    result.cloth.density *= finer * finer;
    result.cloth.thickness /= finer;
    return result;
}

} // namespace

std::vector<BenchCase> bench_cases(const BenchConfig& config) {
    std::vector<BenchCase> cases;
    for (const int n : config.sizes) {
        const int frames = static_cast<int>(std::lround(45 * std::pow(50.0 / n, 0.4)));
        cases.push_back({"pinned", scaled(config.pinned, n), frames});

        sim::Description springs = scaled(config.pinned, n);
        springs.rules.limit = sim::LimitRule::off;
        springs.rules.self_collision = sim::SelfCollisionRule::none;
        cases.push_back({"springs", springs, 10}); // whatever its shape, it costs the same

        cases.push_back({"falling", scaled(config.falling, n), frames});
        if (n == 100) // the file as a user would refine it: every point has neighbours within its thickness
            cases.push_back({"falling-thick", with_points(config.falling, n), 45});
    }
    return cases;
}

} // namespace clothlab::experiments

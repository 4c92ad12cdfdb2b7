#include "sim/description.h"

#include <tuple>

namespace clothlab::sim {

double step_length(const Description& description) {
    return 1.0 / description.stepping.frames_per_second / description.stepping.substeps;
}

double point_mass(const Cloth& cloth) {
    const double points = static_cast<double>(cloth.num_width_points) * cloth.num_height_points;
    return cloth.width * cloth.height * cloth.density / points;
}

bool can_change_live(const Description& from, const Description& to) {
    const auto start = [](const Description& d) {
        const Cloth& c = d.cloth;
        return std::tuple(c.width, c.height, c.num_width_points, c.num_height_points, c.orientation, c.offset,
                          d.stepping.precision, d.stepping.seed);
    };
    return start(from) == start(to);
}

} // namespace clothlab::sim

#include "experiments/stability/start_displacement.h"

#include <cstring>

#include "sim/grid.h"
#include "sim/random.h"
#include "sim/saved_state.h"

namespace clothlab::experiments {
namespace {

/// Of a state's bytes: positions and previous positions, x, y and z each.
template <class Real>
void displace_arrays(std::vector<std::byte>& bytes, double size, const std::vector<sim::Vec3>& shape) {
    const std::size_t n = shape.size();
    for (std::size_t array = 0; array < 6; ++array)
        for (std::size_t i = 0; i < n; ++i) {
            std::byte* place = bytes.data() + sizeof(sim::StateHeader) + (array * n + i) * sizeof(Real);
            const double share = array % 3 == 0 ? shape[i].x : array % 3 == 1 ? shape[i].y : shape[i].z;
            Real value = 0;
            std::memcpy(&value, place, sizeof value);
            value = static_cast<Real>(static_cast<double>(value) + size * share);
            std::memcpy(place, &value, sizeof value);
        }
}

} // namespace

double shortest_spring(const sim::Description& description) {
    return sim::make_grid<double>(description).shortest;
}

std::vector<sim::Vec3> noise(const sim::Description& description) {
    const sim::Cloth& cloth = description.cloth;
    const auto columns = static_cast<std::size_t>(cloth.num_width_points);
    std::vector<sim::Vec3> shape(columns * static_cast<std::size_t>(cloth.num_height_points));
    sim::SplitMix64 random(1);
    for (sim::Vec3& p : shape)
        for (double* axis : {&p.x, &p.y, &p.z})
            *axis = 2 * random.unit() - 1;
    for (const auto& [column, row] : cloth.pinned)
        shape[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] = {};
    return shape;
}

void displace(sim::Simulation& simulation, double size, const std::vector<sim::Vec3>& shape) {
    std::vector<std::byte> bytes = simulation.save_state();
    if (sim::read_state_header(bytes).real_size == sizeof(double))
        displace_arrays<double>(bytes, size, shape);
    else
        displace_arrays<float>(bytes, size, shape);
    const std::size_t end = bytes.size() - sizeof(std::uint64_t);
    const std::uint64_t sum = sim::checksum(std::span(bytes).first(end));
    std::memcpy(bytes.data() + end, &sum, sizeof sum);
    simulation.load_state(bytes);
}

} // namespace clothlab::experiments

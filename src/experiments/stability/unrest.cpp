#include "experiments/stability/unrest.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "experiments/stability/start_displacement.h"
#include "sim/model.h"

namespace clothlab::experiments {
namespace {

constexpr double least_change = 1e-2; ///< in shortest rest lengths
constexpr double least_turning = 0.8;
constexpr std::uint32_t last_ten = (1u << 10) - 1;
constexpr int frames_of_ten = 6;

} // namespace

Unrest::Unrest(const sim::Description& description)
    : substeps_(description.stepping.substeps), least_(least_change * shortest_spring(description)) {
    const sim::Vec3& g = description.stepping.gravity;
    const double dt = sim::step_length(description);
    if (!description.colliders.empty())
        least_ = std::max(least_, sim::plane_offset + std::hypot(g.x, g.y, g.z) * dt * dt);
}

void Unrest::after_step(const sim::Simulation& simulation) {
    const int substep = simulation.substep();
    if (substep != 0 && substep < substeps_ - 3)
        return;
    std::rotate(last_.begin(), last_.end() - 1, last_.end());
    last_[0].resize(simulation.points());
    for (std::size_t i = 0; i < last_[0].size(); ++i)
        last_[0][i] = simulation.position(i);
    if (substep == 0)
        end_of_frame();
}

void Unrest::end_of_frame() {
    const auto& [a, b, c, d] = last_;
    if (d.size() != a.size())
        return;
    double change = 0, turn = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (double sim::Vec3::*axis : {&sim::Vec3::x, &sim::Vec3::y, &sim::Vec3::z}) {
            const double now = a[i].*axis - 2 * b[i].*axis + c[i].*axis;
            const double then = b[i].*axis - 2 * c[i].*axis + d[i].*axis;
            change += now * now;
            turn += (now - then) * (now - then);
        }
    const bool unrest =
        std::sqrt(change / static_cast<double>(a.size())) > least_ && turn > least_turning * least_turning * change;
    frames_ = (frames_ << 1 | (unrest ? 1u : 0u)) & last_ten;
    found_ = found_ || std::popcount(frames_) >= frames_of_ten;
}

} // namespace clothlab::experiments

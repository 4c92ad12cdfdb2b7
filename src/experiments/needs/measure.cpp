#include "experiments/needs/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "sim/random.h"
#include "sim/saved_state.h"

namespace clothlab::experiments::needs {
namespace {

using Clock = std::chrono::steady_clock;

constexpr QuantityInfo all_quantities[] = {
    {Quantity::rms, "rms", "RMS distance", "mm", 1000},
    {Quantity::largest, "largest", "largest distance", "mm", 1000},
    {Quantity::drape, "drape", "drape height", "mm", 1000},
    {Quantity::sag, "sag", "sag", "mm", 1000},
    {Quantity::first_contact, "first-contact", "first contact", "ms", 1000},
    {Quantity::energy, "energy", "energy", "J", 1},
};

std::vector<bool> free_points(const sim::Cloth& cloth) {
    std::vector<bool> is_free(
        static_cast<std::size_t>(cloth.num_width_points) * static_cast<std::size_t>(cloth.num_height_points), true);
    for (const auto& [column, row] : cloth.pinned)
        is_free[static_cast<std::size_t>(row) * static_cast<std::size_t>(cloth.num_width_points) +
                static_cast<std::size_t>(column)] = false;
    return is_free;
}

/// Adds the same to positions and previous positions, so that nothing gets a speed.
template <class Real>
void nudge_axes(std::vector<std::byte>& bytes, const std::vector<bool>& is_free, double by) {
    const std::size_t points = is_free.size();
    sim::SplitMix64 random(1);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < points; ++i) {
            const double shift = is_free[i] ? by * (2 * random.unit() - 1) : 0;
            for (const std::size_t array : {std::size_t{0}, std::size_t{3}}) {
                std::byte* at = bytes.data() + sizeof(sim::StateHeader) + ((array + axis) * points + i) * sizeof(Real);
                Real value;
                std::memcpy(&value, at, sizeof value);
                value = static_cast<Real>(static_cast<double>(value) + shift);
                std::memcpy(at, &value, sizeof value);
            }
        }
}

void nudge_start(sim::Simulation& simulation) {
    std::vector<std::byte> bytes = simulation.save_state();
    const std::vector<bool> is_free = free_points(simulation.description().cloth);
    const double by = nudge(simulation);
    if (sim::read_state_header(bytes).real_size == sizeof(float))
        nudge_axes<float>(bytes, is_free, by);
    else
        nudge_axes<double>(bytes, is_free, by);
    const std::size_t summed = bytes.size() - sizeof(std::uint64_t);
    const std::uint64_t sum = sim::checksum(std::span<const std::byte>(bytes).first(summed));
    std::memcpy(bytes.data() + summed, &sum, sizeof sum);
    simulation.load_state(bytes);
}

double difference(Quantity quantity, const Record& full, const Record& other, std::size_t i) {
    const Shape &a = full.shapes[i], &b = other.shapes[i];
    switch (quantity) {
    case Quantity::rms:
        return distance(a, resampled(b, a.columns, a.rows)).rms;
    case Quantity::largest:
        return distance(a, resampled(b, a.columns, a.rows)).largest;
    case Quantity::drape:
        return std::abs(drape_height(a) - drape_height(b));
    case Quantity::sag:
        return std::abs((full.start_height - mean_height(a)) - (other.start_height - mean_height(b)));
    case Quantity::energy:
        return std::abs(full.energies[i] - other.energies[i]);
    case Quantity::first_contact:
        break;
    }
    if (std::isinf(full.first_contact) && std::isinf(other.first_contact))
        return 0;
    return std::abs(full.first_contact - other.first_contact);
}

} // namespace

std::span<const QuantityInfo> quantities() {
    return all_quantities;
}

const QuantityInfo& info(Quantity quantity) {
    return all_quantities[static_cast<std::size_t>(quantity)];
}

Course course_of(const sim::Description& description, std::uint64_t frames, int threads) {
    return {frames, std::max<std::uint64_t>(frames / 50, 1), threads,
            static_cast<double>(frames) / description.stepping.frames_per_second};
}

double nudge(const sim::Simulation& start) {
    double largest = 0;
    for (std::size_t i = 0; i < start.points(); ++i) {
        const sim::Vec3 p = start.position(i);
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const bool single = start.description().stepping.precision == sim::Precision::single_precision;
    const double rounding =
        single ? static_cast<double>(std::numeric_limits<float>::epsilon()) : std::numeric_limits<double>::epsilon();
    return std::max(1e-10, rounding * largest);
}

Record record(const sim::Description& model, const Course& course, const Progress& progress, double most_wall_s,
              bool nudged) {
    const auto simulation = sim::Simulation::create(model, {.threads = course.threads});
    if (nudged)
        nudge_start(*simulation);
    simulation->watch(true);
    Record kept;
    kept.start_height = mean_height(shape_of(*simulation));
    const auto take_frame = [&] {
        const std::uint64_t now = simulation->frame();
        while (simulation->frame() == now) {
            const auto begin = Clock::now();
            const sim::StepCounts counts = simulation->step();
            kept.wall_s += std::chrono::duration<double>(Clock::now() - begin).count();
            kept.deeds.add(counts);
            if (counts.contacts > 0 && std::isinf(kept.first_contact))
                kept.first_contact = simulation->time();
            if (kept.wall_s > most_wall_s)
                return false;
        }
        return true;
    };
    for (std::uint64_t frame = 1; frame <= course.frames && kept.complete(); ++frame) {
        progress.tell(0, "");
        kept.given_up = !take_frame() && frame < course.frames;
        kept.trouble = simulation->trouble();
        if (kept.complete() && (frame % course.every == 0 || frame == course.frames)) {
            kept.shapes.push_back(shape_of(*simulation));
            kept.energies.push_back(simulation->diagnose().energy.total());
            kept.times.push_back(simulation->time());
        }
    }
    kept.simulated_s = simulation->time();
    kept.hash = simulation->hash();
    return kept;
}

std::vector<double> deviations(Quantity quantity, const Record& full, const Record& other) {
    const std::size_t times = quantity == Quantity::first_contact ? 1 : full.shapes.size();
    std::vector<double> list;
    for (std::size_t i = 0; i < times; ++i) {
        const double d = difference(quantity, full, other, i) * info(quantity).per_si;
        list.push_back(std::isnan(d) ? std::numeric_limits<double>::infinity() : d);
    }
    return list;
}

double deviation(Quantity quantity, const Record& full, const Record& other, bool at_end) {
    const std::vector<double> all = deviations(quantity, full, other);
    return at_end ? all.back() : *std::max_element(all.begin(), all.end());
}

} // namespace clothlab::experiments::needs

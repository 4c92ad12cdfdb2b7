#include "experiments/accuracy/reference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "experiments/accuracy/convergence.h"
#include "experiments/accuracy/physical_model.h"
#include "experiments/formatted.h"
#include "sim/random.h"
#include "sim/saved_state.h"

namespace clothlab::experiments {
namespace {

/// omega h of the coarsest reference run, of the fastest mode. Dormand-Prince's is stable up to 1.
constexpr double coarsest_omega_dt = 0.5;
/// In mm or mJ: an error that nobody needs to be smaller; about what rounding leaves of a metre of cloth.
constexpr double small_enough = 1e-9;
/// Refining goes on while it makes the difference so many times smaller; rounding does not fall at all.
constexpr double still_falling = 1.25;
constexpr int most_substeps = 100000; // of simulation.substeps

const sim::IntegratorInfo& best_method() {
    const auto methods = sim::integrators();
    return *std::max_element(methods.begin(), methods.end(),
                             [](const auto& a, const auto& b) { return a.order < b.order; });
}

/// Of the coarsest reference run.
int first_substeps(const sim::Description& description) {
    const auto simulation = sim::Simulation::create(description);
    const double omega = simulation->stability().omega_bound;
    if (!std::isfinite(omega))
        throw Refusal("springs push here, since the mass is negative: no method stays bounded, and there is nothing to "
                      "compare with");
    const double frame = sim::step_length(description) * description.stepping.substeps;
    const double wanted = std::ceil(omega * frame / coarsest_omega_dt);
    if (4 * wanted > most_substeps)
        throw Refusal(
            formatted("the cloth is so stiff (its fastest mode has %.3g rad/s) that a reference would need more "
                      "than %d substeps per frame",
                      omega, most_substeps));
    return std::max(static_cast<int>(wanted), 1);
}

[[noreturn]] void refuse_chaos(const Growth& growth, std::uint64_t frames, const sim::Description& description) {
    const double fps = description.stepping.frames_per_second;
    std::string sentence = formatted(
        "over %.3g s this scene is chaotic: moved by %.0e m at the start it is %.2g mm off at the end, %.1e times as "
        "much, and errors of methods grow as much. ",
        static_cast<double>(frames) / fps, perturbation, 1000 * growth.apart, growth.factor);
    // Two digits, rounded down.
    const double until = std::floor(static_cast<double>(growth.predictable) / fps * 100) / 100;
    sentence += until > 0
                    ? formatted("Up to %.2f s the growth is below %.0e, and methods can be compared: --seconds %.2f",
                                until, most_growth, until)
                    : "It is so from the first frame on";
    throw Refusal(sentence);
}

} // namespace

std::vector<std::byte> perturbed(const std::vector<std::byte>& state, const std::vector<sim::GridPoint>& pinned,
                                 double by) {
    const sim::StateHeader header = sim::read_state_header(state);
    sim::check_state(header, state);
    std::vector<bool> free(header.points(), true);
    for (const sim::GridPoint& pin : pinned)
        free[static_cast<std::size_t>(pin[1] * header.columns + pin[0])] = false;
    std::vector<std::byte> moved = state;
    const auto add = [&](std::size_t array, std::size_t point, double offset) {
        const std::size_t at = sizeof header + (array * header.points() + point) * sizeof(double);
        double value;
        std::memcpy(&value, moved.data() + at, sizeof value);
        value += offset;
        std::memcpy(moved.data() + at, &value, sizeof value);
    };
    sim::SplitMix64 random(1);
    for (std::size_t point = 0; point < header.points(); ++point)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double offset = by * (2 * random.unit() - 1);
            if (!free[point])
                continue;
            add(axis, point, offset);     // of the position
            add(3 + axis, point, offset); // of the previous one
        }
    const std::size_t body = moved.size() - sizeof(std::uint64_t);
    const std::uint64_t sum = sim::checksum(std::span(moved).first(body));
    std::memcpy(moved.data() + body, &sum, sizeof sum);
    return moved;
}

Growth measure_growth(const sim::Description& description, std::uint64_t frames, const Tick& tick) {
    const auto one = sim::Simulation::create(description), other = sim::Simulation::create(description);
    other->load_state(perturbed(one->save_state(), description.cloth.pinned, perturbation));
    one->watch(true);
    other->watch(true);
    const double start = distance(shape_of(*one), shape_of(*other)).largest;
    Growth growth;
    bool predictable = true;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        for (const auto& simulation : {one.get(), other.get()}) {
            for (int i = 0; i < description.stepping.substeps; ++i)
                growth.self_contacts += simulation->step().self_contacts;
            if (simulation->trouble() && simulation->trouble()->status == sim::Status::diverged)
                throw Refusal("the reference diverges: " + simulation->trouble()->cause);
            tick(static_cast<double>(frame) / static_cast<double>(frames));
        }
        growth.apart = distance(shape_of(*one), shape_of(*other)).largest;
        growth.factor = start > 0 ? growth.apart / start : 1; // a cloth of pins alone cannot be moved
        predictable = predictable && growth.factor <= most_growth;
        if (predictable)
            growth.predictable = frame;
    }
    return growth;
}

Reference find_reference(const scene::Scene& scene, std::uint64_t frames, int finest, ErrorQuantity quantity,
                         double budget, const Tick& tick) {
    const sim::IntegratorInfo& method = best_method();
    PhysicalModel model = physical_model(scene);
    Reference reference;
    reference.notes = model.notes;
    const auto described = [&](int substeps) {
        reference.settings = model.settings;
        for (const std::string& setting :
             {"simulation.integrator=" + std::string(method.name), std::string("simulation.precision=double"),
              std::string("simulation.tolerance=0"), "simulation.substeps=" + std::to_string(substeps)})
            reference.settings.push_back(setting);
        return with(scene, reference.settings).simulation;
    };
    const int first = first_substeps(described(1));
    reference.growth = measure_growth(described(first), frames, [&](double share) { tick(0.3 * share); });
    if (reference.growth.factor > most_growth)
        refuse_chaos(reference.growth, frames, described(first));
    if (described(first).rules.self_collision != sim::SelfCollisionRule::none && reference.growth.self_contacts == 0) {
        std::erase_if(model.settings, [](const std::string& s) { return s.starts_with("rules.self_collision="); });
        model.settings.push_back("rules.self_collision=none");
        reference.notes.push_back(
            "Self-collision is off: in the reference no two points come within reach of each other.");
    }
    reference.model = model.settings;

    const auto run = [&](int substeps) {
        Ending ending = run_to_end(described(substeps), frames, std::numeric_limits<double>::infinity(),
                                   [&](double share) { tick(0.3 + 0.6 * share); });
        if (!ending.finished)
            throw Refusal("the reference, " + std::string(method.name) + " with " + std::to_string(substeps) +
                          " substeps, diverges");
        return ending;
    };
    int substeps = first; // of h
    std::array<Ending, 3> endings{run(substeps), run(2 * substeps), run(4 * substeps)};
    const auto q = static_cast<std::size_t>(quantity);
    Errors coarse, fine;
    for (;;) {
        coarse = errors_between(endings[0], endings[1]);
        fine = errors_between(endings[1], endings[2]);
        const bool converging = fine[q] > small_enough && coarse[q] > still_falling * fine[q];
        if (!converging || 8 * substeps > std::min(2 * finest, most_substeps) || 2 * endings[2].seconds > budget)
            break;
        substeps *= 2;
        endings = {std::move(endings[1]), std::move(endings[2]), run(4 * substeps)};
    }
    for (std::size_t i = 0; i < coarse.size(); ++i)
        reference.error[i] = refined_error(coarse[i], fine[i], method.order);
    reference.substeps = {substeps, 2 * substeps, 4 * substeps};
    reference.description = described(4 * substeps);
    reference.ending = std::move(endings[2]);
    return reference;
}

} // namespace clothlab::experiments

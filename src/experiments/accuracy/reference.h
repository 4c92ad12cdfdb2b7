// The exact motion, as nearly as it can be found, how nearly that is, and whether it can be found at all.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "experiments/accuracy/run.h"
#include "experiments/findings.h"

namespace clothlab::experiments {

/// How far every coordinate of the start is moved at most, to see what becomes of it, in m.
inline constexpr double perturbation = 1e-10;
/// By how much the largest distance between a run and a perturbed one may grow. Errors of a method, 1e-6 m perhaps
/// where a bench of them begins, grow as much; beyond this they would say more of the scene than of the method.
inline constexpr double most_growth = 1e4;

/// A state with every free point and its previous position moved by the same random vector, every coordinate within
/// +-`by` m, so that velocities stay. Of double precision, as Simulation::save_state gives it.
std::vector<std::byte> perturbed(const std::vector<std::byte>& state, const std::vector<sim::GridPoint>& pinned,
                                 double by);

/// How a perturbed start runs away from one that is not.
struct Growth {
    double factor = 1;               ///< of the largest distance between the two, from the start to the end
    double apart = 0;                ///< m, at the end
    std::uint64_t predictable = 0;   ///< whole frames until the factor first was above most_growth
    std::uint64_t self_contacts = 0; ///< of both runs
};
/// Throws Refusal when either diverges.
Growth measure_growth(const sim::Description& description, std::uint64_t frames, const Tick& tick);

struct Reference {
    Settings settings; ///< on top of the experiment's scene
    sim::Description description;
    Ending ending;
    Errors error{};                ///< its own, estimated
    std::array<int, 3> substeps{}; ///< h, h/2 and h/4
    Growth growth;
    Settings model; ///< of all runs, on top of the experiment's scene
    std::vector<std::string> notes;
};

/// `finest`: the largest number of substeps that methods are run with; the reference takes no more than twice as many,
/// but for the sake of its stability. It is refined until `quantity` does not change any more, or a run would take
/// longer than `budget` s. Throws Refusal where the scene has no motion that can be found: chaos, divergence.
Reference find_reference(const scene::Scene& scene, std::uint64_t frames, int finest, ErrorQuantity quantity,
                         double budget, const Tick& tick);

} // namespace clothlab::experiments

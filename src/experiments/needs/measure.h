// Runs a model and keeps of it what others are compared by.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/findings.h"
#include "experiments/needs/proofs.h"
#include "experiments/trial.h"
#include "sim/monitor.h"

namespace clothlab::experiments::needs {

/// What a tolerance is given in.
enum class Quantity : std::uint8_t {
    rms,           ///< root mean square distance of the points from where the full model has them
    largest,       ///< the same of the point that is furthest away
    drape,         ///< height from the lowest to the highest point
    sag,           ///< how far the mean height of the points has sunk since the start
    first_contact, ///< time at which a point first touches a collider
    energy,        ///< kinetic, of springs and of gravity together
};

struct QuantityInfo {
    Quantity id;
    std::string_view name;  ///< as the command line writes it
    std::string_view title; ///< as people read it
    std::string_view unit;
    double per_si; ///< units in one of m, s or J
};
/// In the order of Quantity.
std::span<const QuantityInfo> quantities();
const QuantityInfo& info(Quantity quantity);

/// What all runs have in common.
struct Course {
    std::uint64_t frames = 90;
    std::uint64_t every = 2; ///< frames from one comparison to the next; the last frame is always one
    int threads = 1;
    double seconds = 1; ///< simulated, of all frames
};
/// About fifty comparisons.
Course course_of(const sim::Description& description, std::uint64_t frames, int threads);

struct Record {
    std::vector<Shape> shapes;                                      ///< at each comparison
    std::vector<double> energies;                                   ///< J
    std::vector<double> times;                                      ///< s
    double start_height = 0;                                        ///< m, of all points on average
    double first_contact = std::numeric_limits<double>::infinity(); ///< s
    Deeds deeds;
    std::optional<sim::Trouble> trouble; ///< that it ended at
    bool given_up = false;               ///< as it took longer than it may
    double wall_s = 0, simulated_s = 0;
    std::uint64_t hash = 0; ///< of the state at the end

    bool complete() const { return !trouble && !given_up; }
};

/// Runs a model. It ends early at a divergence or a jitter, and when its steps have taken `most_wall_s`. With `nudged`,
/// all free points start elsewhere by up to nudge() along each axis, at random.
Record record(const sim::Description& model, const Course& course, const Progress& progress,
              double most_wall_s = std::numeric_limits<double>::infinity(), bool nudged = false);

/// m: 1e-10, or what the precision can tell apart in the scene's largest coordinate if that is more.
double nudge(const sim::Simulation& start);

/// How far a complete run is from the full model's, in the quantity's unit: the largest of all comparisons, or that at
/// the end. Distances are taken at all of the full model's points, between which a coarser grid is interpolated.
/// Infinity where one run has a first contact and the other has none, and for what is not finite.
double deviation(Quantity quantity, const Record& full, const Record& other, bool at_end);
/// The same at each comparison; of first_contact, once.
std::vector<double> deviations(Quantity quantity, const Record& full, const Record& other);

} // namespace clothlab::experiments::needs

#include "experiments/needs/chaos.h"

#include <cmath>

#include "experiments/needs/words.h"

namespace clothlab::experiments::needs {
namespace {

std::string amount(Quantity quantity, double value) {
    return words::number(value) + " " + std::string(info(quantity).unit);
}

/// The time of the last comparison before the tolerance was broken; 0 where none was.
double good_until(const Config& config, const Record& full, const std::vector<double>& moved) {
    double until = 0;
    for (std::size_t i = 0; i < moved.size() && moved[i] <= config.tolerance; ++i)
        until = full.times[i];
    return until;
}

/// Other quantities, with what the same nudge moves them by; of the same unit, those that it moves little enough.
std::vector<std::string> steadier(const Config& config, const Record& full, const Record& nudged) {
    std::vector<std::string> list;
    for (const QuantityInfo& other : quantities()) {
        if (other.id == config.quantity || (other.id == Quantity::first_contact && std::isinf(full.first_contact)))
            continue;
        const double moved = deviation(other.id, full, nudged, config.at_end);
        if (other.unit != info(config.quantity).unit || moved <= config.tolerance)
            list.push_back("--quantity " + std::string(other.name) + ", which moves by " + amount(other.id, moved));
    }
    return list;
}

} // namespace

void require_sound(const Config& config, const Record& full) {
    if (full.trouble)
        throw Refusal(config.source + ": the full model is no yardstick, as it " +
                      (full.trouble->status == sim::Status::jitter ? "jitters" : "diverges") + ": " +
                      full.trouble->cause +
                      ". More substeps or a smaller ks may help; see `clothlab experiment stability`");
    if (config.quantity == Quantity::first_contact && std::isinf(full.first_contact))
        throw Refusal(config.source + ": no point touches a collider within " + words::number(full.simulated_s) +
                      " s, so there is no first contact to compare; give it more --seconds or another --quantity");
}

double noise_of(const Config& config, const Record& full, const Record& nudged, double nudge) {
    if (!nudged.complete())
        throw Refusal(config.source + ": the full model is no yardstick: with its start nudged by " +
                      words::number(nudge) + " m it fails: " + nudged.trouble->cause);
    const double moved = deviation(config.quantity, full, nudged, config.at_end);
    if (moved <= config.tolerance)
        return moved;
    std::string why = config.source + ": chaotic over " + words::number(full.simulated_s) +
                      " s: a nudge of the start by " + words::number(nudge) + " m alone moves the " +
                      std::string(info(config.quantity).title) + " by " + amount(config.quantity, moved) +
                      ", more than the tolerance of " + amount(config.quantity, config.tolerance) +
                      ", so no model can be told to be within it";
    std::vector<std::string> instead;
    const std::vector<double> over_time = deviations(config.quantity, full, nudged);
    const double until = over_time.size() > 1 ? good_until(config, full, over_time) : 0;
    if (until > 0)
        instead.push_back("--seconds " + words::number(std::floor(until * 100) / 100) +
                          ", as long as it is predictable");
    for (const std::string& other : steadier(config, full, nudged))
        instead.push_back(other);
    if (config.scene.simulation.stepping.precision == sim::Precision::single_precision)
        instead.emplace_back("--set simulation.precision=double, in which the nudge is 1e-10 m");
    instead.emplace_back("a larger --tolerance");
    why += ". Use ";
    for (std::size_t i = 0; i < instead.size(); ++i)
        why += (i == 0 ? "" : "; or ") + instead[i];
    throw Refusal(why);
}

} // namespace clothlab::experiments::needs

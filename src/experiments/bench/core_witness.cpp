#include "experiments/bench/core_witness.h"

#include <algorithm>
#include <utility>

namespace clothlab::experiments {

CoreWitness::CoreWitness(std::function<double(int)> rate) : rate_(std::move(rate)) {}

double CoreWitness::ask(int threads) {
    const double rate = rate_(threads);
    best_[threads] = std::max(best_[threads], rate);
    return rate;
}

bool CoreWitness::alone(double rate, int threads) const {
    const auto best = best_.find(threads);
    return best == best_.end() || rate >= 0.9 * best->second;
}

} // namespace clothlab::experiments

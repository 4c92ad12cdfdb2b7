#include "timeline/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/simulation.h"

namespace clothlab::timeline {
namespace {

std::uint64_t end_of(const Timeline& timeline, BranchId line) {
    return timeline.line(line).front()->end;
}

/// The grid of a line: nothing that changes it is done live.
std::array<int, 2> grid_of(const Timeline& timeline, BranchId line) {
    const sim::Cloth& cloth = timeline.line(line).back()->start->cloth;
    return {cloth.num_width_points, cloth.num_height_points};
}

bool comparable(const Timeline& timeline, BranchId a, BranchId b) {
    return timeline.find(a) && timeline.find(b) && grid_of(timeline, a) == grid_of(timeline, b);
}

/// In s, with a little for rounding: how far the nearest step of a line may be from a time that it has reached.
double half_a_step(const Timeline& timeline, const Moment& moment) {
    return 0.501 * clock_at(timeline.owner(moment), moment.step).dt;
}

/// The last step that two lines have in common; 0 for two runs of their own, whose starts are compared too.
std::uint64_t parting(const Timeline& timeline, BranchId a, BranchId b) {
    const std::vector<const Branch*> of_a = timeline.line(a), of_b = timeline.line(b);
    if (of_a.back() != of_b.back())
        return 0;
    // From the root on, as far as both are the same branch.
    std::size_t same = 0;
    const auto from_root = [](const auto& line, std::size_t i) { return line[line.size() - 1 - i]; };
    while (same < std::min(of_a.size(), of_b.size()) && from_root(of_a, same) == from_root(of_b, same))
        ++same;
    const auto leaves = [&](const auto& line) {
        return same < line.size() ? from_root(line, same)->fork_step : line.front()->end;
    };
    return std::min(leaves(of_a), leaves(of_b));
}

/// The step of a line whose time is nearest to one in s, and how far that is away.
std::pair<std::uint64_t, double> nearest_step(const Timeline& timeline, BranchId line, double time) {
    const auto time_of = [&](std::uint64_t step) { return timeline.frame_time({line, step}).time; };
    const std::uint64_t end = end_of(timeline, line);
    std::uint64_t low = 0, high = end; // the first step that is not earlier, or the last of all
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (time_of(middle) < time)
            low = middle + 1;
        else
            high = middle;
    }
    const double after = std::abs(time_of(low) - time);
    if (low > 0) {
        const double before = std::abs(time_of(low - 1) - time);
        if (before < after)
            return {low - 1, before};
    }
    return {low, after};
}

void positions_of(const sim::Simulation& simulation, std::vector<float>& positions) {
    positions.resize(3 * simulation.points());
    for (std::size_t i = 0; i < simulation.points(); ++i) {
        const sim::Vec3 p = simulation.position(i);
        positions[3 * i] = static_cast<float>(p.x);
        positions[3 * i + 1] = static_cast<float>(p.y);
        positions[3 * i + 2] = static_cast<float>(p.z);
    }
}

} // namespace

Distance distance(std::span<const float> a, std::span<const float> b, std::vector<float>& each) {
    if (a.size() != b.size() || a.size() % 3 != 0)
        throw std::invalid_argument("cloths of " + std::to_string(a.size() / 3) + " and " +
                                    std::to_string(b.size() / 3) + " points have no distance");
    const std::size_t points = a.size() / 3;
    each.resize(points);
    if (points == 0)
        return {};
    // As many sums as a vector has lanes, so that their order is fixed.
    constexpr std::size_t lanes = 8;
    constexpr double most_finite = std::numeric_limits<double>::max();
    std::array<double, lanes> sums{}, most{};
    const auto add = [&](std::size_t i, std::size_t lane) {
        double squared = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double d = static_cast<double>(a[3 * i + axis]) - static_cast<double>(b[3 * i + axis]);
            squared += d * d;
        }
        squared = squared <= most_finite ? squared : 0.0; // nor what is no number
        each[i] = static_cast<float>(std::sqrt(squared));
        sums[lane] += squared;
        most[lane] = squared > most[lane] ? squared : most[lane];
    };
    std::size_t i = 0;
    for (; i + lanes <= points; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            add(i + lane, lane);
    for (; i < points; ++i)
        add(i, 0);
    double sum = 0;
    for (const double part : sums)
        sum += part;
    return {std::sqrt(sum / static_cast<double>(points)), std::sqrt(*std::max_element(most.begin(), most.end()))};
}

std::optional<Moment> same_time(const Timeline& timeline, const Moment& moment, BranchId other) {
    if (!comparable(timeline, moment.branch, other))
        return {};
    const auto [step, away] = nearest_step(timeline, other, timeline.frame_time(moment).time);
    const Moment there{other, step};
    if (away > half_a_step(timeline, there) || !timeline.reachable(there))
        return {};
    return there;
}

Comparison::Comparison(Timeline timeline, BranchId a, BranchId b, const sim::Execution& execution)
    : timeline_(std::move(timeline)), a_(a), b_(b), reader_a_(execution), reader_b_(execution) {
    if (!comparable(timeline_, a, b))
        return;
    first_ = next_ = timeline_.frame_time({a, parting(timeline_, a, b)}).frame;
    find_end();
}

void Comparison::find_end() {
    const std::uint64_t frames = timeline_.frame_time({a_, end_of(timeline_, a_)}).frame;
    const Moment last{b_, end_of(timeline_, b_)};
    const double until = timeline_.frame_time(last).time + half_a_step(timeline_, last);
    std::uint64_t low = first_, high = frames + 1;
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (timeline_.frame_time({a_, timeline_.step_of_frame(a_, middle)}).time <= until)
            low = middle + 1;
        else
            high = middle;
    }
    end_ = low;
}

void Comparison::grow(Timeline timeline) {
    if (!comparable(timeline_, a_, b_) || !comparable(timeline, a_, b_))
        return;
    timeline_ = std::move(timeline);
    find_end();
}

bool Comparison::advance() {
    while (next_ < end_) {
        const std::uint64_t frame = next_++;
        const Moment here{a_, timeline_.step_of_frame(a_, frame)};
        if (!timeline_.reachable(here))
            continue;
        const std::optional<Moment> there = same_time(timeline_, here, b_);
        if (!there)
            continue;
        reader_a_.seek(timeline_, here);
        reader_b_.seek(timeline_, *there);
        std::vector<float> a, b;
        positions_of(reader_a_.simulation(), a);
        positions_of(reader_b_.simulation(), b);
        samples_.push_back({frame, timeline_.frame_time(here).time, timeline::distance(a, b, each_)});
        return true;
    }
    return false;
}

double Comparison::progress() const {
    return next_ < end_ ? static_cast<double>(next_ - first_) / static_cast<double>(end_ - first_) : 1;
}

} // namespace clothlab::timeline

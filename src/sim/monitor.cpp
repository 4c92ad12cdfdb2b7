#include "sim/monitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <variant>

#include "sim/integrators/integrator.h"
#include "sim/stability.h"

namespace clothlab::sim {
namespace {

struct Threshold {
    double turning; ///< change over displacement
    double change;  ///< in shortest rest lengths
};
/// Of a mode at the limit of Verlet the change is 2 displacements, of Dormand-Prince 0.96, the least of all methods
/// that have a limit; under the stretch limit it settles at 0.15 rest lengths. Sound is: cloth at ks 200 000, just
/// below Verlet's limit, that folds onto itself, up to 0.45.
constexpr Threshold beyond_limit{0.8, 1e-2};
/// Methods that amplify every oscillation raise slower ones too: explicit Euler settles at 0.3, and 0.006 rest lengths.
constexpr Threshold without_limit{0.2, 3e-3};
constexpr int frames_on_end = 5;
/// Of the change over those frames; what grows faster is on its way to infinity, unless something stops it.
constexpr double still_bounded = 2;

/// Frames; to keep the sound pose more often would cost more.
constexpr std::uint64_t sound_every = 8;

/// Sums over all points and coordinates.
struct Motion {
    double displacement = 0; ///< m², of both steps, squared and summed
    double change = 0;       ///< m², of their differences
    double extent = 0;       ///< m, diagonal of the bounding box
    bool finite() const { return std::isfinite(displacement) && std::isfinite(change) && std::isfinite(extent); }
};

/// Sums in lanes and blocks: lanes for the compiler to vectorise, blocks to bound the rounding of single precision.
template <class Real>
Motion motion(const State<Real>& state, const Vec3Array<Real>& before) {
    constexpr std::size_t lanes = 16, block = 4096;
    Motion sum;
    double square_extent = 0;
    const std::size_t n = state.position.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real *x = state.position.axes()[axis], *p = state.previous.axes()[axis], *q = before.axes()[axis];
        Real low[lanes], high[lanes];
        std::fill(low, low + lanes, x[0]);
        std::fill(high, high + lanes, x[0]);
        for (std::size_t begin = 0; begin < n; begin += block) {
            const std::size_t end = std::min(n, begin + block), whole = begin + (end - begin) / lanes * lanes;
            Real displacement[lanes] = {}, change[lanes] = {};
            const auto add = [&](std::size_t i, std::size_t lane) {
                const Real now = x[i] - p[i], then = p[i] - q[i], turn = now - then;
                displacement[lane] += now * now + then * then;
                change[lane] += turn * turn;
                low[lane] = x[i] < low[lane] ? x[i] : low[lane];
                high[lane] = x[i] > high[lane] ? x[i] : high[lane];
            };
            for (std::size_t i = begin; i < whole; i += lanes)
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    add(i + lane, lane);
            for (std::size_t i = whole; i < end; ++i)
                add(i, i - whole);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                sum.displacement += static_cast<double>(displacement[lane]);
                sum.change += static_cast<double>(change[lane]);
            }
        }
        const double side = static_cast<double>(*std::max_element(high, high + lanes)) -
                            static_cast<double>(*std::min_element(low, low + lanes));
        square_extent += side * side;
    }
    sum.extent = std::sqrt(square_extent);
    return sum;
}

/// The point whose motion changed most in the last step, or the first that is not finite.
template <class Real>
std::size_t worst_point(const State<Real>& state, const Vec3Array<Real>& before) {
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = [&](const Vec3Array<Real>& array) { return static_cast<double>(array.axes()[axis][i]); };
            const double turn = at(state.position) - 2 * at(state.previous) + at(before);
            square += turn * turn;
        }
        if (!std::isfinite(square))
            return i;
        if (square > most) {
            most = square;
            worst = i;
        }
    }
    return worst;
}

template <class Real>
bool all_finite(const Vec3Array<Real>& array) {
    for (const Real* axis : array.axes())
        for (std::size_t i = 0; i < array.size(); ++i)
            if (!std::isfinite(axis[i]))
                return false;
    return true;
}

std::string text(const char* format, auto... arguments) {
    char buffer[320];
    std::snprintf(buffer, sizeof buffer, format, arguments...);
    return buffer;
}

/// What lies on a collider hops, and that is sound: falls into it by g dt², and is put back or onto a plane's offset.
/// The most by which that changes the displacement, in m.
template <class Real>
double hop(const Model<Real>& model) {
    const auto is_plane = [](const auto& c) { return std::holds_alternative<PlaneModel<Real>>(c); };
    const double offset = std::any_of(model.colliders.begin(), model.colliders.end(), is_plane) ? plane_offset : 0;
    const auto d = [](Real v) { return static_cast<double>(v); };
    return model.colliders.empty() ? 0
                                   : offset + std::hypot(d(model.gx), d(model.gy), d(model.gz)) * model.dt * model.dt;
}

/// 218 600: groups of three digits, as people read them.
std::string grouped(double value) {
    std::string digits = text("%.0f", value);
    for (std::size_t end = digits.size(); end > 3 && std::abs(value) < 1e12; end -= 3)
        if (digits[end - 4] != '-')
            digits.insert(end - 3, " ");
    return std::abs(value) < 1e12 ? digits : text("%.3g", value);
}

/// Why: the stability margin of the last sound pose or, if that is within the limit, of the one that is left.
template <class Real>
std::string reason(const Model<Real>& model, const Vec3Array<Real>& sound, const Vec3Array<Real>& now) {
    const IntegratorTraits& method = traits(model.integrator);
    if (model.mass < 0)
        return "the density is negative, so springs push where they should pull";
    if (!all_finite(sound))
        return "it was so from the beginning";
    StabilityMargin margin = stability_margin(model, sound);
    if (margin.stable() && all_finite(now))
        margin = stability_margin(model, now);
    const std::string name(method.title);
    if (margin.limit == no_limit && margin.omega_dt > 1)
        return text("%s is stable, but its step does not resolve the springs (omega dt = %.3g): what contacts, wind or "
                    "accelerations set off rings on",
                    name.c_str(), margin.omega_dt);
    if (margin.omega_dt <= margin.limit)
        return text("not by stiffness (omega dt = %.3g <= %.3g); look at contacts, wind, damping and accelerations",
                    margin.omega_dt, margin.limit);
    if (margin.limit == 0)
        return text("%s amplifies every oscillation, whatever the step (omega dt = %.3g)", name.c_str(),
                    margin.omega_dt);
    const double ks = static_cast<double>(model.k[0]);
    return text("omega dt = %.4g > %.4g: ks %s too stiff for %d substep%s; %s substeps would do", margin.omega_dt,
                margin.limit, grouped(ks).c_str(), model.substeps, model.substeps == 1 ? "" : "s",
                grouped(margin.substeps_min).c_str());
}

} // namespace

template <class Real>
void Monitor<Real>::begin(const State<Real>& state) {
    trouble_.reset();
    jittery_frames_ = 0;
    before_ = state.previous;
    sound_ = state.position;
}

template <class Real>
void Monitor<Real>::before_last_step(const State<Real>& state) {
    before_ = state.previous;
}

template <class Real>
void Monitor<Real>::end_of_frame(const Model<Real>& model, const State<Real>& state, std::uint64_t frame) {
    if (trouble_ && trouble_->status == Status::diverged)
        return;
    const Grid<Real>& grid = *model.grid;
    const Motion now = motion(state, before_);
    const auto report = [&](Status status, const char* what) {
        const auto point = static_cast<int>(worst_point(state, before_));
        Trouble found{status, state.time, frame, point % grid.columns, point / grid.columns, {}};
        const std::string since = trouble_ ? text(", after jitter since %.4g s", trouble_->time) : "";
        found.cause = text("at %.4g s (frame %llu) %s%s, worst at column %d, row %d: ", found.time,
                           static_cast<unsigned long long>(frame), what, since.c_str(), found.column, found.row) +
                      reason(model, sound_, state.position);
        trouble_ = std::move(found);
    };
    const auto free = static_cast<double>(state.position.size() - model.pins.size());
    const double change = std::sqrt(now.change / std::max(free, 1.0));
    if (!now.finite() && !(all_finite(state.position) && all_finite(state.previous)))
        return report(Status::diverged, "positions are no longer finite");
    if (!now.finite() || now.extent > blown_up * grid.diagonal)
        return report(Status::diverged, "the cloth is over 100 times its own size");
    if (change > grid.diagonal)
        return report(Status::diverged, "points change course by the size of the cloth in one step");
    const Threshold& least = traits(model.integrator).limit(0) == 0 ? without_limit : beyond_limit;
    const bool turns = now.change > least.turning * least.turning * 0.5 * now.displacement;
    if (!turns || change < std::max(least.change * static_cast<double>(grid.shortest), hop(model))) {
        jittery_frames_ = 0;
        if (frame % sound_every == 0)
            sound_ = state.position;
        return;
    }
    const auto slot = static_cast<std::size_t>(jittery_frames_ % frames_on_end);
    const double first = recent_[slot];
    recent_[slot] = change;
    if (++jittery_frames_ > frames_on_end && change < still_bounded * first && !trouble_)
        report(Status::jitter, "points jitter");
}

template class Monitor<float>;
template class Monitor<double>;

} // namespace clothlab::sim

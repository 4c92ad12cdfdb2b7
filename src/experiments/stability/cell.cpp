#include "experiments/stability/cell.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "experiments/findings.h"
#include "experiments/stability/fastest_mode.h"
#include "experiments/stability/start_displacement.h"
#include "experiments/stability/unrest.h"
#include "scene/frames.h"
#include "sim/integrators/integrator.h"
#include "sim/simulation.h"

namespace clothlab::experiments {
namespace {

/// Frames that a jitter is followed on, to see whether the stretch limit holds it.
constexpr int frames_of_jitter = 10;
constexpr std::uint64_t frames_between_poses = 10;
/// Steps that the growth is fitted to, and the least that counts: rounding leaves some 1e-10.
constexpr std::size_t fitted_steps = 400;
constexpr double least_gain = 1e-8;

std::string text(const char* format, auto... arguments) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, arguments...);
    return buffer;
}

/// Whether a step is one step of an explicit method, not divided by a tolerance: only those have a limit.
bool has_own_steps(const sim::Stepping& stepping) {
    const sim::IntegratorTraits& method = sim::traits(stepping.integrator);
    return method.family == sim::Family::explicit_method && !(method.divides_steps && stepping.tolerance > 0);
}

/// Whether a frame leaves every point where it starts, to rounding.
bool stays(const sim::Description& description) {
    const auto simulation = sim::Simulation::create(description);
    std::vector<sim::Vec3> start;
    for (std::size_t i = 0; i < simulation->points(); ++i)
        start.push_back(simulation->position(i));
    simulation->step_frame();
    const double tiny = 1e-12 * shortest_spring(description);
    for (std::size_t i = 0; i < start.size(); ++i) {
        const sim::Vec3 p = simulation->position(i);
        if (!(std::hypot(p.x - start[i].x, p.y - start[i].y, p.z - start[i].z) <= tiny))
            return false;
    }
    return true;
}

/// How much of the mode a run has, in m.
class ModeSeries {
public:
    ModeSeries(const sim::Simulation& simulation, std::vector<sim::Vec3> shape) : shape_(std::move(shape)) {
        for (std::size_t i = 0; i < shape_.size(); ++i)
            start_.push_back(simulation.position(i));
    }
    bool full() const { return series_.size() >= fitted_steps; }
    void add(const sim::Simulation& simulation) {
        double sum = 0;
        for (std::size_t i = 0; i < shape_.size(); ++i) {
            const sim::Vec3 p = simulation.position(i), &q = start_[i], &s = shape_[i];
            sum += s.x * (p.x - q.x) + s.y * (p.y - q.y) + s.z * (p.z - q.z);
        }
        series_.push_back(sum);
    }
    /// The larger root's modulus, less 1.
    double gain() const { return growth_per_step(series_) - 1; }

private:
    std::vector<sim::Vec3> shape_, start_;
    std::vector<double> series_;
};

} // namespace

std::uint64_t frames_of(const sim::Description& description, const JudgeConfig& config) {
    if (config.frames)
        return *config.frames;
    if (config.seconds)
        return scene::frames_of(*config.seconds, description);
    const auto substeps = static_cast<std::uint64_t>(description.stepping.substeps);
    return std::max(scene::frames_of(default_seconds, description), (default_steps + substeps - 1) / substeps);
}

Judged judge(const sim::Description& description, const JudgeConfig& config, const Check& check, bool poses) {
    Judged result;
    try {
        const auto simulation = sim::Simulation::create(description);
        const sim::StabilityMargin margin = simulation->stability();
        result.limit = margin.limit;
        result.omega_dt = result.pose_omega_dt = margin.omega_dt;

        std::optional<std::vector<sim::Vec3>> mode;
        if (description.stepping.precision == sim::Precision::double_precision && has_own_steps(description.stepping) &&
            stays(description))
            mode = fastest_mode(description);
        std::optional<ModeSeries> series;
        if (mode)
            series.emplace(*simulation, *mode);
        displace(*simulation, start_noise * shortest_spring(description), mode ? *mode : noise(description));
        simulation->watch(true);
        if (series)
            series->add(*simulation);

        std::optional<Unrest> unrest;
        if (has_own_steps(description.stepping))
            unrest.emplace(description);

        const std::uint64_t frames = frames_of(description, config);
        std::uint64_t end = frames;
        std::optional<double> unrest_since;
        while (simulation->frame() < end) {
            const std::uint64_t frame = simulation->frame();
            while (simulation->frame() == frame) {
                check();
                simulation->step();
                if (series && !series->full())
                    series->add(*simulation);
                if (unrest)
                    unrest->after_step(*simulation);
            }
            if (simulation->trouble() && simulation->trouble()->status == sim::Status::diverged)
                break;
            if (unrest && unrest->found() && !unrest_since)
                unrest_since = simulation->time();
            if ((simulation->trouble() || unrest_since) && end == frames)
                end = std::min(frames, simulation->frame() + frames_of_jitter);
            if (poses && simulation->frame() % frames_between_poses == 0)
                result.pose_omega_dt = std::max(result.pose_omega_dt, simulation->stability().omega_dt);
        }
        result.steps = simulation->steps();
        result.time = simulation->time();
        if (series)
            result.gain = series->gain();
        if (const std::optional<sim::Trouble>& trouble = simulation->trouble()) {
            result.verdict = trouble->status == sim::Status::diverged ? Verdict::diverged : Verdict::jittering;
            result.time = trouble->time;
            result.cause = trouble->cause;
        } else if (unrest_since) {
            result.verdict = Verdict::jittering;
            result.time = *unrest_since;
            result.cause = text("at %.4g s (frame %.0f) points turn round in every step or two, under their motion",
                                *unrest_since, *unrest_since * description.stepping.frames_per_second);
        } else if (result.gain && *result.gain > least_gain) {
            result.verdict = Verdict::growing;
            result.cause = text("the fastest oscillation gains %.3g of itself in every step", *result.gain);
        }
    } catch (const std::invalid_argument& e) {
        throw Refusal(e.what());
    }
    return result;
}

} // namespace clothlab::experiments

// One run, until it is judged: stable or not.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "experiments/run_parallel.h"
#include "sim/description.h"

namespace clothlab::experiments {

/// Growing: no trouble by the end of the run, but the fastest oscillation gains in every step, so that trouble comes.
/// Jittering: unstable, but bounded by the stretch limit or by how springs stretch. Diverged: not bounded.
enum class Verdict : std::uint8_t { stable, growing, jittering, diverged };
inline constexpr std::array<const char*, 4> verdict_names{"stable", "growing", "jittering", "diverged"};

struct JudgeConfig {
    /// How long a run is; without both, until it has lasted default_seconds and default_steps.
    std::optional<std::uint64_t> frames;
    std::optional<double> seconds;
};

/// An oscillation that is 0.1 % of ks beyond the limit grows by exp(0.06) a step with Verlet and 0.2 % damping, by
/// exp(0.0036) with Runge-Kutta 4: from start_noise to where trouble is seen it takes 110 and 1900 steps.
inline constexpr double default_seconds = 1;
inline constexpr std::uint64_t default_steps = 3000;

/// In rest lengths of the shortest spring: by how much points are moved at the start.
inline constexpr double start_noise = 1e-5;

struct Judged {
    Verdict verdict = Verdict::stable;
    double time = 0; ///< s, of the first trouble; of a sound run, its end
    std::uint64_t steps = 0;
    std::string cause;        ///< a sentence; empty for sound runs
    double omega_dt = 0;      ///< of the start pose
    double limit = 0;         ///< of omega_dt
    double pose_omega_dt = 0; ///< the largest over the poses of the run, where asked for; else that of the start
    /// How much the fastest oscillation gains in a step, less 1, where it was measured.
    std::optional<double> gain;
};

/// Frames that a run has at most.
std::uint64_t frames_of(const sim::Description& description, const JudgeConfig& config);

/// Runs a cloth in one thread and judges it.
///
/// At the start, points that are not pinned are moved a little, because a symmetric cloth has nothing of the fastest
/// mode, and what is zero does not grow. Where the cloth stays where it starts without that (a straight chain, no
/// gravity), it is moved in the shape of its fastest mode, and otherwise at random, the same in every run. Then
/// sim::Monitor looks at the end of every frame (Simulation::watch), and Unrest for what it does not see. A divergence
/// ends the run; a jitter ends it some frames later, in which it may still diverge.
///
/// Of a cloth that stays where it starts all motion is that mode, and a step of any explicit one step method on it
/// obeys x(n+1) = s x(n) - p x(n-1): s and p are fitted to the run's own first steps, and the larger root says what a
/// step makes of the oscillation. So a growth is found that would take a million steps to become trouble (of
/// Dormand-Prince 3e-7 a step at 0.1 % beyond its limit). In double precision only, and where one mode is the fastest.
///
/// With `poses`, the margin is computed at the end of every tenth frame. Throws Refusal for descriptions without
/// meaning. `check` is called in every step.
Judged judge(const sim::Description& description, const JudgeConfig& config, const Check& check, bool poses = false);

} // namespace clothlab::experiments

// Numbers that tell how a run is doing. All are summed in double precision, in index order, whatever the run's own
// precision is.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// A cloth whose bounding box is this many times its own size has blown up: springs do not stretch so far, and a cloth
/// that only falls or flies keeps its extent.
inline constexpr double blown_up = 100;

struct Energy {
    double kinetic = 0, spring = 0, gravity = 0; ///< J; gravity is zero at the origin
    double total() const { return kinetic + spring + gravity; }
};

struct Momentum {
    Vec3 linear;  ///< kg m/s
    Vec3 angular; ///< kg m²/s about the origin
};

/// Jitter: points hurl to and fro from step to step, but stay within bounds (Monitor).
enum class Status : std::uint8_t { ok, jitter, diverged };
inline constexpr std::array<const char*, 3> status_names{"ok", "jitter", "diverged"};

struct Diagnostics {
    Energy energy;
    double max_strain = 0; ///< largest (length - rest) / rest of any spring; 0 when all are compressed
    double rms_speed = 0;  ///< m/s
    Status status = Status::ok;
    std::string cause; ///< of anything but ok: a sentence
};

/// Energies, strain and speed of a state; velocities are its own, or, for methods that keep none, (position -
/// previous) / dt, those of the last half step.
template <class Real>
Diagnostics diagnose(const Model<Real>& model, const State<Real>& state);

/// Momenta about the origin, with velocities as above.
template <class Real>
Momentum momentum(const Model<Real>& model, const State<Real>& state);

/// A 64-bit hash of all that is in a state: equal for equal bits.
template <class Real>
std::uint64_t hash(const State<Real>& state);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template Diagnostics diagnose<Real>(const Model<Real>&, const State<Real>&);                                \
    extern template Momentum momentum<Real>(const Model<Real>&, const State<Real>&);                                   \
    extern template std::uint64_t hash<Real>(const State<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim

// How a run is computed, not what: instruction set and threads. Nothing here changes a bit of any result, so it is no
// part of a description, a scene or a state.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace clothlab::sim {

/// Which kernels compute a step. Every one gives the same bits.
enum class InstructionSet : std::uint8_t {
    automatic, ///< the fastest that this machine has
    scalar,    ///< no kernels: plain loops over springs and points
    vec128,    ///< vectors of 128 bits: SSE4, or SSE2 with a newer Highway; NEON
    avx2,
    avx512,
};

struct InstructionSetInfo {
    InstructionSet id;
    std::string_view name; ///< as the command line writes it
    std::string_view help;
};

/// All of them, in the order of InstructionSet.
std::span<const InstructionSetInfo> instruction_sets();
/// Whether this build has it and this machine can run it.
bool is_supported(InstructionSet set);
/// What `automatic` stands for here; any other set stands for itself.
InstructionSet resolve(InstructionSet set);

struct Execution {
    InstructionSet instructions = InstructionSet::automatic;
    int threads = 1; ///< at most so many, the caller's own among them
    /// Whether a run may use fewer threads where it measures that fewer are faster; if not, it uses all it was given.
    bool fewer_if_faster = true;
};

} // namespace clothlab::sim

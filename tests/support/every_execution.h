// All ways to compute a run that this machine has: instruction sets and numbers of threads.
#pragma once

#include <string>
#include <vector>

#include "sim/execution.h"

namespace clothlab::test {

inline std::vector<sim::InstructionSet> supported_sets() {
    std::vector<sim::InstructionSet> sets;
    for (const sim::InstructionSetInfo& set : sim::instruction_sets())
        if (set.id != sim::InstructionSet::automatic && sim::is_supported(set.id))
            sets.push_back(set.id);
    return sets;
}

inline std::string name_of(sim::InstructionSet set) {
    return std::string(sim::instruction_sets()[static_cast<std::size_t>(set)].name);
}

/// A run that uses all the threads it is given, however slow that is.
inline sim::Execution exactly(sim::InstructionSet set, int threads) {
    return {.instructions = set, .threads = threads, .fewer_if_faster = false};
}

} // namespace clothlab::test

#include "sim/execution.h"

#include <hwy/targets.h>

#include "sim/kernels/kernels.h"

namespace clothlab::sim {

std::span<const InstructionSetInfo> instruction_sets() {
    static constexpr InstructionSetInfo list[] = {
        {InstructionSet::automatic, "auto", "the fastest that this machine has"},
        {InstructionSet::scalar, "scalar", "no kernels: plain loops over springs and points"},
        {InstructionSet::vec128, "vec128", "vectors of 128 bits (SSE4, NEON)"},
        {InstructionSet::avx2, "avx2", "vectors of 256 bits"},
        {InstructionSet::avx512, "avx512", "vectors of 512 bits"},
    };
    return list;
}

bool is_supported(InstructionSet set) {
    switch (set) {
    case InstructionSet::automatic:
    case InstructionSet::scalar:
        return true;
    case InstructionSet::vec128:
        return kernels<float>(set) && (hwy::SupportedTargets() & (HWY_STATIC_TARGET | HWY_SSE4)) != 0;
    case InstructionSet::avx2:
        return kernels<float>(set) && (hwy::SupportedTargets() & HWY_AVX2) != 0;
    case InstructionSet::avx512:
        return kernels<float>(set) && (hwy::SupportedTargets() & HWY_AVX3) != 0;
    }
    return false;
}

InstructionSet resolve(InstructionSet set) {
    if (set != InstructionSet::automatic)
        return set;
    for (const InstructionSet best : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::vec128})
        if (is_supported(best))
            return best;
    return InstructionSet::scalar;
}

} // namespace clothlab::sim

// The table of all kernels of one precision, for each instruction set: included by one source file per precision, so
// that the two compile side by side.
//
// CLOTHLAB_KERNEL_REAL is the precision. (The design asks for one file per instruction set; Highway makes them of one.)

// Of x86's: SSE2 (bit 14, what every processor has), SSE4 (bit 11), AVX2 (bit 9) and AVX-512 (bit 8). Of ARM's: not
// those with vectors of unknown length.
#undef HWY_DISABLED_TARGETS
#if defined(__SANITIZE_THREAD__) // which has nothing new to see in the shortest vectors, and takes long to compile
#define HWY_DISABLED_TARGETS (0x3CFFLL | (0xFLL << 24))
#else
#define HWY_DISABLED_TARGETS (0x34FFLL | (0xFLL << 24))
#endif
#ifndef HWY_WANT_SSE4
#define HWY_WANT_SSE4 1
#endif

#include <hwy/foreach_target.h> // IWYU pragma: keep

#include <hwy/highway.h>

#include "sim/kernels/kernels.h"

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "sim/kernels/block_shapes-inl.h"
#include "sim/kernels/bucket_sort-inl.h"
#include "sim/kernels/cell_keys-inl.h"
#include "sim/kernels/contact_cells-inl.h"
#include "sim/kernels/contacts-inl.h"
#include "sim/kernels/limit_bands-inl.h"
#include "sim/kernels/near_pairs-inl.h"
#include "sim/kernels/spring_sweep-inl.h"
#include "sim/kernels/stretch_limit-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
/// An older Highway takes this for what every x86 processor has: no vectors, so no kernels.
template <class Real>
const Kernels<Real>* table() {
    return nullptr;
}
#else
template <unsigned kinds, class Real>
constexpr std::array<void (*)(const SweepArguments<Real>&), 3> sweeps() {
    return {sweep<kinds, SweepSink::verlet_damped, Real>, sweep<kinds, SweepSink::verlet, Real>,
            sweep<kinds, SweepSink::force, Real>};
}

template <class Real>
const Kernels<Real>* table() {
    static constexpr Kernels<Real> kernels{{sweeps<0, Real>(), sweeps<1, Real>(), sweeps<2, Real>(), sweeps<3, Real>(),
                                            sweeps<4, Real>(), sweeps<5, Real>(), sweeps<6, Real>(), sweeps<7, Real>()},
                                           sphere_contacts<Real>,
                                           plane_contacts<Real>,
                                           first_over_limit<Real>,
                                           limit<Real>,
                                           limit_band<Real>,
                                           proximity<Real>,
                                           far_pairs<Real>,
                                           keep_pairs<Real>,
                                           block_shapes<Real>,
                                           cell_keys<Real>,
                                           sort_by_bucket,
                                           cell_pass<Real>};
    return &kernels;
}
#endif

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clothlab::sim {

template <>
const Kernels<CLOTHLAB_KERNEL_REAL>* kernels<CLOTHLAB_KERNEL_REAL>(InstructionSet set) {
    switch (set) {
    case InstructionSet::automatic:
        return kernels<CLOTHLAB_KERNEL_REAL>(resolve(set));
    case InstructionSet::scalar:
        return nullptr;
    case InstructionSet::vec128:
#if (HWY_STATIC_TARGET == HWY_SCALAR || HWY_STATIC_TARGET == HWY_EMU128) && (HWY_TARGETS & HWY_SSE4)
        return N_SSE4::table<CLOTHLAB_KERNEL_REAL>();
#else
        return HWY_STATIC_DISPATCH(table)<CLOTHLAB_KERNEL_REAL>();
#endif
    case InstructionSet::avx2:
#if (HWY_TARGETS & HWY_AVX2)
        return N_AVX2::table<CLOTHLAB_KERNEL_REAL>();
#else
        return nullptr;
#endif
    case InstructionSet::avx512:
#if (HWY_TARGETS & HWY_AVX3)
        return N_AVX3::table<CLOTHLAB_KERNEL_REAL>();
#else
        return nullptr;
#endif
    }
    return nullptr;
}

} // namespace clothlab::sim
#endif

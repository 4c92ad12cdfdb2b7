#define HWY_TARGET_INCLUDE "sim/kernels/kernels_float.cpp"
#define CLOTHLAB_KERNEL_REAL float
#include "sim/kernels/kernels-inl.h"

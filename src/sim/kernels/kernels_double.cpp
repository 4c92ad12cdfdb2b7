#define HWY_TARGET_INCLUDE "sim/kernels/kernels_double.cpp"
#define CLOTHLAB_KERNEL_REAL double
#include "sim/kernels/kernels-inl.h"

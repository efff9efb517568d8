#pragma once

/// Instruction sets that wide kernels are not compiled for. Read before any header of Highway. Sizes
/// of registers are known to the compiler here.
#ifdef SWEPT_SIMD_FEW
// AVX2 alone: under sanitizers each set takes seconds to compile, and what clang has for plain processors minutes.
#define HWY_BROKEN_EMU128 1
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_AVX3 | HWY_AVX3_DL | HWY_SSE4 | HWY_SSSE3)
#else
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_AVX3_DL)
#endif

#pragma once

/// Instruction sets that the wide kernels of this folder are not compiled for. Read before Highway's foreach_target.h. Sizes of
/// registers are known to the compiler here; SSE4 is all there was to SSSE3, soon after it.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_AVX3_DL | HWY_SSSE3)

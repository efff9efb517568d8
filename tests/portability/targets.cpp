#include "../../shapes/wide_targets.h"
// after it
#include <hwy/targets.h>

#include <cstdint>

/// The part of Highway's library that kernels and suites ask which instruction sets there are, where its headers alone
/// are at hand. Machines with one need no choice.
namespace hwy {
namespace {

std::int64_t mocked = 0;

std::int64_t ofThisProcessor() {
#if HWY_ARCH_X86
    std::int64_t targets = HWY_STATIC_TARGET;
    if (__builtin_cpu_supports("ssse3")) { targets |= HWY_SSSE3; }
    if (__builtin_cpu_supports("sse4.2")) { targets |= HWY_SSE4; }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) {
        targets |= HWY_AVX2;
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
            targets |= HWY_AVX3;
        }
    }
    return targets;
#else
    static_assert((HWY_TARGETS & (HWY_TARGETS - 1)) == 0, "more than one instruction set asks for a choice");
    return HWY_STATIC_TARGET;
#endif
}

}  // namespace

std::int64_t SupportedTargets() { return mocked != 0 ? mocked : ofThisProcessor(); }

ChosenTarget& GetChosenTarget() {
    static ChosenTarget chosen;
    return chosen;
}

void SetSupportedTargetsForTest(std::int64_t targets) {
    mocked = targets;
    GetChosenTarget().DeInit();
}

}  // namespace hwy

#pragma once

#include "../../shapes/compiler.h"

#ifdef SWEPT_HAS_MSVC_INTRINSICS
#include <intrin.h>
#endif

namespace swept {

/// Tells the processor that this thread waits in a loop, where it has an instruction for that.
inline void spinPause() {
#if defined(SWEPT_HAS_GNU_EXTENSIONS) && (defined(__x86_64__) || defined(__i386__))
    __builtin_ia32_pause();
#elif defined(SWEPT_HAS_MSVC_INTRINSICS) && (defined(_M_X64) || defined(_M_IX86))
    _mm_pause();
#endif
}

}  // namespace swept

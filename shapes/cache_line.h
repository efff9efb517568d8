#pragma once

#include <cstddef>

#include "compiler.h"

#ifdef SWEPT_HAS_MSVC_INTRINSICS
#include <intrin.h>
#endif

namespace swept {

/// Bytes that processors hand to each other at once; on other machines than most, sharing is only slower.
inline constexpr std::size_t kCacheLine = 64;

/// Has the cache line at an address fetched, which need not be valid. (What only fetches has no effect that GCC knows
/// of: calls of such a function that it does not inline at once are dropped.)
SWEPT_FORCE_INLINE void prefetch(const void* address) {
#if defined(SWEPT_HAS_GNU_EXTENSIONS)
    __builtin_prefetch(address);
#elif defined(SWEPT_HAS_MSVC_INTRINSICS) && (defined(_M_X64) || defined(_M_IX86))
    _mm_prefetch(static_cast<const char*>(address), _MM_HINT_T0);
#else
    static_cast<void>(address);
#endif
}

/// Has the cache line of something that will be written soon fetched, and taken from whoever has a copy: to read it
/// first would bring a copy alone, and then the write waits for the others to give up theirs. (Processors of Intel
/// before Broadwell pass over it.)
template <class T>
SWEPT_FORCE_INLINE void fetchToWrite(const T& thing) {
#if defined(SWEPT_HAS_GNU_EXTENSIONS) && defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(thing));  // which compilers leave out unless told of a newer processor
#elif defined(SWEPT_HAS_GNU_EXTENSIONS)
    __builtin_prefetch(&thing, 1);
#elif defined(SWEPT_HAS_MSVC_INTRINSICS) && defined(_M_X64)
    _m_prefetchw(&thing);
#else
    prefetch(&thing);
#endif
}

}  // namespace swept

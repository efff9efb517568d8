#pragma once

#include <cstddef>

namespace swept {

/// Bytes that processors hand to each other at once; on other machines than most, sharing is only slower.
inline constexpr std::size_t kCacheLine = 64;

/// Has the cache line of something that will be written soon fetched, and taken from whoever has a copy: to read it
/// first would bring a copy alone, and then the write waits for the others to give up theirs. (Processors of Intel before
/// Broadwell pass over it.)
template <class T>
[[gnu::always_inline]] inline void fetchToWrite(const T& thing) {
#if defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(thing));  // which compilers leave out unless told of a newer processor
#else
    __builtin_prefetch(&thing, 1);
#endif
}

}  // namespace swept

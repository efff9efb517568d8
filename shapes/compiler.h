#pragma once

/// What compilers have beyond the language. Asked for here and in the headers that use it (lanes.h, cache_line.h,
/// engine/crew/spin_pause.h), nowhere else. With SWEPT_PLAIN_CPP (a CMake option) nothing of it is used: the same bits,
/// only slower. Clang is taken for GCC also where its command line is that of MSVC.
#if defined(SWEPT_PLAIN_CPP)
#define SWEPT_FORCE_INLINE inline
#define SWEPT_COLD
#elif defined(__GNUC__) || defined(__clang__)
#define SWEPT_HAS_GNU_EXTENSIONS
#define SWEPT_FORCE_INLINE [[gnu::always_inline]] inline
#define SWEPT_COLD [[gnu::noinline, gnu::cold]]
#elif defined(_MSC_VER)
#define SWEPT_HAS_MSVC_INTRINSICS
#define SWEPT_FORCE_INLINE __forceinline  // which warns of an `inline` beside it
#define SWEPT_COLD __declspec(noinline)
#else
#define SWEPT_FORCE_INLINE inline
#define SWEPT_COLD
#endif

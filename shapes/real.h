#pragma once

/// The scalar of a build. Every library folder except `toi/` is compiled twice from the same sources: with `SWEPT_F64`
/// defined as double, else as float. All that depends on the choice lives in the inline namespace `SWEPT_PRECISION`, so
/// that objects of different precision cannot be linked together by mistake, and a tool may link both on purpose.
/// What does not depend on it (`DVec2`, `Status`, `toi/`) lives in `swept` itself and is inline or compiled once.

#include <limits>

// Set by the targets swept2d::f32 and swept2d::f64: of both, the one would silently be taken for the other.
#if defined(SWEPT_LINKS_F32) && defined(SWEPT_LINKS_F64)
#error "linked with swept2d::f32 and with swept2d::f64: look at what its other dependencies link"
#endif

#if defined(SWEPT_F64)
#define SWEPT_PRECISION f64
#else
#define SWEPT_PRECISION f32
#endif

namespace swept::inline SWEPT_PRECISION {

#if defined(SWEPT_F64)
using Real = double;
#else
using Real = float;
#endif

/// Distance from 1 to the next larger `Real`.
inline constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();

constexpr Real square(Real x) { return x * x; }

}  // namespace swept::inline SWEPT_PRECISION

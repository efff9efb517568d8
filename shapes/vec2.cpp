#include "vec2.h"

#include <type_traits>

namespace swept::inline SWEPT_PRECISION {

UnitAndLength normalized(Vec2 a) {
    if (a == Vec2{}) { return {}; }
    if constexpr (std::is_same_v<Real, float>) {
        // No square of a float leaves the range of double, so nothing has to be scaled.
        const DVec2 exact = toDouble(a);
        const double size = swept::length(exact);
        return {toReal({exact.x / size, exact.y / size}), static_cast<Real>(size)};
    } else {
        // Squares within the range of double need no scaling; the result is the same to the bit.
        constexpr Real kSafe = Real(0x1p500L);
        const Real squared = lengthSquared(a);
        if (squared < kSafe && squared > 1 / kSafe) {
            const Real size = std::sqrt(squared);
            return {{a.x / size, a.y / size}, size};
        }
        int exponent = 0;
        std::frexp(std::fmax(std::fabs(a.x), std::fabs(a.y)), &exponent);
        const Vec2 scaled{std::ldexp(a.x, -exponent), std::ldexp(a.y, -exponent)};  // larger component in [½, 1)
        const Real size = length(scaled);
        return {{scaled.x / size, scaled.y / size}, std::ldexp(size, exponent)};
    }
}

}  // namespace swept::inline SWEPT_PRECISION

#include "aabb.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Part of a ray's line, as fractions.
struct Span {
    double from;
    double to;
};

// A fraction (bound − origin) / direction carries two roundings of ½ ulp, relative to itself. Three steps cover both,
// also where the quotient is subnormal.
constexpr int kFractionSteps = 3;

double stepsDown(double x) {
    if (!std::isfinite(x)) { return x; }
    for (int i = 0; i < kFractionSteps; ++i) { x = nextDown(x); }
    return x;
}

double stepsUp(double x) { return -stepsDown(-x); }

/// Where the line lies between two parallels, widened by the rounding; empty (from > to) if nowhere.
Span slab(double lower, double upper, double origin, double direction) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (direction == 0) {
        return lower <= origin && origin <= upper ? Span{-kInfinity, kInfinity} : Span{kInfinity, -kInfinity};
    }
    const double toLower = (lower - origin) / direction;
    const double toUpper = (upper - origin) / direction;
    return direction > 0 ? Span{stepsDown(toLower), stepsUp(toUpper)} : Span{stepsDown(toUpper), stepsUp(toLower)};
}

}  // namespace

RayHit rayCast(const Aabb& box, DVec2 origin, DVec2 direction, Real maxFraction) {
    const DVec2 lower = toDouble(box.lower);
    const DVec2 upper = toDouble(box.upper);
    const Span x = slab(lower.x, upper.x, origin.x, direction.x);
    const Span y = slab(lower.y, upper.y, origin.y, direction.y);
    const double enter = std::fmax(0.0, std::fmax(x.from, y.from));
    const double leave = std::fmin(x.to, y.to);
    if (!(enter <= leave) || enter > static_cast<double>(maxFraction)) { return {}; }
    return {.hit = true, .fraction = roundedDown(enter)};
}

}  // namespace swept::inline SWEPT_PRECISION

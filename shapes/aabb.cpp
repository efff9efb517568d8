#include "aabb.h"

#include "rounding.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// The largest `Real` not above a + b. The error of a rounded sum is itself a floating-point number (Knuth's TwoSum), so
/// its sign says on which side of the exact sum the rounded one lies, however far apart the magnitudes are.
Real sumRoundedDown(Real a, Real b) {
    constexpr Real kMax = std::numeric_limits<Real>::max();
    const Real sum = a + b;
    if (!(std::fabs(sum) <= kMax)) { return std::isnan(sum) ? sum : (sum > 0 ? kMax : -kMax); }
    const Real partOfB = sum - a;
    const Real partOfA = sum - partOfB;
    const Real error = (a - partOfA) + (b - partOfB);
    if (!(error < 0)) { return sum; }
    return sum > -kMax ? nextDown(sum) : sum;
}

Real sumRoundedUp(Real a, Real b) { return -sumRoundedDown(-a, -b); }

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

Aabb roundedOutward(DVec2 lower, DVec2 upper) {
    return {{roundedDown(lower.x), roundedDown(lower.y)}, {roundedUp(upper.x), roundedUp(upper.y)}};
}

Aabb grown(const Aabb& a, Real margin) {
    return {{sumRoundedDown(a.lower.x, -margin), sumRoundedDown(a.lower.y, -margin)},
            {sumRoundedUp(a.upper.x, margin), sumRoundedUp(a.upper.y, margin)}};
}

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

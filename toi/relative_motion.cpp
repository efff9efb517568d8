#include "relative_motion.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

double RelativeMotion::farthestWithin(double from, double to) const {
    // On a straight line the distance is largest at an end. The parabola leaves its chord by s (s − span) k, at most
    // span²/4·|k|, in the middle.
    const double span = to - from;
    const double ends = std::max(length(offsetAt(from)), length(offsetAt(to)));
    return ends + 0.25 * span * span * length(curvature);
}

double RelativeMotion::fastestWithin(double from, double to) const {
    // The velocity is linear in the fraction, so its length is largest at an end.
    return std::max(length(velocityAt(from)), length(velocityAt(to)));
}

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <algorithm>

#include "../../toi/sweep.h"

namespace swept {

/// Whether the centres of two sweeps over the same time stay farther apart than that, metres. The distance is least
/// near where it is least on the chord of their relative path; the path is within a quarter of its bend of that.
inline bool stayBeyond(const Sweep& first, const Sweep& second, double reach) {
    const DVec2 start = second.c0 - first.c0;
    const DVec2 way = (second.c1 - second.c0) - (first.c1 - first.c0);
    const double square = dot(way, way);
    const double nearest = square > 0 ? std::clamp(-dot(start, way) / square, 0.0, 1.0) : 0;
    const double bend = 0.25 * length(second.k - first.k);
    return length(start + nearest * way) - bend > reach;
}

}  // namespace swept

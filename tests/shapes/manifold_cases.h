#pragma once

#include <algorithm>

#include <swept/shapes/manifold.h>

#include "shape_families.h"

/// What suites of manifolds share.

namespace swept::test {

inline Transform poseAt(double x, double y, double angle) { return {{real(x), real(y)}, rotationFromAngle(angle)}; }

inline Real deepest(const Manifold& m) {
    const Real first = m.points[0].separation;
    return m.count > 1 ? std::min(first, m.points[1].separation) : first;
}

}  // namespace swept::test

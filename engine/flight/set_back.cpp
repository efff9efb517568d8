#include "set_back.h"

#include <algorithm>
#include <cmath>

#include "../../solver/contacts/contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A push at one point moves no point of a convex body of one density by more than 1.5 times the depth: its radius is
/// at most 2.83 times that of gyration (a triangle as thin as a line), and the turn is at most half of the depth over
/// that.
constexpr Real kMostSwing = 4;

SetBack leastOf(const std::array<LowPoint, 2>& points, const BodyInertia& inertia) {
    const LowPoint& one = points[0];
    const LowPoint& two = points[1];
    // By unit mass: responses of the points to an impulse at each.
    const Real ratio = inertia.inverseMass > 0 ? inertia.inverseInertia / inertia.inverseMass : Real(0);
    const Real own1 = 1 + ratio * one.arm * one.arm;
    const Real own2 = 1 + ratio * two.arm * two.arm;
    const Real shared = 1 + ratio * one.arm * two.arm;
    const auto withPushes = [&](Real p1, Real p2) { return SetBack{p1 + p2, ratio * (one.arm * p1 + two.arm * p2)}; };
    const Real alone1 = std::max(one.depth, Real(0)) / own1;
    const Real alone2 = std::max(two.depth, Real(0)) / own2;
    if (!(two.depth - shared * alone1 > 0)) { return withPushes(alone1, 0); }
    if (!(one.depth - shared * alone2 > 0)) { return withPushes(0, alone2); }
    const Real rest = own1 * own2 - shared * shared;
    if (!(rest > kTwoPointsRatio * own1 * own2)) { return withPushes(std::max(one.depth, two.depth), 0); }
    return withPushes((own2 * one.depth - shared * two.depth) / rest, (own1 * two.depth - shared * one.depth) / rest);
}

}  // namespace

SetBack setBackOf(const std::array<LowPoint, 2>& points, const BodyInertia& inertia, Real radius) {
    const SetBack least = leastOf(points, inertia);
    const LowPoint& deepest = points[0].depth >= points[1].depth ? points[0] : points[1];
    const bool isLow = deepest.depth > 0;
    if (!isLow || !(std::fabs(least.turn) * radius > kMostSwing * deepest.depth)) { return least; }
    return {.along = deepest.depth, .turn = 0, .arm = deepest.arm};
}

Real speedLeft(const SetBack& back, const SetBackEnergy& energy, const BodyInertia& inertia) {
    if (!(back.along > 0)) { return 1; }
    // By the way of the centre, so that squares of small lengths do not vanish.
    const Real turn = back.arm != 0 ? inertia.inverseInertia / inertia.inverseMass * back.arm : back.turn / back.along;
    const Real swing = inertia.inverseInertia > 0 ? inertia.inverseMass / inertia.inverseInertia * turn : Real(0);
    const Real approach = -(energy.velocity + swing * energy.spin);
    const Real work = energy.pull * back.along;
    if (!(approach > 0) || !(work > 0)) { return 1; }
    const Real share = 2 * (1 + turn * swing) * (work / approach) / approach;
    return share < 1 ? std::sqrt(1 - share) : Real(0);
}

}  // namespace swept::inline SWEPT_PRECISION

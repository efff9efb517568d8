#pragma once

#include "body_state.h"
#include "softness.h"

namespace swept::inline SWEPT_PRECISION {

/// Effective-mass matrix of two points that must coincide: symmetric 2×2, 1/kg.
struct PointMatrix {
    Real xx = 0;
    Real xy = 0;
    Real yy = 0;
};

constexpr PointMatrix pointMatrix(const BodyInertia& a, Vec2 armA, const BodyInertia& b, Vec2 armB) {
    const Real inverseMass = a.inverseMass + b.inverseMass;
    return {inverseMass + a.inverseInertia * square(armA.y) + b.inverseInertia * square(armB.y),
            -a.inverseInertia * armA.x * armA.y - b.inverseInertia * armB.x * armB.y,
            inverseMass + a.inverseInertia * square(armA.x) + b.inverseInertia * square(armB.x)};
}

/// Impulse x with matrix·x = rhs; zero when neither body can move. The matrix is positive definite whenever one body has
/// mass, so the determinant is zero only then.
constexpr Vec2 solve(const PointMatrix& m, Vec2 rhs) {
    const Real determinant = m.xx * m.yy - m.xy * m.xy;
    if (!(determinant > 0)) { return {}; }
    return {(m.yy * rhs.x - m.xy * rhs.y) / determinant, (m.xx * rhs.y - m.xy * rhs.x) / determinant};
}

/// One step of a constraint in one direction: the change of the accumulated impulse.
/// @param speed  present velocity of the constraint; @param error  its position error C
constexpr Real scalarChange(Real mass, Real speed, Real error, Real accumulated, const Softness& softness) {
    return -softness.massScale * mass * (speed + softness.biasRate * error) - softness.impulseScale * accumulated;
}

}  // namespace swept::inline SWEPT_PRECISION

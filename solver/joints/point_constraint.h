#pragma once

#include "../body_state.h"
#include "../softness.h"

namespace swept::inline SWEPT_PRECISION {

/// Response matrix of two points that must coincide: relative velocity per impulse, symmetric 2×2, 1/kg.
struct PointMatrix {
    Real xx = 0;
    Real xy = 0;
    Real yy = 0;
    Real determinant = 0;
};

/// The determinant is expanded by hand into terms that are all ≥ 0: xx·yy − xy² would cancel for arms that are long
/// against the bodies' radii of gyration.
constexpr PointMatrix pointMatrix(const BodyInertia& a, Vec2 armA, const BodyInertia& b, Vec2 armB) {
    const Real inverseMass = a.inverseMass + b.inverseMass;
    const Real spin = a.inverseInertia * lengthSquared(armA) + b.inverseInertia * lengthSquared(armB);
    return {inverseMass + a.inverseInertia * square(armA.y) + b.inverseInertia * square(armB.y),
            -a.inverseInertia * armA.x * armA.y - b.inverseInertia * armB.x * armB.y,
            inverseMass + a.inverseInertia * square(armA.x) + b.inverseInertia * square(armB.x),
            inverseMass * (inverseMass + spin) + a.inverseInertia * b.inverseInertia * square(cross(armA, armB))};
}

/// Impulse x with matrix·x = rhs; zero when neither body can move (only then is the determinant zero).
constexpr Vec2 solve(const PointMatrix& m, Vec2 rhs) {
    if (!(m.determinant > 0)) { return {}; }
    return {(m.yy * rhs.x - m.xy * rhs.y) / m.determinant, (m.xx * rhs.y - m.xy * rhs.x) / m.determinant};
}

constexpr Vec2 product(const PointMatrix& m, Vec2 impulse) {
    return {m.xx * impulse.x + m.xy * impulse.y, m.xy * impulse.x + m.yy * impulse.y};
}

/// The same in axes that are turned against those of now: of what turns with them.
constexpr PointMatrix turned(const PointMatrix& matrix, const Rotation& by) {
    const Vec2 x = rotate(by, {matrix.xx, matrix.xy});  // the columns, and then the rows
    const Vec2 y = rotate(by, {matrix.xy, matrix.yy});
    const Vec2 top = rotate(by, {x.x, y.x});
    const Vec2 bottom = rotate(by, {x.y, y.y});
    return {top.x, top.y, bottom.y, matrix.determinant};
}

/// One step of a constraint in one direction: the change of the accumulated impulse.
/// @param speed  present velocity of the constraint; @param error  its position error C
constexpr Real scalarChange(Real mass, Real speed, Real error, Real accumulated, const Softness& softness) {
    return -softness.massScale * mass * (speed + softness.biasRate * error) - softness.impulseScale * accumulated;
}

}  // namespace swept::inline SWEPT_PRECISION

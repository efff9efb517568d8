#pragma once

#include "rotation.h"

namespace swept::inline SWEPT_PRECISION {

/// A rigid motion of relative coordinates: rotates, then translates. `bInA` takes coordinates of B to coordinates of A.
struct Transform {
    Vec2 translation;
    Rotation rotation;

    constexpr bool operator==(const Transform&) const = default;
};

constexpr Vec2 apply(const Transform& t, Vec2 point) { return rotate(t.rotation, point) + t.translation; }
constexpr Vec2 applyInverse(const Transform& t, Vec2 point) { return unrotate(t.rotation, point - t.translation); }
constexpr Transform inverse(const Transform& t) { return {-unrotate(t.rotation, t.translation), inverse(t.rotation)}; }

/// Where a body frame stands in the world: its position in double (in both builds), its rotation in `Real`.
struct WorldTransform {
    DVec2 position;
    Rotation rotation;

    constexpr bool operator==(const WorldTransform&) const = default;
};

/// World coordinates of a body point, in double.
constexpr DVec2 apply(const WorldTransform& t, Vec2 point) { return t.position + toDouble(rotate(t.rotation, point)); }
/// Body coordinates of a world point: the difference of positions is taken in double, then rounded.
constexpr Vec2 applyInverse(const WorldTransform& t, DVec2 point) {
    return unrotate(t.rotation, toReal(point - t.position));
}
/// Pose of B in the frame of A: exact difference of the positions first, so it does not depend on where both are.
constexpr Transform relativeTransform(const WorldTransform& a, const WorldTransform& b) {
    return {applyInverse(a, b.position), inverse(a.rotation) * b.rotation};
}

}  // namespace swept::inline SWEPT_PRECISION

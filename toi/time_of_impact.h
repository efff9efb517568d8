#pragma once

#include <array>
#include <cstdint>

#include "../shapes/status.h"
#include "sweep.h"

namespace swept {

/// A convex polygon with radius in double, the input of everything in `toi/`; same invariants as `Polygon`
/// (shapes/polygon.h), without normals. Body frame, metres.
struct ToiPolygon {
    std::array<DVec2, 8> vertices{};
    int count = 0;
    double radius = 0;
};

class ToiObserver;

/// How much an answer tells beyond the event. The event (state, fraction, target, and the bracket of a hit) is the same
/// for all; to tell the contact of what stays apart may take one more distance (`iterations`). The contact (separation,
/// normal, points, features, the bracket of other states) is told of these states, and else left as a new `Toi` has it:
///
///     detail    hit   failed   separated   overlapped
///     event     yes   yes      no          no
///     contact   yes   yes      yes         no
///     depth     yes   yes      yes         yes
enum class ToiDetail : std::uint8_t { event, contact, depth };

/// Lengths in metres, fraction without unit.
struct ToiSettings {
    double target = 0;                    ///< separation that counts as touching; target + rA + rB ≥ 0
    double tolerance = 0;                 ///< greater than 0
    double tMax = 1;                      ///< search [0, tMax], 0 < tMax ≤ 1
    ToiDetail detail = ToiDetail::depth;  ///< what is not asked for is not paid for
    ToiObserver* observer = nullptr;      ///< is told of every step of `timeOfImpact` (toi_observer.h); changes nothing
};

/// Default target 2⁻¹⁰ of the pair's extent (the smaller non-zero one of the two shapes'), tolerance a quarter of it.
ToiSettings defaultToiSettings(const ToiPolygon& a, const ToiPolygon& b);

enum class ToiState : std::uint8_t {
    hit,         ///< separation falls to the target at `fraction`
    separated,   ///< it stays above target − tolerance on all of [0, tMax]
    overlapped,  ///< the polygons themselves, without radii, intersect at fraction 0
    failed,      ///< the budget ran out: `fraction` is safe (no contact before it), nothing is known beyond
};

/// A vertex (`second` −1) or the edge between two vertices of a polygon, by their indices; none: both −1.
struct ToiFeature {
    int first = -1;
    int second = -1;

    constexpr bool operator==(const ToiFeature&) const = default;
};

struct Toi {
    ToiState state = ToiState::failed;
    double fraction = 0;    ///< hit, failed: see there; separated: tMax; overlapped: 0
    double separation = 0;  ///< signed, radii included, at `fraction`; overlapped: minus the penetration depth
    DVec2 normal;           ///< unit, from A to B, world, at `fraction`
    DVec2 pointA;           ///< witness points on the rounded surfaces, world, at `fraction`
    DVec2 pointB;
    ToiFeature featureA;  ///< what touches, or is closest; none where the polygons overlap
    ToiFeature featureB;
    double target = 0;  ///< the level of the certificate: that of the settings, or below it (`timeOfImpactInContact`)
    /// The other end of the bracket, with `fraction` the certificate of a hit: the last fraction before it that was
    /// looked at. The separation stays above target − tolerance up to there and on to `fraction`; at `fractionLower` it
    /// is at least `separationLower`, above the target; at `fraction` it is down to it. Other states: the same as
    /// `fraction`.
    double fractionLower = 0;
    double separationLower = 0;  ///< a lower bound, along the axis in use
    int iterations = 0;          ///< distances found, of which each gives an axis
    int rootIterations = 0;      ///< looks along these axes between the distances
};

/// First fraction at which the separation of two moving polygons falls to the target. At every earlier fraction the
/// separation is above target − tolerance, and at the reported one it lies within target ± tolerance. A pair that
/// starts nearer than the target, also with its roundings overlapping, is a `hit` at 0 with the separation it has.
/// Works on differences of the centres, so the cost and the error do not depend on the distance from the origin.
/// @pre the polygons are valid, all numbers finite, settings in range (`validateToi` checks all of it).
Toi timeOfImpact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings);

/// For a pair that touches already, whose approach in the contact is the business of a solver: the first fraction at
/// which the separation falls to min(target, separation at 0 − 2·tolerance), certified at that level, which the answer
/// names. No pair is exempt, and none becomes `overlapped`: where the polygons themselves overlap, the separation is
/// that along a remembered direction, signed, so that what is deep inside does not come out at the other side
/// unnoticed. The direction is the closest one of the last look at which they were apart, held by the body whose face
/// it is normal to; at the start `axis`, held by A.
/// @param axis  unit, world, from A to B; only looked at when the polygons overlap at fraction 0. That of the contact.
Toi timeOfImpactInContact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                          const ToiSettings& settings, DVec2 axis);

/// `timeOfImpact` with the rotations left out (both keep the angle of fraction 0): linear shape cast by GJK ray cast /
/// conservative advancement along the relative translation. Same result type, same tolerances.
Toi shapeCast(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
              const ToiSettings& settings);

/// Separation of the two polygons at a fraction, with normal and witness points (state `separated` or `overlapped`).
Toi separationAt(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB, double fraction);

/// The same along a direction: lowest projection of B minus highest of A. Never more than their separation.
/// @param normal  unit, world, from A to B
double separationAlong(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                       double fraction, DVec2 normal);

/// Whether a query may be asked: vertices 1 … 8, finite, convex, counter-clockwise; radius ≥ 0; 0 < tMax ≤ 1;
/// tolerance > 0 and not below what double resolves at the pair's relative coordinates; target + rA + rB ≥ 0.
Status validateToi(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                   const ToiSettings& settings);
Status validateToiPolygon(const ToiPolygon& polygon);

}  // namespace swept

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

/// Lengths in metres, fraction without unit.
struct ToiSettings {
    double target = 0;     ///< separation that counts as touching; target + rA + rB ≥ 0
    double tolerance = 0;  ///< greater than 0
    double tMax = 1;       ///< search [0, tMax], 0 < tMax ≤ 1
    ToiObserver* observer = nullptr;  ///< is told of every step (toi_observer.h); changes nothing
};

/// Default target 2⁻¹⁰ of the pair's extent (the smaller non-zero one of the two shapes'), tolerance a quarter of it.
ToiSettings defaultToiSettings(const ToiPolygon& a, const ToiPolygon& b);

enum class ToiState : std::uint8_t {
    hit,         ///< separation falls to the target at `fraction`
    separated,   ///< it stays above target − tolerance on all of [0, tMax]
    overlapped,  ///< the polygons themselves, without radii, intersect at fraction 0
    failed,      ///< the budget ran out: `fraction` is safe (no contact before it), nothing is known beyond
};

struct Toi {
    ToiState state = ToiState::failed;
    double fraction = 0;    ///< hit, failed: see there; separated: tMax; overlapped: 0
    double separation = 0;  ///< signed, radii included, at `fraction`; overlapped: minus the penetration depth
    DVec2 normal;           ///< unit, from A to B, world, at `fraction`
    DVec2 pointA;           ///< witness points on the rounded surfaces, world, at `fraction`
    DVec2 pointB;
    int iterations = 0;     ///< distance evaluations
};

/// First fraction at which the separation of two moving polygons falls to the target. At every earlier fraction the
/// separation is above target − tolerance, and at the reported one it lies within target ± tolerance. Shapes that start
/// within the target are a hit at 0.
/// Works on differences of the centres, so the cost and the error do not depend on the distance from the origin.
/// @pre the polygons are valid, all numbers finite, settings in range (`validateToi` checks all of it).
Toi timeOfImpact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings);

/// The same with the rotations left out (both keep the angle of fraction 0): linear shape cast by GJK ray cast /
/// conservative advancement along the relative translation. Same result type, same tolerances.
Toi shapeCast(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
              const ToiSettings& settings);

/// Separation of the two polygons at a fraction, with normal and witness points (state `separated` or `overlapped`).
Toi separationAt(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB, double fraction);

/// Whether a query may be asked: vertices 1 … 8, finite, convex, counter-clockwise; radius ≥ 0; 0 < tMax ≤ 1;
/// tolerance > 0 and not below what double resolves at the pair's relative coordinates; target + rA + rB ≥ 0.
Status validateToi(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                   const ToiSettings& settings);
Status validateToiPolygon(const ToiPolygon& polygon);

}  // namespace swept

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <swept/toi/time_of_impact.h>

#include "plain_vec.h"

/// Where a pair stands at a fraction, in plain double and without any promise: tells the oracle where to look, and
/// generators what they have made. Nothing is proved with it.

namespace swept::oracle {

struct PlainPolygon {
    std::array<PlainVec, 8> points{};  ///< world axes, relative to the centre of A
    int count = 0;

    PlainVec at(int i) const { return points[static_cast<std::size_t>(i)]; }
    PlainVec after(int i) const { return points[static_cast<std::size_t>(i + 1 < count ? i + 1 : 0)]; }
};

/// Which body's edge the axis is a normal of.
enum class AxisOwner : std::uint8_t { none, a, b };

/// The point that is `part` (0 … 1) of the way from one vertex to the next.
struct PointOnEdge {
    std::size_t from = 0;
    std::size_t to = 0;
    double part = 0;
};

struct PlainSeparation {
    double core = 0;  ///< signed separation without radii, metres: distance, or minus the smallest translation apart
    PlainVec axis;    ///< along which it is seen, of unit length, world, from A to B
    AxisOwner owner = AxisOwner::none;
    PointOnEdge onA;  ///< closest points of the boundaries of the cores
    PointOnEdge onB;
};

PlainSeparation plainSeparation(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                                double fraction);

/// The same with bodies turned otherwise than their sweeps say.
/// @param rotationA, rotationB  cosine and sine.
PlainSeparation plainSeparation(const ToiPolygon& a, const Sweep& sweepA, PlainVec rotationA, const ToiPolygon& b,
                                const Sweep& sweepB, PlainVec rotationB, double fraction);

}  // namespace swept::oracle

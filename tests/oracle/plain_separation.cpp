#include "plain_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swept::oracle {
namespace {

PlainVec rotationOf(const Sweep& s, double t) {
    const double angle = s.a0 + t * (s.a1 - s.a0);
    return {std::cos(angle), std::sin(angle)};
}

PlainPolygon place(const ToiPolygon& polygon, const Sweep& s, PlainVec rotation, PlainVec center) {
    PlainPolygon placed;
    placed.count = polygon.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        const PlainVec r = plain(polygon.vertices[i]) - plain(s.localCenter);
        placed.points[i] = center + PlainVec{rotation.x * r.x - rotation.y * r.y, rotation.y * r.x + rotation.x * r.y};
    }
    return placed;
}

PlainVec centersApart(const Sweep& a, const Sweep& b, double t) {
    const PlainVec start = plain(b.c0) - plain(a.c0);
    const PlainVec end = plain(b.c1) - plain(a.c1);
    return start + t * (end - start) + (t * (t - 1)) * (plain(b.k) - plain(a.k));
}

double gapAlong(const PlainPolygon& a, const PlainPolygon& b, PlainVec axis) {
    double farthestOfA = -std::numeric_limits<double>::infinity();
    double nearestOfB = std::numeric_limits<double>::infinity();
    for (int i = 0; i < a.count; ++i) { farthestOfA = std::max(farthestOfA, dot(axis, a.at(i))); }
    for (int i = 0; i < b.count; ++i) { nearestOfB = std::min(nearestOfB, dot(axis, b.at(i))); }
    return nearestOfB - farthestOfA;
}

/// Improves `best` by the outward normals of the edges of `p`; both sides of a segment.
/// @param sign  1 when `p` is A; −1 when it is B, whose normals point the other way.
void tryEdges(const PlainPolygon& p, const PlainPolygon& a, const PlainPolygon& b, double sign, PlainSeparation& best) {
    for (int i = 0; p.count > 1 && i < p.count; ++i) {
        const PlainVec edge = p.after(i) - p.at(i);
        const double size = length(edge);
        if (!(size > 0)) { continue; }
        const PlainVec axis = (sign / size) * PlainVec{edge.y, -edge.x};
        const double gap = gapAlong(a, b, axis);
        if (gap > best.core) {
            best.core = gap;
            best.axis = axis;
            best.owner = sign > 0 ? AxisOwner::a : AxisOwner::b;
        }
    }
}

/// A vertex of one polygon and an edge of the other.
struct Nearest {
    double square = std::numeric_limits<double>::infinity();
    int vertex = 0;
    int edge = 0;
    double part = 0;  ///< of the edge, 0 … 1
};

Nearest nearest(const PlainPolygon& p, const PlainPolygon& q) {
    Nearest best;
    for (int j = 0; j < q.count; ++j) {
        const PlainVec edge = q.after(j) - q.at(j);
        const double size = dot(edge, edge);
        for (int i = 0; i < p.count; ++i) {
            const PlainVec to = p.at(i) - q.at(j);
            const double part = size > 0 ? std::clamp(dot(to, edge) / size, 0.0, 1.0) : 0;
            const PlainVec apart = to - part * edge;
            const double square = dot(apart, apart);
            if (square < best.square) { best = {square, i, j, part}; }
        }
    }
    return best;
}

PointOnEdge onEdge(const Nearest& n, int count) {
    return {static_cast<std::size_t>(n.edge), static_cast<std::size_t>((n.edge + 1) % count), n.part};
}

}  // namespace

PlainSeparation plainSeparation(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                                double fraction) {
    return plainSeparation(a, sweepA, rotationOf(sweepA, fraction), b, sweepB, rotationOf(sweepB, fraction), fraction);
}

PlainSeparation plainSeparation(const ToiPolygon& a, const Sweep& sweepA, PlainVec rotationA, const ToiPolygon& b,
                                const Sweep& sweepB, PlainVec rotationB, double fraction) {
    const PlainPolygon placedA = place(a, sweepA, rotationA, {});
    const PlainPolygon placedB = place(b, sweepB, rotationB, centersApart(sweepA, sweepB, fraction));
    PlainSeparation found;
    found.core = -std::numeric_limits<double>::infinity();
    tryEdges(placedA, placedA, placedB, 1, found);
    tryEdges(placedB, placedA, placedB, -1, found);

    const Nearest ofA = nearest(placedA, placedB);
    const Nearest ofB = nearest(placedB, placedA);
    const bool vertexOfA = ofA.square < ofB.square;
    const Nearest& closest = vertexOfA ? ofA : ofB;
    const auto vertex = static_cast<std::size_t>(closest.vertex);
    const PointOnEdge corner{vertex, vertex, 0};
    found.onA = vertexOfA ? corner : onEdge(closest, a.count);
    found.onB = vertexOfA ? onEdge(closest, b.count) : corner;
    if (std::isfinite(found.core) && found.core <= 0) { return found; }

    // Apart (or two points): the distance is that of the closest vertex and edge.
    const double distance = std::sqrt(closest.square);
    const PlainPolygon& p = vertexOfA ? placedA : placedB;
    const PlainPolygon& q = vertexOfA ? placedB : placedA;
    const PlainVec foot = q.at(closest.edge) + closest.part * (q.after(closest.edge) - q.at(closest.edge));
    const PlainVec apart = p.at(closest.vertex) - foot;
    const PlainVec axis = distance > 0 ? (vertexOfA ? -1 : 1) / distance * apart : PlainVec{1, 0};
    // Where rounding has spoiled the short vector, the normal of the edge shows more.
    if (gapAlong(placedA, placedB, axis) > found.core) {
        found.axis = axis;
        found.owner = AxisOwner::none;
    }
    found.core = std::max(found.core, distance);
    return found;
}

}  // namespace swept::oracle

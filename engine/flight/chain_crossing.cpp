#include "chain_crossing.h"

#include <algorithm>

#include "../../toi/toi_polygon.h"
#include "../contacts/chain_passage.h"
#include "../state/tolerances.h"
#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {
namespace {


/// The middle of a shape in the frame of a chain.
Vec2 middleAt(const WorldState& world, const Shape& own, const Shape& segment, const Sweep& sweep,
              const Sweep& otherSweep, double fraction) {
    const WorldTransform pose = motionAt(sweep, fraction, world.bodies[own.body].localCenter).pose;
    const WorldTransform otherPose = motionAt(otherSweep, fraction, world.bodies[segment.body].localCenter).pose;
    return applyInverse(otherPose, apply(pose, middleOf(own.polygon)));
}

Toi apartAt(const Shape& own, const Shape& segment, const Sweep& sweep, const Sweep& otherSweep, double fraction) {
    return separationAt(asToiPolygon(segment.polygon), otherSweep, asToiPolygon(own.polygon), sweep, fraction);
}

/// What is nearest to an inner corner is behind the chain, though it may be in front of one of its two sides.
bool isNearestToInnerCorner(const ChainSegment& segment, Vec2 middle, Vec2 nearest) {
    const Vec2 edge = segment.q - segment.p;
    const auto isBehindNeighbour = [middle](Vec2 corner, Vec2 neighbour) {
        return cross(neighbour, middle - corner) > 0;
    };
    const bool isFirst = lengthSquared(nearest - segment.p) < lengthSquared(nearest - segment.q);
    if (isFirst) {
        const Vec2 before = segment.p - segment.before;
        return segment.hasBefore && cross(before, edge) < 0 && isBehindNeighbour(segment.p, before);
    }
    const Vec2 after = segment.after - segment.q;
    return segment.hasAfter && cross(edge, after) < 0 && isBehindNeighbour(segment.q, after);
}

bool contains(const std::vector<ChainPasser>& all, ChainPasser asked) {
    return std::find(all.begin(), all.end(), asked) != all.end();
}

/// Calls `visit(passer)` for what a shape met from behind, or was in already.
template <class Visit>
void visitCrossed(const WorldState& world, const FlightScratch& scratch, const Visit& visit) {
    for (const ChainPasser& passer : scratch.fromBehind) { visit(passer); }
    for (const ChainPasser& passer : scratch.crossings) { visit(passer); }
    if (scratch.knowsCrossings) { return; }
    for (const ChainPasser& passer : world.chainPassers) { visit(passer); }
}

}  // namespace

bool isCrossing(const WorldState& world, const FlightScratch& scratch, std::uint32_t shape, std::uint32_t segment) {
    if (contains(scratch.crossings, {.segment = segment, .shape = shape})) { return true; }
    return !scratch.knowsCrossings && passesChain(world, shape, segment);
}

bool crossesAt(const WorldState& world, const FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep,
               double fraction, const FlightScratch& scratch) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const Vec2 middle = middleAt(world, own, other, sweep, otherSweep, fraction);
    if (isBehind(other, middle)) { return true; }
    if (!(fraction > 0)) { return false; }
    const Toi met = apartAt(own, other, sweep, otherSweep, fraction);
    if (met.featureA.first >= 0 && met.featureA.second < 0) {
        const Vec2 nearest = other.polygon.vertices[static_cast<std::size_t>(met.featureA.first)];
        if (isNearestToInnerCorner(other.segment, middle, nearest)) { return true; }
    }
    bool crosses = false;
    visitCrossed(world, scratch, [&](const ChainPasser& passer) {
        const Shape& segment = world.shapes[passer.segment];
        if (crosses || passer.shape != obstacle.own || segment.head != other.head) { return; }
        if (isBehind(segment, middle)) { return; }
        const Toi there = apartAt(own, segment, sweep, otherSweep, fraction);
        const auto passed = static_cast<double>(kPassedRatio * std::min(own.extent, segment.extent));
        crosses = there.separation < -passed &&
                  hangTogether(world, own, middle, passer.segment, obstacle.other);
    });
    return crosses;
}

void noteCrossings(const WorldState& world, std::uint32_t body, const Sweep& sweep, double from, double to,
                   double fraction, FlightScratch& scratch) {
    std::vector<ChainPasser>& still = scratch.stillCrossings;
    still.clear();
    visitCrossed(world, scratch, [&](const ChainPasser& passer) {
        const Shape& own = world.shapes[passer.shape];
        const Shape& segment = world.shapes[passer.segment];
        if (own.body != body || contains(still, passer)) { return; }
        const Sweep otherSweep = obstacleSweep(world, segment.body, from, to);
        if (isBehind(segment, middleAt(world, own, segment, sweep, otherSweep, fraction))) { return; }
        const auto out = static_cast<double>(kTargetRatio * std::min(own.extent, segment.extent));
        if (apartAt(own, segment, sweep, otherSweep, fraction).separation < -out) { still.push_back(passer); }
    });
    std::erase_if(scratch.crossings, [&](const ChainPasser& passer) { return world.shapes[passer.shape].body == body; });
    scratch.crossings.insert(scratch.crossings.end(), still.begin(), still.end());
    scratch.fromBehind.clear();
}

void beginCrossings(const WorldState& world, std::uint32_t body, FlightScratch& scratch) {
    scratch.knowsCrossings = true;
    for (const ChainPasser& passer : world.chainPassers) {
        if (world.shapes[passer.shape].body == body) { scratch.crossings.push_back(passer); }
    }
}

void endCrossings(FlightScratch& scratch) {
    scratch.knowsCrossings = false;
    scratch.crossed.insert(scratch.crossed.end(), scratch.crossings.begin(), scratch.crossings.end());
    scratch.crossings.clear();
    scratch.fromBehind.clear();
}

}  // namespace swept::inline SWEPT_PRECISION

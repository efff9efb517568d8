#include "chain_crossing.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// How fast a place that goes with a swept body does, by the unit of its time.
DVec2 velocityThere(const Sweep& sweep, double fraction, DVec2 place) {
    const DVec2 arm = place - centerAt(sweep, fraction);
    const double turn = sweep.a1 - sweep.a0;
    return (sweep.c1 - sweep.c0) + (2 * fraction - 1) * sweep.k + DVec2{-turn * arm.y, turn * arm.x};
}

/// How a shape gets to a segment; `towards` stays 0.
ChainArrival arrivalAt(const WorldState& world, const Shape& own, const Shape& segment, const Sweep& sweep,
                       const Sweep& otherSweep, double fraction) {
    const WorldTransform pose = motionAt(sweep, fraction, world.bodies[own.body].localCenter).pose;
    const WorldTransform otherPose = motionAt(otherSweep, fraction, world.bodies[segment.body].localCenter).pose;
    const DVec2 middle = apply(pose, middleOf(own.polygon));
    const DVec2 velocity = velocityThere(sweep, fraction, middle) - velocityThere(otherSweep, fraction, middle);
    return {.height = heightOver(segment, otherPose, own, pose),
            .normal = rotate(otherPose.rotation, segment.polygon.normals[0]),
            .velocity = toReal(velocity),
            .extent = std::min(own.extent, segment.extent)};
}

/// What is nearest to an inner corner is behind the chain, though it may be in front of one of its two sides.
/// @param beside  the middle of the shape, or a place along the normal of the contact: the middle of a bar may be
/// anywhere
bool isNearestToInnerCorner(const ChainSegment& segment, Vec2 beside, Vec2 nearest) {
    const Vec2 edge = segment.q - segment.p;
    const auto isBehindNeighbour = [beside](Vec2 corner, Vec2 neighbour) {
        return cross(neighbour, beside - corner) > 0;
    };
    const bool isFirst = lengthSquared(nearest - segment.p) < lengthSquared(nearest - segment.q);
    if (isFirst) {
        const Vec2 before = segment.p - segment.before;
        return segment.hasBefore && cross(before, edge) < 0 && isBehindNeighbour(segment.p, before);
    }
    const Vec2 after = segment.after - segment.q;
    return segment.hasAfter && cross(edge, after) < 0 && isBehindNeighbour(segment.q, after);
}

bool isListed(const std::vector<ChainPasser>& all, ChainPasser asked) {
    return std::find(all.begin(), all.end(), asked) != all.end();
}

/// Calls `visit(passer)` for what shapes were in as the sweep began.
template <class Visit>
void visitCrossings(const WorldState& world, const FlightScratch& scratch, const Visit& visit) {
    for (const ChainPasser& passer : scratch.chains.crossings) { visit(passer); }
    if (scratch.chains.knowsCrossings) { return; }
    for (const ChainPasser& passer : world.chainPassers) { visit(passer); }
}

/// Two shapes on their ways, at one moment.
struct CrossingMoment {
    const WorldState& world;
    const Sweep& sweep;
    double from;
    double to;
    double fraction;

    bool isInFront(std::uint32_t own, std::uint32_t other) const {
        const Shape& segment = world.shapes[other];
        return !isBehind(segment, middleAt(world, world.shapes[own], segment, sweep, otherSweep(segment), fraction));
    }
    /// Whether they overlap by more than this part of the extent.
    bool isDeeper(std::uint32_t own, std::uint32_t other, Real ratio) const {
        const Shape& shape = world.shapes[own];
        const Shape& segment = world.shapes[other];
        const Toi there = apartAt(shape, segment, sweep, otherSweep(segment), fraction);
        return there.separation < -static_cast<double>(ratio * std::min(shape.extent, segment.extent));
    }
    Sweep otherSweep(const Shape& segment) const { return obstacleSweep(world, segment.body, from, to); }
};

/// Whether the shape, behind the segment, is in front of a neighbour beyond an outer corner that it touches.
bool isInFrontOfNeighbour(const WorldState& world, const FlightObstacle& obstacle, const Sweep& sweep,
                          const Sweep& otherSweep, double fraction, Vec2 middle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const ChainSegment& segment = other.segment;
    const auto touches = [&](Vec2 corner) {
        ToiPolygon point;
        point.count = 1;
        point.radius = static_cast<double>(segment.radius);
        point.vertices[0] = toDouble(corner);
        const Toi there = separationAt(point, otherSweep, asToiPolygon(own.polygon), sweep, fraction);
        return there.separation < static_cast<double>(kBeginRatio * extentOfPair(own, other));
    };
    const auto isInFront = [middle](Vec2 from, Vec2 to) { return cross(to - from, middle - from) < 0; };
    const Vec2 edge = segment.q - segment.p;
    const bool isOuterFirst = segment.hasBefore && cross(segment.p - segment.before, edge) > 0;
    const bool isOuterLast = segment.hasAfter && cross(edge, segment.after - segment.q) > 0;
    return (isOuterFirst && isInFront(segment.before, segment.p) && touches(segment.p)) ||
           (isOuterLast && isInFront(segment.q, segment.after) && touches(segment.q));
}

/// Where a shape is that touches a segment.
enum class ChainSide : std::uint8_t {
    front,
    back,       ///< or in the chain that it came to from behind: it passes
    neighbour,  ///< at a corner, in front of the neighbour beyond it: that is what stops it
};

ChainSide sideAt(const WorldState& world, const FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep,
                 double fraction, const FlightScratch& scratch) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const Vec2 middle = middleAt(world, own, other, sweep, otherSweep, fraction);
    if (isBehind(other, middle)) {
        return isInFrontOfNeighbour(world, obstacle, sweep, otherSweep, fraction, middle) ? ChainSide::neighbour
                                                                                          : ChainSide::back;
    }
    // What is in another piece of the chain, or behind it, may get to this one from behind, too.
    ChainArrival arrival = arrivalAt(world, own, other, sweep, otherSweep, fraction);
    if (!comesAlong(arrival)) { return ChainSide::front; }  // wherever it is touched first
    const Toi met = apartAt(own, other, sweep, otherSweep, fraction);
    arrival.towards = toReal(met.normal);
    if (!comesAlong(arrival)) { return ChainSide::front; }
    if (met.featureA.first >= 0 && met.featureA.second < 0) {
        const Vec2 nearest = other.polygon.vertices[static_cast<std::size_t>(met.featureA.first)];
        const WorldTransform pose = motionAt(otherSweep, fraction, world.bodies[other.body].localCenter).pose;
        const Vec2 beside = nearest + unrotate(pose.rotation, toReal(met.normal));
        const bool isNearest = isNearestToInnerCorner(other.segment, middle, nearest);
        if (isNearest && isNearestToInnerCorner(other.segment, beside, nearest)) { return ChainSide::back; }
    }
    bool isInside = false;
    const auto look = [&](const ChainPasser& passer, Real ratio) {
        const Shape& segment = world.shapes[passer.segment];
        if (isInside || passer.shape != obstacle.own || !canBeJoined(world, segment, other)) { return; }
        const bool isOneBody = segment.body == other.body;
        const Sweep ofSegment = isOneBody ? otherSweep : obstacleSweep(world, segment.body, 0, 0);
        const Vec2 place = isOneBody ? middle : middleAt(world, own, segment, sweep, ofSegment, fraction);
        if (isBehind(segment, place)) { return; }
        const auto deep = static_cast<double>(ratio * std::min(own.extent, segment.extent));
        isInside = apartAt(own, segment, sweep, ofSegment, fraction).separation < -deep &&
                   hangTogether(world, own, place, passer.segment, obstacle.other);
    };
    for (const ChainPasser& passer : scratch.chains.fromBehind) { look(passer, kPassedRatio); }
    visitCrossings(world, scratch, [&](const ChainPasser& passer) { look(passer, kTargetRatio); });
    return isInside ? ChainSide::back : ChainSide::front;
}

}  // namespace

bool StartAtChains::isBehind(std::uint32_t segment) {
    const Shape& other = world_.shapes[segment];
    if (other.body != chainBody_) {
        chainBody_ = other.body;
        middle_ =
            applyInverse(groundPose(world_, chainBody_, from_), apply(pose_, middleOf(world_.shapes[shape_].polygon)));
    }
    return swept::isBehind(other, middle_);
}

bool StartAtChains::isCrossing(std::uint32_t segment, const FlightScratch& scratch) const {
    if (isListed(scratch.chains.crossings, {.segment = segment, .shape = shape_})) { return true; }
    if (scratch.chains.knowsCrossings || !passesChain(world_, shape_, segment)) { return false; }
    // It was in it as the step began. What meets others on its way may have left it, and come back from the front.
    const Shape& own = world_.shapes[shape_];
    const Shape& other = world_.shapes[segment];
    const WorldTransform ofChain = groundPose(world_, other.body, from_);
    return heightOver(other, ofChain, own, pose_) < -kTargetRatio * extentOfPair(own, other);
}

bool passesFromBehind(const WorldState& world, FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep,
                      double fraction, FlightScratch& scratch) {
    if (!world.shapes[obstacle.other].isChainSegment) { return false; }
    const ChainSide side = sideAt(world, obstacle, sweep, otherSweep, fraction, scratch);
    if (side == ChainSide::front) { return false; }
    obstacle.isCrossed = obstacle.isClear = true;
    if (side == ChainSide::neighbour) { return true; }
    scratch.chains.fromBehind.push_back({.segment = obstacle.other, .shape = obstacle.own});
    scratch.chains.meetsBacks = true;
    return true;
}

void noteCrossings(const WorldState& world, std::uint32_t body, const Sweep& sweep, double from, double to,
                   double fraction, FlightScratch& scratch) {
    std::vector<ChainPasser>& still = scratch.chains.stillCrossings;
    still.clear();
    const CrossingMoment now{world, sweep, from, to, fraction};
    const auto isIn = [&](const ChainPasser& passer) {
        return world.shapes[passer.shape].body == body && !isListed(still, passer) &&
               now.isInFront(passer.shape, passer.segment) && now.isDeeper(passer.shape, passer.segment, kTargetRatio);
    };
    visitCrossings(world, scratch, [&](const ChainPasser& passer) {
        if (isIn(passer)) { still.push_back(passer); }
    });
    for (const ChainPasser& passer : scratch.chains.fromBehind) {
        if (isIn(passer)) { still.push_back(passer); }
    }
    std::erase_if(scratch.chains.crossings,
                  [&](const ChainPasser& passer) { return world.shapes[passer.shape].body == body; });
    scratch.chains.crossings.insert(scratch.chains.crossings.end(), still.begin(), still.end());
    scratch.chains.fromBehind.clear();
}

void beginCrossings(const WorldState& world, std::uint32_t body, FlightScratch& scratch) {
    scratch.chains.knowsCrossings = true;
    for (const ChainPasser& passer : world.chainPassers) {
        if (world.shapes[passer.shape].body == body) { scratch.chains.crossings.push_back(passer); }
    }
}

void endCrossings(FlightScratch& scratch) {
    scratch.chains.knowsCrossings = false;
    scratch.chains.crossed.insert(scratch.chains.crossed.end(), scratch.chains.crossings.begin(),
                                  scratch.chains.crossings.end());
    scratch.chains.crossings.clear();
    scratch.chains.fromBehind.clear();
}

}  // namespace swept::inline SWEPT_PRECISION

#include "flush_impacts.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../contacts/ghosts.h"
#include "../state/flight_work.h"
#include "flight_contacts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A point of a constraint, and where it is along the ground.
struct PlacedPoint {
    Real place = 0;
    std::uint32_t constraint = 0;
    std::uint32_t point = 0;
};

bool areOfOneGround(const ContactConstraint& a, const ContactConstraint& b) {
    return b.slotA == kFixedSlot && b.slotB == a.slotB && a.friction == b.friction && a.restitution == b.restitution &&
           a.surfaceSpeed == b.surfaceSpeed && dot(a.normal, b.normal) > kSameNormal;
}

/// With those that follow it in the list, and are of one ground with it.
/// @param isTaken  by constraint: stands in another one already, or was left out
void mergeFrom(const Flight& flight, std::size_t first, std::vector<std::uint8_t>& isTaken) {
    FlightScratch& scratch = *flight.scratch;
    const ContactConstraint& one = scratch.constraints[first];
    const Vec2 along = rightPerp(one.normal);
    const auto isOfIt = [&](std::size_t i) {
        return i == first || (isTaken[i] == 0 && areOfOneGround(one, scratch.constraints[i]));
    };
    PlacedPoint own;
    PlacedPoint guest;
    std::uint32_t points = 0;
    // Where the flyer is tilted some normals are its own.
    const ContactConstraint* ofGround = nullptr;
    for (std::size_t i = first; i < scratch.constraints.size(); ++i) {
        if (!isOfIt(i)) { continue; }
        const ContactConstraint& constraint = scratch.constraints[i];
        if (ofGround == nullptr && !scratch.obstacles[constraint.source].hasOwnNormal) { ofGround = &constraint; }
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(constraint.count); ++k) {
            const PlacedPoint point{dot(constraint.points[k].anchorB, along), static_cast<std::uint32_t>(i), k};
            if (points == 0 || point.place < own.place) { own = point; }
            if (points == 0 || point.place > guest.place) { guest = point; }
            ++points;
        }
    }
    if (points < 3 || own.constraint == guest.constraint || ofGround == nullptr) { return; }
    const GroundContact ground = groundContactOf(flight, *ofGround);
    for (std::size_t i = first; i < scratch.constraints.size(); ++i) {
        if (isOfIt(i) && !areFlush(ground, groundContactOf(flight, scratch.constraints[i]))) { return; }
    }
    FlushImpact& impact = scratch.flushImpacts.emplace_back();
    impact = {.both = scratch.constraints[own.constraint],
              .own = own.constraint,
              .guest = guest.constraint,
              .pointOfOwn = own.point,
              .pointOfGuest = guest.point};
    impact.both.normal = ofGround->normal;
    impact.both.count = 2;
    impact.both.points = {scratch.constraints[own.constraint].points[own.point],
                          scratch.constraints[guest.constraint].points[guest.point]};
    prepareContact(impact.both, scratch.inertias);
    for (std::size_t i = first; i < scratch.constraints.size(); ++i) {
        if (isOfIt(i)) { isTaken[i] = 1; }
    }
}

void giveBack(ContactConstraintPoint& to, const ContactConstraintPoint& from) {
    to.totalNormalImpulse = from.totalNormalImpulse;
    to.bounceApproach = from.bounceApproach;
}

}  // namespace

void mergeFlushImpacts(const Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    scratch.flushImpacts.clear();
    const std::size_t count = scratch.constraints.size();
    if (count < 2) { return; }
    std::vector<std::uint8_t>& isTaken = scratch.isMerged;
    isTaken.assign(count, 0);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (isTaken[i] == 0 && scratch.constraints[i].slotA == kFixedSlot) { mergeFrom(flight, i, isTaken); }
    }
    if (scratch.flushImpacts.empty()) { return; }
    scratch.order.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (isTaken[i] == 0) { scratch.order.push_back(&scratch.constraints[i]); }
    }
    for (FlushImpact& impact : scratch.flushImpacts) { scratch.order.push_back(&impact.both); }
}

void partFlushImpacts(FlightScratch& scratch) {
    for (const FlushImpact& impact : scratch.flushImpacts) {
        giveBack(scratch.constraints[impact.own].points[impact.pointOfOwn], impact.both.points[0]);
        giveBack(scratch.constraints[impact.guest].points[impact.pointOfGuest], impact.both.points[1]);
    }
}

}  // namespace swept::inline SWEPT_PRECISION

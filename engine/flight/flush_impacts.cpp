#include "flush_impacts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../contacts/ghosts.h"
#include "../state/flight_work.h"
#include "../state/tolerances.h"
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
           dot(a.normal, b.normal) > kSameNormal;
}

bool hasOwnNormal(const FlightScratch& scratch, const ContactConstraint& constraint) {
    return scratch.obstacles[constraint.source].hasOwnNormal;
}

/// As `areFlush` of the solver's contacts.
bool areFlush(const FlightScratch& scratch, const ContactConstraint& a, const ContactConstraint& b) {
    return hasOwnNormal(scratch, a) != hasOwnNormal(scratch, b) || std::fabs(cross(a.normal, b.normal)) <= kTargetRatio;
}

/// With those that follow it in the list, and are of one ground with it.
/// @param isTaken  by constraint: stands in another one already, or was left out
void mergeFrom(FlightScratch& scratch, std::size_t first, std::vector<std::uint8_t>& isTaken) {
    const ContactConstraint& one = scratch.constraints[first];
    const Vec2 along = rightPerp(one.normal);
    const auto isOfIt = [&](std::size_t i) {
        return i == first || (isTaken[i] == 0 && areOfOneGround(one, scratch.constraints[i]));
    };
    PlacedPoint own;
    PlacedPoint guest;
    std::uint32_t points = 0;
    for (std::size_t i = first; i < scratch.constraints.size(); ++i) {
        if (!isOfIt(i)) { continue; }
        const ContactConstraint& constraint = scratch.constraints[i];
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(constraint.count); ++k) {
            const PlacedPoint point{dot(constraint.points[k].anchorB, along), static_cast<std::uint32_t>(i), k};
            if (points == 0 || point.place < own.place) { own = point; }
            if (points == 0 || point.place > guest.place) { guest = point; }
            ++points;
        }
    }
    if (points < 3 || own.constraint == guest.constraint) { return; }
    if (!areFlush(scratch, scratch.constraints[own.constraint], scratch.constraints[guest.constraint])) { return; }
    if (hasOwnNormal(scratch, scratch.constraints[own.constraint])) { std::swap(own, guest); }
    FlushImpact& impact = scratch.flushImpacts.emplace_back();
    impact = {.both = scratch.constraints[own.constraint],
              .own = own.constraint,
              .guest = guest.constraint,
              .pointOfOwn = own.point,
              .pointOfGuest = guest.point};
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

void mergeFlushImpacts(FlightScratch& scratch) {
    scratch.flushImpacts.clear();
    const std::size_t count = scratch.constraints.size();
    if (count < 2) { return; }
    std::vector<std::uint8_t>& isTaken = scratch.isMerged;
    isTaken.assign(count, 0);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (isTaken[i] == 0 && scratch.constraints[i].slotA == kFixedSlot) { mergeFrom(scratch, i, isTaken); }
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

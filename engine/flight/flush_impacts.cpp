#include "flush_impacts.h"

#include <algorithm>
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

/// The two ends of what touches one ground.
struct Ends {
    PlacedPoint own;
    PlacedPoint guest;
    std::uint32_t points = 0;  ///< of all its constraints

    /// More points than one constraint has room for, and none has both ends.
    bool areOfSeveral() const { return points > 2 && own.constraint != guest.constraint; }
};

bool areOfOneGround(const ContactConstraint& a, const ContactConstraint& b) {
    return b.slotA == kFixedSlot && b.slotB == a.slotB && a.friction == b.friction && a.restitution == b.restitution &&
           a.surfaceSpeed == b.surfaceSpeed && dot(a.normal, b.normal) > kSameNormal;
}

/// A constraint, and those that follow it in the list and are of one ground with it.
/// @param isTaken  by constraint: stands in another one already, or was left out
void listOneGround(FlightScratch& scratch, std::uint32_t first, const std::vector<std::uint8_t>& isTaken) {
    std::vector<std::uint32_t>& found = scratch.ofOneGround;
    found.assign(1, first);
    for (std::uint32_t i = first + 1; i < static_cast<std::uint32_t>(scratch.constraints.size()); ++i) {
        if (isTaken[i] == 0 && areOfOneGround(scratch.constraints[first], scratch.constraints[i])) {
            found.push_back(i);
        }
    }
}

Ends endsOf(const FlightScratch& scratch) {
    Ends ends;
    const Vec2 along = rightPerp(scratch.constraints[scratch.ofOneGround.front()].normal);
    for (const std::uint32_t i : scratch.ofOneGround) {
        const ContactConstraint& constraint = scratch.constraints[i];
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(constraint.count); ++k) {
            const PlacedPoint point{dot(constraint.points[k].anchorB, along), i, k};
            if (ends.points == 0 || point.place < ends.own.place) { ends.own = point; }
            if (ends.points == 0 || point.place > ends.guest.place) { ends.guest = point; }
            ++ends.points;
        }
    }
    return ends;
}

/// Where the flyer is tilted some normals are its own. @return null: all are
const ContactConstraint* withNormalOfGround(const FlightScratch& scratch) {
    for (const std::uint32_t i : scratch.ofOneGround) {
        const ContactConstraint& constraint = scratch.constraints[i];
        if (!scratch.obstacles[constraint.source].hasOwnNormal) { return &constraint; }
    }
    return nullptr;
}

/// With those that follow it in the list, and are of one ground with it.
/// @param isTaken  as of listOneGround
void mergeFrom(const Flight& flight, std::uint32_t first, std::vector<std::uint8_t>& isTaken) {
    FlightScratch& scratch = *flight.scratch;
    listOneGround(scratch, first, isTaken);
    const Ends ends = endsOf(scratch);
    const ContactConstraint* const ofGround = withNormalOfGround(scratch);
    if (!ends.areOfSeveral() || ofGround == nullptr) { return; }
    const GroundContact ground = groundContactOf(flight, *ofGround);
    const bool isFlush = std::all_of(scratch.ofOneGround.begin(), scratch.ofOneGround.end(), [&](std::uint32_t i) {
        return areFlush(ground, groundContactOf(flight, scratch.constraints[i]));
    });
    if (!isFlush) { return; }
    FlushImpact& impact = scratch.flushImpacts.emplace_back();
    impact = {.both = scratch.constraints[ends.own.constraint],
              .own = ends.own.constraint,
              .guest = ends.guest.constraint,
              .pointOfOwn = ends.own.point,
              .pointOfGuest = ends.guest.point};
    impact.both.normal = ofGround->normal;
    impact.both.count = 2;
    impact.both.points = {scratch.constraints[impact.own].points[impact.pointOfOwn],
                          scratch.constraints[impact.guest].points[impact.pointOfGuest]};
    prepareContact(impact.both, scratch.inertias);
    for (const std::uint32_t i : scratch.ofOneGround) { isTaken[i] = 1; }
}

void giveBack(ContactConstraintPoint& to, const ContactConstraintPoint& from) {
    to.totalNormalImpulse = from.totalNormalImpulse;
    to.bounceApproach = from.bounceApproach;
}

}  // namespace

void mergeFlushImpacts(const Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    scratch.flushImpacts.clear();
    const auto count = static_cast<std::uint32_t>(scratch.constraints.size());
    if (count < 2) { return; }
    std::vector<std::uint8_t>& isTaken = scratch.isMerged;
    isTaken.assign(count, 0);
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        if (isTaken[i] == 0 && scratch.constraints[i].slotA == kFixedSlot) { mergeFrom(flight, i, isTaken); }
    }
    if (scratch.flushImpacts.empty()) { return; }
    scratch.order.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
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

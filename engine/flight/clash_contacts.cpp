#include "clash_contacts.h"

#include <algorithm>

#include "../contacts/contact_making.h"
#include "../contacts/hit_event.h"
#include "../solve/constraint_builder.h"
#include "../state/tolerances.h"
#include "flight_state.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What overlaps from the start leaves by itself when it would be out within so many steps; else the solver pushes.
constexpr Real kStepsToLeave = 4;

/// How deep an overlap may be of this step, or of the one before.
Real deepestOwn(const Clash& clash, const ClashPair& pair) {
    return (pair.isRide ? kSlackRatio : kShallowRatio) * clash.world.contacts[pair.contact].extent;
}

/// Sets apart what sank below its target, the lighter one farther. Deep overlaps are from before, and stay as they are.
void setApart(Clash& clash, ClashPair& pair) {
    Flight& first = clash.work.flights[pair.first];
    Flight& second = clash.work.flights[pair.second];
    if (pair.deepest < -deepestOwn(clash, pair)) { return; }
    const auto inverseFirst = static_cast<double>(first.body().inverseMass);
    const auto inverseSecond = static_cast<double>(second.body().inverseMass);
    const DVec2 way = partingWay(clash.world, pair.shapes, pair.deepest, inverseFirst + inverseSecond, pair.normal);
    if (way == DVec2{}) { return; }
    pair.deepest = static_cast<Real>(targetOf(clash.world, pair.shapes));
    const auto shift = [](Flight& flight, DVec2 by) {
        flight.motion.center += by;
        flight.motion.pose = poseOf(flight.motion.center, flight.motion.angle, flight.body().localCenter);
    };
    shift(first, -inverseFirst * way);
    shift(second, inverseSecond * way);
}

BodySlot slotOf(std::size_t flight) { return static_cast<BodySlot>(flight + 1); }

/// Of a pair as it stands now.
Manifold manifoldOf(const Clash& clash, const ClashPair& pair, bool isStart) {
    const Real reach = reachOf(clash.world, pair.shapes);
    const Flight& first = clash.work.flights[pair.first];
    const Flight& second = clash.work.flights[pair.second];
    if (!isStart) { return obstacleManifold(clash.world, pair.shapes, first.motion.pose, second.motion.pose, reach); }
    // The contact has that of the start of the step, with points that are farther apart, too.
    Manifold manifold = clash.world.contacts[pair.contact].manifold;
    manifold.count = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const bool isThere = k < static_cast<std::size_t>(clash.world.contacts[pair.contact].manifold.count);
        if (!isThere || manifold.points[k].separation > reach) { continue; }
        manifold.points[static_cast<std::size_t>(manifold.count++)] = manifold.points[k];
    }
    return manifold;
}

/// Contacts of this moment.
void listMet(Clash& clash, bool isStart) {
    ClashScratch& work = clash.work;
    work.constraints.clear();
    for (std::size_t i = 0; i < work.pairs.size(); ++i) {
        ClashPair& pair = work.pairs[i];
        const Flight& first = work.flights[pair.first];
        const Flight& second = work.flights[pair.second];
        const Manifold manifold = manifoldOf(clash, pair, isStart);
        if (manifold.count == 0) { continue; }
        const Contact& contact = clash.world.contacts[pair.contact];
        ContactConstraint constraint =
            constraintOf(manifold, contactFrameOf(first.motion, first.body().localCenter, second.motion),
                         surfaceOf(clash.world, contact), 0);
        pair.isMet = true;
        pair.normal = constraint.normal;
        pair.deepest = deepestSeparation(manifold);
        constraint.source = static_cast<std::uint32_t>(i);
        constraint.slotA = slotOf(pair.first);
        constraint.slotB = slotOf(pair.second);
        work.constraints.push_back(constraint);
        setApart(clash, pair);
    }
}

void report(Clash& clash, const ContactConstraint& constraint) {
    ClashPair& pair = clash.work.pairs[constraint.source];
    const Flight& first = clash.work.flights[pair.first];
    const Flight& second = clash.work.flights[pair.second];
    for (std::size_t k = 0; k < pair.impulse.size(); ++k) {
        pair.impulse[k] += constraint.points[k].totalNormalImpulse;
    }
    if (!(impactSpeed(constraint) > std::max(first.threshold(), second.threshold()))) { return; }
    const Contact& contact = clash.world.contacts[pair.contact];
    clash.scratch.events.push_back(hitOf(clash.world, contact.shapeA, contact.shapeB, constraint, second.motion.center,
                                         second.elapsed / clash.dt));
}

void reflect(Clash& clash) {
    FlightScratch& scratch = clash.scratch;
    scratch.states.assign(1, {});
    scratch.inertias.assign(1, {});
    Real threshold = 0;
    for (const Flight& flight : clash.work.flights) {
        scratch.states.push_back(
            {.velocity = flight.motion.velocity, .angularVelocity = flight.motion.angularVelocity});
        scratch.inertias.push_back({flight.body().inverseMass, flight.body().inverseInertia});
        threshold = std::max(threshold, flight.threshold());
    }
    scratch.order.clear();
    for (ContactConstraint& constraint : clash.work.constraints) {
        prepareContact(constraint, scratch.inertias);
        scratch.order.push_back(&constraint);
    }
    reflectOrStop(scratch, threshold);
    for (std::size_t i = 0; i < clash.work.flights.size(); ++i) {
        BodyMotion& motion = clash.work.flights[i].motion;
        motion.velocity = scratch.states[slotOf(i)].velocity;
        motion.angularVelocity = scratch.states[slotOf(i)].angularVelocity;
    }
}

}  // namespace

void resolvePairs(Clash& clash, bool isStart) {
    listMet(clash, isStart);
    if (clash.work.constraints.empty()) { return; }
    reflect(clash);
    for (const ContactConstraint& constraint : clash.work.constraints) { report(clash, constraint); }
}

bool allLeave(const Clash& clash) {
    for (const ContactConstraint& constraint : clash.work.constraints) {
        const ClashPair& pair = clash.work.pairs[constraint.source];
        const BodyMotion& a = clash.work.flights[pair.first].motion;
        const BodyMotion& b = clash.work.flights[pair.second].motion;
        for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
            const ContactConstraintPoint& point = constraint.points[k];
            const Real depth = -point.baseSeparation;
            const Vec2 velocity = b.velocity + cross(b.angularVelocity, point.anchorB) - a.velocity -
                                  cross(a.angularVelocity, point.anchorA);
            const Real way = static_cast<Real>(clash.dt) * dot(velocity, constraint.normal);
            if (depth > deepestOwn(clash, pair) && !(kStepsToLeave * way > depth)) { return false; }
        }
    }
    return true;
}

}  // namespace swept::inline SWEPT_PRECISION

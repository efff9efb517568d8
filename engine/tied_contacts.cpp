#include "tied_contacts.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "../solver/contact_lanes.h"
#include "effort_budget.h"
#include "modes.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Softness softnessFor(const WorldState& world, const TiedGroup& group, Real dt, Real h) {
    const Real usual = dt / static_cast<Real>(standardSubSteps(world.settings, group.effort));
    return softnessOfSubStep(kContactCycles, kContactDampingRatio, std::max(h, usual));
}

/// Contacts that are fetched from memory ahead of time: before a solve, and after it, which has displaced
/// them.
constexpr std::size_t kOutcomesAhead = 8;

void fetchForSolve(const Contact& contact) {
    constexpr std::size_t kLine = 64;
    const char* const first = reinterpret_cast<const char*>(&contact);
    for (std::size_t i = 0; i < offsetof(Contact, kept); i += kLine) { __builtin_prefetch(first + i); }
}

void fetchOutcome(const Contact& contact) {
    __builtin_prefetch(&contact.normalImpulse);
    __builtin_prefetch(&contact.pressed);
}

/// For `SolverSettings::settled`: what presses holds where it is, what is apart is not in the way.
void holdAsItIs(ContactConstraintPoint& point) {
    point.separation = point.normalImpulse > 0 ? Real(0) : point.baseSeparation;
}

/// How fast a point comes along the normal; less than 0: it goes.
Real approachAt(const ContactConstraintPoint& point, Vec2 normal, const BodyState& a, const BodyState& b) {
    return -dot(velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA), normal);
}

Real approachSpeedOf(const ContactConstraint& constraint, const SolverBatch& batch) {
    Real fastest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i) {
        fastest = std::max(fastest, approachAt(constraint.points[i], constraint.normal, batch.states[constraint.slotA],
                                               batch.states[constraint.slotB]));
    }
    return fastest;
}

}  // namespace

TiedContacts::TiedContacts(WorldState& world, const TiedGroup& group, const StepPart& part, Real h, Real scale)
    : world_(world),
      group_(group),
      part_(part),
      scale_(scale),
      dt_(static_cast<Real>(part.dt)),
      hitThreshold_(length(world.settings.gravity) * dt_),
      softness_(softnessFor(world, group, dt_, h)) {}

/// Of all contacts with points of which the group moves a body, in their order, and whether they bounce.
template <class Visit>
void TiedContacts::forEachLink(Visit&& visit) const {
    const std::vector<BodyInertia>& inertias = group_.desk.batch.inertias;
    const auto visitIfTied = [&](ContactLink link, std::uint32_t bodyA, std::uint32_t bodyB, bool bounces) {
        link.slotA = world_.solverSlots[bodyA];
        link.slotB = world_.solverSlots[bodyB];
        if (isMovable(inertias[link.slotA]) || isMovable(inertias[link.slotB])) { visit(link, bounces); }
    };
    if (group_.role == BodyRole::solved) {
        for (const TouchingPair& pair : world_.touching) {
            visitIfTied({.source = pair.contact, .points = pair.points}, pair.bodyA, pair.bodyB, pair.bounces);
        }
        return;
    }
    for (std::uint32_t i = 0; i < group_.contacts.size(); ++i) {
        const Contact& contact = group_.contacts[i];
        if (contact.isSolid()) {
            visitIfTied({.source = i, .points = static_cast<std::uint8_t>(contact.manifold.count)}, contact.bodyA,
                        contact.bodyB, contact.restitution > 0);
        }
    }
}

ContactConstraint TiedContacts::constraintFor(const ContactLink& link) {
    Contact& contact = group_.contacts[link.source];
    ContactConstraint constraint = constraintOf(
        contact.manifold, world_.motions[contact.bodyA], world_.bodies[contact.bodyA].localCenter,
        world_.motions[contact.bodyB], contact.friction, contact.restitution, kPushRatio * contact.extent / dt_);
    constraint.slotA = link.slotA;
    constraint.slotB = link.slotB;
    constraint.softness = softness_;
    constraint.radiusA = contact.radiusA;
    constraint.radiusB = contact.radiusB;
    constraint.source = link.source;
    constraint.bounceSpeed = bounceSpeedOf(contact);
    for (std::size_t k = 0; k < link.points; ++k) {
        constraint.points[k].normalImpulse = scale_ * contact.normalImpulse[k];
        constraint.points[k].tangentImpulse = scale_ * contact.tangentImpulse[k];
        if (group_.effort.isSettled) { holdAsItIs(constraint.points[k]); }
    }
    contact.approachSpeed = approachSpeedOf(constraint, group_.desk.batch);
    return constraint;
}

/// The same as `constraintFor`, without making one.
template <std::size_t kPoints>
void TiedContacts::fillContact(WideContact<kPoints>& block, std::size_t lane, const ContactLink& link) {
    Contact& contact = group_.contacts[link.source];
    const SolverBatch& batch = group_.desk.batch;
    const BodyMotion& a = world_.motions[contact.bodyA];
    // Of the bodies of a solve it stands in an array of their own; what does not move in it is most often one and the
    // same.
    const Vec2 localCenterA =
        link.slotA != kFixedSlot ? group_.desk.localCenters[link.slotA] : world_.bodies[contact.bodyA].localCenter;
    const Vec2 fromAToB = toReal(world_.motions[contact.bodyB].center - a.center);
    const Vec2 normal = rotate(a.pose.rotation, contact.manifold.normal);
    Real approach = 0;
    for (std::size_t k = 0; k < kPoints; ++k) {
        ContactConstraintPoint point = constraintPointOf(contact.manifold.points[k], a, localCenterA, fromAToB);
        point.normalImpulse = scale_ * contact.normalImpulse[k];
        point.tangentImpulse = scale_ * contact.tangentImpulse[k];
        if (group_.effort.isSettled) { holdAsItIs(point); }
        if (!contact.pressed) {  // else nobody asks
            approach =
                std::max(approach, approachAt(point, normal, batch.states[link.slotA], batch.states[link.slotB]));
        }
        fillNewPoint(block.points[k], lane, point);
        if (group_.effort.isSettled) { block.points[k].separation[lane] = point.separation; }
    }
    contact.approachSpeed = approach;
    if (lane == 0) { setSoftness(block, softness_); }  // the first to be filled
    fillHead(block, lane,
             {.slotA = link.slotA,
              .slotB = link.slotB,
              .normal = normal,
              .friction = contact.friction,
              .maxPushSpeed = kPushRatio * contact.extent / dt_,
              .radiusA = contact.radiusA,
              .radiusB = contact.radiusB,
              .bounceSpeed = bounceSpeedOf(contact),
              .restitution = contact.restitution},
             batch.inertias[link.slotA], batch.inertias[link.slotB]);
}

Real TiedContacts::bounceSpeedOf(const Contact& contact) const {
    return contact.restitution > kLivelyRestitution ? bounceSpeed_ : std::numeric_limits<Real>::infinity();
}

std::size_t TiedContacts::countBouncing() const {
    std::size_t count = 0;
    forEachLink([&count](const ContactLink&, bool bounces) { count += bounces ? 1 : 0; });
    return count;
}

void TiedContacts::link(bool inTurn) {
    SolverBatch& batch = group_.desk.batch;
    if (inTurn) { bounceSpeed_ = hitThreshold_; }
    forEachLink([&batch, inTurn](ContactLink link, bool bounces) {
        link.isAlone = bounces && !inTurn;  // who bounces together is found contact by contact
        batch.links.push_back(link);
    });
    batch.store = this;
}

void TiedContacts::addConstraints() {
    SolverBatch& batch = group_.desk.batch;
    forEachLink([&](const ContactLink& link, bool) { batch.contacts.push_back(constraintFor(link)); });
    if (world_.watched) { anchorAhead(); }
}

/// What was made ahead is held by its cores (mode `speculative`).
void TiedContacts::anchorAhead() {
    for (ContactConstraint& constraint : group_.desk.batch.contacts) {
        Contact& contact = group_.contacts[constraint.source];
        if (!isAhead(world_, contact)) { continue; }
        anchorAtCores(constraint, contact.radiusA, contact.radiusB);
        contact.approachSpeed = approachSpeedOf(constraint, group_.desk.batch);
    }
}

void TiedContacts::readConstraints() {
    for (const ContactConstraint& constraint : group_.desk.batch.contacts) { takeConstraint(constraint); }
    end();
}

/// Hits become events in the order of their contacts, whoever found them.
void TiedContacts::end() {
    std::vector<ContactHit>& hits = group_.desk.hits;
    std::sort(hits.begin(), hits.end(), [](const ContactHit& a, const ContactHit& b) { return a.contact < b.contact; });
    for (const ContactHit& hit : hits) { group_.desk.events.push_back(hit.event); }
    hits.clear();
}

std::size_t TiedContacts::count() const {
    return group_.desk.batch.store != nullptr ? group_.desk.batch.links.size() : group_.desk.batch.contacts.size();
}

void TiedContacts::fill(std::size_t first, std::span<const ContactPlace> places, const ContactArrays& to) {
    const std::span<const ContactLink> links = std::span(group_.desk.batch.links).subspan(first);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ContactPlace& place = places[i];
        const ContactLink& link = links[i];
        if (i + kOutcomesAhead < links.size()) { fetchForSolve(group_.contacts[links[i + kOutcomesAhead].source]); }
        switch (place.points) {
            case 2:
                fillContact(to.two[place.index], place.lane, link);
                break;
            case 1:
                fillContact(to.one[place.index], place.lane, link);
                break;
            default:
                to.rest[place.index] = constraintFor(link);
        }
    }
}

void TiedContacts::take(std::size_t first, std::span<const ContactPlace> places, const ContactArrays& from) {
    const std::span<const ContactLink> links = std::span(group_.desk.batch.links).subspan(first);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i + kOutcomesAhead < links.size()) { fetchOutcome(group_.contacts[links[i + kOutcomesAhead].source]); }
        const ContactPlace& place = places[i];
        Contact& contact = group_.contacts[links[i].source];
        switch (place.points) {
            case 2:
                takeContact(from.two[place.index], place.lane, contact);
                break;
            case 1:
                takeContact(from.one[place.index], place.lane, contact);
                break;
            default:
                takeConstraint(from.rest[place.index]);
        }
    }
}

template <std::size_t kPoints>
void TiedContacts::takeContact(const WideContact<kPoints>& block, std::size_t lane, Contact& contact) {
    Outcome outcome{.normal = {block.normalX[lane], block.normalY[lane]}};
    for (std::size_t k = 0; k < kPoints; ++k) {
        outcome.normalImpulse[k] = block.points[k].normalImpulse[lane];
        outcome.tangentImpulse[k] = block.points[k].tangentImpulse[lane];
        outcome.totalImpulse[k] = block.points[k].totalNormalImpulse[lane];
    }
    takeOutcome(contact, kPoints, outcome);
}

void TiedContacts::takeConstraint(const ContactConstraint& constraint) {
    Outcome outcome{
        .normal = constraint.normal,
        .bounceApproach = std::max(constraint.points[0].bounceApproach, constraint.points[1].bounceApproach)};
    for (std::size_t k = 0; k < constraint.points.size(); ++k) {
        outcome.normalImpulse[k] = constraint.points[k].normalImpulse;
        outcome.tangentImpulse[k] = constraint.points[k].tangentImpulse;
        outcome.totalImpulse[k] = constraint.points[k].totalNormalImpulse;
    }
    takeOutcome(group_.contacts[constraint.source], static_cast<std::size_t>(constraint.count), outcome);
}

void TiedContacts::takeOutcome(Contact& contact, std::size_t points, const Outcome& outcome) {
    const auto kept = [this](Real impulse) { return scale_ == 1 ? impulse : impulse / scale_; };  // most often it is
    if (!contact.pressed) { noteHit(contact, outcome); }
    const bool pressedBefore = contact.pressed;
    contact.pressed = false;
    for (std::size_t k = 0; k < points; ++k) {
        contact.normalImpulse[k] = kept(outcome.normalImpulse[k]);
        contact.tangentImpulse[k] = kept(outcome.tangentImpulse[k]);
        contact.totalImpulse[k] = outcome.totalImpulse[k];
        contact.pressed = contact.pressed || contact.totalImpulse[k] > 0;
    }
    contact.pressedOn = pressedBefore && contact.pressed;
}

/// A contact that began to press while it approached faster than resting contacts do, or that bounced, is a hit.
/// @pre it did not press before
void TiedContacts::noteHit(const Contact& contact, const Outcome& outcome) {
    const Real speed = std::max(contact.approachSpeed, outcome.bounceApproach);
    const Real impulse = outcome.totalImpulse[0] + outcome.totalImpulse[1];
    if (!(impulse > 0) || !(speed > hitThreshold_)) { return; }
    const std::size_t k = outcome.totalImpulse[1] > outcome.totalImpulse[0] ? 1 : 0;
    const BodyMotion& a = world_.motions[contact.bodyA];
    // The gap closes at the approach speed: a first-order estimate of when in the step.
    const auto gap = static_cast<double>(std::max(contact.manifold.points[k].separation, Real(0)));
    const double wait = std::min(gap / static_cast<double>(speed), part_.length);
    const auto place = static_cast<std::uint32_t>(&contact - group_.contacts.data());
    const ContactEvent hit{.type = ContactEventType::hit,
                           .shapeA = world_.shapes.idOf(world_.shapes[contact.shapeA].head),
                           .shapeB = world_.shapes.idOf(world_.shapes[contact.shapeB].head),
                           .bodyA = world_.bodies.idOf(contact.bodyA),
                           .bodyB = world_.bodies.idOf(contact.bodyB),
                           .fraction = (part_.begin + wait) / part_.dt,
                           .point = apply(a.pose, contact.manifold.points[k].point),
                           .normal = outcome.normal,
                           .approachSpeed = speed,
                           .impulse = impulse};
    const HeldLock lock(hitting_);
    group_.desk.hits.push_back({place, hit});
}

}  // namespace swept::inline SWEPT_PRECISION

#include "bullet_impact.h"

#include <algorithm>

#include "../../solver/impacts/impact.h"
#include "../contacts/hit_event.h"
#include "../solve/blow_answer.h"
#include "../solve/constraint_builder.h"
#include "../solve/joint_place.h"
#include "bullet_paths.h"
#include "bullet_search.h"
#include "flight_state.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Two points of a contact, and friction at each: more rounds change nothing.
constexpr int kPairRounds = 8;

void report(WorldState& world, const BulletMeeting& pair, const ContactConstraint& constraint) {
    const Flight& second = partnerIn(world.bulletWork, pair.second).flight;
    if (!(impactSpeed(constraint) > second.threshold())) { return; }
    second.scratch->events.push_back(
        hitOf(world, pair.shapes.other, pair.shapes.own, constraint, second.motion.center, pair.time / second.dt));
}

/// In the contact that they have, if it was that of a clash.
void noteImpulse(WorldState& world, const BulletMeeting& pair, const ContactConstraint& constraint) {
    const std::uint32_t clash = partnerIn(world.bulletWork, pair.first).clash;
    if (clash == kNoIndex || clash != partnerIn(world.bulletWork, pair.second).clash) { return; }
    for (const std::uint32_t index : world.fastIslands.contacts.of(clash)) {
        Contact& contact = world.contacts[world.probes[index].contact];
        const bool isTheirs = (contact.shapeA == pair.shapes.other && contact.shapeB == pair.shapes.own) ||
                              (contact.shapeA == pair.shapes.own && contact.shapeB == pair.shapes.other);
        if (!isTheirs) { continue; }
        for (std::size_t k = 0; k < contact.totalImpulse.size(); ++k) {
            contact.totalImpulse[k] += constraint.points[k].totalNormalImpulse;
            contact.pressed = contact.pressed || contact.totalImpulse[k] > 0;
        }
    }
}

/// In slacks: what is deeper in each other did not get there while it was swept. It stays, as in a clash: to set it
/// apart at once would put one of both through what is beside it. Bullets that something squeezes get as deep as that.
constexpr int kDeepest = 1;
constexpr int kDeepestOfBullets = 4;

/// Sets them back to their target along the normal, the lighter one farther; what is on its way by the solver stays on
/// it.
void setApart(WorldState& world, const BulletMeeting& pair, Real deepest, Vec2 normal) {
    BulletPartner& first = partnerIn(world.bulletWork, pair.first);
    BulletPartner& second = partnerIn(world.bulletWork, pair.second);
    const int slacks = first.isBullet || second.isBullet ? kDeepestOfBullets : kDeepest;
    if (-static_cast<double>(deepest) > slacks * slackOf(world, pair.shapes)) { return; }
    const double inverseFirst = first.flies ? static_cast<double>(first.flight.body().inverseMass) : 0;
    const double inverseSecond = second.flies ? static_cast<double>(second.flight.body().inverseMass) : 0;
    const DVec2 way = partingWay(world, pair.shapes, deepest, inverseFirst + inverseSecond, normal);
    if (way == DVec2{}) { return; }
    shift(first.flight, -inverseFirst * way);
    shift(second.flight, inverseSecond * way);
}

BodySlot slotOf(const BulletWork& work, std::uint32_t body) {
    const auto place = std::find(work.members.begin(), work.members.end(), work.indices[body]);
    return static_cast<BodySlot>(place - work.members.begin() + 1);
}

/// A hinge by which a body turns on the ground, or on something kinematic, and which no other body has a part in; null:
/// none. (The first link of a rope goes as the rope lets it: three blows of one moment gave it six times the energy
/// that there was, when it turned as if it hung alone, and answered as if it were free.)
const Joint* groundHingeOf(const WorldState& world, std::uint32_t slot) {
    if (!isHeldByGround(world, slot)) { return nullptr; }
    for (const std::uint32_t index : world.bodies[slot].joints) {
        const Joint& joint = world.joints[index];
        const std::uint32_t other = joint.bodyA == slot ? joint.bodyB : joint.bodyA;
        if (joint.type() == JointType::revolute && joint.holds() && !world.bodies[other].isDynamic()) { return &joint; }
    }
    return nullptr;
}

/// From where a body stands at this moment to where its joints are known, at the end of the step.
Rotation turnToEnd(const WorldState& world, const Flight& flight) {
    return rotationFromAngle(world.motions[flight.slot].angle - flight.motion.angle);
}

/// Of what joints hold to its way.
BlowAnswer answerIn(const WorldState& world, const BulletPartner& partner, Vec2 arm, Vec2 direction) {
    const Flight& flight = partner.flight;
    if (partner.flies || flight.body().holdingJoints == 0) { return {}; }
    if (groundHingeOf(world, flight.slot) == nullptr) { return answerOf(world, flight.slot, arm, direction); }
    const Rotation turn = turnToEnd(world, flight);
    const BlowAnswer then = answerOf(world, flight.slot, rotate(turn, arm), rotate(turn, direction));
    const Vec2 x = rotate(turn, {1, 0});
    const Vec2 y = rotate(turn, {0, 1});
    return {.isHeld = then.isHeld,
            .xx = then.along(x, 0, x, 0),
            .xy = then.along(x, 0, y, 0),
            .yy = then.along(y, 0, y, 0),
            .xt = dot(x, then.velocity({}, 1)),
            .yt = dot(y, then.velocity({}, 1)),
            .tt = then.tt};
}

/// Contacts of this moment. One that is not in reach after all comes later.
void listImpacts(WorldState& world, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    scratch.constraints.clear();
    work.separations.clear();
    for (std::size_t i = 0; i < work.together.size(); ++i) {
        const BulletMeeting& pair = work.together[i];
        const Flight& first = partnerIn(work, pair.first).flight;
        const Flight& second = partnerIn(work, pair.second).flight;
        const Manifold manifold =
            obstacleManifold(world, pair.shapes, first.motion.pose, second.motion.pose, reachOf(world, pair.shapes));
        if (manifold.count == 0) { continue; }
        const ShapeDef& own = world.shapes[pair.shapes.own].def;
        const ShapeDef& other = world.shapes[pair.shapes.other].def;
        ContactConstraint constraint =
            constraintOf(manifold, contactFrameOf(first.motion, first.body().localCenter, second.motion),
                         mixedSurface(own, other), 0);
        constraint.source = static_cast<std::uint32_t>(i);
        constraint.slotA = slotOf(work, pair.first);
        constraint.slotB = slotOf(work, pair.second);
        const BlowArms arms = armsOf(constraint);
        constraint.answerA = answerIn(world, partnerIn(work, pair.first), arms.a, -constraint.normal);
        constraint.answerB = answerIn(world, partnerIn(work, pair.second), arms.b, constraint.normal);
        scratch.constraints.push_back(constraint);
        work.separations.push_back(deepestSeparation(manifold));
    }
}

/// Whether it keeps to the path that it began the step with, at the speed of that.
bool keepsPath(const BulletPartner& partner) { return partner.tied && !partner.flies && !partner.stopped; }

/// What turns about a hinge on the ground goes as it turns, whatever the chord of its way says.
void leadAbout(const WorldState& world, const Joint& hinge, BulletPartner& partner) {
    const Flight& flight = partner.flight;
    const bool isA = hinge.bodyA == flight.slot;
    const Vec2 anchor = isA ? hinge.localAnchorA : hinge.localAnchorB;
    const Vec2 center = -rotate(flight.motion.pose.rotation, anchor - flight.body().localCenter);  // from the hinge
    const std::uint32_t ground = isA ? hinge.bodyB : hinge.bodyA;
    const BodyMotion& under = world.motions[ground];
    const Vec2 arm = armOf(world, ground, isA ? hinge.localAnchorB : hinge.localAnchorA);
    const Real spin = flight.motion.angularVelocity + partner.angularLead;
    partner.lead = under.velocity + cross(under.angularVelocity, arm) + cross(spin, center) - flight.motion.velocity;
}

/// @return the threshold below which they do not bounce, m/s
Real listStates(WorldState& world, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    scratch.states.assign(1, {});
    scratch.inertias.assign(1, {});
    for (const std::uint32_t index : work.members) {
        BulletPartner& partner = work.partners[index];
        const Flight& flight = partner.flight;
        BodyState& state = scratch.states.emplace_back();
        state.velocity = flight.motion.velocity;
        state.angularVelocity = flight.motion.angularVelocity;
        if (keepsPath(partner)) {
            if (const Joint* const hinge = groundHingeOf(world, flight.slot)) { leadAbout(world, *hinge, partner); }
            state.velocity += partner.lead;
            state.angularVelocity += partner.angularLead;
        }
        scratch.inertias.push_back({flight.body().inverseMass, flight.body().inverseInertia});
    }
    Real threshold = 0;
    for (const BulletMeeting& pair : work.together) {
        threshold = std::max(threshold, work.partners[work.indices[pair.second]].flight.threshold());
    }
    return threshold;
}

/// Velocities of what keeps its path are those of the end of the step.
void takeVelocity(const WorldState& world, BulletPartner& partner, const BodyState& state) {
    BodyMotion& motion = partner.flight.motion;
    const bool keeps = keepsPath(partner);
    const Vec2 lead = keeps ? partner.lead : Vec2{};
    if (keeps && groundHingeOf(world, partner.flight.slot) != nullptr) {
        motion.velocity += rotate(turnToEnd(world, partner.flight), state.velocity - lead - motion.velocity);
    } else {
        motion.velocity = keeps ? state.velocity - lead : state.velocity;
    }
    motion.angularVelocity = keeps ? state.angularVelocity - partner.angularLead : state.angularVelocity;
}

void reflect(WorldState& world, FlightScratch& scratch, Real threshold) {
    scratch.order.clear();
    for (ContactConstraint& constraint : scratch.constraints) {
        prepareContact(constraint, scratch.inertias);
        scratch.order.push_back(&constraint);
    }
    if (scratch.order.size() == 1) {
        const ImpactRule rule{.restitutionThreshold = threshold, .resolvePlastic = true};
        resolveImpacts(scratch.order, {scratch.states, scratch.inertias}, rule, kPairRounds);
    } else {
        reflectOrStop(scratch, threshold);
    }
    BulletWork& work = world.bulletWork;
    for (std::size_t i = 0; i < work.members.size(); ++i) {
        BulletPartner& partner = work.partners[work.members[i]];
        takeVelocity(world, partner, scratch.states[i + 1]);
    }
}

}  // namespace

void listMembers(BulletWork& work) {
    work.members.clear();
    for (const BulletMeeting& pair : work.together) {
        for (const std::uint32_t slot : {pair.first, pair.second}) {
            const std::uint32_t index = work.indices[slot];
            if (std::find(work.members.begin(), work.members.end(), index) == work.members.end()) {
                work.members.push_back(index);
            }
        }
    }
}

void collideBodies(WorldState& world, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    listImpacts(world, scratch);
    if (scratch.constraints.empty()) { return; }
    const Real threshold = listStates(world, scratch);
    reflect(world, scratch, threshold);
    for (std::size_t i = 0; i < scratch.constraints.size(); ++i) {
        const ContactConstraint& constraint = scratch.constraints[i];
        const BulletMeeting& pair = work.together[constraint.source];
        report(world, pair, constraint);
        noteImpulse(world, pair, constraint);
        setApart(world, pair, work.separations[i], constraint.normal);
        const bool bounces = constraint.restitution > 0 && impactSpeed(constraint) > threshold;
        setCarrier(work, pair, bounces ? Vec2{} : constraint.normal);
    }
}

}  // namespace swept::inline SWEPT_PRECISION

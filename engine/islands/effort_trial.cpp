#include "effort_trial.h"

#include <algorithm>

#include "../bodies/body_mass.h"
#include "../solve/joint_builder.h"
#include "../solve/solve_outcome.h"
#include "../state/profile.h"
#include "../state/world_state.h"
#include "effort_budget.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// By what a doubling of the sub-steps is taken to divide the error, try by try: by four where things press steadily,
/// by two in a blow; and what neither mended has all the sub-steps there may be. Tries in vain cost less than the last
/// one: each has at least twice the sub-steps.
constexpr std::array<Real, 3> kErrorOfDoublingByTry{4, 2, 1};

bool isMember(const WorldState& world, std::uint32_t slot, Effort effort) {
    const Body& body = world.bodies[slot];
    return body.role == BodyRole::solved && body.effort == effort;
}

template <class Visit>
void forEachKinematic(const WorldState& world, const Visit& visit) {
    if (world.kinematicBodies == 0) { return; }
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].def.type == BodyType::kinematic) { visit(slot); }
    }
}

void moveKinematics(WorldState& world, double dt) {
    world.trial.bodies.resize(std::max<std::size_t>(world.trial.bodies.size(), world.bodies.slotCount()));
    forEachKinematic(world, [&](std::uint32_t slot) {
        BodyMotion& motion = world.motions[slot];
        world.trial.bodies[slot].motion = motion;
        motion.center += dt * toDouble(motion.velocity);
        motion.angle += dt * static_cast<double>(motion.angularVelocity);
        updatePose(world, slot);
    });
}

void putKinematicsBack(WorldState& world) {
    forEachKinematic(world, [&](std::uint32_t slot) { world.motions[slot] = world.trial.bodies[slot].motion; });
}

const WorldTransform& poseBeforeTrial(const WorldState& world, std::uint32_t slot) {
    const bool mayMove = world.bodies[slot].def.type != BodyType::fixed;
    return mayMove ? world.trial.bodies[slot].motion.pose : world.motions[slot].pose;
}

/// What the motion of the step makes of the points that a contact had as it began: how deep they are, metres.
Real depthAfter(const WorldState& world, const Contact& contact) {
    const Transform before =
        relativeTransform(poseBeforeTrial(world, contact.bodyA), poseBeforeTrial(world, contact.bodyB));
    const Transform after = relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
    const Manifold& manifold = contact.manifold;
    const Rotation turn = after.rotation * inverse(before.rotation);
    const Vec2 normal = manifold.isNormalOfB ? rotate(turn, manifold.normal) : manifold.normal;
    Real depth = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        const ManifoldPoint& point = manifold.points[i];
        const Vec2 moved = after.translation + rotate(turn, point.point - before.translation) - point.point;
        depth = std::max(depth, -(point.separation + dot(moved, normal)));
    }
    return depth;
}

void measureJoint(WorldState& world, const Joint& joint) {
    const auto bodies = joint.allBodies();
    const auto moves = [&world](std::uint32_t slot) { return world.bodies[slot].isDynamic(); };
    const std::uint32_t slot = *std::find_if(bodies.begin(), bodies.end(), moves);
    Real& error = world.islandErrors[world.islands.find(slot)].jointErrorAfter;
    error = std::max(error, errorsOf(world, joint).length);
}

void measureClass(WorldState& world, Effort effort, double dt) {
    for (const std::uint32_t slot : world.trial.members) {
        IslandErrors& errors = world.islandErrors[slot];
        errors.penetrationAfter = errors.jointErrorAfter = 0;
    }
    moveKinematics(world, dt);
    for (const TouchingPair& pair : world.touching) {
        const std::uint32_t slot = pair.dynamicBody();
        if (!isMember(world, slot, effort)) { continue; }
        Real& depth = world.islandErrors[world.islands.find(slot)].penetrationAfter;
        depth = std::max(depth, depthAfter(world, world.contacts[pair.contact]));
    }
    for (const std::uint32_t i : world.tiedJoints) { measureJoint(world, world.joints[i]); }
    putKinematicsBack(world);
}

/// How far an error is beyond what a step may end with, as a ratio; 0: not at all, or it was there before.
Real excessOf(Real after, Real before, Real budget) {
    return after > kGoodBudgetRatio * budget && after > before ? after / (kGoodBudgetRatio * budget) : 0;
}

/// Sub-steps for another try. @return whether there is one
bool raise(IslandErrors& errors, Effort& effort, const WorldSettings& settings) {
    const Real excess = std::max(excessOf(errors.penetrationAfter, errors.penetration, settings.maxPenetration),
                                 excessOf(errors.jointErrorAfter, errors.jointError, settings.maxJointError));
    if (!(excess > 0) || errors.tries == kErrorOfDoublingByTry.size()) { return false; }
    const int subSteps = subStepsOf(settings);
    const int most = std::max(kMostSubSteps, subSteps);
    const std::int8_t first = effort.doublings;
    for (Real left = excess; left > 1; left /= kErrorOfDoublingByTry[errors.tries]) {
        Effort more = effort;  // a large web is searched as patiently, and what takes turns stays in their class
        ++more.doublings;
        if (subStepsFor(more, subSteps) > most) { break; }
        effort = more;
    }
    if (effort.doublings == first) { return false; }
    ++errors.tries;
    return true;
}

/// @return whether some island has another try
bool raiseMissed(WorldState& world, Effort effort) {
    bool any = false;
    for (const std::uint32_t slot : world.trial.members) {
        if (world.islands.find(slot) != slot) { continue; }
        IslandErrors& errors = world.islandErrors[slot];
        errors.next = effort;
        any = raise(errors, errors.next, world.settings) || any;
    }
    return any;
}

/// In order of their sub-steps.
void addEffort(std::vector<Effort>& efforts, std::size_t place, Effort effort) {
    const auto later = efforts.begin() + static_cast<std::ptrdiff_t>(place) + 1;
    if (std::find(later, efforts.end(), effort) != efforts.end()) { return; }
    efforts.insert(std::find_if(later, efforts.end(), [&](Effort e) { return e.doublings > effort.doublings; }),
                   effort);
}

/// As it was remembered: what `isTakenBack` tells of a body's slot.
template <class IsTakenBack>
void restoreClass(WorldState& world, const IsTakenBack& isTakenBack) {
    const EffortTrial& trial = world.trial;
    for (const ContactOutcome& outcome : trial.contacts) {
        Contact& contact = world.contacts[outcome.contact];
        if (isTakenBack(contact.dynamicBody())) { restore(contact, outcome); }
    }
    for (std::size_t i = 0; i < trial.joints.size(); ++i) {
        Joint& joint = world.joints[world.tiedJoints[i]];
        const auto bodies = joint.allBodies();
        if (std::any_of(bodies.begin(), bodies.end(), isTakenBack)) { joint = trial.joints[i]; }
    }
    const auto events = world.contactEvents.begin() + static_cast<std::ptrdiff_t>(trial.events);
    world.contactEvents.erase(std::remove_if(events, world.contactEvents.end(),
                                             [&](const ContactEvent& event) {
                                                 return isTakenBack(event.bodyA.index) ||
                                                        isTakenBack(event.bodyB.index);
                                             }),
                              world.contactEvents.end());
    for (const std::uint32_t slot : trial.members) {
        if (!isTakenBack(slot)) { continue; }
        restore(world, slot, trial.bodies[slot]);
        ++world.counters.bodiesAgain;
    }
    for (const ChainLoan& loan : trial.loans) {
        JointChain& chain = world.jointChains.list[loan.chain];
        if (isTakenBack(chain.lowest)) { chain.lent = loan.lent; }
    }
}

void rememberLoans(WorldState& world, Effort effort) {
    world.trial.loans.clear();
    if (!world.jointChains.mayAnyLend) { return; }
    const std::vector<JointChain>& chains = world.jointChains.list;
    for (std::uint32_t i = 0; i < chains.size(); ++i) {
        const bool isIn = chains[i].mayLend && isMember(world, chains[i].lowest, effort);
        if (isIn) { world.trial.loans.push_back({.chain = i, .lent = chains[i].lent}); }
    }
}

}  // namespace

void rememberClass(WorldState& world, Effort effort) {
    EffortTrial& trial = world.trial;
    trial.bodies.resize(std::max<std::size_t>(trial.bodies.size(), world.bodies.slotCount()));
    trial.members.clear();
    for (const std::uint32_t slot : world.tied) {
        if (!isMember(world, slot, effort)) { continue; }
        trial.members.push_back(slot);
        trial.bodies[slot] = outcomeOf(world, slot);
    }
    trial.contacts.clear();
    for (const TouchingPair& pair : world.touching) {
        if (!isMember(world, pair.dynamicBody(), effort)) { continue; }
        trial.contacts.push_back(outcomeOf(world.contacts[pair.contact], pair.contact));
    }
    trial.joints.clear();
    for (const std::uint32_t i : world.tiedJoints) { trial.joints.push_back(world.joints[i]); }
    rememberLoans(world, effort);
    trial.events = world.contactEvents.size();
}

void takeBackMissed(WorldState& world, std::size_t place, double dt) {
    const Effort effort = world.efforts[place];
    measureClass(world, effort, dt);
    if (!raiseMissed(world, effort)) { return; }
    const auto isTakenBack = [&world](std::uint32_t slot) {
        const Body& body = world.bodies[slot];
        return body.role == BodyRole::solved && world.islandErrors[world.islands.find(slot)].next != body.effort;
    };
    restoreClass(world, isTakenBack);
    for (const std::uint32_t slot : world.trial.members) {
        const Effort next = world.islandErrors[world.islands.find(slot)].next;
        Body& body = world.bodies[slot];
        if (next == body.effort) { continue; }
        body.effort = next;
        addEffort(world.efforts, place, next);
    }
}

void takeBackClass(WorldState& world, std::size_t place, Effort next) {
    const Effort effort = world.efforts[place];
    restoreClass(world, [&world, effort](std::uint32_t slot) { return isMember(world, slot, effort); });
    for (const std::uint32_t slot : world.trial.members) { world.bodies[slot].effort = next; }
    addEffort(world.efforts, place, next);
}

bool raiseMissedJoints(WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> joints,
                       double dt) {
    IslandErrors& errors = world.islandErrors[world.islands.find(members.front())];
    errors.penetrationAfter = errors.jointErrorAfter = 0;
    moveKinematics(world, dt);
    for (const std::uint32_t i : joints) { measureJoint(world, world.joints[i]); }
    putKinematicsBack(world);
    Effort effort = world.bodies[members.front()].effort;
    if (!raise(errors, effort, world.settings)) { return false; }
    for (const std::uint32_t slot : members) { world.bodies[slot].effort = effort; }
    world.counters.bodiesAgain += members.size();
    return true;
}

}  // namespace swept::inline SWEPT_PRECISION

#include "clash.h"

#include <algorithm>
#include <cmath>

#include "constraint_builder.h"
#include "flight_state.h"
#include "modes.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Every impact looks at all pairs of the clash anew: more bodies are cheaper in the solver.
constexpr std::size_t kMostMembers = 8;
/// Impacts per member. What takes more chatters, and is coming to rest.
constexpr int kImpactsPerMember = 4;
/// Rounds of impulses at one moment: as a flyer's.
constexpr int kMaxImpactRounds = 64;
/// What overlaps from the start leaves by itself when it would be out within so many steps; else the solver pushes.
constexpr Real kStepsToLeave = 4;

struct Clash {
    WorldState& world;
    FlightScratch& scratch;
    ClashScratch& work;
    double dt;
};

/// What comes next in the rest of the step.
struct NextImpact {
    bool hit = false;
    bool isPair = false;
    std::size_t flight = 0;  ///< that meets something static or kinematic
    double fraction = 1;
};

bool mayFly(const WorldState& world, const Body& body) {
    return !body.deepContact && !body.rests && body.holdingJoints == 0 &&
           modeOf(world, body) == ContinuousMode::subStep;
}

std::uint32_t memberIndex(std::span<const std::uint32_t> members, std::uint32_t slot) {
    return static_cast<std::uint32_t>(std::find(members.begin(), members.end(), slot) - members.begin());
}

/// @return false: what meets there does not bounce
bool listPairs(Clash& clash, std::span<const std::uint32_t> members, std::span<const std::uint32_t> contacts) {
    for (const std::uint32_t index : contacts) {
        const Contact& contact = clash.world.contacts[index];
        const std::uint32_t first = memberIndex(members, contact.bodyA);
        const std::uint32_t second = memberIndex(members, contact.bodyB);
        if (first == members.size() || second == members.size()) {
            const std::uint32_t grounded = std::min(first, second);
            if (contact.isSolid() && grounded < members.size()) {
                clash.work.isNearGround[grounded] = 1;
            }
            continue;
        }
        if (!(contact.restitution > 0)) {
            return false;
        }
        ClashPair pair{.contact = index, .first = first, .second = second};
        pair.shapes = {.own = contact.shapeB, .other = contact.shapeA};
        clash.work.pairs.push_back(pair);
    }
    return true;
}

bool begin(Clash& clash, std::span<const std::uint32_t> members, std::span<const std::uint32_t> contacts) {
    if (members.size() < 2 || members.size() > kMostMembers) {
        return false;
    }
    const auto flies = [&](std::uint32_t slot) { return mayFly(clash.world, clash.world.bodies[slot]); };
    if (!std::all_of(members.begin(), members.end(), flies)) {
        return false;
    }
    ClashScratch& work = clash.work;
    work.pairs.clear();
    work.isNearGround.assign(members.size(), 0);
    if (!listPairs(clash, members, contacts)) {
        return false;
    }
    work.flights.clear();
    work.paths.resize(members.size());
    for (const std::uint32_t slot : members) {
        work.flights.push_back(flightOf(clash.world, slot, clash.dt, clash.scratch));
        limitSpeed(work.flights.back());
    }
    return true;
}

/// Sets apart what sank below its target, the lighter one farther. Deep overlaps are from before, and stay as they are.
void setApart(Clash& clash, ClashPair& pair) {
    Flight& first = clash.work.flights[pair.first];
    Flight& second = clash.work.flights[pair.second];
    const WorldState& world = clash.world;
    const double target = targetOf(world, pair.shapes);
    const double gap = target - static_cast<double>(pair.deepest);
    const double noise = toleranceOf(world, pair.shapes) + static_cast<double>(roundingOf(world, pair.shapes));
    if (!(gap > noise) || pair.deepest < -kShallowRatio * world.contacts[pair.contact].extent) {
        return;
    }
    pair.deepest = static_cast<Real>(target);
    const auto inverseFirst = static_cast<double>(first.body().inverseMass);
    const auto inverseSecond = static_cast<double>(second.body().inverseMass);
    const DVec2 way = (gap / (inverseFirst + inverseSecond)) * toDouble(pair.normal);
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
    if (!isStart) {
        return obstacleManifold(clash.world, pair.shapes, first.motion.pose, second.motion.pose, reach);
    }
    // The contact has that of the start of the step, with points that are farther apart, too.
    Manifold manifold = clash.world.contacts[pair.contact].manifold;
    manifold.count = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const bool isThere = k < static_cast<std::size_t>(clash.world.contacts[pair.contact].manifold.count);
        if (!isThere || manifold.points[k].separation > reach) {
            continue;
        }
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
        if (manifold.count == 0) {
            continue;
        }
        const Contact& contact = clash.world.contacts[pair.contact];
        ContactConstraint constraint = constraintOf(manifold, first.motion, first.body().localCenter, second.motion,
                                                    contact.friction, contact.restitution, 0);
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
    const ContactConstraintPoint& a = constraint.points[0];
    const ContactConstraintPoint& b = constraint.points[1];
    pair.impulse[0] += a.totalNormalImpulse;
    pair.impulse[1] += b.totalNormalImpulse;
    const Real speed = std::max(a.bounceApproach, b.bounceApproach);
    if (!(speed > std::max(first.threshold(), second.threshold()))) {
        return;
    }
    const WorldState& world = clash.world;
    const Contact& contact = world.contacts[pair.contact];
    const Vec2 arm = b.totalNormalImpulse > a.totalNormalImpulse ? b.anchorB : a.anchorB;
    clash.scratch.events.push_back({.type = ContactEventType::hit,
                                    .shapeA = world.shapes.idOf(world.shapes[contact.shapeA].head),
                                    .shapeB = world.shapes.idOf(world.shapes[contact.shapeB].head),
                                    .bodyA = world.bodies.idOf(contact.bodyA),
                                    .bodyB = world.bodies.idOf(contact.bodyB),
                                    .fraction = second.elapsed / clash.dt,
                                    .point = second.motion.center + toDouble(arm),
                                    .normal = constraint.normal,
                                    .approachSpeed = speed,
                                    .impulse = a.totalNormalImpulse + b.totalNormalImpulse});
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
    const SolverBodies bodies{scratch.states, scratch.inertias};
    ImpactRule rule{.restitutionThreshold = threshold, .resolvePlastic = true};
    if (reflectImpacts(scratch.order, bodies, rule, kMaxImpactRounds, scratch.impact) == kMaxImpactRounds) {
        rule.restitutionThreshold = std::numeric_limits<Real>::infinity();
        reflectImpacts(scratch.order, bodies, rule, kMaxImpactRounds, scratch.impact);
    }
    for (std::size_t i = 0; i < clash.work.flights.size(); ++i) {
        BodyMotion& motion = clash.work.flights[i].motion;
        motion.velocity = scratch.states[slotOf(i)].velocity;
        motion.angularVelocity = scratch.states[slotOf(i)].angularVelocity;
    }
}

/// Contacts of this moment, all together.
void resolvePairs(Clash& clash, bool isStart) {
    listMet(clash, isStart);
    if (clash.work.constraints.empty()) {
        return;
    }
    reflect(clash);
    for (const ContactConstraint& constraint : clash.work.constraints) {
        report(clash, constraint);
    }
}

void resolveGround(Clash& clash) {
    for (std::size_t i = 0; i < clash.work.flights.size(); ++i) {
        if (clash.work.isNearGround[i] != 0) {
            resolveStanding(clash.work.flights[i]);
        }
    }
}

/// Whether all that overlaps deeply is on its way out. @pre nothing has moved since the last `resolvePairs`
bool allLeave(const Clash& clash) {
    for (const ContactConstraint& constraint : clash.work.constraints) {
        const Contact& contact = clash.world.contacts[clash.work.pairs[constraint.source].contact];
        const BodyMotion& a = clash.work.flights[clash.work.pairs[constraint.source].first].motion;
        const BodyMotion& b = clash.work.flights[clash.work.pairs[constraint.source].second].motion;
        for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
            const ContactConstraintPoint& point = constraint.points[k];
            const Real depth = -(point.baseSeparation + dot(point.anchorB - point.anchorA, constraint.normal));
            const Vec2 velocity = b.velocity + cross(b.angularVelocity, point.anchorB) - a.velocity -
                                  cross(a.angularVelocity, point.anchorA);
            const Real way = static_cast<Real>(clash.dt) * dot(velocity, constraint.normal);
            if (depth > kShallowRatio * contact.extent && !(kStepsToLeave * way > depth)) {
                return false;
            }
        }
    }
    return true;
}

/// What meets now and only moves apart along the normal, however it turns, does not meet again: the separation along a
/// fixed axis grows at least as fast as the centres part, less what the turns may bring. The speed of a parabola is
/// linear in time: least at one of its ends.
bool staysApart(const WorldState& world, const ClashScratch& work, const ClashPair& pair) {
    if (!pair.isMet) {
        return false;
    }
    const Sweep& first = work.paths[pair.first];
    const Sweep& second = work.paths[pair.second];
    const DVec2 normal = toDouble(pair.normal);
    const DVec2 parting = (second.c1 - second.c0) - (first.c1 - first.c0);
    const double slowest = dot(parting, normal) - std::fabs(dot(second.k - first.k, normal));
    const double turns = std::fabs(first.a1 - first.a0) * turningArm(world.shapes[pair.shapes.other]) +
                         std::fabs(second.a1 - second.a0) * turningArm(world.shapes[pair.shapes.own]);
    return slowest >= turns;
}

/// Whether the circles of both shapes miss each other. The distance of the centres is least near where it is least on
/// the chord of their relative path; the path is within a quarter of its bend of that.
bool passesBy(const WorldState& world, const ClashScratch& work, const ClashPair& pair) {
    const Sweep& first = work.paths[pair.first];
    const Sweep& second = work.paths[pair.second];
    const DVec2 start = second.c0 - first.c0;
    const DVec2 way = (second.c1 - second.c0) - (first.c1 - first.c0);
    const double square = dot(way, way);
    const double nearest = square > 0 ? std::clamp(-dot(start, way) / square, 0.0, 1.0) : 0;
    const double bend = 0.25 * length(second.k - first.k);
    const double circles = static_cast<double>(world.shapes[pair.shapes.own].radius) +
                           static_cast<double>(world.shapes[pair.shapes.other].radius);
    return length(start + nearest * way) - bend > circles + 2 * targetOf(world, pair.shapes);
}

/// The separation at which a pair meets next: its target; one below what there is where it meets now; and where it
/// overlaps, that is undone along the normal. `firstImpactWith` would find both by itself, with more searches.
void aim(const Clash& clash, ClashPair& pair) {
    const WorldState& world = clash.world;
    const double target = targetOf(world, pair.shapes);
    pair.shapes.level = target;
    pair.shapes.lift = {};
    if (!pair.isMet) {
        return;
    }
    const auto deepest = static_cast<double>(pair.deepest);
    const double up = deepest < 0 ? target - deepest : 0;
    pair.shapes.lift = up * toDouble(pair.normal);
    pair.shapes.level = levelInContact(world, pair.shapes, deepest + up);
}

NextImpact nextImpactOf(Clash& clash) {
    ClashScratch& work = clash.work;
    NextImpact next;
    for (std::size_t i = 0; i < work.flights.size(); ++i) {
        work.paths[i] = sweepOf(work.flights[i]);
        const FirstImpact impact = nextImpact(work.flights[i], work.paths[i], next.fraction);
        work.isNearGround[i] = clash.scratch.obstacles.empty() ? 0 : 1;
        if (impact.hit) {
            next = {.hit = true, .isPair = false, .flight = i, .fraction = impact.fraction};
        }
    }
    for (ClashPair& pair : work.pairs) {
        if (!(next.fraction > 0)) {
            break;
        }
        if (staysApart(clash.world, work, pair) || passesBy(clash.world, work, pair)) {
            continue;
        }
        aim(clash, pair);
        const FirstImpact impact = firstImpactWith(clash.world, work.paths[pair.second], work.paths[pair.first],
                                                   pair.shapes, next.fraction, clash.scratch);
        if (impact.hit) {
            next = {.hit = true, .isPair = true, .fraction = impact.fraction};
        }
    }
    return next;
}

void advanceAll(Clash& clash, double fraction) {
    for (std::size_t i = 0; i < clash.work.flights.size(); ++i) {
        advance(clash.work.flights[i], clash.work.paths[i], fraction);
    }
    for (ClashPair& pair : clash.work.pairs) {
        pair.isMet = false;
    }
}

/// @return whether the step was used up within the budget of impacts
bool flyThrough(Clash& clash) {
    ClashScratch& work = clash.work;
    const int most =
        std::min(kImpactsPerMember * static_cast<int>(work.flights.size()), clash.world.settings.maxImpacts);
    resolvePairs(clash, true);
    if (!allLeave(clash)) {
        return false;
    }
    resolveGround(clash);
    for (int impacts = 0; impacts <= most; ++impacts) {
        const NextImpact next = nextImpactOf(clash);
        advanceAll(clash, next.hit ? next.fraction : 1);
        if (!next.hit) {
            return true;
        }
        ++clash.scratch.impacts;
        if (next.isPair) {
            resolvePairs(clash, false);
            resolveGround(clash);
        } else {
            resolveStanding(work.flights[next.flight]);
        }
        for (const Flight& flight : work.flights) {
            notePose(flight);
        }
    }
    return false;
}

void store(Clash& clash) {
    for (Flight& flight : clash.work.flights) {
        limitSpeed(flight);
        clash.world.motions[flight.slot] = flight.motion;
    }
    for (const ClashPair& pair : clash.work.pairs) {
        Contact& contact = clash.world.contacts[pair.contact];
        contact.normalImpulse = contact.tangentImpulse = {};
        contact.totalImpulse = pair.impulse;
        contact.pressed = pair.impulse[0] > 0 || pair.impulse[1] > 0;
    }
}

}  // namespace

bool clash(WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> contacts,
           double dt, FlightScratch& scratch, ClashScratch& work) {
    Clash clash{world, scratch, work, dt};
    if (!begin(clash, members, contacts)) {
        return false;
    }
    const std::size_t events = scratch.events.size();
    const std::size_t poses = scratch.impactPoses.size();
    const std::uint64_t impacts = scratch.impacts;
    const std::uint64_t speedsLimited = scratch.speedsLimited;
    if (flyThrough(clash)) {
        store(clash);
        return true;
    }
    scratch.events.resize(events);
    scratch.impactPoses.resize(poses);
    scratch.impacts = impacts;
    scratch.speedsLimited = speedsLimited;
    return false;
}

}  // namespace swept::inline SWEPT_PRECISION

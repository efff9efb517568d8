#include "clash.h"

#include <algorithm>
#include <cmath>

#include "../../broadphase/proxy_table.h"
#include "../contacts/may_touch.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "bullet_start.h"
#include "clash_contacts.h"
#include "curved_path.h"
#include "flight_state.h"
#include "flight_traces.h"
#include "sweep_circles.h"
#include "sweep_tolerances.h"
#include "take_along.h"
#include "turning_ride.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Impacts per member. What takes more chatters, and is coming to rest.
constexpr int kImpactsPerMember = 4;

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
        const std::uint32_t place = clash.world.probes[index].contact;
        const Contact& contact = clash.world.contacts[place];
        const std::uint32_t first = memberIndex(members, contact.bodyA);
        const std::uint32_t second = memberIndex(members, contact.bodyB);
        if (first == members.size() || second == members.size()) {
            const std::uint32_t grounded = std::min(first, second);
            if (contact.isSolid() && grounded < members.size()) { clash.work.isNearGround[grounded] = 1; }
            continue;
        }
        ClashPair pair{.contact = place, .first = first, .second = second};
        pair.isRide = !(contact.restitution > 0);
        const bool isBullets =
            clash.world.bodies[contact.bodyA].def.bullet || clash.world.bodies[contact.bodyB].def.bullet;
        if (pair.isRide && !isBullets) { return false; }
        clash.work.anyRides = clash.work.anyRides || pair.isRide;
        pair.shapes = {.own = contact.shapeB, .other = contact.shapeA};
        clash.work.pairs.push_back(pair);
    }
    return true;
}

bool begin(Clash& clash, std::span<const std::uint32_t> members, std::span<const std::uint32_t> contacts) {
    if (members.size() < 2 || members.size() > kMostClashing) { return false; }
    const auto flies = [&](std::uint32_t slot) { return mayFly(clash.world, clash.world.bodies[slot]); };
    if (!std::all_of(members.begin(), members.end(), flies)) { return false; }
    ClashScratch& work = clash.work;
    work.pairs.clear();
    work.anyRides = false;
    work.anyBullets =
        std::any_of(members.begin(), members.end(), [&](std::uint32_t slot) { return isBullet(clash.world, slot); });
    work.impacts = 0;
    work.isNearGround.assign(members.size(), 0);
    if (!listPairs(clash, members, contacts)) { return false; }
    work.flights.clear();
    work.paths.resize(members.size());
    work.hulls.assign(members.size(), kNoBox);
    for (const std::uint32_t slot : members) {
        work.flights.push_back(flightOf(clash.world, slot, clash.dt, clash.scratch));
        limitSpeed(work.flights.back());
    }
    return true;
}

void resolveGround(Clash& clash) {
    for (std::size_t i = 0; i < clash.work.flights.size(); ++i) {
        if (clash.work.isNearGround[i] != 0) { resolveStanding(clash.work.flights[i]); }
    }
}

/// What meets now and only moves apart along the normal, however it turns, does not meet again: the separation along a
/// fixed axis grows at least as fast as the centres part, less what the turns may bring. The speed of a parabola is
/// linear in time: least at one of its ends.
bool staysApart(const WorldState& world, const ClashScratch& work, const ClashPair& pair) {
    if (!pair.isMet) { return false; }
    const Sweep& first = work.paths[pair.first];
    const Sweep& second = work.paths[pair.second];
    const DVec2 normal = toDouble(pair.normal);
    const DVec2 parting = (second.c1 - second.c0) - (first.c1 - first.c0);
    const double slowest = dot(parting, normal) - std::fabs(dot(second.k - first.k, normal));
    const double turns = std::fabs(first.a1 - first.a0) * turningArm(world.shapes[pair.shapes.other]) +
                         std::fabs(second.a1 - second.a0) * turningArm(world.shapes[pair.shapes.own]);
    return slowest >= turns;
}

/// Whether the circles of both shapes miss each other.
bool passesBy(const WorldState& world, const ClashScratch& work, const ClashPair& pair) {
    const double circles = static_cast<double>(world.shapes[pair.shapes.own].radius) +
                           static_cast<double>(world.shapes[pair.shapes.other].radius);
    return stayBeyond(work.paths[pair.first], work.paths[pair.second], circles + 2 * targetOf(world, pair.shapes));
}

/// The separation at which a pair meets next: its target; one below what there is where it meets now; and where it
/// overlaps, that is undone along the normal. `firstImpactWith` would find both by itself, with more searches.
void aim(const Clash& clash, ClashPair& pair) {
    const WorldState& world = clash.world;
    const double target = targetOf(world, pair.shapes);
    pair.shapes.level = target;
    pair.shapes.lift = {};
    if (!pair.isMet) { return; }
    const auto deepest = static_cast<double>(pair.deepest);
    const double up = deepest < 0 ? target - deepest : 0;
    if (pair.isRide) {
        pair.shapes.lift = (up + rideSag(world, pair.shapes, clash.work.impacts)) * toDouble(pair.normal);
        return;
    }
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
        if (impact.hit) { next = {.hit = true, .isPair = false, .flight = i, .fraction = impact.fraction}; }
    }
    for (ClashPair& pair : work.pairs) {
        if (!(next.fraction > 0)) { break; }
        if (staysApart(clash.world, work, pair) || passesBy(clash.world, work, pair)) { continue; }
        aim(clash, pair);
        const FirstImpact impact = firstImpactWith(clash.world, work.paths[pair.second], work.paths[pair.first],
                                                   pair.shapes, next.fraction, clash.scratch);
        if (impact.hit) { next = {.hit = true, .isPair = true, .fraction = impact.fraction}; }
    }
    return next;
}

void growHull(ClashScratch& work, std::size_t flight, double fraction) {
    const Sweep& path = work.paths[flight];
    const Body& body = work.flights[flight].body();
    const auto reach = static_cast<double>(body.radius + kTargetRatio * body.widest);
    const Aabb box = boxOfPath(fraction < 1 ? part(path, 0, fraction) : path, reach);
    work.hulls[flight] = hullOf(work.hulls[flight], box);
}

void advanceAll(Clash& clash, double fraction) {
    for (std::size_t i = 0; i < clash.work.flights.size(); ++i) {
        if (clash.work.anyBullets) { growHull(clash.work, i, fraction); }
        advance(clash.work.flights[i], clash.work.paths[i], fraction);
    }
    for (ClashPair& pair : clash.work.pairs) { pair.isMet = false; }
}

bool isExhausted(const Clash& clash) {
    const ClashScratch& work = clash.work;
    if (!work.anyRides) {
        const int most = kImpactsPerMember * static_cast<int>(work.flights.size());
        return work.impacts > std::min(most, clash.world.settings.maxImpacts);
    }
    return std::all_of(work.flights.begin(), work.flights.end(),
                       [&](const Flight& flight) { return isExhausted(flight, work.impacts, LostTimeReason::budget); });
}

/// The solver would have turning faces stand still for the rest of the step, and a bullet would get through: all stay
/// where they are, or where a kinematic body that goes on takes them.
bool giveUp(Clash& clash) {
    if (!clash.work.anyRides) { return false; }
    for (Flight& flight : clash.work.flights) {
        enterLedger(flight, LostTimeReason::budget);
        takeAlong(clash.world, flight.slot, flight.motion, flight.elapsed, clash.dt, clash.scratch);
    }
    return true;
}

/// To the end of the step, if the budget of impacts lasts so far. What chatters comes to rest, which is for the solver;
/// but that would let a fast bullet sink in.
ClashEnd flyThrough(Clash& clash) {
    ClashScratch& work = clash.work;
    resolvePairs(clash, true);
    if (!allLeave(clash)) { return ClashEnd::none; }
    resolveGround(clash);
    for (; !isExhausted(clash); ++work.impacts) {
        const NextImpact next = nextImpactOf(clash);
        advanceAll(clash, next.hit ? next.fraction : 1);
        if (!next.hit) { return ClashEnd::bounced; }
        ++clash.scratch.counters.impacts;
        if (next.isPair) {
            resolvePairs(clash, false);
            resolveGround(clash);
        } else {
            resolveStanding(work.flights[next.flight]);
        }
        for (const Flight& flight : work.flights) { notePose(flight); }
    }
    if (giveUp(clash)) { return ClashEnd::bounced; }
    return work.anyBullets ? ClashEnd::dissolved : ClashEnd::none;
}

/// Whether the clash looks at these two shapes.
bool isPair(const ClashScratch& work, std::uint32_t a, std::uint32_t b) {
    return std::any_of(work.pairs.begin(), work.pairs.end(), [a, b](const ClashPair& pair) {
        const FlightObstacle& both = pair.shapes;
        return (both.own == a && both.other == b) || (both.own == b && both.other == a);
    });
}

/// Whether a bullet that is a member, or another one, may get to where these members were, and the clash does not know:
/// of other members only those are pairs that were near when the step began. Where others get to in clashes of their
/// own is not known here, but all that is early is within the reach of the fastest.
bool mayMeetMore(const Clash& clash, std::span<const std::uint32_t> members) {
    const WorldState& world = clash.world;
    const ClashScratch& work = clash.work;
    std::array<Aabb, kMostClashing> boxes;
    std::transform(work.hulls.begin(), work.hulls.end(), boxes.begin(),
                   [&world](const Aabb& hull) { return grown(hull, world.bulletWork.farthest); });
    bool mayMeet = false;
    world.broadphase->queryDynamic(std::span(boxes).first(members.size()), [&](std::size_t i, ProxyId id) {
        const std::uint32_t other = world.proxyShapes[static_cast<std::uint32_t>(id)];
        const Shape& shape = world.shapes[other];
        if (mayMeet || shape.body == members[i] || !world.bodies[shape.body].isDynamic() || shape.def.sensor) {
            return;
        }
        if (!isBullet(world, members[i]) && !isBullet(world, shape.body)) { return; }
        const std::uint32_t index = memberIndex(members, shape.body);
        const bool isMember = index != members.size();
        const Aabb way = isMember ? work.hulls[index] : realmAtStart(world, shape.body, static_cast<Real>(clash.dt));
        if (!overlaps(work.hulls[i], way)) { return; }
        const std::vector<std::uint32_t>& own = world.bodies[members[i]].shapes;
        mayMeet = std::any_of(own.begin(), own.end(), [&](std::uint32_t slot) {
            if (isMember && isPair(work, slot, other)) { return false; }
            return !world.shapes[slot].def.sensor && mayTouch(world, world.shapes[slot], shape);
        });
    });
    return mayMeet;
}

void store(Clash& clash) {
    for (Flight& flight : clash.work.flights) {
        endRide(flight);
        limitSqueezed(flight);
        limitSpeed(flight);
        clash.world.motions[flight.slot] = flight.motion;
        rememberGround(flight, clash.world.bodies[flight.slot]);
    }
    for (const ClashPair& pair : clash.work.pairs) {
        Contact& contact = clash.world.contacts[pair.contact];
        contact.normalImpulse = contact.tangentImpulse = {};
        contact.totalImpulse = pair.impulse;
        contact.pressed = pair.impulse[0] > 0 || pair.impulse[1] > 0;
    }
}

}  // namespace

ClashEnd clash(WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> contacts,
               double dt, FlightScratch& scratch, ClashScratch& work) {
    Clash clash{world, scratch, work, dt};
    const FlightTraces before = tracesOf(scratch);
    if (!begin(clash, members, contacts)) { return ClashEnd::none; }
    ClashEnd end = flyThrough(clash);
    if (end == ClashEnd::bounced && work.anyBullets && mayMeetMore(clash, members)) { end = ClashEnd::dissolved; }
    if (end == ClashEnd::bounced) {
        store(clash);
        return end;
    }
    cutTo(scratch, before);
    return end;
}

}  // namespace swept::inline SWEPT_PRECISION

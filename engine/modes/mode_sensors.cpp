#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "../../broadphase/wide_kernels.h"
#include "../../toi/toi_polygon.h"
#include "../bodies/place_order.h"
#include "../contacts/may_touch.h"
#include "../contacts/new_pairs.h"
#include "../contacts/parked_contacts.h"
#include "../containers/sort_few.h"
#include "../state/tolerances.h"
#include "modes.h"

/// Sensors are looked at where the bodies stand at the start of a step (stage_collide.cpp). What moves fast may be in
/// and out again between two looks: here its whole way is followed, impact by impact, past the sensors along it.

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isOfLowerBody(const ImpactOfBody& impact, std::uint32_t slot) { return impact.body < slot; }

/// By body: a step has thousands of impacts, and all that is awake is asked.
void listImpacts(WorldState& world) {
    std::vector<ImpactOfBody>& impacts = world.sensorSweeps.impacts;
    impacts.clear();
    for (std::size_t i = 0; i < world.impactPoses.size(); ++i) {
        impacts.push_back({world.impactPoses[i].body.index, static_cast<std::uint32_t>(i)});
    }
    std::sort(impacts.begin(), impacts.end());
}

/// From the first impact of the body on, if it has any.
std::span<const ImpactOfBody> impactsFrom(const WorldState& world, std::uint32_t slot) {
    const std::vector<ImpactOfBody>& impacts = world.sensorSweeps.impacts;
    const auto first = std::lower_bound(impacts.begin(), impacts.end(), slot, isOfLowerBody);
    return std::span(impacts).subspan(static_cast<std::size_t>(first - impacts.begin()));
}

bool hadImpact(const WorldState& world, std::uint32_t slot) {
    const std::span<const ImpactOfBody> impacts = impactsFrom(world, slot);
    return !impacts.empty() && impacts.front().body == slot;
}

bool isFast(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    if (!isSwept(modeOf(world, body))) { return false; }
    const BodyMotion& motion = world.motions[slot];
    const double way = length(motion.center - body.startCenter) +
                       std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    return way > static_cast<double>(kFastRatio * body.extent) || hadImpact(world, slot);
}

/// Start, impacts and end of a body's way in this step.
void findWaypoints(const WorldState& world, std::uint32_t slot, std::vector<Waypoint>& points) {
    const Body& body = world.bodies[slot];
    points.clear();
    // What no step moves stands where it was put.
    const BodyMotion& motion = world.motions[slot];
    points.push_back({0, body.awake ? body.startCenter : motion.center, body.awake ? body.startAngle : motion.angle});
    for (const ImpactOfBody& impact : impactsFrom(world, slot)) {
        if (impact.body != slot) { break; }
        const ImpactPose& pose = world.impactPoses[impact.place];
        const DVec2 arm = toDouble(rotate(rotationFromAngle(pose.angle), body.localCenter));
        points.push_back({pose.fraction, pose.position + arm, pose.angle});
    }
    sortFew(points, [](const Waypoint& a, const Waypoint& b) { return a.fraction < b.fraction; });
    if (points.back().fraction < 1) { points.push_back({1, world.motions[slot].center, world.motions[slot].angle}); }
}

/// The way between two fractions that have no waypoint between them. A flyer's is a parabola.
Sweep wayBetween(const WorldState& world, std::uint32_t slot, const std::vector<Waypoint>& points, double from,
                 double to, double dt) {
    const Body& body = world.bodies[slot];
    auto next = std::find_if(points.begin() + 1, points.end(), [from](const Waypoint& p) { return p.fraction > from; });
    if (next == points.end()) { --next; }
    const Waypoint& end = *next;
    const Waypoint& start = *(next - 1);
    Sweep sweep{.localCenter = toDouble(body.localCenter),
                .c0 = start.center,
                .c1 = end.center,
                .a0 = start.angle,
                .a1 = end.angle};
    const double time = (end.fraction - start.fraction) * dt;
    if (!(time > 0)) { return sweep; }
    const bool stands = start.center == end.center;
    if (body.role == BodyRole::flyer && !stands) {
        sweep.k = (0.5 * time * time) * toDouble(accelerationOf(world, body));
    }
    const double whole = end.fraction - start.fraction;
    return part(sweep, std::clamp((from - start.fraction) / whole, 0.0, 1.0),
                std::clamp((to - start.fraction) / whole, 0.0, 1.0));
}

Sweep backwards(const Sweep& sweep) {
    Sweep result = sweep;
    std::swap(result.c0, result.c1);
    std::swap(result.a0, result.a1);
    return result;
}

bool isInside(const Toi& toi) { return toi.state == ToiState::overlapped || toi.separation <= 0; }
bool meets(const Toi& toi) { return toi.state == ToiState::hit || toi.state == ToiState::overlapped; }

/// One sensor, one shape, and what is known of them.
struct Watch {
    WorldState& world;
    SensorPair pair;
    ToiPolygon sensor;
    ToiPolygon other;
    ToiSettings settings;
    bool inside = false;

    Toi firstTouch(const Sweep& sensorWay, const Sweep& otherWay) const {
        const Toi toi = timeOfImpact(sensor, sensorWay, other, otherWay, settings);
        ++world.counters.toiCalls;
        world.counters.toiIterations += static_cast<std::uint64_t>(toi.iterations);
        return toi;
    }
    /// @param touch  of the two at that time
    void announce(ContactEventType type, double fraction, const Toi& touch) const {
        const Shape& a = world.shapes[pair.sensor];
        const Shape& b = world.shapes[pair.other];
        world.contactEvents.push_back({.type = type,
                                       .shapeA = world.shapes.idOf(a.head),
                                       .shapeB = world.shapes.idOf(b.head),
                                       .bodyA = world.bodies.idOf(a.body),
                                       .bodyB = world.bodies.idOf(b.body),
                                       .segmentA = a.segmentIndex,
                                       .segmentB = b.segmentIndex,
                                       .fraction = fraction,
                                       .point = 0.5 * (touch.pointA + touch.pointB),
                                       .normal = toReal(touch.normal)});
    }
};

/// A stretch of the step without impacts of either: at most one begin and one end. The last time of touching is the
/// first one of the way back. What touches and is gone at once, without any stay, is not told.
void watchStretch(Watch& watch, const Sweep& sensorWay, const Sweep& otherWay, double from, double to) {
    const auto after = [&](double fraction) {
        return separationAt(watch.sensor, sensorWay, watch.other, otherWay, fraction);
    };
    const bool endsInside = isInside(after(1));
    const bool begins = !watch.inside;
    double began = from;
    Toi touch;
    if (begins) {
        touch = watch.firstTouch(sensorWay, otherWay);
        if (!meets(touch)) { return; }
        began = from + touch.fraction * (to - from);
    }
    double left = to;
    Toi last;
    if (!endsInside) {
        last = watch.firstTouch(backwards(sensorWay), backwards(otherWay));
        left = meets(last) ? to - last.fraction * (to - from) : began;
        if (begins && !(left > began)) { return; }
        if (!meets(last)) { last = after(0); }
    }
    if (begins) { watch.announce(ContactEventType::sensorBegin, began, touch); }
    watch.inside = endsInside;
    // Never at once with its begin, which would be sorted behind it.
    if (!endsInside) { watch.announce(ContactEventType::sensorEnd, std::max(std::nextafter(began, 2.0), left), last); }
}

/// What the next look at the start of a step goes on from.
void remember(WorldState& world, const SensorPair& pair, Contact* contact, bool inside) {
    if (contact == nullptr) {
        if (!inside || !addContact(world, pair.sensor, pair.other)) { return; }
        contact = &world.contacts[world.probes.back().contact];
    }
    contact->touching = inside;
}

bool isPair(const WorldState& world, const Shape& sensor, const Shape& other) {
    return sensor.def.sensor && !other.def.sensor && mayTouch(world, sensor, other);
}

void addPairs(WorldState& world, std::uint32_t a, std::uint32_t b) {
    std::vector<SensorPair>& pairs = world.sensorSweeps.pairs;
    if (isPair(world, world.shapes[a], world.shapes[b])) { pairs.push_back({a, b}); }
    if (isPair(world, world.shapes[b], world.shapes[a])) { pairs.push_back({b, a}); }
}

/// Pairs of sensors and shapes of which one belongs to the body, and whose boxes meet on its way: those that the other
/// one has for its start. Keeps its own.
void findPairsOnWay(WorldState& world, std::uint32_t slot, double dt) {
    SensorSweeps& sweeps = world.sensorSweeps;
    findWaypoints(world, slot, sweeps.ofSensor);
    DVec2 lower = sweeps.ofSensor.front().center;
    DVec2 upper = lower;
    for (const Waypoint& point : sweeps.ofSensor) {
        lower = {std::min(lower.x, point.center.x), std::min(lower.y, point.center.y)};
        upper = {std::max(upper.x, point.center.x), std::max(upper.y, point.center.y)};
    }
    const Body& body = world.bodies[slot];
    // By how much a parabola leaves the straight line between two waypoints.
    const Real bulge =
        body.role == BodyRole::flyer ? length(accelerationOf(world, body)) * static_cast<Real>(dt * dt / 8) : Real(0);
    for (const std::uint32_t own : body.shapes) {
        const Shape& mine = world.shapes[own];
        const Real reach = radiusAbout(mine.polygon, body.localCenter) + kTargetRatio * mine.extent + bulge;
        const Aabb box = grown(roundedOutward(lower, upper), reach);
        WaysOfShapes& ways = mine.def.sensor ? sweeps.ofSensors : sweeps.ofOthers;
        ways.boxes.push_back(box);
        ways.shapes.push_back(own);
        world.broadphase->query(box, [&](ProxyId id) {
            addPairs(world, world.proxyShapes[static_cast<std::uint32_t>(id)], own);
            return true;
        });
    }
}

bool hasSensor(const WorldState& world, std::uint32_t slot) {
    const std::vector<std::uint32_t>& shapes = world.bodies[slot].shapes;
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](std::uint32_t shape) { return world.shapes[shape].def.sensor; });
}

/// Neighbours follow each other where their ways go into a tree.
void listFast(WorldState& world) {
    std::vector<std::uint32_t>& fast = world.sensorSweeps.fast;
    fast.clear();
    for (const std::uint32_t slot : world.awake) {
        if (isFast(world, slot)) { fast.push_back(slot); }
    }
    const auto carriesSensor = [&world](std::uint32_t slot) { return hasSensor(world, slot); };
    if (std::any_of(fast.begin(), fast.end(), carriesSensor)) { orderByPlace(world, fast); }
}

/// Of what both moves fast, neither need come near where the other one was.
void findPairsOfWays(WorldState& world) {
    SensorSweeps& sweeps = world.sensorSweeps;
    if (sweeps.ofSensors.boxes.empty() || sweeps.ofOthers.boxes.empty()) { return; }
    sweeps.tree.pack(sweeps.ofOthers.boxes);
    for (std::size_t i = 0; i < sweeps.ofSensors.boxes.size(); ++i) {
        bool goesOn = true;
        widestKernels().query(sweeps.tree, sweeps.ofSensors.boxes[i], goesOn, [&](ProxyId id) {
            addPairs(world, sweeps.ofSensors.shapes[i], sweeps.ofOthers.shapes[static_cast<std::uint32_t>(id)]);
            return true;
        });
    }
}

/// By pair: a step has thousands of contacts.
void listSensorContacts(WorldState& world) {
    std::vector<ContactOfSensor>& contacts = world.sensorSweeps.contacts;
    contacts.clear();
    for (const ContactProbe& probe : world.probes) {
        if (probe.isPlain) { continue; }
        const Contact& contact = world.contacts[probe.contact];
        if (contact.sensor) { contacts.push_back({{contact.shapeA, contact.shapeB}, probe.contact}); }
    }
    std::sort(contacts.begin(), contacts.end());
}

/// No two pairs are the same: what was added for one in this step is none of another one's.
Contact* contactOfPair(WorldState& world, const SensorPair& pair) {
    const std::vector<ContactOfSensor>& contacts = world.sensorSweeps.contacts;
    const auto found = std::lower_bound(contacts.begin(), contacts.end(), ContactOfSensor{pair, 0});
    return found != contacts.end() && found->pair == pair ? &world.contacts[found->contact] : nullptr;
}

void watchPair(WorldState& world, const SensorPair& pair, double dt) {
    SensorSweeps& sweeps = world.sensorSweeps;
    const Shape& sensor = world.shapes[pair.sensor];
    const Shape& other = world.shapes[pair.other];
    Contact* const contact = contactOfPair(world, pair);
    const auto extent = static_cast<double>(std::min(sensor.extent, other.extent));
    Watch watch{world,
                pair,
                asToiPolygon(sensor.polygon),
                asToiPolygon(other.polygon),
                {.target = 0, .tolerance = static_cast<double>(kToleranceRatio) * extent},
                contact != nullptr && contact->touching};
    findWaypoints(world, sensor.body, sweeps.ofSensor);
    findWaypoints(world, other.body, sweeps.ofOther);
    sweeps.fractions.clear();
    for (const auto* const points : {&sweeps.ofSensor, &sweeps.ofOther}) {
        for (const Waypoint& point : *points) { sweeps.fractions.push_back(point.fraction); }
    }
    std::sort(sweeps.fractions.begin(), sweeps.fractions.end());
    for (std::size_t i = 1; i < sweeps.fractions.size(); ++i) {
        const double from = sweeps.fractions[i - 1];
        const double to = sweeps.fractions[i];
        if (!(to > from)) { continue; }
        watchStretch(watch, wayBetween(world, sensor.body, sweeps.ofSensor, from, to, dt),
                     wayBetween(world, other.body, sweeps.ofOther, from, to, dt), from, to);
    }
    ++world.counters.sensorSweeps;
    remember(world, pair, contact, watch.inside);
}

}  // namespace

void sweepSensors(WorldState& world, double dt) {
    if (!world.parked.woken.empty()) { unparkContacts(world); }  // what bullets woke is in some sensors already
    std::vector<SensorPair>& pairs = world.sensorSweeps.pairs;
    pairs.clear();
    for (WaysOfShapes* const ways : {&world.sensorSweeps.ofSensors, &world.sensorSweeps.ofOthers}) {
        ways->boxes.clear();
        ways->shapes.clear();
    }
    listImpacts(world);
    listFast(world);
    for (const std::uint32_t slot : world.sensorSweeps.fast) { findPairsOnWay(world, slot, dt); }
    findPairsOfWays(world);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    if (!pairs.empty()) { listSensorContacts(world); }
    for (const SensorPair& pair : pairs) { watchPair(world, pair, dt); }
}

}  // namespace swept::inline SWEPT_PRECISION

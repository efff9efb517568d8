#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../../broadphase/wide_kernels.h"
#include "../../shapes/distance.h"
#include "../../toi/toi_polygon.h"
#include "../bodies/body_measures.h"
#include "../bodies/place_order.h"
#include "../contacts/may_touch.h"
#include "../contacts/new_pairs.h"
#include "../contacts/pair_boxes.h"
#include "../contacts/parked_contacts.h"
#include "../state/tolerances.h"
#include "modes.h"
#include "sensor_ways.h"

/// Sensors are looked at where the bodies stand at the start of a step (stage_collide.cpp). What moves far, for its
/// size or for that of the sensor, may be in and out again between two looks: here its whole way is followed, impact by
/// impact, past the sensors along it.

namespace swept::inline SWEPT_PRECISION {
namespace {

Sweep backwards(const Sweep& sweep) {
    Sweep result = sweep;
    std::swap(result.c0, result.c1);
    std::swap(result.a0, result.a1);
    return result;
}

bool isInside(const Toi& toi) { return toi.state == ToiState::overlapped || toi.separation <= 0; }
bool meets(const Toi& toi) { return toi.state == ToiState::hit || toi.state == ToiState::overlapped; }

/// Of the tolerance of times: deeper is no rounding.
constexpr double kSkimRatio = 1.0 / 64;

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
    /// As the next look will find them (near_update.cpp): what is told here must not be told again for a rounding.
    bool areSeenInside() const {
        const Shape& a = world.shapes[pair.sensor];
        const Shape& b = world.shapes[pair.other];
        const Transform bInA = relativeTransform(world.motions[a.body].pose, world.motions[b.body].pose);
        return distance(a.polygon, b.polygon, bInA).distance <= 0;
    }
    /// Whether they were as near as times are found, and nearer by no more than roundings: what slides along an edge of
    /// a sensor would begin and end in every step.
    /// @param first, last  when they were so near
    bool isSkim(const Toi& first, const Toi& between, const Toi& last) const {
        return between.separation <= 2 * settings.tolerance && between.separation >= -kSkimRatio * settings.tolerance &&
               dot(first.normal, last.normal) > 0;
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
    const bool endsInside = to < 1 ? isInside(after(1)) : watch.areSeenInside();
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
        if (begins) {
            if (!(left > began)) { return; }
            const double middle = (0.5 * (began + left) - from) / (to - from);
            if (meets(last) && watch.isSkim(touch, after(middle), last)) { return; }
        }
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

/// So many are compared faster, one by one, than found among all shapes.
constexpr std::size_t kFewSensors = 32;

/// What has no proxy, since its body is disabled, meets nothing.
void listFewSensors(WorldState& world) {
    WaysOfShapes& few = world.sensorSweeps.few;
    few.boxes.clear();
    few.shapes.clear();
    if (world.sensors.size() > kFewSensors) { return; }
    for (const std::uint32_t slot : world.sensors) {
        const ProxyId proxy = world.shapes[slot].proxy;
        if (proxy == kNoProxy) { continue; }
        few.boxes.push_back(world.broadphase->box(proxy));
        few.shapes.push_back(slot);
    }
}

/// Of a shape with those whose boxes, as the step begins, meet its way.
void findPairsAlong(WorldState& world, std::uint32_t own, const Aabb& way) {
    const WaysOfShapes& few = world.sensorSweeps.few;
    if (!world.shapes[own].def.sensor && world.sensors.size() <= kFewSensors) {
        for (std::size_t i = 0; i < few.boxes.size(); ++i) {
            if (overlapAtOnce<Real>(few.boxes[i], way)) { addPairs(world, few.shapes[i], own); }
        }
        return;
    }
    world.broadphase->query(way, [&](ProxyId id) {
        addPairs(world, world.proxyShapes[static_cast<std::uint32_t>(id)], own);
        return true;
    });
}

/// Pairs of sensors and shapes of which one belongs to the body, and whose boxes meet on its way: those that the other
/// one has for its start. Keeps its own.
void findPairsOnWay(WorldState& world, std::uint32_t slot, double dt) {
    SensorSweeps& sweeps = world.sensorSweeps;
    findWaypoints(world, slot, sweeps.ofSensor);
    const Body& body = world.bodies[slot];
    const double bulge = bulgeOfWay(world, slot, sweeps.ofSensor, dt);
    for (const std::uint32_t own : body.shapes) {
        const Shape& mine = world.shapes[own];
        // What does not move far itself is looked for where it was.
        const Real reach = leastPassed(mine) / 2 + kTargetRatio * mine.extent + static_cast<Real>(bulge);
        const Aabb box = boxOfWay(world, mine, sweeps.ofSensor, reach);
        WaysOfShapes& ways = mine.def.sensor ? sweeps.ofSensors : sweeps.ofOthers;
        ways.boxes.push_back(box);
        ways.shapes.push_back(own);
        findPairsAlong(world, own, box);
    }
}

/// Neighbours follow each other where their ways go into a tree.
void listFast(WorldState& world, double dt) {
    std::vector<std::uint32_t>& fast = world.sensorSweeps.fast;
    fast.clear();
    for (const std::uint32_t slot : world.awake) {
        if (mayPassUnseen(world, slot, dt)) { fast.push_back(slot); }
    }
    const auto carriesSensor = [&world](std::uint32_t slot) { return world.bodies[slot].hasSensor; };
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

/// Of all that is fast. What carries no sensor comes last: most of that moves far from all of them.
void findPairsOfFast(WorldState& world, double dt) {
    SensorSweeps& sweeps = world.sensorSweeps;
    if (sweeps.fast.empty()) { return; }
    listFewSensors(world);
    for (const std::uint32_t slot : sweeps.fast) {
        if (world.bodies[slot].hasSensor) { findPairsOnWay(world, slot, dt); }
    }
    const bool areFew = world.sensors.size() <= kFewSensors;
    if (areFew) {
        sweeps.few.boxes.insert(sweeps.few.boxes.end(), sweeps.ofSensors.boxes.begin(), sweeps.ofSensors.boxes.end());
        sweeps.few.shapes.insert(sweeps.few.shapes.end(), sweeps.ofSensors.shapes.begin(),
                                 sweeps.ofSensors.shapes.end());
    }
    for (const std::uint32_t slot : sweeps.fast) {
        if (world.bodies[slot].hasSensor || (areFew && isClearOnWay(world, slot, sweeps.few.boxes, dt))) { continue; }
        findPairsOnWay(world, slot, dt);
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
    listImpactsByBody(world);
    listFast(world, dt);
    findPairsOfFast(world, dt);
    findPairsOfWays(world);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::erase_if(pairs, [&world, dt](const SensorPair& pair) { return !passesUnseen(world, pair, dt); });
    if (!pairs.empty()) { listSensorContacts(world); }
    for (const SensorPair& pair : pairs) { watchPair(world, pair, dt); }
}

}  // namespace swept::inline SWEPT_PRECISION

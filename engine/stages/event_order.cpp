#include "event_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "../../shapes/bit_cast.h"
#include "../containers/key_sort.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isBegin(const ContactEvent& e) {
    return e.type == ContactEventType::begin || e.type == ContactEventType::sensorBegin;
}

bool isOfSensor(const ContactEvent& e) {
    return e.type == ContactEventType::sensorBegin || e.type == ContactEventType::sensorEnd;
}

TouchKind touchKind(bool isOfSensor, std::uint32_t shapeA, std::uint32_t shapeB) {
    if (!isOfSensor) { return TouchKind::ofSolid; }
    return shapeA < shapeB ? TouchKind::ofLowerSensor : TouchKind::ofHigherSensor;
}

/// Slots of the shapes, the lower one first: with another type of a body either may be A.
std::pair<std::uint32_t, std::uint32_t> slotsOf(const ContactEvent& e) {
    return std::minmax({e.shapeA.index, e.shapeB.index});
}

/// Ends first: what a call between the steps ended may begin again in the step.
auto eventKey(const ContactEvent& e) {
    return std::make_tuple(e.fraction, slotsOf(e), isBegin(e), e.shapeA.index, e.type, e.approachSpeed, e.impulse,
                           e.point.x, e.point.y, e.normal.x, e.normal.y, e.segmentA, e.segmentB, e.shapeA.generation,
                           e.shapeB.generation);
}

/// Sorts events by their keys, and where these are the same by `isLess`: what is moved about while they are sorted is
/// small, and mostly told apart by a whole number.
template <class IsLess>
void sortPlaces(WorldState& world, std::vector<EventPlace>& places, const IsLess& isLess) {
    const std::span<const ContactEvent> events = world.contactEvents;
    sortByKeys(places, world.eventPlaces.spare,
               [&](const EventPlace& a, const EventPlace& b) { return isLess(events[a.index], events[b.index]); });
}

/// @param bits  of the largest slot of a shape
std::uint64_t keyOfShapes(std::uint32_t a, std::uint32_t b, int bits) {
    return (std::uint64_t{std::min(a, b)} << bits) | std::max(a, b);
}
std::uint64_t keyOfShapes(const ContactEvent& e, int bits) { return keyOfShapes(e.shapeA.index, e.shapeB.index, bits); }

/// @pre the fraction is larger than 0: then the larger one has the larger key
std::uint64_t keyOfFraction(const ContactEvent& e) { return bitCast<std::uint64_t>(e.fraction); }

bool isChainOrGone(const WorldState& world, ShapeId id) {
    const Shape* shape = world.shapes.find(id);
    return shape == nullptr || shape->isChainSegment;
}

/// Touches of the pairs that begin or end with a chain, and of few others: one byte per shape tells whether it is in
/// any of these.
void listChainTouches(WorldState& world, int bits) {
    std::vector<ChainTouch>& touches = world.eventPlaces.chainTouches;
    touches.clear();
    std::vector<std::uint8_t>& isNamed = world.eventPlaces.isNamed;
    isNamed.resize(world.shapes.slotCount(), 0);
    const auto name = [&world, &isNamed](std::uint8_t value) {
        for (const EventPlace& place : world.eventPlaces.ofChains) {
            const ContactEvent& e = world.contactEvents[place.index];
            isNamed[e.shapeA.index] = isNamed[e.shapeB.index] = value;
        }
    };
    name(1);
    const std::vector<std::uint8_t>& isSegment = world.chainSegments;
    const auto headOf = [&](std::uint32_t shape) { return isSegment[shape] != 0 ? world.shapes[shape].head : shape; };
    // What sleeps begins and ends nothing.
    for (const ContactProbe& probe : world.probes) {
        if (probe.isPlain || probe.isIdle) { continue; }  // chains do not move; what is idle does not touch
        const Contact& contact = world.contacts[probe.contact];
        if (!contact.touching || (isSegment[contact.shapeA] | isSegment[contact.shapeB]) == 0) { continue; }
        const std::uint32_t a = headOf(contact.shapeA);
        const std::uint32_t b = headOf(contact.shapeB);
        if ((isNamed[a] & isNamed[b]) != 0) {
            touches.push_back({keyOfShapes(a, b, bits), touchKind(contact.sensor, a, b)});
        }
    }
    name(0);
    sortByKeys(touches, world.eventPlaces.spareTouches, [](const ChainTouch&, const ChainTouch&) { return false; });
}

/// Segments by which the shapes of an event touch now. @param touches  from the first on that is not before theirs
std::ptrdiff_t touchesNow(const WorldState& world, const EventPlace& place, std::span<const ChainTouch> touches) {
    const ContactEvent& e = world.contactEvents[place.index];
    if (!world.shapes.isValid(e.shapeA) || !world.shapes.isValid(e.shapeB)) { return 0; }
    const TouchKind kind = touchKind(isOfSensor(e), e.shapeA.index, e.shapeB.index);
    std::ptrdiff_t count = 0;
    for (const ChainTouch& touch : touches) {
        if (touch.key != place.key) { break; }
        count += touch.kind == kind ? 1 : 0;
    }
    return count;
}

/// Whether it is of a chain, or of what may have been one: a shape that is gone. Of what the step itself found both
/// shapes are there.
bool concernsChain(const WorldState& world, std::size_t index) {
    const ContactEvent& e = world.contactEvents[index];
    if (index < world.eventsBetween) { return isChainOrGone(world, e.shapeA) || isChainOrGone(world, e.shapeB); }
    return world.chainSegments[e.shapeA.index] != 0 || world.chainSegments[e.shapeB.index] != 0;
}

/// When an event was: before the step (false), or in it, and at which fraction.
std::pair<bool, double> momentOf(const WorldState& world, const EventPlace& place) {
    return {place.index >= world.eventsBetween, world.contactEvents[place.index].fraction};
}

/// Of begins and ends of one pair, in order of their moments, those by which touching at all begins or ends. What
/// begins and ends at the same moment is handed over from one segment to the next.
/// @param now   segments by which the pair touches after all of them
/// @param keep  where they are put, not behind the first of `group`
/// @return the end of what was put there
std::vector<EventPlace>::iterator keepTurns(const WorldState& world, std::span<EventPlace> group, std::ptrdiff_t now,
                                            std::vector<EventPlace>::iterator keep) {
    const auto begins = [&](const EventPlace& place) { return isBegin(world.contactEvents[place.index]); };
    /// Segments that more begin to touch than end to.
    const auto gain = [&](auto first, auto last) { return 2 * std::count_if(first, last, begins) - (last - first); };
    std::ptrdiff_t count = now - gain(group.begin(), group.end());
    for (auto first = group.begin(); first != group.end();) {
        const auto moment = momentOf(world, *first);
        const auto next =
            std::find_if(first, group.end(), [&](const EventPlace& place) { return momentOf(world, place) > moment; });
        const bool touched = count > 0;
        count += gain(first, next);
        if ((count > 0) != touched) {
            *keep++ = *std::find_if(first, next, [&](const EventPlace& place) { return begins(place) != touched; });
        }
        first = next;
    }
    return keep;
}

/// A chain is one shape to the user: it begins to touch with its first segment, and ends with its last. Leaves of the
/// places of begins and ends with chains those. What calls ended before the step is a moment of its own: what begins
/// again in the step, at the same fraction, is not handed over, but told.
void mergeChainEvents(WorldState& world, int bits) {
    std::vector<EventPlace>& places = world.eventPlaces.ofChains;
    if (places.empty()) { return; }
    const std::span<const ContactEvent> events = world.contactEvents;
    listChainTouches(world, bits);
    std::span<const ChainTouch> touches = world.eventPlaces.chainTouches;
    const auto pairKey = [](const ContactEvent& e) {
        return std::make_tuple(e.shapeA.index, e.shapeA.generation, e.shapeB.index, e.shapeB.generation, isOfSensor(e));
    };
    sortByKeys(places, world.eventPlaces.spare, [&](const EventPlace& x, const EventPlace& y) {
        const ContactEvent& a = events[x.index];
        const ContactEvent& b = events[y.index];
        return std::make_tuple(pairKey(a), momentOf(world, x), eventKey(a)) <
               std::make_tuple(pairKey(b), momentOf(world, y), eventKey(b));
    });
    auto keep = places.begin();
    for (auto group = places.begin(); group != places.end();) {
        const ContactEvent& first = events[group->index];
        const auto last = std::find_if(group, places.end(), [&](const EventPlace& place) {
            return pairKey(events[place.index]) != pairKey(first);
        });
        while (!touches.empty() && touches.front().key < group->key) { touches = touches.subspan(1); }
        const std::span<EventPlace> ofPair(&*group, static_cast<std::size_t>(last - group));
        keep = keepTurns(world, ofPair, touchesNow(world, *group, touches), keep);
        group = last;
    }
    places.erase(keep, places.end());
}

/// A hit of a chain is one, too, whichever segments share it: at the hardest of their points, with all of their
/// impulse.
void mergeChainHits(WorldState& world) {
    std::vector<EventPlace>& places = world.eventPlaces.hitsOfChains;
    const std::span<ContactEvent> events = world.contactEvents;
    const auto impactKey = [](const ContactEvent& e) {
        return std::make_tuple(e.shapeA.index, e.shapeA.generation, e.shapeB.index, e.shapeB.generation, e.fraction);
    };
    sortByKeys(places, world.eventPlaces.spare, [&](const EventPlace& x, const EventPlace& y) {
        const ContactEvent& a = events[x.index];
        const ContactEvent& b = events[y.index];
        return std::make_tuple(impactKey(a), -a.impulse, eventKey(a)) <
               std::make_tuple(impactKey(b), -b.impulse, eventKey(b));
    });
    auto end = places.begin();
    for (const EventPlace& place : places) {
        const ContactEvent& hit = events[place.index];
        const bool isShared = end != places.begin() && impactKey(events[(end - 1)->index]) == impactKey(hit);
        if (isShared) {
            events[(end - 1)->index].impulse += hit.impulse;
        } else {
            *end++ = place;
        }
    }
    places.erase(end, places.end());
}

/// Of what the step itself found, when all that it names is there. (What calls ended was told it by them.)
void tellUserData(const WorldState& world, ContactEvent& event) {
    event.userDataA = world.shapes[event.shapeA.index].def.userData;
    event.userDataB = world.shapes[event.shapeB.index].def.userData;
    event.bodyUserDataA = world.bodies[event.bodyA.index].def.userData;
    event.bodyUserDataB = world.bodies[event.bodyB.index].def.userData;
}

/// Events per block of a parallel loop: each asks for two shapes and two bodies all over memory.
constexpr std::size_t kEventGrain = 16;

/// By fraction, shapes, and the rest of `eventKey`. Most are of the start of the step, where shapes are the key.
void findOrder(WorldState& world) {
    const std::vector<ContactEvent>& events = world.contactEvents;
    std::vector<EventPlace>& ofChains = world.eventPlaces.ofChains;
    std::vector<EventPlace>& hitsOfChains = world.eventPlaces.hitsOfChains;
    std::vector<EventPlace>& atStart = world.eventPlaces.atStart;
    std::vector<EventPlace>& later = world.eventPlaces.later;
    ofChains.clear();
    hitsOfChains.clear();
    atStart.clear();
    later.clear();
    const auto bits = static_cast<int>(std::bit_width(world.shapes.slotCount()));
    const auto addPlace = [&](std::uint32_t i) {
        const bool isLater = events[i].fraction > 0;
        (isLater ? later : atStart).push_back({isLater ? keyOfFraction(events[i]) : keyOfShapes(events[i], bits), i});
    };
    for (std::uint32_t i = 0; i < events.size(); ++i) {
        if (concernsChain(world, i)) {
            const bool isHit = events[i].type == ContactEventType::hit;
            (isHit ? hitsOfChains : ofChains).push_back({keyOfShapes(events[i], bits), i});
        } else {
            addPlace(i);
        }
    }
    mergeChainEvents(world, bits);
    mergeChainHits(world);
    for (const EventPlace& place : ofChains) { addPlace(place.index); }
    for (const EventPlace& place : hitsOfChains) { addPlace(place.index); }
    const auto isLess = [](const ContactEvent& a, const ContactEvent& b) { return eventKey(a) < eventKey(b); };
    sortPlaces(world, atStart, isLess);
    sortPlaces(world, later, isLess);
}

}  // namespace

void sortEvents(WorldState& world) {
    if (!world.contactEvents.empty()) { findOrder(world); }
    std::sort(world.lostTime.begin(), world.lostTime.end(), [](const LostTimeEntry& a, const LostTimeEntry& b) {
        return std::tie(a.body.index, a.seconds, a.reason) < std::tie(b.body.index, b.seconds, b.reason);
    });
    std::sort(world.impactPoses.begin(), world.impactPoses.end(), [](const ImpactPose& a, const ImpactPose& b) {
        return std::tie(a.body.index, a.fraction, a.position.x, a.position.y, a.angle) <
               std::tie(b.body.index, b.fraction, b.position.x, b.position.y, b.angle);
    });
}

void putEventsInOrder(WorldState& world) {
    if (world.contactEvents.empty()) { return; }
    const std::span<const EventPlace> atStart = world.eventPlaces.atStart;
    const std::span<const EventPlace> later = world.eventPlaces.later;
    world.sortedEvents.resize(atStart.size() + later.size());
    world.loops->run(world.sortedEvents.size(), kEventGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const EventPlace& place = i < atStart.size() ? atStart[i] : later[i - atStart.size()];
            world.sortedEvents[i] = world.contactEvents[place.index];
            if (place.index >= world.eventsBetween) { tellUserData(world, world.sortedEvents[i]); }
        }
    });
    world.contactEvents.swap(world.sortedEvents);
}

}  // namespace swept::inline SWEPT_PRECISION

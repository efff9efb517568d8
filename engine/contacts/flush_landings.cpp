#include "flush_landings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "../state/tolerances.h"
#include "../state/world_state.h"
#include "ghosts.h"
#include "hit_event.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Vec2 worldNormal(const WorldState& world, const Contact& contact) {
    return rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
}

DVec2 placeOf(const WorldState& world, const Contact& contact, std::size_t point) {
    return apply(world.motions[contact.bodyA].pose, contact.manifold.points[point].point);
}

/// Whether both pieces stay beside each other: are parts of one body, or static.
bool moveAlike(const WorldState& world, std::uint32_t a, std::uint32_t b) {
    return a == b || (world.bodies[a].def.type == BodyType::fixed && world.bodies[b].def.type == BodyType::fixed);
}

/// Whether they may be pieces of one ground. Where a body is tilted the normals of some are its own, of others those of
/// the ground. @pre of one body B
bool areOfOneGround(const WorldState& world, const TouchingPair& one, const TouchingPair& other) {
    const Contact& a = world.contacts[one.contact];
    const Contact& b = world.contacts[other.contact];
    return a.friction == b.friction && dot(worldNormal(world, a), worldNormal(world, b)) > kSameNormal &&
           moveAlike(world, a.bodyA, b.bodyA);
}

/// Of pieces of one ground one whose contact has the normal of that, not that of the tilted body; null: none has.
const Contact* withNormalOfGround(const WorldState& world, std::span<const TouchingPair> pairs) {
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&world](const TouchingPair& pair) {
        return !world.contacts[pair.contact].manifold.isNormalOfB;
    });
    return found == pairs.end() ? nullptr : &world.contacts[found->contact];
}

bool areAllFlush(const WorldState& world, std::span<const TouchingPair> pairs, const Contact& ofGround) {
    const GroundContact ground = groundContactOf(world, ofGround);
    return std::all_of(pairs.begin(), pairs.end(), [&](const TouchingPair& pair) {
        return areFlush(ground, groundContactOf(world, world.contacts[pair.contact]));
    });
}

/// In order along the ground.
void listPoints(const WorldState& world, std::span<const TouchingPair> pairs, std::vector<LandingPoint>& points) {
    points.clear();
    const Vec2 along = rightPerp(worldNormal(world, world.contacts[pairs.front().contact]));
    const DVec2 center = world.motions[pairs.front().bodyB].center;
    for (const TouchingPair& pair : pairs) {
        const Contact& contact = world.contacts[pair.contact];
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(contact.manifold.count); ++i) {
            const ManifoldPoint& point = contact.manifold.points[i];
            points.push_back({.place = dot(toReal(placeOf(world, contact, i) - center), along),
                              .separation = point.separation,
                              .slack = kTargetRatio * contact.extent,
                              .contact = pair.contact,
                              .point = i});
        }
    }
    std::sort(points.begin(), points.end(), [](const LandingPoint& p, const LandingPoint& q) {
        return std::tie(p.place, p.separation, p.contact, p.point) <
               std::tie(q.place, q.separation, q.contact, q.point);
    });
}

bool carriesNothing(const WorldState& world, const LandingPoint& point) {
    const Contact& contact = world.contacts[point.contact];
    return contact.normalImpulse[point.point] == 0 && contact.tangentImpulse[point.point] == 0;
}

/// Whether the first and the last of the points meet the ground before those between them do, which carried nothing.
bool areOutermostFirst(const WorldState& world, std::span<const LandingPoint> points) {
    const LandingPoint& first = points.front();
    const LandingPoint& last = points.back();
    const Real width = last.place - first.place;
    if (!(width > 0)) { return false; }
    return std::all_of(points.begin() + 1, points.end() - 1, [&](const LandingPoint& point) {
        const Real share = (point.place - first.place) / width;
        const Real chord = first.separation + share * (last.separation - first.separation);
        return point.separation >= chord - point.slack && carriesNothing(world, point);
    });
}

/// The point of the other contact, in the frame of this one's body A.
ManifoldPoint seenFrom(const WorldState& world, const Contact& contact, const Contact& other, std::size_t point) {
    ManifoldPoint seen = other.manifold.points[point];
    if (other.bodyA == contact.bodyA) { return seen; }
    seen.point = applyInverse(world.motions[contact.bodyA].pose, placeOf(world, other, point));
    return seen;
}

/// @param pairs  of one body and pieces of one ground
void mergeFlush(WorldState& world, std::span<const TouchingPair> pairs) {
    std::vector<LandingPoint>& points = world.landings.points;
    listPoints(world, pairs, points);
    const LandingPoint& own = points.front();
    const LandingPoint& guest = points.back();
    if (points.size() < 3 || own.contact == guest.contact || !areOutermostFirst(world, points)) { return; }
    Contact& contact = world.contacts[own.contact];
    const Contact& other = world.contacts[guest.contact];
    const Contact* const ofGround = withNormalOfGround(world, pairs);
    const bool areAlike = contact.radiusA == other.radiusA && contact.radiusB == other.radiusB;
    if (!areAlike || ofGround == nullptr || !areAllFlush(world, pairs, *ofGround)) { return; }
    world.landings.merged.push_back({.contact = own.contact,
                                     .other = guest.contact,
                                     .point = own.point,
                                     .pointOfOther = guest.point,
                                     .wasPressed = contact.pressed,
                                     .wasOtherPressed = other.pressed,
                                     .before = contact.manifold});
    const ManifoldPoint one = contact.manifold.points[own.point];
    contact.manifold = {.normal = unrotate(world.motions[contact.bodyA].pose.rotation, worldNormal(world, *ofGround)),
                        .points = {one, seenFrom(world, contact, other, guest.point)},
                        .count = 2};
    contact.normalImpulse = {contact.normalImpulse[own.point], other.normalImpulse[guest.point]};
    contact.tangentImpulse = {contact.tangentImpulse[own.point], other.tangentImpulse[guest.point]};
    contact.totalImpulse = {contact.totalImpulse[own.point], other.totalImpulse[guest.point]};
    // One of two that begins to press is struck.
    contact.pressed = contact.pressed && other.pressed;
    for (const TouchingPair& pair : pairs) {
        if (pair.contact != own.contact) { world.landings.leftOut.push_back(pair.contact); }
    }
}

/// In an order that no library decides.
void sortByContact(std::span<TouchingPair> pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const TouchingPair& p, const TouchingPair& q) {
        return std::tie(p.bodyB, p.contact) < std::tie(q.bodyB, q.contact);
    });
}

/// @param pairs  of one body, sorted
void mergeOf(WorldState& world, std::span<TouchingPair> pairs) {
    while (pairs.size() > 1) {
        const TouchingPair first = pairs.front();
        const auto rest = std::partition(pairs.begin() + 1, pairs.end(), [&world, &first](const TouchingPair& pair) {
            return areOfOneGround(world, first, pair);
        });
        const auto count = static_cast<std::size_t>(rest - pairs.begin());
        sortByContact(pairs.first(count));
        if (count > 1) { mergeFlush(world, pairs.first(count)); }
        pairs = pairs.subspan(count);
        sortByContact(pairs);
    }
}

/// Whether the step solves it once, as a whole.
bool isSolvedOnce(const WorldState& world, std::uint32_t body) {
    const bool isFast = world.fastIslands.any && world.fastIslands.numbers[body] != kNoIndex;
    return world.bodies[body].role == BodyRole::solved && !isFast;
}

bool isPlain(const TouchingPair& pair) {
    return !(pair.dynamicA || pair.bounces || pair.isBelt || pair.resistsRolling);
}

/// All contacts with ground of the bodies that may meet some.
void listGroundPairs(WorldState& world) {
    Landings& landings = world.landings;
    landings.pairs.clear();
    landings.areTheirs.resize(world.bodies.slotCount());
    const auto tell = [&landings](std::uint8_t areTheirs) {
        for (const TouchingPair& pair : landings.meeting) { landings.areTheirs[pair.dynamicBody()] = areTheirs; }
    };
    tell(1);
    for (const TouchingPair& pair : world.touching) {
        if (pair.areDynamic() || landings.areTheirs[pair.dynamicBody()] == 0) { continue; }
        if (isPlain(pair) && isSolvedOnce(world, pair.bodyB)) { landings.pairs.push_back(pair); }
    }
    tell(0);
}

/// What is left out is no part of what is solved.
void leaveOut(WorldState& world) {
    Landings& landings = world.landings;
    std::sort(landings.leftOut.begin(), landings.leftOut.end());
    std::erase_if(world.touching, [&landings](const TouchingPair& pair) {
        return !pair.areDynamic() && std::binary_search(landings.leftOut.begin(), landings.leftOut.end(), pair.contact);
    });
    std::sort(landings.merged.begin(), landings.merged.end(),
              [](const MergedContact& a, const MergedContact& b) { return a.contact < b.contact; });
    for (TouchingPair& pair : world.touching) {
        if (pair.areDynamic()) { continue; }
        const auto found =
            std::lower_bound(landings.merged.begin(), landings.merged.end(), pair.contact,
                             [](const MergedContact& merged, std::uint32_t place) { return merged.contact < place; });
        if (found != landings.merged.end() && found->contact == pair.contact) { pair.points = 2; }
    }
}

/// @param from  as the solve left it @param pointThere  in which the point of the contact stood
void takeImpulses(Contact& contact, std::size_t point, const ContactRow& from, std::size_t pointThere,
                  bool wasPressed) {
    contact.normalImpulse = contact.tangentImpulse = contact.totalImpulse = {};
    contact.normalImpulse[point] = from.normalImpulse[pointThere];
    contact.tangentImpulse[point] = from.tangentImpulse[pointThere];
    contact.totalImpulse[point] = from.totalImpulse[pointThere];
    contact.pressed = contact.totalImpulse[point] > 0;
    contact.pressedOn = wasPressed && contact.pressed;
}

/// A blow of both points is one of each contact. @pre each has its points and impulses again
void shareHit(WorldState& world, const MergedContact& merged) {
    const Contact& contact = world.contacts[merged.contact];
    const Contact& other = world.contacts[merged.other];
    const ContactEvent own = hitBetween(world, contact.shapeA, contact.shapeB);
    const std::span<ContactEvent> events = std::span(world.contactEvents).subspan(world.landings.eventsBefore);
    const auto hit = std::find_if(events.begin(), events.end(), [&own](const ContactEvent& event) {
        return event.type == own.type && event.shapeA == own.shapeA && event.segmentA == own.segmentA &&
               event.shapeB == own.shapeB;
    });
    if (hit == events.end()) { return; }
    hit->point = placeOf(world, contact, merged.point);
    hit->impulse = contact.totalImpulse[merged.point];
    ContactEvent ofOther = hitBetween(world, other.shapeA, other.shapeB);
    ofOther.fraction = hit->fraction;
    ofOther.point = placeOf(world, other, merged.pointOfOther);
    ofOther.normal = hit->normal;
    ofOther.approachSpeed = hit->approachSpeed;
    ofOther.impulse = other.totalImpulse[merged.pointOfOther];
    // What pressed before is not struck.
    if (!(ofOther.impulse > 0)) { return; }
    if (merged.wasPressed || !(hit->impulse > 0)) {
        *hit = ofOther;
    } else if (!merged.wasOtherPressed) {
        world.contactEvents.push_back(ofOther);
    }
}

}  // namespace

void mergeLandings(WorldState& world) {
    Landings& landings = world.landings;
    landings.merged.clear();
    landings.leftOut.clear();
    std::vector<TouchingPair>& pairs = landings.pairs;
    listGroundPairs(world);
    if (pairs.size() < 2) { return; }
    sortByContact(pairs);
    for (std::size_t begin = 0; begin < pairs.size();) {
        std::size_t end = begin + 1;
        while (end < pairs.size() && pairs[end].bodyB == pairs[begin].bodyB) { ++end; }
        mergeOf(world, std::span(pairs).subspan(begin, end - begin));
        begin = end;
    }
    if (landings.merged.empty()) { return; }
    leaveOut(world);
    landings.eventsBefore = world.contactEvents.size();
}

void partLandings(WorldState& world) {
    if (world.landings.merged.empty()) { return; }
    for (const std::uint32_t place : world.landings.leftOut) {
        Contact& contact = world.contacts[place];
        contact.totalImpulse = {};
        contact.pressed = contact.pressedOn = false;
    }
    for (const MergedContact& merged : world.landings.merged) {
        Contact& contact = world.contacts[merged.contact];
        Contact& other = world.contacts[merged.other];
        const ContactRow solved = contact;
        contact.manifold = merged.before;
        takeImpulses(contact, merged.point, solved, 0, merged.wasPressed);
        takeImpulses(other, merged.pointOfOther, solved, 1, merged.wasOtherPressed);
        shareHit(world, merged);
    }
    world.landings.merged.clear();
}

}  // namespace swept::inline SWEPT_PRECISION

#include "ghosts.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "../state/tolerances.h"
#include "contact_manifold.h"
#include "slides.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kBodyGrain = 256;

/// Two normals that are both so near to a third one are the same by `kSameNormal`: half of its angle, rounded down.
constexpr Real kNearNormal = 1 - Real(1) / 4000;

bool isGroundContact(const Contact& contact) { return contact.dynamicA != contact.dynamicB && contact.isSolid(); }

bool isFaceContact(const GroundContact& contact) {
    if (contact.count > 1) { return true; }
    return faceWithNormal(contact.ground, unrotate(contact.groundPose.rotation, contact.normal)) >= 0;
}

bool isGroundAtRest(const WorldState& world, const Contact& contact) {
    return world.bodies[contact.dynamicA ? contact.bodyB : contact.bodyA].def.type == BodyType::fixed;
}

/// Of the body over its ground, metres.
Real heightAbove(const GroundContact& contact, Vec2 normal) {
    return separationAlong(contact.ground, contact.groundPose, contact.own, contact.ownPose, normal);
}

/// How far the other ground is below the plane of what the body stands on, metres.
Real stepDown(const GroundContact& stands, const GroundContact& other) {
    return heightAbove(other, stands.normal) - heightAbove(stands, stands.normal);
}

/// Ground that the body has yet to reach holds it off in this step just as ground does on which it stands: what comes
/// down beside a seam would else be turned back by the corner of the next piece, before it lands. But what moves may
/// lay bare what it hides, of faces that meet at a ridge the body may turn onto either, and a step is in the way.
bool mayHideAhead(const WorldState& world, const Contact& stands, const Contact& hidden, const GroundContact& seen) {
    if (!isGroundAtRest(world, stands) || !isGroundAtRest(world, hidden) || isFaceContact(seen)) { return false; }
    return std::fabs(stepDown(groundContactOf(world, stands), seen)) <= seen.slop;
}

/// @return another one of the same body that hides the contact; null: none does
const Contact* hiderOf(const WorldState& world, const GroundContacts& contacts, std::uint32_t index,
                       const GroundContact& contact) {
    for (std::uint32_t i = contacts.first; i != kNoIndex; i = contacts.next[i]) {
        const Contact& stands = contacts.all[i];
        if (i == index || !stands.isSolid()) { continue; }
        const bool isReached = deepestSeparation(stands.manifold) <= kEndRatio * stands.extent;
        if (!isReached && !mayHideAhead(world, stands, contacts.all[index], contact)) { continue; }
        if (hides(groundContactOf(world, stands), contact)) { return &stands; }
    }
    return nullptr;
}

/// What the contacts of a body are like.
struct GhostRanks {
    std::uint32_t bits = 0;    ///< by rank: whether some contact has it
    bool areOneNormal = true;  ///< all normals are one
    bool has(int rank) const { return (bits >> rank & 1U) != 0; }
    /// Faces hide corners whatever their normals, and others of their kind only along another normal.
    bool mayHide() const { return !areOneNormal || ((has(0) || has(1)) && (has(2) || has(3))); }
};
GhostRanks ranksOf(const WorldState& world, const GroundContacts& contacts) {
    GhostRanks ranks;
    Vec2 normal{};
    for (std::uint32_t i = contacts.first; i != kNoIndex; i = contacts.next[i]) {
        if (!contacts.all[i].isSolid()) { continue; }
        const GroundContact contact = groundContactOf(world, contacts.all[i]);
        if (ranks.bits == 0) { normal = contact.normal; }
        ranks.areOneNormal = ranks.areOneNormal && dot(contact.normal, normal) > kNearNormal;
        ranks.bits |= 1U << ghostRank(contact);
    }
    return ranks;
}

/// @return whether there were any
bool dropGhostsOf(const WorldState& world, const GroundContacts& contacts) {
    const GhostRanks ranks = ranksOf(world, contacts);
    if (!ranks.mayHide()) { return false; }
    bool anyGhost = false;
    // What was dropped hides nothing, so one of each pair stays.
    for (int rank = 0; rank < kGhostRanks; ++rank) {
        if (!ranks.has(rank)) { continue; }  // mostly all of a body are of one rank, or of two
        for (std::uint32_t i = contacts.first; i != kNoIndex; i = contacts.next[i]) {
            Contact& contact = contacts.all[i];
            if (!contact.isSolid()) { continue; }
            const GroundContact seen = groundContactOf(world, contact);
            if (ghostRank(seen) != rank) { continue; }
            const Contact* const hider = hiderOf(world, contacts, i, seen);
            if (hider == nullptr) { continue; }
            const Vec2 normal = groundContactOf(world, *hider).normal;
            if (!turnToFlushFace(world, contact, seen, !contact.dynamicA, normal)) { contact.manifold.count = 0; }
            anyGhost = true;
        }
    }
    return anyGhost;
}

/// As the same contact of B with A.
Manifold turnedAround(const Manifold& manifold, const Transform& bInA) {
    Manifold other = manifold;
    other.normal = -rotate(bInA.rotation, manifold.normal);
    for (ManifoldPoint& point : other.points) { point.point = apply(bInA, point.point); }
    other.isNormalOfB = !manifold.isNormalOfB;
    return other;
}

}  // namespace

GroundContact groundContactOf(const WorldState& world, const Contact& contact) {
    return groundContactOf(world, contact, !contact.dynamicA);
}

GroundContact groundContactOf(const WorldState& world, const Contact& contact, bool groundIsA) {
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const Shape& ground = world.shapes[groundIsA ? contact.shapeA : contact.shapeB];
    const Shape& own = world.shapes[groundIsA ? contact.shapeB : contact.shapeA];
    return {.ground = ground.polygon,
            .own = own.polygon,
            .groundPose = world.motions[ground.body].pose,
            .ownPose = world.motions[own.body].pose,
            .normal = groundIsA ? normal : -normal,
            .count = contact.manifold.count,
            .slop = kTargetRatio * contact.extent};
}

bool areFlush(const GroundContact& one, const GroundContact& other) {
    const Vec2 normal = unrotate(other.groundPose.rotation, one.normal);
    return faceWithNormal(other.ground, normal) >= 0 && std::fabs(stepDown(one, other)) <= other.slop;
}

int ghostRank(const GroundContact& contact) { return (isFaceContact(contact) ? 2 : 0) + (contact.count > 1 ? 1 : 0); }

bool turnToFlushFace(const WorldState& world, Contact& contact, const GroundContact& seen, bool groundIsA,
                     Vec2 normal) {
    if (contact.ofChain || contact.manifold.isNormalOfB != groundIsA) { return false; }
    const int face = faceWithNormal(seen.ground, unrotate(seen.groundPose.rotation, normal));
    if (face < 0) { return false; }
    Real farthest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        farthest = std::max(farthest, contact.manifold.points[i].separation);
    }
    const Transform ownInGround = relativeTransform(seen.groundPose, seen.ownPose);
    const Manifold onFace = collideOnFace(seen.ground, face, seen.own, ownInGround, seen.slop + farthest, kFaceSine);
    if (onFace.count == 0) { return false; }
    const Transform bInA = relativePoseOf(world, contact);
    takeManifold(contact, bInA, groundIsA ? onFace : turnedAround(onFace, bInA));
    return true;
}

bool hides(const GroundContact& stands, const GroundContact& other) {
    const bool yields = isFaceContact(stands) && !isFaceContact(other);
    const bool areOne = dot(stands.normal, other.normal) > kSameNormal;
    if (!yields && (areOne || isFaceContact(other) != isFaceContact(stands))) { return false; }
    const Real clear = heightAbove(other, stands.normal);
    if (clear >= -other.slop) { return true; }
    // What is heavy sinks in: then the next piece, flush with what holds it, is no more in the way than that.
    const Real sunk = heightAbove(stands, stands.normal);
    return sunk < 0 && clear >= sunk - other.slop;
}

Real separationAlong(const Polygon& a, const WorldTransform& poseA, const Polygon& b, const WorldTransform& poseB,
                     Vec2 direction) {
    const Vec2 inA = unrotate(poseA.rotation, direction);
    const Vec2 inB = unrotate(poseB.rotation, -direction);
    const Vec2 top = rotate(poseA.rotation, a.vertices[static_cast<std::size_t>(supportIndex(a, inA))]);
    const Vec2 bottom = rotate(poseB.rotation, b.vertices[static_cast<std::size_t>(supportIndex(b, inB))]);
    return dot(direction, toReal(poseB.position - poseA.position) + (bottom - top)) - a.radius - b.radius;
}

bool dropGhosts(WorldState& world, std::span<Contact> contacts, std::span<Slide> slides,
                std::span<const std::uint32_t> renewed, std::span<const std::uint32_t> bodies,
                std::vector<std::uint32_t>& next, TaskSystem& loops) {
    // Lists of the ground contacts of each body, through arrays that keep their capacity; empty before and after.
    std::vector<std::uint32_t>& firstOf = world.firstGroundContact;
    firstOf.resize(world.bodies.slotCount(), kNoIndex);
    next.resize(contacts.size());
    bool anyTwo = false;
    std::atomic<bool> anyGhost = false;
    for (const std::uint32_t i : renewed) {
        if (!isGroundContact(contacts[i]) && !(slides[i].impulse > 0)) { continue; }
        std::uint32_t& first = firstOf[contacts[i].dynamicBody()];
        anyTwo = anyTwo || first != kNoIndex;
        next[i] = first;
        first = i;
    }
    const auto dropOf = [&](std::uint32_t slot) {
        const std::uint32_t first = firstOf[slot];
        if (first == kNoIndex || next[first] == kNoIndex) { return; }
        const GroundContacts ofBody{contacts, slides, next, first};
        if (dropGhostsOf(world, ofBody)) { anyGhost.store(true, std::memory_order_relaxed); }
        carryAlong(world, ofBody);
    };
    if (anyTwo) {  // of each body its own
        loops.run(bodies.size(), kBodyGrain, [&bodies, &dropOf](std::size_t begin, std::size_t end, int) {
            for (const std::uint32_t slot : bodies.subspan(begin, end - begin)) { dropOf(slot); }
        });
    }
    for (const std::uint32_t i : renewed) {
        if (contacts[i].dynamicA != contacts[i].dynamicB) { firstOf[contacts[i].dynamicBody()] = kNoIndex; }
        slides[i].impulse = 0;
    }
    return anyGhost;
}

}  // namespace swept::inline SWEPT_PRECISION

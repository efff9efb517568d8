#include "ghosts.h"

#include <algorithm>

#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A contact of a dynamic body with something that does not yield, seen from the ground.
struct GroundContact {
    const Shape& ground;
    const Shape& own;
    Vec2 normal;  ///< world, from the ground to the body
    bool touches;
};

bool isGroundContact(const WorldState& world, const Contact& contact) {
    if (!contact.isSolid() || !contact.updated || contact.apart) { return false; }
    return world.bodies[contact.bodyA].isDynamic() != world.bodies[contact.bodyB].isDynamic();
}

GroundContact groundContactOf(const WorldState& world, const Contact& contact) {
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const Real deepest = deepestSeparation(contact.manifold);
    const bool touches = deepest <= kBeginRatio * contact.extent;
    const Shape& a = world.shapes[contact.shapeA];
    const Shape& b = world.shapes[contact.shapeB];
    if (world.bodies[contact.bodyA].isDynamic()) { return {b, a, -normal, touches}; }
    return {a, b, normal, touches};
}

bool hides(const WorldState& world, const GroundContact& stands, const GroundContact& other) {
    if (!stands.touches || dot(stands.normal, other.normal) > kSameNormal) { return false; }
    const Real slop = kTargetRatio * std::min(other.ground.extent, other.own.extent);
    return separationAlong(other.ground.polygon, world.motions[other.ground.body].pose, other.own.polygon,
                           world.motions[other.own.body].pose, stands.normal) >= -slop;
}

/// @return whether the contact is hidden by another one of the same body
bool isGhost(const WorldState& world, std::uint32_t index, std::uint32_t first) {
    const GroundContact contact = groundContactOf(world, world.contacts[index]);
    for (std::uint32_t i = first; i != kNoIndex; i = world.nextGroundContact[i]) {
        if (i != index && world.contacts[i].isSolid() && hides(world, groundContactOf(world, world.contacts[i]), contact)) { return true; }
    }
    return false;
}

}  // namespace

Real separationAlong(const Polygon& a, const WorldTransform& poseA, const Polygon& b, const WorldTransform& poseB,
                     Vec2 direction) {
    const Vec2 inA = unrotate(poseA.rotation, direction);
    const Vec2 inB = unrotate(poseB.rotation, -direction);
    const Vec2 top = rotate(poseA.rotation, a.vertices[static_cast<std::size_t>(supportIndex(a, inA))]);
    const Vec2 bottom = rotate(poseB.rotation, b.vertices[static_cast<std::size_t>(supportIndex(b, inB))]);
    return dot(direction, toReal(poseB.position - poseA.position) + (bottom - top)) - a.radius - b.radius;
}

void dropGhosts(WorldState& world) {
    // Lists of the ground contacts of each body, through arrays that keep their capacity.
    world.firstGroundContact.assign(world.bodies.slotCount(), kNoIndex);
    world.nextGroundContact.assign(world.contacts.size(), kNoIndex);
    bool anyTwo = false;
    for (std::uint32_t i = 0; i < world.contacts.size(); ++i) {
        const Contact& contact = world.contacts[i];
        if (!isGroundContact(world, contact)) { continue; }
        const std::uint32_t body = world.bodies[contact.bodyA].isDynamic() ? contact.bodyA : contact.bodyB;
        anyTwo = anyTwo || world.firstGroundContact[body] != kNoIndex;
        world.nextGroundContact[i] = world.firstGroundContact[body];
        world.firstGroundContact[body] = i;
    }
    if (!anyTwo) { return; }
    for (const std::uint32_t slot : world.awake) {
        const std::uint32_t first = world.firstGroundContact[slot];
        if (first == kNoIndex || world.nextGroundContact[first] == kNoIndex) { continue; }
        // Single points first: corners yield to faces. What was dropped hides nothing, so one of each pair stays.
        for (const int count : {1, 2}) {
            for (std::uint32_t i = first; i != kNoIndex; i = world.nextGroundContact[i]) {
                Contact& contact = world.contacts[i];
                if (contact.manifold.count == count && isGhost(world, i, first)) { contact.manifold.count = 0; }
            }
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

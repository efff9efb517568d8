#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "../state/world_state.h"

/// Ghost collisions: a body that slides from one flush piece of ground to the next meets the side or the corner of the
/// next piece, which the ground before it hides. What tells them apart from a wall: along the normal of the ground it
/// stands on, or comes down on, the body is already clear of the next piece. So a contact yields to another one of the
/// same body whose normal keeps the two shapes apart just as well, to within the slop. Corners yield to faces, never
/// the other way round.

namespace swept::inline SWEPT_PRECISION {

/// Normals closer than this (cosine) are one: no face can hide another.
inline constexpr Real kSameNormal = 1 - Real(1) / 1024;
/// Sine up to which a normal is that of a face: round shapes lose the square of it at every corner they pass.
inline constexpr Real kFaceSine = Real(1) / 1024;

/// The face with this normal, both in the polygon's frame; −1: none.
inline int faceWithNormal(const Polygon& polygon, Vec2 normal) {
    const int edges = polygon.count > 1 ? polygon.count : 0;
    for (int i = 0; i < edges; ++i) {
        const Vec2 face = polygon.normals[static_cast<std::size_t>(i)];
        if (dot(face, normal) > 0 && std::fabs(cross(face, normal)) <= kFaceSine) { return i; }
    }
    return -1;
}

/// A contact of a body with something that does not yield.
struct GroundContact {
    const Polygon& ground;
    const Polygon& own;
    WorldTransform groundPose;
    WorldTransform ownPose;
    Vec2 normal;  ///< world, from the ground to the body
    int count;    ///< points
    Real slop;    ///< metres
};

GroundContact groundContactOf(const WorldState& world, const Contact& contact);
/// Likewise of two dynamic bodies, of which either may be as the ground.
GroundContact groundContactOf(const WorldState& world, const Contact& contact, bool groundIsA);

/// Whether the other ground has a face in the plane of this one, to within the slop. Not where ground bends, however
/// little: what meets one side of a bend goes on into the other one.
bool areFlush(const GroundContact& one, const GroundContact& other);

/// What yields first has the lowest rank: corners before faces, single points before pairs.
inline constexpr int kGhostRanks = 4;
int ghostRank(const GroundContact& contact);

/// @return whether `other` is a ghost of the same body while it stands on `stands`
bool hides(const GroundContact& stands, const GroundContact& other);

/// What hides a tilted body's own normal leaves the ground below it, which the body may yet reach: where that has a
/// face flush with what the body stands on the two meet along that.
/// @param seen    the contact, with A or B as the ground
/// @param normal  world, of what it stands on. @return whether there is such a face
bool turnToFlushFace(const WorldState& world, Contact& contact, const GroundContact& seen, bool groundIsA, Vec2 normal);

/// Separation of two placed shapes along a unit world direction from A to B, radii included, metres: how far B's lowest
/// point lies above A's highest.
Real separationAlong(const Polygon& a, const WorldTransform& poseA, const Polygon& b, const WorldTransform& poseB,
                     Vec2 direction);

/// Drops the ghosts among new contacts, or turns them to what the body may meet there of these bodies (slots) with
/// static and kinematic shapes.
/// @param slides   of each contact; forgotten
/// @param renewed  indices of the contacts whose manifold is new, in their order; those of dynamic bodies alone may be
/// left out
/// @param next  scratch: by contact, the next one of the same body
/// @return whether there were any
bool dropGhosts(WorldState& world, std::span<Contact> contacts, std::span<Slide> slides,
                std::span<const std::uint32_t> renewed, std::span<const std::uint32_t> bodies,
                std::vector<std::uint32_t>& next, TaskSystem& loops);

}  // namespace swept::inline SWEPT_PRECISION

#include "flight_contacts.h"

#include <algorithm>

#include "../contacts/ghosts.h"
#include "../solve/constraint_builder.h"
#include "../state/tolerances.h"
#include "set_back.h"
#include "sweep_obstacles.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Real deepestOf(const ContactConstraint& constraint) {
    const Real first = constraint.points[0].baseSeparation;
    return constraint.count > 1 ? std::min(first, constraint.points[1].baseSeparation) : first;
}

/// Sets a body that sank below the band of its target back to the target, along the contact normal: what gravity does
/// between two impacts of a sliding body is undone by it. What something kinematic holds deeper than that is squeezed,
/// and stays in it: behind it may be a wall.
/// @param groundVelocity  where they meet, m/s
void setBack(Flight& flight, ContactConstraint& contact, const FlightObstacle& obstacle, Vec2 groundVelocity) {
    const auto target = static_cast<Real>(targetOf(*flight.world, obstacle));
    const auto tolerance = static_cast<Real>(toleranceOf(*flight.world, obstacle));
    const Real deepest = std::min(target, deepestOf(contact));
    if (deepest >= target - tolerance - roundingOf(*flight.world, obstacle)) { return; }
    const Body& other = flight.world->bodies[flight.world->shapes[obstacle.other].body];
    const bool isSqueezed = static_cast<double>(target - deepest) > slackOf(*flight.world, obstacle);
    if (isSqueezed && other.def.type == BodyType::kinematic) { return; }
    const auto lowPoint = [&](std::size_t i) {
        const ContactConstraintPoint& point = contact.points[i];
        return LowPoint{cross(point.anchorB, contact.normal), target - point.baseSeparation};
    };
    const Body& body = flight.body();
    const BodyInertia inertia{body.inverseMass, body.inverseInertia};
    BodyMotion& motion = flight.motion;
    const LowPoint first = lowPoint(0);
    const SetBack back = setBackOf({first, contact.count > 1 ? lowPoint(1) : first}, inertia, body.radius);
    const SetBackEnergy energy{.pull = -dot(accelerationOf(*flight.world, body), contact.normal),
                               .velocity = dot(motion.velocity - groundVelocity, contact.normal),
                               .spin = motion.angularVelocity};
    contact.restitution *= speedLeft(back, energy, inertia);
    motion.center += toDouble(back.along * contact.normal);
    motion.angle += static_cast<double>(back.turn);
    motion.pose = poseOf(motion.center, motion.angle, body.localCenter);
}

/// Faces that meet flush meet at all their points: what the slop tells from touching takes part in the impact of
/// another point with the same normal, or the body would be thrown about the corner that happens to come first.
void dropWhatIsNotMet(Flight& flight) {
    std::vector<ContactConstraint>& all = flight.scratch->constraints;
    const auto isMet = [&](const ContactConstraint& constraint) {
        return deepestOf(constraint) <= reachOf(*flight.world, flight.scratch->obstacles[constraint.source]);
    };
    const auto isBesideAMetOne = [&](const ContactConstraint& constraint) {
        return std::any_of(all.begin(), all.end(), [&](const ContactConstraint& other) {
            return isMet(other) && dot(other.normal, constraint.normal) > kSameNormal;
        });
    };
    for (std::size_t i = 0; i < all.size();) {
        if (isBesideAMetOne(all[i])) {
            ++i;
        } else {
            all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

void addConstraint(Flight& flight, FlightObstacle& obstacle, std::uint32_t source) {
    if (obstacle.isCrossed) { return; }
    const Shape& own = flight.world->shapes[obstacle.own];
    const Shape& other = flight.world->shapes[obstacle.other];
    const Body& otherBody = flight.world->bodies[other.body];
    const Sweep otherSweep = obstacleSweep(*flight.world, other.body, flight.elapsed, flight.dt);
    const BodyMotion otherMotion = motionAt(otherSweep, 0, otherBody.localCenter);
    const Real margin = std::max(reachOf(*flight.world, obstacle), slopOf(*flight.world, obstacle));
    const Manifold manifold = obstacleManifold(*flight.world, obstacle, otherMotion.pose, flight.motion.pose, margin);
    if (manifold.count == 0) { return; }
    obstacle.hasOwnNormal = manifold.isNormalOfB;
    ContactConstraint constraint =
        constraintOf(manifold, contactFrameOf(otherMotion, otherBody.localCenter, flight.motion),
                     mixedSurface(own.def, other.def), 0);
    constraint.source = source;
    constraint.slotB = kFlyerSlot;
    Vec2 groundVelocity{};
    if (otherBody.def.type == BodyType::kinematic) {
        const BodyMotion& moving = flight.world->motions[other.body];
        groundVelocity = moving.velocity + cross(moving.angularVelocity, constraint.points[0].anchorA);
        constraint.slotA = static_cast<BodySlot>(flight.scratch->states.size());
        flight.scratch->states.push_back({.velocity = moving.velocity, .angularVelocity = moving.angularVelocity});
        flight.scratch->inertias.push_back({});
    }
    setBack(flight, constraint, obstacle, groundVelocity);
    flight.scratch->constraints.push_back(constraint);
}

/// Drops the constraints that another one's normal shows to be ghosts (ghosts.h).
void dropGhosts(Flight& flight) {
    std::vector<ContactConstraint>& all = flight.scratch->constraints;
    for (int rank = 0; rank < kGhostRanks && all.size() > 1; ++rank) {
        for (std::size_t i = 0; i < all.size();) {
            const GroundContact contact = groundContactOf(flight, all[i]);
            const auto hidesIt = [&](const ContactConstraint& stands) {
                return &stands != &all[i] && hides(groundContactOf(flight, stands), contact);
            };
            if (ghostRank(contact) == rank && std::any_of(all.begin(), all.end(), hidesIt)) {
                all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
            } else {
                ++i;
            }
        }
    }
}

/// @pre the separations of the constraints are those of the points
void noteMet(Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    for (const ContactConstraint& constraint : scratch.constraints) {
        const FlightObstacle& obstacle = scratch.obstacles[constraint.source];
        const double lowest = targetOf(*flight.world, obstacle) - toleranceOf(*flight.world, obstacle) -
                              static_cast<double>(roundingOf(*flight.world, obstacle));
        if (constraint.slotA != kFixedSlot || static_cast<double>(deepestOf(constraint)) < lowest) { continue; }
        scratch.met.push_back({obstacle.own, obstacle.other, constraint.normal});
    }
}

}  // namespace

GroundContact groundContactOf(const Flight& flight, const ContactConstraint& constraint) {
    const FlightObstacle& obstacle = flight.scratch->obstacles[constraint.source];
    const Shape& other = flight.world->shapes[obstacle.other];
    const Sweep otherSweep = obstacleSweep(*flight.world, other.body, flight.elapsed, flight.dt);
    return {.ground = other.polygon,
            .own = flight.world->shapes[obstacle.own].polygon,
            .groundPose = motionAt(otherSweep, 0, flight.world->bodies[other.body].localCenter).pose,
            .ownPose = flight.motion.pose,
            .normal = constraint.normal,
            .count = constraint.count,
            .slop = slopOf(*flight.world, obstacle)};
}

void listMet(Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    scratch.constraints.clear();
    scratch.met.clear();
    for (std::size_t i = 0; i < scratch.obstacles.size(); ++i) {
        addConstraint(flight, scratch.obstacles[i], static_cast<std::uint32_t>(i));
    }
    dropWhatIsNotMet(flight);
    dropGhosts(flight);
    noteMet(flight);
}

}  // namespace swept::inline SWEPT_PRECISION

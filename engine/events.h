#pragma once

#include <cstdint>

#include "../shapes/vec2.h"
#include "ids.h"

namespace swept {

enum class ContactEventType : std::uint8_t {
    begin,  ///< two shapes touched as the step began, and did not before
    end,    ///< they touch no longer, or one of them is gone
    /// An impact faster than gravity could make it within a step (of any speed where there is none), or one that
    /// bounced; told at its time. Shapes that touch already tell one when they meet at another point, faster than the
    /// forces on them could make it within a step: a crate that tips over, for each corner that slaps down. One event
    /// for a pair and an impact, at its hardest point; `impulse` is that of the pair. `begin` follows in the next step
    /// only if they still touch then. Compare `approachSpeed` or `impulse` with what is worth a sound.
    hit,
    sensorBegin,  ///< a shape overlaps a sensor
    sensorEnd,
};

/// Why a body did not use its whole step.
enum class LostTimeReason : std::uint8_t {
    stop,        ///< continuous mode `stop`
    budget,      ///< `maxImpacts` was used up
    stuck,       ///< it could not move, or hardly, without passing through something
    clamp,       ///< a fast body with joints or touching neighbours was held at its impact
    speedLimit,  ///< continuous mode `speedLimit` cut the speed: the part of its way that it did not go, as time
};

/// One line of the lost-time ledger of the last step.
struct LostTimeEntry {
    BodyId body{};
    double seconds = 0;
    LostTimeReason reason = LostTimeReason::stop;
};

struct JointBreakEvent {
    JointId joint{};
    BodyId bodyA{};
    BodyId bodyB{};
    std::uint64_t userData = 0;
    DVec2 point{};      ///< anchor on A, world
    DVec2 force{};      ///< on B at its anchor, mean of the step: what broke it, N
    double torque = 0;  ///< on B, likewise, N·m
};

}  // namespace swept

namespace swept::inline SWEPT_PRECISION {

/// Something between two shapes in the last step. For sensor events `shapeA` is the sensor.
struct ContactEvent {
    ContactEventType type = ContactEventType::begin;
    ShapeId shapeA{};
    ShapeId shapeB{};
    BodyId bodyA{};
    BodyId bodyB{};
    /// Of a chain the segment, from 0 in the order of its points; of other shapes 0. That which was hit, at which
    /// touching began, or ended: where `point` is, if several did so at once. What slides on from one segment to the
    /// next tells no event; `World::visitContacts` has those of now.
    std::uint32_t segmentA = 0;
    std::uint32_t segmentB = 0;
    double fraction = 0;  ///< of the step, 0 … 1
    /// World; of sensor events half way between the closest points, or the deepest where the two overlap; 0 where the
    /// shapes were apart or gone already.
    DVec2 point{};
    Vec2 normal{};           ///< unit, from A to B
    Real approachSpeed = 0;  ///< m/s before a hit
    Real impulse = 0;        ///< N·s along the normal, of a hit: what of the blow this step solved
    // Those of the time of the event: they tell who it was after what the ids name is gone.
    std::uint64_t userDataA = 0;      ///< of `shapeA`
    std::uint64_t userDataB = 0;      ///< of `shapeB`
    std::uint64_t bodyUserDataA = 0;  ///< of `bodyA`
    std::uint64_t bodyUserDataB = 0;  ///< of `bodyB`
};

/// A pose at which a body met something within the step, or at which its island ended a part of the step.
struct ImpactPose {
    BodyId body{};
    DVec2 position{};  ///< body origin
    double angle = 0;
    double fraction = 0;
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <optional>

#include "../shapes/vec2.h"

namespace swept {

/// `fixed` (static in the scene format; a keyword here) never moves; `kinematic` moves by its velocity and is not moved
/// by anything; `dynamic` obeys forces and impulses.
enum class BodyType : std::uint8_t { fixed, kinematic, dynamic };

/// Whether a force wakes a body. With `no` a sleeping body stays asleep, and the force counts only if something else
/// wakes it before the next step; a body that comes to rest on something under the force falls asleep. For forces that
/// act in every step: a planet's pull, wind, buoyancy.
enum class Wake : std::uint8_t { yes, no };

/// What happens when a body moves so fast that it could pass through something within a step.
enum class ContinuousMode : std::uint8_t {
    off,         ///< nothing: contacts are looked for at the start of the step only
    speedLimit,  ///< no point of the body moves farther in a step than half its own width and that of the world's
                 ///< thinnest wall; what is faster is slowed (and entered in the lost-time ledger). Dynamic bodies only
    speculative,  ///< contacts are made ahead, as far as the body may move in the step, and let it close the gap and no
                  ///< more; the plane of a contact has no end, so what would have passed by may be stopped (a ghost)
    stop,         ///< the body stops at its first hit of a static or kinematic shape; the rest of its step is lost
                  ///< (and entered in the lost-time ledger)
    /// The impact is resolved at its own time, and the body goes on through the rest of the step. (That divides the
    /// step of this body where it hits; into how many parts the solver divides all steps, `WorldSettings::subSteps`
    /// says.)
    subStep,
};

}  // namespace swept

namespace swept::inline SWEPT_PRECISION {

/// How to make a body. Metres, radians, seconds, kilograms.
struct BodyDef {
    BodyType type = BodyType::fixed;
    DVec2 position{};  ///< of the body origin, world
    double angle = 0;  ///< counter-clockwise; kept unwrapped
    Vec2 velocity{};   ///< of the centre of mass (of what is not dynamic: of the origin); not for static bodies
    Real angularVelocity = 0;
    Real linearDamping = 0;  ///< 1/s, v′ = −c·v, applied exactly; at least 0
    Real angularDamping = 0;
    Real gravityScale = 1;
    Real mass = 0;     ///< replaces the mass of the shapes, and scales their inertia along; 0: take theirs. Of dynamic
                       ///< bodies only. Shapes without density have no inertia, nor do they move the centre of mass
    Real inertia = 0;  ///< kg·m² about the centre of mass; likewise. What has none is turned by nothing
    bool fixedRotation = false;  ///< does not turn; its angular velocity is 0
    bool bullet = false;         ///< in mode `subStep`, also swept against dynamic bodies, in order of time
    bool awake = true;           ///< false: sleeps until something wakes it, with the shapes that it is given then
    bool allowSleep = true;      ///< false: never falls asleep by itself, nor does what touches it or is jointed to it
    bool enabled = true;         ///< false: takes no part until `World::setEnabled` lets it
    std::optional<ContinuousMode> continuous{};  ///< empty: the world's
    std::uint64_t userData = 0;

    bool operator==(const BodyDef&) const = default;
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "../broadphase/broadphase_kind.h"
#include "../shapes/vec2.h"
#include "body_def.h"

namespace swept {

/// How much work a step does where the settings do not say it themselves.
enum class Profile : std::uint8_t {
    accurate,  ///< 16 sub-steps with 2 relaxation passes each
    fast,      ///< 4 sub-steps with 1 relaxation pass each
};

}  // namespace swept

namespace swept::inline SWEPT_PRECISION {

struct WorldSettings {
    Vec2 gravity{0, Real(-9.81)};  ///< m/s²
    Profile profile = Profile::accurate;
    std::optional<int> subSteps{};     ///< 1 … 1024; else the profile's
    std::optional<int> relaxPasses{};  ///< per sub-step, 0 … 64; else the profile's
    ContinuousMode continuous = ContinuousMode::subStep;
    /// Most impacts per body and step, at least 1. Progress is checked after each 64 of them: a body that got on by
    /// less than 1/1024 of the step meanwhile is held (`LostTimeReason::stuck`).
    int maxImpacts = 64;
    /// m/s, greater than 0; of dynamic bodies: faster ones are slowed to it. Kinematic ones move as they are told.
    Real maxSpeed = std::numeric_limits<Real>::infinity();
    /// Errors that are accepted. Each island then gets the sub-steps that keep them (effort_budget.h): from a quarter
    /// of those above up to 64; what has no budget gets no worse. Beyond them is counted: `overPenetration` and its
    /// like.
    Real maxPenetration = std::numeric_limits<Real>::infinity();  ///< metres, at least 0
    Real maxJointError = std::numeric_limits<Real>::infinity();   ///< metres, at least 0
    /// Seconds that a body may lose in all, at least 0: one that would lose more gets up to 16 times `maxImpacts`.
    double maxLostTime = std::numeric_limits<double>::infinity();
    /// Metres, greater than 0; else a quarter of the target, which is 2⁻¹⁰ of the pair's extent.
    std::optional<Real> toiTolerance{};
    bool sleep = true;  ///< islands at rest are left out of steps until something wakes them; false: never
    /// m/s, at least 0, finite: what moves (its rim, where it turns) no faster than this in the mean, for as long as
    /// rest takes, falls asleep, too: what rolls or creeps on. 0: only what stays where it is.
    Real sleepSpeed = 0;
    bool measureStageTimes = false;
    BroadphaseKind broadphase = BroadphaseKind::automatic;  ///< may change only while the world has no shapes
};

}  // namespace swept::inline SWEPT_PRECISION

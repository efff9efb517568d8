#pragma once

#include <cstdint>
#include <limits>

#include "../broadphase/broadphase.h"
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
    int subSteps = 0;      ///< 1 … 1024; 0: the profile's
    int relaxPasses = -1;  ///< per sub-step, 0 … 64; −1: the profile's
    ContinuousMode continuous = ContinuousMode::subStep;
    int maxImpacts = 64;   ///< per body and step, at least 1
    Real maxSpeed = std::numeric_limits<Real>::infinity();  ///< m/s, greater than 0
    Real toiTolerance = 0;  ///< metres; 0: a quarter of the target, which is 2⁻¹⁰ of the pair's extent
    bool sleep = true;
    bool measureStageTimes = false;
    BroadphaseKind broadphase = BroadphaseKind::automatic;  ///< may change only while the world is empty
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <optional>

#include "../shapes/vec2.h"
#include "ids.h"

namespace swept::inline SWEPT_PRECISION {

/// Common to all joints. Anchors are world points at the poses the bodies have when the joint is made.
struct JointDef {
    BodyId bodyA{};
    BodyId bodyB{};
    bool collideConnected = false;
    std::optional<Real> breakForce{};   ///< N; the joint breaks when its reaction over a step is larger
    std::optional<Real> breakTorque{};  ///< N·m
    std::uint64_t userData = 0;
};

struct Spring {
    Real hertz = 0;         ///< greater than 0
    Real dampingRatio = 0;  ///< at least 0; 1 is critical
};
struct AngleLimits {
    Real lower = 0;  ///< radians from the initial relative angle
    Real upper = 0;  ///< at least `lower`
};
struct AngularMotor {
    Real speed = 0;      ///< rad/s of B relative to A
    Real maxTorque = 0;  ///< N·m, at least 0
};

/// A hinge. An empty limit, motor or spring does not exist.
struct RevoluteJointDef {
    JointDef base{};
    DVec2 anchor{};
    std::optional<AngleLimits> limits{};
    std::optional<AngularMotor> motor{};
    std::optional<Spring> spring{};  ///< towards the initial relative angle
};

struct LengthLimits {
    Real min = 0;  ///< metres, at least 0
    Real max = 0;  ///< at least `min`; infinity: none
};

/// Rod (neither spring nor limits), rope (limits), spring (spring), or spring within limits.
struct DistanceJointDef {
    JointDef base{};
    DVec2 anchorA{};
    DVec2 anchorB{};
    std::optional<Real> length{};  ///< empty: the initial distance of the anchors; greater than 0
    std::optional<LengthLimits> limits{};
    std::optional<Spring> spring{};
};

}  // namespace swept::inline SWEPT_PRECISION

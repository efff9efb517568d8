#pragma once

#include <cstdint>

#include "../solver/distance_constraint.h"
#include "../solver/revolute_constraint.h"
#include "joint_def.h"

namespace swept::inline SWEPT_PRECISION {

enum class JointKind : std::uint8_t { revolute, distance };

/// A joint between steps: its definition in body frames, and the impulses that warm-start it.
struct Joint {
    JointKind kind = JointKind::revolute;
    JointDef base;
    std::uint32_t bodyA = 0;  ///< slots
    std::uint32_t bodyB = 0;
    Vec2 localAnchorA;        ///< body frames
    Vec2 localAnchorB;
    double referenceAngle = 0;  ///< angle of B minus angle of A at creation
    Real extent = 0;            ///< smaller non-zero extent of the bodies, metres; 0: none
    RevoluteJointDef revolute;
    DistanceJointDef distance;
    Real length = 0;

    RevoluteConstraint revoluteState;  ///< impulses of the last sub-step
    DistanceConstraint distanceState;
    Vec2 reactionForce;                ///< on B in the last sub-step, N
    Real reactionTorque = 0;           ///< on B, N·m
};

}  // namespace swept::inline SWEPT_PRECISION

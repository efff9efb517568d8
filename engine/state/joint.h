#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "../../solver/solver_batch.h"
#include "../joint_def.h"

namespace swept::inline SWEPT_PRECISION {

/// A definition and the constraint of the last step, whose impulses warm-start the next.
template <class JointDefinition, class JointConstraintKind>
struct JointPart {
    using Constraint = JointConstraintKind;
    JointDefinition def;
    Constraint memory;
};
/// That of a hinge is in the joint itself.
struct HingePart {
    using Constraint = RevoluteConstraint;
    RevoluteJointDef def;
};
struct FilterPart {
    FilterJointDef def;
};

/// A joint that calls moved, see driven_joints.h. A move is what one call does; a step takes all moves since the last.
struct DrivenJoint {
    JointId joint{};
    int stepsLeft = 0;  ///< in which it still draws what it holds after it
    /// A move was a yank: farther than a slow body goes in a step, and than limits at a pace carry it. Nobody is pulled
    /// like that, but put elsewhere: the gap is closed at no cost, and that is no work of the joint.
    bool isYank = false;
    bool isPut = false;  ///< one of its bodies was put elsewhere since the last step: a gap that is left is a yank
    /// After a yank some gap was not closed in time: something is in the way. The joint is torn (torn_joints.h), and
    /// stays in the list until it is closed.
    bool isStuck = false;

    // How far, as a length, whatever it is that was moved.
    Real toGo = 0;        ///< all moves since the last step, metres
    Real jump = 0;        ///< the farthest one of these, metres
    Real speed = 0;       ///< the fastest that a step so far had to go what there was to go, m/s
    Real springToGo = 0;  ///< as `toGo`, of the target of its spring
    Real springJump = 0;  ///< as `jump`, likewise

    // What of that are its limits, which way: the lower one and the upper one, or its length and nothing.
    std::array<Real, 2> way{};          ///< since the last step, metres or radians
    std::array<Real, 2> speedBefore{};  ///< what that came to in the step before (from its start on: in this one), by s
    Real lever = 1;                     ///< metres by unit of these
    LimitMotion motion{};               ///< in this step: how they glide, and the pace that both steps have in common
    Real paceSpeed = 0;                 ///< of the faster limit at that pace, m/s; 0: it goes at none
};

/// Impulses with which a hinge begins the next step: those of the last sub-step, N·s and N·m·s.
struct HingeMemory {
    Vec2 point{};
    Real lower = 0;
    Real upper = 0;
    Real motor = 0;
    Real spring = 0;
};

/// A load that a joint carries without giving way (joint_rest.h), on B.
struct JointLoad {
    Vec2 force{};     ///< N, world; of a rod in the direction of the rod, in the first coordinate
    Real torque = 0;  ///< N·m

    bool any() const { return force != Vec2{} || torque != 0; }
};

/// In the order of `JointType`.
using JointParts =
    std::variant<HingePart, JointPart<DistanceJointDef, DistanceConstraint>,
                 JointPart<PrismaticJointDef, PrismaticConstraint>, JointPart<WheelJointDef, WheelConstraint>,
                 JointPart<WeldJointDef, WeldConstraint>, JointPart<MotorJointDef, MotorConstraint>,
                 JointPart<MouseJointDef, MouseConstraint>, JointPart<GearJointDef, GearConstraint>,
                 JointPart<PulleyJointDef, PulleyConstraint>, FilterPart>;
static_assert(std::variant_size_v<JointParts> == static_cast<std::size_t>(JointType::filter) + 1);

inline constexpr std::size_t kMostJointBodies = 4;  ///< a gear's
inline constexpr std::uint32_t kNotDriven = std::numeric_limits<std::uint32_t>::max();

/// A joint between steps: its definition in body frames, and what the last step left.
struct Joint {
    // What each step asks of a hinge comes first and close together: 64 bytes in float, without its spring.
    std::uint32_t bodyA = 0;  ///< slots
    std::uint32_t bodyB = 0;
    double referenceAngle = 0;  ///< angle of B minus angle of A where its own is 0
    Vec2 localAnchorA;          ///< body frames
    Vec2 localAnchorB;
    Vec2 reactionForce;       ///< on B, mean of the last step, N
    Real reactionTorque = 0;  ///< on B, N·m
    HingeMemory hinge;
    JointParts parts;
    Real length = 0;  ///< of a rod or spring, or all of a pulley's rope, metres
    Vec2 localAxis;   ///< unit, in the frame of A; of what has none, any
    Vec2 localAxisB;  ///< the same in the frame of B, as it was made (rest_springs.h)
    std::array<std::uint32_t, kMostJointBodies> bodies{};  ///< all that it ties together: A, B, and a gear's others
    std::size_t bodyCount = 0;
    JointLoad restLoad;
    bool isOff = false;                 ///< it cannot hold: see `canHold`
    std::uint32_t driven = kNotDriven;  ///< place in `WorldState::drivenJoints`, while a call's move of it is noted
    double gearConstant = 0;            ///< metres or radians
    JointDef base;

    JointType type() const { return static_cast<JointType>(parts.index()); }
    bool isFilter() const { return type() == JointType::filter; }
    /// Whether it holds its bodies at all.
    bool holds() const { return !isFilter() && !isOff; }
    /// Whether A and B do not collide with each other.
    bool keepsApart() const { return !base.collideConnected || isFilter(); }
    std::span<const std::uint32_t> allBodies() const { return {bodies.data(), bodyCount}; }
};

/// Calls `visit(part)` unless the joint is a filter.
template <class Parts, class Visit>
void visitPart(Parts& parts, Visit&& visit) {
    std::visit(
        [&](auto& part) {
            if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(part)>, FilterPart>) { visit(part); }
        },
        parts);
}

/// What the step asks of all joints, one after the other, before it looks at any of them: joints are large.
struct JointTie {
    std::uint32_t bodyA = 0;  ///< slots
    std::uint32_t bodyB = 0;
    bool holds : 1 = false;     ///< a joint is there, and `Joint::holds`
    bool isPair : 1 = true;     ///< it ties no other bodies
    bool mayBreak : 1 = false;  ///< it has a limit
    bool isHinge : 1 = false;
    bool isPlain : 1 = false;           ///< holds what it holds rigidly, and does nothing else
    bool isSoft : 1 = false;            ///< a rod or a weld that holds nothing rigidly
    bool hasDrives : 1 = false;         ///< drives what it leaves free: see `DirectScope::islandsWithDrives`
    bool isPassive : 1 = false;         ///< does nothing that gives energy, but for what its springs held
    bool isPowered : 1 = false;         ///< does what takes or gives energy: what it holds keeps none
    bool holdsAngle : 1 = false;        ///< of its bodies to each other, rigidly
    bool isSprung : 1 = false;          ///< passive, with a spring
    bool drivesAngleAlone : 1 = false;  ///< a motor joint that drives no point
    bool hasRestLoad : 1 = false;       ///< `Joint::restLoad`
    bool pushesInside : 1 = false;      ///< nothing but its two bodies, away from each other
    HingeParts hingeParts;              ///< of a hinge

    bool operator==(const JointTie&) const = default;
};
static_assert(sizeof(JointTie) == 12);

}  // namespace swept::inline SWEPT_PRECISION

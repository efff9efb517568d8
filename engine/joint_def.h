#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "../shapes/vec2.h"
#include "ids.h"

namespace swept {

enum class JointType : std::uint8_t {
    revolute,
    distance,
    prismatic,
    wheel,
    weld,
    motor,
    mouse,
    gear,
    pulley,
    filter,
};

}  // namespace swept

namespace swept::inline SWEPT_PRECISION {

/// Common to all joints. Anchors are world points, axes world directions, at the poses the bodies have when the joint
/// is made. An empty limit, motor or spring does not exist.
///
/// A joint need not be made where it holds. Its `anchor` is a point of A and B, or of A alone: then `anchorB` is the
/// point of B that belongs there. Its angle, from which limits, springs and drives count, is 0 where it is made, or
/// where B is turned by `referenceAngle` more than A. So bodies may begin anywhere on the way that a joint leaves them,
/// such as a door half open. What is apart is drawn together within some steps, which leaves no speed. Where a joint
/// is made, or its bodies are enabled again, its angle is taken to within half a turn of where it holds or drives them,
/// or of its nearest limit: whole turns are not wound back. From then on every turn counts: a target that goes on from
/// π to −π takes B a turn back.
struct JointDef {
    BodyId bodyA{};
    BodyId bodyB{};
    bool collideConnected = false;  ///< whether the two bodies collide; sensors of either see the other all the same
    /// N, above 0; the joint breaks when its mean reaction over a step is larger.
    std::optional<Real> breakForce{};
    std::optional<Real> breakTorque{};  ///< N·m, above 0; likewise
    std::uint64_t userData = 0;
};

/// Undamped it keeps its amplitude while a sub-step is less than 1/25 of its period; what is stiffer is damped by as
/// much as a stable step needs. Its stiffness is the one with which it swings at `hertz` at the poses that the bodies
/// have when the joint is made (with a `referenceAngle`: with B turned to there), with the masses that they have now:
/// it does not change as they turn. Two kinds swing at `hertz` at every pose instead, so that their stiffness varies:
/// that of a mouse joint; and that of an angle between two dynamic bodies whose anchors are held together (a hinge; a
/// weld without a linear spring).
struct Spring {
    Real hertz = 0;         ///< greater than 0; of the two bodies alone, held by nothing but this joint
    Real dampingRatio = 0;  ///< at least 0; 1 is critical

    bool operator==(const Spring&) const = default;
};
struct AngleLimits {
    Real lower = 0;  ///< radians of the joint's angle
    Real upper = 0;  ///< at least `lower`

    bool operator==(const AngleLimits&) const = default;
};
/// A motor, angular or linear, that moves its body by less than a thousandth of the body's size in 4·√(size / g) counts
/// as resting: the body falls asleep, and the motor stops. Not so kinematic bodies, nor where `WorldSettings::sleep` is
/// off.
struct AngularMotor {
    Real speed = 0;      ///< rad/s of B relative to A
    Real maxTorque = 0;  ///< N·m, at least 0

    bool operator==(const AngularMotor&) const = default;
};

struct TranslationLimits {
    Real lower = 0;  ///< metres of B's anchor from A's, along the axis
    Real upper = 0;  ///< at least `lower`

    bool operator==(const TranslationLimits&) const = default;
};
struct LinearMotor {
    Real speed = 0;     ///< m/s of B relative to A, along the axis
    Real maxForce = 0;  ///< N, at least 0

    bool operator==(const LinearMotor&) const = default;
};

/// A hinge.
struct RevoluteJointDef {
    JointDef base{};
    DVec2 anchor{};
    std::optional<AngleLimits> limits{};
    std::optional<AngularMotor> motor{};
    std::optional<Spring> spring{};
    Real springTarget = 0;                   ///< rad of the joint's angle: where the spring pulls to
    std::optional<DVec2> anchorB{};          ///< of B; empty: `anchor`
    std::optional<double> referenceAngle{};  ///< rad of B beyond A; empty: the present one
};

struct LengthLimits {
    Real min = 0;  ///< metres, at least 0
    Real max = 0;  ///< at least `min`; infinity: none

    bool operator==(const LengthLimits&) const = default;
};

/// Rod (neither spring nor limits), rope (limits), spring (spring), or spring within limits.
struct DistanceJointDef {
    JointDef base{};
    DVec2 anchorA{};
    DVec2 anchorB{};
    std::optional<Real> length{};  ///< empty: the initial distance of the anchors; greater than 0, of a rope at least 0
    std::optional<LengthLimits> limits{};
    std::optional<Spring> spring{};
};

/// B slides along an axis fixed in A, and does not turn relative to A.
struct PrismaticJointDef {
    JointDef base{};
    DVec2 anchor{};
    DVec2 axis{1, 0};  ///< of any length greater than 0
    std::optional<TranslationLimits> limits{};
    std::optional<LinearMotor> motor{};
    std::optional<Spring> spring{};
    Real springTarget = 0;           ///< metres of B's anchor from A's, along the axis: where the spring pulls to
    std::optional<DVec2> anchorB{};  ///< of B; empty: `anchor`. It may be anywhere on the axis
    std::optional<double> referenceAngle{};  ///< rad of B beyond A, which it keeps; empty: the present one
};

/// A wheel (B) on a suspension: its anchor slides along an axis fixed in A, and it turns freely or by its motor.
struct WheelJointDef {
    JointDef base{};
    DVec2 anchor{};
    DVec2 axis{0, 1};  ///< of any length greater than 0
    std::optional<TranslationLimits> limits{};
    std::optional<AngularMotor> motor{};
    std::optional<Spring> spring{};          ///< along the axis; empty: none, the wheel slides freely
    Real springTarget = 0;                   ///< as of a prismatic joint
    std::optional<DVec2> anchorB{};          ///< of B; empty: `anchor`. It may be anywhere on the axis
    std::optional<double> referenceAngle{};  ///< rad of B beyond A; empty: the present one
};

/// Two bodies as one; where a spring is given, held by that spring. The linear one and the angular one do not know of
/// each other: where both are given, each has the hertz it has with the other at rest only for anchors at the centres
/// of mass.
struct WeldJointDef {
    JointDef base{};
    DVec2 anchor{};
    std::optional<Spring> linearSpring{};    ///< empty: rigid
    std::optional<Spring> angularSpring{};   ///< empty: rigid
    std::optional<DVec2> anchorB{};          ///< of B; empty: `anchor`
    std::optional<double> referenceAngle{};  ///< rad of B beyond A, which it keeps; empty: the present one
};

/// Where, or how fast, a motor joint drives B relative to A. A pose is approached so that the motor can stop there. (In
/// profile `fast`, and in touch with others, it gives way a little under a load where other joints hold its bodies,
/// too.) Without any strength it drives nothing (the scene format refuses that).
struct MotorDrive {
    std::optional<Vec2>
        linearOffset{};  ///< of B's origin in the frame of A, metres; empty: as it was when the joint was made
    std::optional<Vec2> linearVelocity{};   ///< of B's origin in the frame of A, m/s; then there is no offset
    std::optional<Real> angularOffset{};    ///< rad of the joint's angle; empty: 0
    std::optional<Real> angularVelocity{};  ///< of B relative to A, rad/s; then there is no offset
    std::optional<Real> maxForce{};         ///< N, at least 0; empty: no linear drive
    std::optional<Real> maxTorque{};        ///< N·m, at least 0; empty: no angular drive

    bool operator==(const MotorDrive&) const = default;
};
struct MotorJointDef {
    JointDef base{};
    MotorDrive drive{};
    std::optional<double> referenceAngle{};  ///< rad of B beyond A; empty: the present one
};

/// Pulls a point of B to a target in the world; nothing pulls at A, which may be any body: the level, say (one that is
/// dynamic is awake as long as B is). The two collide as if there were no joint, whatever `collideConnected` says. B
/// must be dynamic. A target that is set elsewhere moves there within the next step, and what it drags gets its speed;
/// by a spring it follows 2ζv/ω behind. A spring that holds B off its centre may add energy unless it is damped
/// (LIMITS.md).
struct MouseJointDef {
    JointDef base{};
    DVec2 target{};
    std::optional<DVec2> anchor{};   ///< the point of B that is pulled; empty: the one at the target
    std::optional<Spring> spring{};  ///< empty: rigid
    std::optional<Real> maxForce{};  ///< N, at least 0; empty: unlimited
};

/// Couples two revolute or prismatic joints: coordinate of A + ratio · coordinate of B is constant (radians, metres).
/// Its bodies are those that the joints move, their B; `bodyA`, `bodyB` of `base` are filled in. Goes when either joint
/// goes.
struct GearJointDef {
    JointDef base{};
    JointId jointA{};
    JointId jointB{};
    Real ratio = 1;  ///< not 0
};

/// A rope from A over two fixed wheels to B: the length on A's side + ratio · the length on B's side is at most its
/// `length`. It pulls and never pushes. Another ratio (`World::redefine`) changes the length by as much as the sum, so
/// that slack and stretch stay as they are, and is refused where a stretched rope would have no length left.
struct PulleyJointDef {
    JointDef base{};
    DVec2 groundA{};  ///< the wheels, world points
    DVec2 groundB{};
    DVec2 anchorA{};
    DVec2 anchorB{};
    Real ratio = 1;                ///< greater than 0
    std::optional<Real> length{};  ///< metres, greater than 0; empty: the present sum
};

/// Keeps two bodies from colliding with each other, and does nothing else: it ignores `collideConnected`, and bears no
/// force, so that it never breaks (the scene format refuses these members of a filter).
struct FilterJointDef {
    JointDef base{};
};

/// Any of them, in the order of `JointType`.
using AnyJointDef = std::variant<RevoluteJointDef, DistanceJointDef, PrismaticJointDef, WheelJointDef, WeldJointDef,
                                 MotorJointDef, MouseJointDef, GearJointDef, PulleyJointDef, FilterJointDef>;

}  // namespace swept::inline SWEPT_PRECISION

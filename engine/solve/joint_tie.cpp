#include "joint_tie.h"

#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Whether a joint holds what it holds rigidly, and does nothing else.
struct PlainJoints {
    bool operator()(const HingePart& part) const { return isFree(part.def); }
    bool operator()(const JointPart<PrismaticJointDef, PrismaticConstraint>& part) const { return isFree(part.def); }
    bool operator()(const JointPart<WheelJointDef, WheelConstraint>& part) const { return isFree(part.def); }
    bool operator()(const JointPart<DistanceJointDef, DistanceConstraint>& part) const {
        return !part.def.spring && !part.def.limits;
    }
    bool operator()(const JointPart<WeldJointDef, WeldConstraint>& part) const {
        return !part.def.linearSpring && !part.def.angularSpring;
    }
    template <class Part>
    bool operator()(const Part&) const {
        return false;
    }

private:
    template <class Def>
    static bool isFree(const Def& def) {
        return !def.spring && !def.limits && !def.motor;
    }
};
bool isPlain(const Joint& joint) { return std::visit(PlainJoints{}, joint.parts); }

/// Whether a rod or a weld holds nothing rigidly.
struct SoftJoints {
    bool operator()(const JointPart<DistanceJointDef, DistanceConstraint>& part) const {
        return part.def.spring || part.def.limits;
    }
    bool operator()(const JointPart<WeldJointDef, WeldConstraint>& part) const {
        return part.def.linearSpring && part.def.angularSpring;
    }
    template <class Part>
    bool operator()(const Part&) const {
        return false;
    }
};
bool isSoft(const Joint& joint) { return std::visit(SoftJoints{}, joint.parts); }

bool hasDrives(const Joint& joint) {
    const auto* const weld = std::get_if<JointPart<WeldJointDef, WeldConstraint>>(&joint.parts);
    if (weld != nullptr) { return weld->def.angularSpring && !weld->def.linearSpring; }
    const JointType type = joint.type();
    const bool mayBe = type == JointType::revolute || type == JointType::prismatic || type == JointType::wheel;
    return mayBe && !isPlain(joint);
}

/// Whether a hinge, slider, wheel or rod has a motor or a spring: what it holds keeps no energy.
struct PoweredJoints {
    template <class Part>
    bool operator()(const Part& part) const {
        bool isPowered = false;
        if constexpr (requires { part.def.motor.has_value(); }) { isPowered = part.def.motor.has_value(); }
        if constexpr (requires { part.def.spring.has_value(); }) { isPowered |= part.def.spring.has_value(); }
        return isPowered;
    }
};
/// Whether a joint gives no energy but what its springs held: no motor, nor what follows a target.
struct PassiveJoints {
    bool operator()(const JointPart<MotorJointDef, MotorConstraint>&) const { return false; }
    bool operator()(const JointPart<MouseJointDef, MouseConstraint>&) const { return false; }
    template <class Part>
    bool operator()(const Part& part) const {
        if constexpr (requires { part.def.motor.has_value(); }) { return !part.def.motor.has_value(); }
        return true;
    }
};
bool isPassive(const Joint& joint) { return std::visit(PassiveJoints{}, joint.parts); }

/// Whether a joint keeps its bodies from turning against each other.
struct AngleJoints {
    bool operator()(const JointPart<PrismaticJointDef, PrismaticConstraint>&) const { return true; }
    bool operator()(const JointPart<WeldJointDef, WeldConstraint>& part) const { return !part.def.angularSpring; }
    template <class Part>
    bool operator()(const Part&) const {
        return false;
    }
};
/// Whether it has a spring, and is passive.
struct SprungJoints {
    bool operator()(const JointPart<WeldJointDef, WeldConstraint>& part) const {
        return part.def.linearSpring || part.def.angularSpring;
    }
    template <class Part>
    bool operator()(const Part& part) const {
        if constexpr (requires { part.def.spring.has_value(); }) { return part.def.spring && PassiveJoints{}(part); }
        return false;
    }
};
bool isSprung(const Joint& joint) { return std::visit(SprungJoints{}, joint.parts); }

bool holdsAngle(const Joint& joint) { return std::visit(AngleJoints{}, joint.parts); }

/// Whether it pushes at nothing but its two bodies, and at both alike.
struct InnerJoints {
    bool operator()(const JointPart<MouseJointDef, MouseConstraint>&) const { return false; }
    bool operator()(const JointPart<GearJointDef, GearConstraint>&) const { return false; }
    bool operator()(const JointPart<PulleyJointDef, PulleyConstraint>&) const { return false; }
    template <class Part>
    bool operator()(const Part&) const {
        return true;
    }
};
bool pushesInside(const Joint& joint) { return std::visit(InnerJoints{}, joint.parts); }

bool isPowered(const Joint& joint) { return std::visit(PoweredJoints{}, joint.parts); }

HingeParts hingePartsOf(const RevoluteJointDef& def) {
    return {
        .hasSpring = def.spring.has_value(), .hasMotor = def.motor.has_value(), .hasLimits = def.limits.has_value()};
}

}  // namespace

JointTie tieOf(const Joint& joint) {
    const auto* const hinge = std::get_if<HingePart>(&joint.parts);
    const auto* const motor = std::get_if<JointPart<MotorJointDef, MotorConstraint>>(&joint.parts);
    return {.bodyA = joint.bodyA,
            .bodyB = joint.bodyB,
            .holds = joint.holds(),
            .isPair = joint.bodyCount <= 2,
            .mayBreak = joint.base.breakForce || joint.base.breakTorque,
            .isHinge = hinge != nullptr,
            .isPlain = isPlain(joint),
            .isSoft = isSoft(joint),
            .hasDrives = hasDrives(joint),
            .isPassive = isPassive(joint),
            .isPowered = isPowered(joint),
            .holdsAngle = holdsAngle(joint),
            .isSprung = isSprung(joint),
            .drivesAngleAlone = motor != nullptr && !motor->def.drive.maxForce,
            .hasRestLoad = joint.restLoad.any(),
            .pushesInside = pushesInside(joint),
            .hingeParts = hinge != nullptr ? hingePartsOf(hinge->def) : HingeParts{}};
}

}  // namespace swept::inline SWEPT_PRECISION

#include "joint_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "../bodies/body_joints.h"
#include "../state/profile.h"
#include "driven_joints.h"
#include "joint_place.h"
#include "joint_rest.h"
#include "motor_stop.h"
#include "rest_springs.h"
#include "step_change.h"
#include "torn_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Part of the way to its pose that a motor joint covers in a step, as far as its force allows.
constexpr Real kApproachRatio = Real(0.3);

template <class Def>
void fillLimits(FreedomParts& parts, const Def& def) {
    parts.hasLimits = def.limits.has_value();
    parts.isGliding = false;
    if (!def.limits) { return; }
    parts.lower = def.limits->lower - springTargetOf(def);
    parts.upper = def.limits->upper - springTargetOf(def);
}
void fillSpring(FreedomParts& parts, const std::optional<Spring>& spring, Real h) {
    parts.hasSpring = spring.has_value();
    if (spring) { parts.spring = gainsOf(*spring, h); }
}
/// Also of a `WheelConstraint`, whose motor has members of the same names.
template <class Parts, class Motor>
void fillMotor(Parts& parts, const std::optional<Motor>& motor, Real maxImpulse) {
    parts.hasMotor = motor.has_value();
    parts.maxMotorImpulse = maxImpulse;
    if (motor) { parts.motorSpeed = motor->speed; }
}
void fillFreedom(FreedomParts& parts, const RevoluteJointDef& def, Real h) {
    fillLimits(parts, def);
    fillMotor(parts, def.motor, h * (def.motor ? def.motor->maxTorque : Real(0)));
    fillSpring(parts, def.spring, h);
}

/// A constraint with the impulses of the last step.
template <class Part>
auto rememberedOf(const Joint&, const Part& part) {
    return part.memory;
}
RevoluteConstraint rememberedOf(const Joint& joint, const HingePart&) {
    RevoluteConstraint constraint;
    constraint.linearImpulse = joint.hinge.point;
    constraint.lowerImpulse = joint.hinge.lower;
    constraint.upperImpulse = joint.hinge.upper;
    constraint.motorImpulse = joint.hinge.motor;
    constraint.springImpulse = joint.hinge.spring;
    return constraint;
}

/// Fills constraints in from the present state. The impulses stay what they are.
struct ConstraintFiller {
    const WorldState& world;
    const Joint& joint;
    Real h;
    Real dt;
    Real length;  ///< of the solve, s

    SpringGains gainsOf(const Spring& spring) const { return swept::gainsOf(spring, h); }
    Real baseAngle() const { return static_cast<Real>(angleOf(world, joint)); }

    void fillSpring(FreedomParts& parts, const std::optional<Spring>& spring) const {
        swept::fillSpring(parts, spring, h);
    }
    /// Any point of its axis may be A's anchor: forces act at that of B. @pre the axis is filled in
    template <class Constraint, class Def>
    void shiftToTarget(Constraint& constraint, const Def& def) const {
        if (const Real target = springTargetOf(def); target != 0) { constraint.anchorA += target * constraint.axis; }
    }
    template <class Parts, class Motor>
    void fillMotor(Parts& parts, const std::optional<Motor>& motor, Real strength) const {
        swept::fillMotor(parts, motor, h * strength);
    }

    void operator()(RevoluteConstraint& constraint, const RevoluteJointDef& def) const {
        constraint.baseAngle = baseAngle() - springTargetOf(def);
        fillFreedom(constraint, def, h);
        endAtLimits(constraint, constraint.baseAngle, length);
    }
    void operator()(DistanceConstraint& constraint, const DistanceJointDef& def) const {
        constraint.length = joint.length;
        constraint.hasSpring = def.spring.has_value();
        if (def.spring) { constraint.spring = rodSpringOf(world, joint, *def.spring, h); }
        constraint.hasLimits = def.limits.has_value();
        constraint.isGliding = false;
        if (def.limits) {
            constraint.minLength = def.limits->min;
            constraint.maxLength = def.limits->max;
        }
        constraint.isRigid = !constraint.hasSpring && !constraint.hasLimits;
    }
    void operator()(PrismaticConstraint& constraint, const PrismaticJointDef& def) const {
        constraint.axis = axisOf(world, joint);
        constraint.baseAngle = baseAngle();
        shiftToTarget(constraint, def);
        fillLimits(constraint, def);
        fillMotor(constraint, def.motor, def.motor ? def.motor->maxForce : Real(0));
        fillSpring(constraint, def.spring);
        endAtLimits(constraint, translationOf(world, joint) - springTargetOf(def), length);
    }
    void operator()(WheelConstraint& constraint, const WheelJointDef& def) const {
        constraint.axis = axisOf(world, joint);
        shiftToTarget(constraint, def);
        fillLimits(constraint.suspension, def);
        fillMotor(constraint, def.motor, def.motor ? def.motor->maxTorque : Real(0));
        constraint.suspension.hasSpring = def.spring.has_value();
        if (def.spring) { constraint.spring = wheelSpringOf(world, joint, *def.spring, h); }
    }
    /// Of the bodies the one that a push at its anchor turns more. @return slot
    std::uint32_t easilyTurned(const WeldConstraint& constraint) const {
        const Real a = world.bodies[joint.bodyA].inverseInertia * lengthSquared(constraint.anchorA);
        const Real b = world.bodies[joint.bodyB].inverseInertia * lengthSquared(constraint.anchorB);
        return a > b ? joint.bodyA : joint.bodyB;
    }
    void operator()(WeldConstraint& constraint, const WeldJointDef& def) const {
        constraint.baseAngle = baseAngle();
        constraint.hasLinearSpring = def.linearSpring.has_value();
        if (def.linearSpring) {
            constraint.linearSpring = pointSpringOf(world, joint, *def.linearSpring, h, !def.angularSpring,
                                                    world.motions[joint.bodyA].pose.rotation);
            constraint.isLinked = world.bodies[easilyTurned(constraint)].holdingJoints > 1;
        }
        constraint.hasAngularSpring = def.angularSpring.has_value();
        if (def.angularSpring) { constraint.angularSpring = gainsOf(*def.angularSpring); }
    }
    void operator()(MotorConstraint& constraint, const MotorJointDef& def) const {
        const MotorDrive& drive = def.drive;
        constraint.approachRate = kApproachRatio / dt;
        const auto isHeldElsewhere = [this](std::uint32_t slot) {
            return world.bodies[slot].isDynamic() && world.bodies[slot].holdingJoints > 1;
        };
        const Softness& weld = constraint.softness;
        const bool isTied = isHeldElsewhere(joint.bodyA) || isHeldElsewhere(joint.bodyB);
        constraint.ease =
            isTied ? kDriveGive * (constraint.approachRate / weld.biasRate) * (weld.impulseScale / weld.massScale)
                   : Real(0);
        constraint.drivesLine = drive.maxForce.has_value();
        constraint.maxLinearImpulse = h * drive.maxForce.value_or(0);
        constraint.seeksPlace = !drive.linearVelocity.has_value();
        if (drive.linearVelocity) {
            constraint.velocity = rotate(world.motions[joint.bodyA].pose.rotation, *drive.linearVelocity);
            constraint.anchorA = constraint.centerOffset + constraint.anchorB;
        } else {
            constraint.anchorA = armOf(world, joint.bodyA, drive.linearOffset.value_or(joint.localAnchorA));
        }
        constraint.drivesAngle = drive.maxTorque.has_value();
        constraint.maxAngularImpulse = h * drive.maxTorque.value_or(0);
        constraint.seeksAngle = !drive.angularVelocity.has_value();
        constraint.spin = drive.angularVelocity.value_or(0);
        constraint.baseAngle =
            static_cast<Real>(angleOf(world, joint) - static_cast<double>(drive.angularOffset.value_or(0)));
        fillHinge(constraint.hinge, drive.maxTorque.has_value());
    }
    void fillHinge(HingeBeside& hinge, bool isTurned) const {
        hinge.isThere = false;
        if (!isTurned) { return; }
        // Many joints may hang on what is not dynamic.
        for (const std::uint32_t other : world.bodies[heldBodyOf(world, joint)].joints) {
            const JointTie& tie = world.jointTies[other];
            const bool isSame = tie.bodyA == joint.bodyA && tie.bodyB == joint.bodyB;
            const bool isReversed = tie.bodyA == joint.bodyB && tie.bodyB == joint.bodyA;
            if (!tie.isHinge || !tie.holds || !(isSame || isReversed)) { continue; }
            const Joint& found = world.joints[other];
            hinge.isThere = true;
            hinge.isReversed = isReversed;
            hinge.source = other;
            hinge.armA = armOf(world, joint.bodyA, isReversed ? found.localAnchorB : found.localAnchorA);
            hinge.armB = armOf(world, joint.bodyB, isReversed ? found.localAnchorA : found.localAnchorB);
            return;
        }
    }
    void operator()(MouseConstraint& constraint, const MouseJointDef& def) const {
        constraint.slotA = kFixedSlot;
        constraint.anchorA = {};
        constraint.centerOffset = toReal(world.motions[joint.bodyB].center - (def.target - toDouble(constraint.toGo)));
        constraint.gone = {};
        constraint.hasSpring = def.spring.has_value();
        if (def.spring) { constraint.spring = gainsOf(*def.spring); }
        constraint.approachRate = kApproachRatio / dt;
        constraint.maxImpulse = def.maxForce ? h * *def.maxForce : std::numeric_limits<Real>::infinity();
    }
    void fillSide(GearSide& side, const Joint& geared) const {
        side.slotA = world.solverSlots[geared.bodyA];
        side.slotB = world.solverSlots[geared.bodyB];
        side.slides = geared.type() == JointType::prismatic;
        side.axis = axisOf(world, geared);
        side.anchorA = armOf(world, geared.bodyA, geared.localAnchorA);
        side.anchorB = armOf(world, geared.bodyB, geared.localAnchorB);
        side.centerOffset = centerOffset(world, geared);
    }
    void operator()(GearConstraint& constraint, const GearJointDef& def) const {
        const Joint& first = world.joints[def.jointA.index];
        const Joint& second = world.joints[def.jointB.index];
        fillSide(constraint.first, first);
        fillSide(constraint.second, second);
        constraint.ratio = def.ratio;
        constraint.baseError = gearError(def);
    }
    void operator()(PulleyConstraint& constraint, const PulleyJointDef& def) const {
        constraint.offsetA = toReal(world.motions[joint.bodyA].center - def.groundA);
        constraint.offsetB = toReal(world.motions[joint.bodyB].center - def.groundB);
        constraint.ratio = def.ratio;
        constraint.totalLength = joint.length;
    }

    Real gearError(const GearJointDef& def) const {
        const double first = coordinateOf(world, world.joints[def.jointA.index]);
        const double second = coordinateOf(world, world.joints[def.jointB.index]);
        return static_cast<Real>(first + static_cast<double>(def.ratio) * second - joint.gearConstant);
    }

    template <class Part>
    typename Part::Constraint constraintOf(const Part& part) const {
        auto constraint = rememberedOf(joint, part);
        fill(constraint, part);
        return constraint;
    }
    template <class Part>
    void fill(typename Part::Constraint& constraint, const Part& part) const {
        constraint.isHeld = constraint.isDriveHeld = false;
        constraint.slotA = world.solverSlots[joint.bodyA];
        constraint.slotB = world.solverSlots[joint.bodyB];
        constraint.anchorA = armOf(world, joint.bodyA, joint.localAnchorA);
        constraint.anchorB = armOf(world, joint.bodyB, joint.localAnchorB);
        constraint.centerOffset = centerOffset(world, joint);
        constraint.softness = jointSoftness(world, world.bodies[heldBodyOf(world, joint)].effort, h, dt);
        (*this)(constraint, part.def);
        if (std::is_same_v<typename Part::Constraint, MouseConstraint> || mayTear(world, joint)) {
            ease(constraint, part);
        }
    }
    template <class Part>
    void ease(typename Part::Constraint& constraint, const Part& part) const;
};

constexpr BodyState kStill{};

/// Errors by kind, at the start of a step.
struct ErrorReader {
    const ConstraintFiller& filler;

    JointErrors operator()(const RevoluteConstraint& c, const RevoluteJointDef&) const {
        return {anchorGap(c, kStill, kStill), 0};
    }
    JointErrors operator()(const DistanceConstraint& c, const DistanceJointDef&) const {
        return {lengthError(c, kStill, kStill), 0};
    }
    JointErrors operator()(const PrismaticConstraint& c, const PrismaticJointDef&) const {
        return {axisGap(c, kStill, kStill), std::fabs(c.baseAngle)};
    }
    JointErrors operator()(const WheelConstraint& c, const WheelJointDef&) const {
        return {axisGap(c, kStill, kStill), 0};
    }
    JointErrors operator()(const WeldConstraint& c, const WeldJointDef&) const {
        return {c.hasLinearSpring ? Real(0) : anchorGap(c, kStill, kStill),
                c.hasAngularSpring ? Real(0) : std::fabs(c.baseAngle)};
    }
    JointErrors operator()(const MotorConstraint&, const MotorJointDef&) const { return {}; }
    JointErrors operator()(const MouseConstraint& c, const MouseJointDef&) const {
        return {c.hasSpring ? Real(0) : anchorGap(c, kStill, kStill), 0};
    }
    JointErrors operator()(const GearConstraint& c, const GearJointDef&) const {
        const Real error = std::fabs(c.baseError);
        return c.first.slides ? JointErrors{error, 0} : JointErrors{0, error};
    }
    JointErrors operator()(const PulleyConstraint& c, const PulleyJointDef&) const {
        return {std::max(ropeLength(c, kStill, kStill) - c.totalLength, Real(0)), 0};
    }
};

/// Where it may not hold.
template <class Part>
void ConstraintFiller::ease(typename Part::Constraint& constraint, const Part& part) const {
    const JointErrors held = ErrorReader{*this}(constraint, part.def);
    const JointErrors limits = limitErrorsOf(world, joint);
    constraint.softness = easedOf(constraint.softness, world, joint,
                                  {std::max(held.length, limits.length), std::max(held.angle, limits.angle)});
}

RevoluteConstraint& append(SolverBatch& batch, const RevoluteConstraint& c) { return batch.revolutes.emplace_back(c); }
DistanceConstraint& append(SolverBatch& batch, const DistanceConstraint& c) { return batch.distances.emplace_back(c); }
PrismaticConstraint& append(SolverBatch& batch, const PrismaticConstraint& c) {
    return batch.prismatics.emplace_back(c);
}
WheelConstraint& append(SolverBatch& batch, const WheelConstraint& c) { return batch.wheels.emplace_back(c); }
WeldConstraint& append(SolverBatch& batch, const WeldConstraint& c) { return batch.welds.emplace_back(c); }
MotorConstraint& append(SolverBatch& batch, const MotorConstraint& c) { return batch.motors.emplace_back(c); }
MouseConstraint& append(SolverBatch& batch, const MouseConstraint& c) { return batch.mice.emplace_back(c); }
GearConstraint& append(SolverBatch& batch, const GearConstraint& c) { return batch.gears.emplace_back(c); }
PulleyConstraint& append(SolverBatch& batch, const PulleyConstraint& c) { return batch.pulleys.emplace_back(c); }

/// Limits that move are where they come from. @return false where they would come from beyond each other
/// @param left  of the step, s
bool setOut(Real& lower, Real& upper, const LimitPace& glide, Real left) {
    const Real lowerBefore = lower - left * glide.lower;
    const Real upperBefore = upper - left * glide.upper;
    if (!(lowerBefore <= upperBefore)) { return false; }
    lower = lowerBefore;
    upper = upperBefore;
    return true;
}
void setOut(FreedomParts& parts, const LimitMotion& motion, Real left) {
    parts.isGliding = parts.hasLimits && setOut(parts.lower, parts.upper, motion.glide, left);
    parts.motion = motion;
}
void setOut(WheelConstraint& constraint, const LimitMotion& motion, Real left) {
    setOut(constraint.suspension, motion, left);
}
void setOut(DistanceConstraint& constraint, const LimitMotion& motion, Real left) {
    const bool isLimited = constraint.hasLimits;
    const bool glides = isLimited && setOut(constraint.minLength, constraint.maxLength, motion.glide, left);
    constraint.isGliding = constraint.isRigid || glides;
    if (constraint.isRigid) { constraint.length -= left * motion.glide.lower; }
    constraint.motion = motion;
}

bool isIterated(const WorldState& world, const Joint& joint) {
    return world.bodies[heldBodyOf(world, joint)].effort.direct == DirectScope::none;
}

}  // namespace

void addConstraint(SolverBatch& batch, const WorldState& world, std::uint32_t source, const SolveTimes& times) {
    const Joint& joint = world.joints[source];
    const ConstraintFiller filler{world, joint, times.h, times.dt, times.length};
    visitPart(joint.parts, [&](const auto& part) {
        // Where it stays: a copy of what was just written in parts has to wait for all of them.
        auto& constraint = append(batch, rememberedOf(joint, part));
        filler.fill(constraint, part);
        constraint.woundSpeed = 0;
        constraint.source = source;
        if (world.anyRestLoads && isIterated(world, joint)) { bear(constraint, world, joint, times.h); }
        if (const DrivenJoint* const driven = drivenOf(world, joint)) {
            constraint.woundSpeed = woundSpeed(*driven);
            if constexpr (requires { setOut(constraint, driven->motion, times.left); }) {
                if (driven->motion.glide.any()) { setOut(constraint, driven->motion, times.left); }
            }
        }
    });
}

RevoluteConstraint hingeConstraint(const WorldState& world, std::uint32_t source, const SolveTimes& times) {
    const Joint& joint = world.joints[source];
    const auto& part = *std::get_if<HingePart>(&joint.parts);
    const ConstraintFiller filler{world, joint, times.h, times.dt, times.length};
    RevoluteConstraint constraint = filler.constraintOf(part);
    if (const DrivenJoint* const driven = drivenOf(world, joint)) {
        if (driven->motion.glide.any()) { setOut(constraint, driven->motion, times.left); }
    }
    constraint.source = source;
    return constraint;
}

FreedomParts hingeParts(const Joint& joint, Real angle, const SolveTimes& times) {
    const auto& part = *std::get_if<HingePart>(&joint.parts);
    FreedomParts parts = rememberedOf(joint, part);
    fillFreedom(parts, part.def, times.h);
    endAtLimits(parts, angle, times.length);
    dropUnused(parts);
    return parts;
}

Softness jointSoftness(const WorldState& world, Effort effort, Real h, Real dt) {
    return softnessOfStep(world, effort, kJointCycles, kJointDampingRatio, h, dt);
}

JointErrors errorsOf(const WorldState& world, const Joint& joint) {
    constexpr Real kAnyStep = 1;  // the errors do not depend on it
    const ConstraintFiller filler{world, joint, kAnyStep, kAnyStep, kAnyStep};
    JointErrors errors;
    visitPart(joint.parts,
              [&](const auto& part) { errors = ErrorReader{filler}(filler.constraintOf(part), part.def); });
    return errors;
}

}  // namespace swept::inline SWEPT_PRECISION

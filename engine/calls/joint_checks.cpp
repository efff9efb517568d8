#include "joint_checks.h"

#include "../state/number_range.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Status checkFinite(Real number, const char* field) {
    return isFinite(number) ? Status::success() : Status{StatusCode::notFinite, field};
}

Status checkBreak(const std::optional<Real>& limit, const char* field) {
    if (!limit) { return Status::success(); }
    if (!isFinite(*limit)) { return {StatusCode::notFinite, field}; }
    if (*limit <= 0) { return {StatusCode::notPositive, field}; }
    return Status::success();
}

template <class Limits>
Status checkOrder(const std::optional<Limits>& limits) {
    if (!limits) { return Status::success(); }
    const Status finite = firstFault({checkFinite(limits->lower, "lower"), checkFinite(limits->upper, "upper")});
    if (!finite.ok()) { return finite; }
    return limits->lower > limits->upper ? Status{StatusCode::outOfRange, "upper"} : Status::success();
}

template <class Def>
Status checkGuided(const Def& def) {
    return firstFault({checkLimits(def.limits), checkMotor(def.motor), checkSpring(def.spring),
                       checkNumber(static_cast<double>(def.springTarget), "springTarget")});
}

}  // namespace

Status checkBreakLimits(const std::optional<Real>& force, const std::optional<Real>& torque) {
    return firstFault({checkBreak(force, "breakForce"), checkBreak(torque, "breakTorque")});
}

Status checkBase(const WorldState& world, const JointDef& def) {
    if (!world.bodies.isValid(def.bodyA)) { return {StatusCode::staleId, "bodyA"}; }
    if (!world.bodies.isValid(def.bodyB)) { return {StatusCode::staleId, "bodyB"}; }
    if (def.bodyA == def.bodyB) { return {StatusCode::notDistinct, "bodyB"}; }
    const bool anyDynamic = world.bodies[def.bodyA.index].isDynamic() || world.bodies[def.bodyB.index].isDynamic();
    if (!anyDynamic) { return {StatusCode::wrongBodyType, "bodyB"}; }
    return checkBreakLimits(def.breakForce, def.breakTorque);
}

Status checkSpring(const std::optional<Spring>& spring) {
    if (!spring) { return Status::success(); }
    if (!isFinite(spring->hertz)) { return {StatusCode::notFinite, "hertz"}; }
    if (!isFinite(spring->dampingRatio)) { return {StatusCode::notFinite, "dampingRatio"}; }
    if (spring->hertz <= 0) { return {StatusCode::notPositive, "hertz"}; }
    if (spring->dampingRatio < 0) { return {StatusCode::negative, "dampingRatio"}; }
    return Status::success();
}

Status checkLimits(const std::optional<AngleLimits>& limits) { return checkOrder(limits); }
Status checkLimits(const std::optional<TranslationLimits>& limits) { return checkOrder(limits); }

Status checkMotor(const std::optional<AngularMotor>& motor) {
    if (!motor) { return Status::success(); }
    return firstFault({checkFinite(motor->speed, "motorSpeed"), checkStrength(motor->maxTorque, "maxMotorTorque")});
}

Status checkMotor(const std::optional<LinearMotor>& motor) {
    if (!motor) { return Status::success(); }
    return firstFault({checkFinite(motor->speed, "motorSpeed"), checkStrength(motor->maxForce, "maxMotorForce")});
}

Status checkLength(Real length, const std::optional<LengthLimits>& limits, const std::optional<Spring>& spring) {
    if (!isFinite(length)) { return {StatusCode::notFinite, "length"}; }
    const bool isRope = limits && !spring;
    if (length < 0 || (length == 0 && !isRope)) { return {StatusCode::notPositive, "length"}; }
    if (!limits) { return Status::success(); }
    if (!isFinite(limits->min)) { return {StatusCode::notFinite, "minLength"}; }
    if (limits->min < 0) { return {StatusCode::negative, "minLength"}; }
    if (!(limits->max >= limits->min)) { return {StatusCode::outOfRange, "maxLength"}; }
    return Status::success();
}

Status checkAxis(DVec2 axis) {
    const Status number = checkNumber(axis, "axis");
    if (!number.ok()) { return number; }
    return axis == DVec2{} ? Status{StatusCode::degenerate, "axis"} : Status::success();
}

Status checkStrength(const std::optional<Real>& strength, const char* field) {
    if (!strength) { return Status::success(); }
    if (!isFinite(*strength)) { return {StatusCode::notFinite, field}; }
    return *strength < 0 ? Status{StatusCode::negative, field} : Status::success();
}

Status checkDrive(const MotorDrive& drive) {
    const Status numbers =
        firstFault({checkNumber(drive.linearOffset.value_or(Vec2{}), "linearOffset"),
                    checkNumber(drive.linearVelocity.value_or(Vec2{}), "linearVelocity"),
                    checkFinite(drive.angularOffset.value_or(0), "angularOffset"),
                    checkFinite(drive.angularVelocity.value_or(0), "angularVelocity"),
                    checkStrength(drive.maxForce, "maxForce"), checkStrength(drive.maxTorque, "maxTorque")});
    if (!numbers.ok()) { return numbers; }
    // Which of the two would count is not for us to guess.
    if (drive.linearOffset && drive.linearVelocity) { return {StatusCode::outOfRange, "linearVelocity"}; }
    if (drive.angularOffset && drive.angularVelocity) { return {StatusCode::outOfRange, "angularVelocity"}; }
    return Status::success();
}

Status checkRatio(Real ratio) {
    if (!isFinite(ratio)) { return {StatusCode::notFinite, "ratio"}; }
    return ratio == 0 ? Status{StatusCode::outOfRange, "ratio"} : Status::success();
}

Status checkParts(const RevoluteJointDef& def) { return checkGuided(def); }
Status checkParts(const DistanceJointDef& def, Real length) {
    return firstFault({checkLength(def.length.value_or(length), def.limits, def.spring), checkSpring(def.spring)});
}
Status checkParts(const PrismaticJointDef& def) { return checkGuided(def); }
Status checkParts(const WheelJointDef& def) { return checkGuided(def); }
Status checkParts(const WeldJointDef& def) {
    return firstFault({checkSpring(def.linearSpring), checkSpring(def.angularSpring)});
}
Status checkParts(const MotorJointDef& def) { return checkDrive(def.drive); }
Status checkParts(const MouseJointDef& def) {
    return firstFault(
        {checkNumber(def.target, "target"), checkSpring(def.spring), checkStrength(def.maxForce, "maxForce")});
}
Status checkParts(const GearJointDef& def) { return checkRatio(def.ratio); }
Status checkParts(const PulleyJointDef& def) {
    const Status ratio = checkRatio(def.ratio);
    if (!ratio.ok()) { return ratio; }
    if (def.ratio < 0) { return {StatusCode::negative, "ratio"}; }
    const Real length = def.length.value_or(1);
    if (!isFinite(length)) { return {StatusCode::notFinite, "length"}; }
    return length > 0 ? Status::success() : Status{StatusCode::notPositive, "length"};
}

}  // namespace swept::inline SWEPT_PRECISION

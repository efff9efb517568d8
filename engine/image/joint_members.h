#pragma once

#include "../state/joint.h"
#include "members.h"

/// Members of joints that have bases and bit-fields: each list is checked to be complete.

namespace swept::inline SWEPT_PRECISION {

constexpr Flags<4> flagsOf(const HingeParts& p) { return {p.hasSpring, p.hasMotor, p.hasLimits, p.isGliding}; }
constexpr void setFlags(HingeParts& p, const Flags<4>& flags) {
    p.hasSpring = flags[0];
    p.hasMotor = flags[1];
    p.hasLimits = flags[2];
    p.isGliding = flags[3];
}
template <MaybeConst<HingeParts> T>
constexpr auto allMembers(T& parts) {
    static_assert(areAllListed<HingeParts>(0, 4));
    return listed(flagsIn(parts));
}

constexpr Flags<14> flagsOf(const JointTie& t) {
    return {t.holds,      t.isPair,   t.mayBreak,         t.isHinge,     t.isPlain,      t.isPassive, t.isPowered,
            t.holdsAngle, t.isSprung, t.drivesAngleAlone, t.hasRestLoad, t.pushesInside, t.hasDrives, t.isSoft};
}
constexpr void setFlags(JointTie& t, const Flags<14>& flags) {
    t.holds = flags[0];
    t.isPair = flags[1];
    t.mayBreak = flags[2];
    t.isHinge = flags[3];
    t.isPlain = flags[4];
    t.isPassive = flags[5];
    t.isPowered = flags[6];
    t.holdsAngle = flags[7];
    t.isSprung = flags[8];
    t.drivesAngleAlone = flags[9];
    t.hasRestLoad = flags[10];
    t.pushesInside = flags[11];
    t.hasDrives = flags[12];
    t.isSoft = flags[13];
}
template <MaybeConst<JointTie> T>
constexpr auto allMembers(T& tie) {
    static_assert(areAllListed<JointTie>(3, 14));
    return listed(tie.bodyA, tie.bodyB, flagsIn(tie), tie.hingeParts);
}

template <MaybeConst<DistanceConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<DistanceConstraint>(15));
    return listed(baseOf<JointConstraint>(joint), joint.length, joint.minLength, joint.maxLength, joint.motion,
                  joint.spring, joint.isRigid, joint.hasSpring, joint.hasLimits, joint.isGliding, joint.axis,
                  joint.rigidImpulse, joint.springImpulse, joint.lowerImpulse, joint.upperImpulse);
}
template <MaybeConst<PrismaticConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<PrismaticConstraint>(6));
    return listed(baseOf<JointConstraint>(joint), baseOf<FreedomParts>(joint), joint.axis, joint.baseAngle,
                  joint.heldImpulse, joint.axisNow);
}
template <MaybeConst<WheelConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<WheelConstraint>(10));
    return listed(baseOf<JointConstraint>(joint), joint.axis, joint.suspension, joint.spring, joint.motorSpeed,
                  joint.maxMotorImpulse, joint.hasMotor, joint.motorImpulse, joint.heldImpulse, joint.axisNow);
}
template <MaybeConst<WeldConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<WeldConstraint>(9));
    return listed(baseOf<JointConstraint>(joint), joint.baseAngle, joint.linearSpring, joint.angularSpring,
                  joint.hasLinearSpring, joint.isLinked, joint.hasAngularSpring, joint.linearImpulse,
                  joint.angularImpulse);
}
template <MaybeConst<MotorConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<MotorConstraint>(15));
    return listed(baseOf<JointConstraint>(joint), joint.baseAngle, joint.velocity, joint.spin, joint.approachRate,
                  joint.ease, joint.maxLinearImpulse, joint.maxAngularImpulse, joint.drivesLine, joint.drivesAngle,
                  joint.seeksPlace, joint.seeksAngle, joint.linearImpulse, joint.angularImpulse, joint.hinge);
}
template <MaybeConst<MouseConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<MouseConstraint>(11));
    return listed(baseOf<JointConstraint>(joint), joint.spring, joint.maxImpulse, joint.approachRate, joint.hasSpring,
                  joint.linearImpulse, joint.springImpulse, joint.velocity, joint.toGo, joint.pace, joint.gone);
}
template <MaybeConst<GearConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<GearConstraint>(7));
    return listed(baseOf<JointConstraint>(joint), joint.first, joint.second, joint.ratio, joint.baseError,
                  joint.axisNow, joint.impulse);
}
template <MaybeConst<PulleyConstraint> T>
constexpr auto allMembers(T& joint) {
    static_assert(areAllListed<PulleyConstraint>(8));
    return listed(baseOf<JointConstraint>(joint), joint.offsetA, joint.offsetB, joint.ratio, joint.totalLength,
                  joint.axisA, joint.axisB, joint.tension);
}

}  // namespace swept::inline SWEPT_PRECISION

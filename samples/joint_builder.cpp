#include "joint_builder.h"

#include <limits>
#include <optional>
#include <variant>

#include "scene_definitions.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Spring of a joint, when it has one.
std::optional<Spring> springOf(const std::optional<double>& hertz, const std::optional<double>& dampingRatio) {
    if (!hertz) { return std::nullopt; }
    return Spring{realOf(*hertz), realOf(dampingRatio.value_or(0))};
}

/// Limits of a translation, or of an angle.
template <class Limits>
std::optional<Limits> limitsOf(const std::optional<double>& lower, const std::optional<double>& upper) {
    constexpr Real kUnlimited = std::numeric_limits<Real>::max();
    if (!lower && !upper) { return std::nullopt; }
    return Limits{realOf(lower).value_or(-kUnlimited), realOf(upper).value_or(kUnlimited)};
}

template <class Motor>
std::optional<Motor> motorOf(const std::optional<double>& speed, const std::optional<double>& strength) {
    if (!speed && !strength) { return std::nullopt; }
    return Motor{realOf(speed.value_or(0)), realOf(strength.value_or(0))};
}

/// Where a joint takes hold of its bodies.
template <class Def, class Members>
void setGrip(Def& def, const Members& given) {
    def.anchor = given.anchor;
    def.anchorB = given.anchorB;
    def.referenceAngle = given.referenceAngle;
}

struct JointMaker {
    World& world;
    JointDef base;
    const JointNames& joints;

    Result<JointId> operator()(const RevoluteDescription& given) const {
        RevoluteJointDef def;
        def.base = base;
        setGrip(def, given);
        def.limits = limitsOf<AngleLimits>(given.lower, given.upper);
        def.motor = motorOf<AngularMotor>(given.motorSpeed, given.maxMotorTorque);
        def.spring = springOf(given.hertz, given.dampingRatio);
        def.springTarget = realOf(given.springTarget.value_or(0));
        return world.createJoint(def);
    }
    Result<JointId> operator()(const DistanceDescription& given) const {
        DistanceJointDef def;
        def.base = base;
        def.anchorA = given.anchorA;
        def.anchorB = given.anchorB;
        def.length = realOf(given.length);
        if (given.minLength || given.maxLength) {
            def.limits = LengthLimits{realOf(given.minLength).value_or(0),
                                      realOf(given.maxLength).value_or(std::numeric_limits<Real>::infinity())};
        }
        def.spring = springOf(given.hertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const PrismaticDescription& given) const {
        PrismaticJointDef def;
        def.base = base;
        setGrip(def, given);
        def.axis = given.axis;
        def.limits = limitsOf<TranslationLimits>(given.lower, given.upper);
        def.motor = motorOf<LinearMotor>(given.motorSpeed, given.maxMotorForce);
        def.spring = springOf(given.hertz, given.dampingRatio);
        def.springTarget = realOf(given.springTarget.value_or(0));
        return world.createJoint(def);
    }
    Result<JointId> operator()(const WheelDescription& given) const {
        WheelJointDef def;
        def.base = base;
        setGrip(def, given);
        def.axis = given.axis;
        def.limits = limitsOf<TranslationLimits>(given.lower, given.upper);
        def.motor = motorOf<AngularMotor>(given.motorSpeed, given.maxMotorTorque);
        def.spring = springOf(given.hertz, given.dampingRatio);
        def.springTarget = realOf(given.springTarget.value_or(0));
        return world.createJoint(def);
    }
    Result<JointId> operator()(const WeldDescription& given) const {
        WeldJointDef def;
        def.base = base;
        setGrip(def, given);
        def.linearSpring = springOf(given.linearHertz, given.dampingRatio);
        def.angularSpring = springOf(given.angularHertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const MotorDescription& given) const {
        MotorJointDef def;
        def.base = base;
        def.referenceAngle = given.referenceAngle;
        if (given.linearOffset) { def.drive.linearOffset = toReal(*given.linearOffset); }
        if (given.linearVelocity) { def.drive.linearVelocity = toReal(*given.linearVelocity); }
        def.drive.angularOffset = realOf(given.angularOffset);
        def.drive.angularVelocity = realOf(given.angularVelocity);
        def.drive.maxForce = realOf(given.maxForce);
        def.drive.maxTorque = realOf(given.maxTorque);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const MouseDescription& given) const {
        MouseJointDef def;
        def.base = base;
        def.target = given.target;
        def.anchor = given.anchor;
        def.spring = springOf(given.hertz, given.dampingRatio);
        def.maxForce = realOf(given.maxForce);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const GearDescription& given) const {
        GearJointDef def;
        def.base = base;
        def.jointA = jointNamed(given.jointA);
        def.jointB = jointNamed(given.jointB);
        def.ratio = realOf(given.ratio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const PulleyDescription& given) const {
        PulleyJointDef def;
        def.base = base;
        def.groundA = given.groundA;
        def.groundB = given.groundB;
        def.anchorA = given.anchorA;
        def.anchorB = given.anchorB;
        def.ratio = realOf(given.ratio);
        def.length = realOf(given.length);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const FilterJointDescription&) const {
        FilterJointDef def;
        def.base = base;
        return world.createJoint(def);
    }

    JointId jointNamed(const std::string& name) const {
        const auto found = joints.find(name);
        return found != joints.end() ? found->second : JointId{};
    }
};

/// Null, and hence refused by `createJoint`, when there is none of that name.
BodyId bodyNamed(const BodyNames& names, const std::string& name) {
    const auto found = names.find(name);
    return found != names.end() ? found->second : BodyId{};
}

}  // namespace

Result<JointId> buildJoint(const JointDescription& given, std::size_t index, const BodyNames& bodies,
                           const JointNames& joints, World& world) {
    JointMaker maker{world, {}, joints};
    maker.base.bodyA = bodyNamed(bodies, given.bodyA);
    maker.base.bodyB = bodyNamed(bodies, given.bodyB);
    maker.base.collideConnected = given.collideConnected;
    maker.base.breakForce = realOf(given.breakForce);
    maker.base.breakTorque = realOf(given.breakTorque);
    maker.base.userData = index;
    return std::visit(maker, given.joint);
}

}  // namespace swept::inline SWEPT_PRECISION

#include "scene_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "../solve/joint_place.h"
#include "../solve/rest_springs.h"
#include "json_text.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::array kTypeNames{"revolute", "distance", "prismatic", "wheel",  "weld",
                                "motor",    "mouse",    "gear",      "pulley", "filter"};
static_assert(kTypeNames.size() == std::variant_size_v<JointParts>);

using MotorPart = JointPart<MotorJointDef, MotorConstraint>;
using GearPart = JointPart<GearJointDef, GearConstraint>;

/// In place of 0, which the reader refuses: too little to be seen.
constexpr Real kLeastLength = Real(1e-30);

bool hasStrength(const MotorDrive& drive) { return drive.maxForce || drive.maxTorque; }

/// What a joint is in a scene.
JointType typeInScene(const Joint& joint) {
    const auto* const motor = std::get_if<MotorPart>(&joint.parts);
    return motor != nullptr && !hasStrength(motor->def.drive) ? JointType::filter : joint.type();
}

template <class Value>
void addGiven(JsonObject& out, const char* key, const std::optional<Value>& value) {
    if (value) { out.add(key, *value); }
}

void addSpring(JsonObject& out, const std::optional<Spring>& spring) {
    if (!spring) { return; }
    out.add("hertz", spring->hertz);
    out.addUnless("dampingRatio", spring->dampingRatio, Real(0));
}

/// The same stiffness with another mass, and the same speed at which it loses its swing (`TurningSpring`). What moves
/// along a rod is another one where the bodies turned since the joint was made.
std::optional<Spring> withMass(const std::optional<Spring>& spring, Real before, Real now) {
    if (!spring || !(before > 0) || !(now > 0)) { return spring; }
    const Real faster = std::sqrt(before / now);
    return Spring{spring->hertz * faster, spring->dampingRatio / faster};
}

/// One that is beyond all numbers of a scene is none there.
bool isFar(Real number) { return !(std::fabs(static_cast<double>(number)) < kLargestInScene / 2); }

template <class Limits>
void addLimits(JsonObject& out, const std::optional<Limits>& limits) {
    if (!limits) { return; }
    if (!isFar(limits->lower)) { out.add("lower", limits->lower); }
    if (!isFar(limits->upper)) { out.add("upper", limits->upper); }
}
void addBreakLimit(JsonObject& out, const char* key, const std::optional<Real>& limit) {
    if (limit && !isFar(*limit)) { out.add(key, *limit); }
}

void addMotor(JsonObject& out, const std::optional<AngularMotor>& motor) {
    if (!motor) { return; }
    out.add("motorSpeed", motor->speed);
    out.add("maxMotorTorque", motor->maxTorque);
}
void addMotor(JsonObject& out, const std::optional<LinearMotor>& motor) {
    if (!motor) { return; }
    out.add("motorSpeed", motor->speed);
    out.add("maxMotorForce", motor->maxForce);
}

/// What each kind of joint has of its own.
struct JointMembers {
    const WorldState& world;
    const Joint& joint;
    const ScenePlaces& places;
    JsonObject& out;

    void operator()(const HingePart& part) const {
        addGrip();
        addGuide(part.def);
    }
    void operator()(const JointPart<PrismaticJointDef, PrismaticConstraint>& part) const { addSlide(part.def); }
    void operator()(const JointPart<WheelJointDef, WheelConstraint>& part) const { addSlide(part.def); }
    void operator()(const JointPart<DistanceJointDef, DistanceConstraint>& part) const {
        const DistanceJointDef& def = part.def;
        out.add("anchorA", anchorAOf(world, joint));
        out.add("anchorB", anchorBOf(world, joint));
        const bool isBounded = def.limits && !isFar(def.limits->max);
        const bool isOne = anchorAOf(world, joint) == anchorBOf(world, joint);  // the reader wants some length then
        if (def.spring || !def.limits || (isOne && !isBounded)) { out.add("length", lengthWithin(def.limits)); }
        if (def.limits) { out.addUnless("minLength", def.limits->min, Real(0)); }
        if (isBounded) { out.add("maxLength", std::max(def.limits->max, kLeastLength)); }
        addSpring(out,
                  withMass(def.spring, rodMassOf(world, joint), rodMassOf(world, madeNow(directionOf(world, joint)))));
    }
    void operator()(const JointPart<WeldJointDef, WeldConstraint>& part) const {
        const WeldJointDef& def = part.def;
        addGrip();
        if (def.linearSpring) { out.add("linearHertz", def.linearSpring->hertz); }
        if (def.angularSpring) { out.add("angularHertz", def.angularSpring->hertz); }
        const std::optional<Spring>& damped = def.linearSpring ? def.linearSpring : def.angularSpring;
        if (damped) { out.addUnless("dampingRatio", damped->dampingRatio, Real(0)); }
    }
    void operator()(const MotorPart& part) const {
        const MotorDrive& drive = part.def.drive;
        addReference();
        if (drive.maxForce) {
            if (drive.linearVelocity) {
                out.add("linearVelocity", *drive.linearVelocity);
            } else {
                out.add("linearOffset", drive.linearOffset.value_or(joint.localAnchorA));
            }
        }
        if (drive.maxTorque) {
            if (drive.angularVelocity) {
                out.add("angularVelocity", *drive.angularVelocity);
            } else {
                out.addUnless("angularOffset", drive.angularOffset.value_or(0), Real(0));
            }
        }
        addGiven(out, "maxForce", drive.maxForce);
        addGiven(out, "maxTorque", drive.maxTorque);
    }
    void operator()(const JointPart<MouseJointDef, MouseConstraint>& part) const {
        out.add("target", anchorAOf(world, joint));
        out.add("anchor", anchorBOf(world, joint));
        addSpring(out, part.def.spring);
        addGiven(out, "maxForce", part.def.maxForce);
    }
    void operator()(const GearPart& part) const {
        out.add("jointA", places.jointWords.at(places.joints[part.def.jointA.index]));
        out.add("jointB", places.jointWords.at(places.joints[part.def.jointB.index]));
        out.add("ratio", part.def.ratio);
    }
    void operator()(const JointPart<PulleyJointDef, PulleyConstraint>& part) const {
        out.add("groundA", part.def.groundA);
        out.add("groundB", part.def.groundB);
        out.add("anchorA", anchorAOf(world, joint));
        out.add("anchorB", anchorBOf(world, joint));
        out.add("ratio", part.def.ratio);
        out.add("length", std::max(joint.length, kLeastLength));
    }
    void operator()(const FilterPart&) const {}

private:
    /// One point, where the two are one but for what rounding keeps apart.
    void addGrip() const {
        const DVec2 anchorA = anchorAOf(world, joint);
        const DVec2 anchorB = anchorBOf(world, joint);
        const double arms = length(toDouble(joint.localAnchorA)) + length(toDouble(joint.localAnchorB));
        constexpr double kArmRounding = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        const bool isOne = length(anchorB - anchorA) <= kArmRounding * arms;
        out.add("anchor", isOne ? anchorB : anchorA);
        if (!isOne) { out.add("anchorB", anchorB); }
        addReference();
    }
    void addReference() const {
        if (angleOf(world, joint) != 0) { out.add("referenceAngle", joint.referenceAngle); }
    }
    /// The joint if it were made at the present poses, as far as masses go. @param axis  unit, world
    Joint madeNow(Vec2 axis) const {
        Joint now = joint;
        now.localAxis = unrotate(world.motions[joint.bodyA].pose.rotation, axis);
        now.localAxisB = unrotate(world.motions[joint.bodyB].pose.rotation, axis);
        return now;
    }
    template <class Def>
    void addGuide(const Def& def) const {
        addLimits(out, def.limits);
        addMotor(out, def.motor);
        addSpring(out, def.spring);
        if (def.spring) { out.addUnless("springTarget", def.springTarget, Real(0)); }
    }
    template <class Def>
    void addSlide(const Def& def) const {
        addGrip();
        out.add("axis", axisOf(world, joint));
        addGuide(def);
    }
    Real lengthWithin(const std::optional<LengthLimits>& limits) const {
        const Real within = limits ? std::clamp(joint.length, limits->min, limits->max) : joint.length;
        return std::max(within, kLeastLength);
    }
};

}  // namespace

bool isInScene(const WorldState& world, const Joint& joint) {
    if (const auto* const gear = std::get_if<GearPart>(&joint.parts)) {
        const bool areBoth = isInScene(world, world.joints[gear->def.jointA.index]) &&
                             isInScene(world, world.joints[gear->def.jointB.index]);
        if (!areBoth) { return false; }
    }
    if (typeInScene(joint) == JointType::filter && !joint.keepsApart()) { return false; }
    const bool isDynamicB = world.bodies[joint.bodyB].isDynamic();
    return isDynamicB || (joint.type() != JointType::mouse && world.bodies[joint.bodyA].isDynamic());
}

void appendJoint(std::string& text, const WorldState& world, JointId id, const ScenePlaces& places) {
    const Joint& joint = world.joints[id.index];
    const JointType type = typeInScene(joint);
    JsonObject out(text);
    const std::string& name = places.jointWords.given(places.joints[id.index]);
    if (!name.empty()) { out.add("name", name); }
    out.add("type", kTypeNames[static_cast<std::size_t>(type)]);
    out.add("bodyA", places.bodyWords.at(places.bodies[joint.bodyA]));
    out.add("bodyB", places.bodyWords.at(places.bodies[joint.bodyB]));
    if (type != JointType::filter) {
        out.addUnless("collideConnected", joint.base.collideConnected, false);
        addBreakLimit(out, "breakForce", joint.base.breakForce);
        addBreakLimit(out, "breakTorque", joint.base.breakTorque);
        std::visit(JointMembers{world, joint, places, out}, joint.parts);
    }
    out.close();
}

}  // namespace swept::inline SWEPT_PRECISION

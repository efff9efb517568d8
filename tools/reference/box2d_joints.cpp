#include "box2d_joints.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <swept/samples/joint_start.h>

#include "box2d_shapes.h"

namespace swept {
namespace {

// Hertz of a mouse joint that is to be rigid.
constexpr float kStiffMouse = 20;
// Stands for "no limit": beyond any angle or translation that a run reaches (radians, metres), or torque that a float
// times dt can hold.
constexpr float kAnyAngle = 1e6f;
constexpr float kAnyTorque = 1e30f;

float orElse(const std::optional<double>& value, float otherwise) {
    return value ? static_cast<float>(*value) : otherwise;
}

struct JointMaker {
    b2World& world;
    b2Body* bodyA;
    b2Body* bodyB;
    bool collideConnected;
    const std::map<std::string, b2Joint*>& joints;

    b2Joint* operator()(const RevoluteDescription& revolute) const {
        b2RevoluteJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(revolute.anchor));
        place(definition, revolute);
        definition.collideConnected = collideConnected;
        definition.enableLimit = revolute.lower.has_value() || revolute.upper.has_value();
        definition.lowerAngle = orElse(revolute.lower, -kAnyAngle);
        definition.upperAngle = orElse(revolute.upper, kAnyAngle);
        definition.enableMotor = revolute.motorSpeed.has_value() || revolute.maxMotorTorque.has_value();
        definition.motorSpeed = orElse(revolute.motorSpeed, 0);
        definition.maxMotorTorque = orElse(revolute.maxMotorTorque, kAnyTorque);
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const DistanceDescription& distance) const {
        b2DistanceJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(distance.anchorA), toBox2d(distance.anchorB));
        definition.collideConnected = collideConnected;
        if (distance.length) { definition.length = static_cast<float>(*distance.length); }
        const bool isSpring = distance.hertz.has_value();
        const bool isLimited = distance.minLength.has_value() || distance.maxLength.has_value();
        if (isSpring) {
            b2LinearStiffness(definition.stiffness, definition.damping, static_cast<float>(*distance.hertz),
                              orElse(distance.dampingRatio, 0), bodyA, bodyB);
        }
        const bool isRigid = !isSpring && !isLimited;
        definition.minLength = isRigid ? definition.length : orElse(distance.minLength, 0);
        definition.maxLength = isRigid ? definition.length : orElse(distance.maxLength, b2_maxFloat);
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const PrismaticDescription& slide) const {
        b2PrismaticJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(slide.anchor), unit(slide.axis));
        place(definition, slide);
        definition.collideConnected = collideConnected;
        setLimits(definition, slide.lower, slide.upper);
        definition.enableMotor = slide.motorSpeed.has_value() || slide.maxMotorForce.has_value();
        definition.motorSpeed = orElse(slide.motorSpeed, 0);
        definition.maxMotorForce = orElse(slide.maxMotorForce, 0);
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const WheelDescription& wheel) const {
        b2WheelJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(wheel.anchor), unit(wheel.axis));
        placeB(definition, wheel);
        definition.collideConnected = collideConnected;
        setLimits(definition, wheel.lower, wheel.upper);
        definition.enableMotor = wheel.motorSpeed.has_value() || wheel.maxMotorTorque.has_value();
        definition.motorSpeed = orElse(wheel.motorSpeed, 0);
        definition.maxMotorTorque = orElse(wheel.maxMotorTorque, 0);
        definition.stiffness = definition.damping = 0;
        if (wheel.hertz) {
            b2LinearStiffness(definition.stiffness, definition.damping, static_cast<float>(*wheel.hertz),
                              orElse(wheel.dampingRatio, 0), bodyA, bodyB);
        }
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const WeldDescription& weld) const {
        b2WeldJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(weld.anchor));
        place(definition, weld);
        definition.collideConnected = collideConnected;
        if (weld.angularHertz) {
            b2AngularStiffness(definition.stiffness, definition.damping, static_cast<float>(*weld.angularHertz),
                               orElse(weld.dampingRatio, 0), bodyA, bodyB);
        }
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const MotorDescription& motor) const {
        b2MotorJointDef definition;
        definition.Initialize(bodyA, bodyB);
        definition.collideConnected = collideConnected;
        if (motor.linearOffset) { definition.linearOffset = toBox2d(*motor.linearOffset); }
        definition.angularOffset = referenceAngle(motor) + orElse(motor.angularOffset, 0);
        definition.maxForce = orElse(motor.maxForce, 0);
        definition.maxTorque = orElse(motor.maxTorque, 0);
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const MouseDescription& mouse) const {
        b2MouseJointDef definition;
        definition.bodyA = bodyA;
        definition.bodyB = bodyB;
        definition.collideConnected = true;                                // as here: A takes no part
        definition.target = toBox2d(mouse.anchor.value_or(mouse.target));  // takes hold there
        definition.maxForce = orElse(mouse.maxForce, kAnyTorque);
        b2LinearStiffness(definition.stiffness, definition.damping, orElse(mouse.hertz, kStiffMouse),
                          orElse(mouse.dampingRatio, mouse.hertz ? 0.0f : 1.0f), bodyA, bodyB);
        auto* const joint = static_cast<b2MouseJoint*>(world.CreateJoint(&definition));
        joint->SetTarget(toBox2d(mouse.target));
        return joint;
    }

    b2Joint* operator()(const GearDescription& gear) const {
        b2GearJointDef definition;
        definition.bodyA = bodyA;
        definition.bodyB = bodyB;
        definition.collideConnected = collideConnected;
        definition.joint1 = joints.at(gear.jointA);
        definition.joint2 = joints.at(gear.jointB);
        definition.ratio = static_cast<float>(gear.ratio);
        return world.CreateJoint(&definition);
    }

    b2Joint* operator()(const PulleyDescription& pulley) const {
        b2PulleyJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(pulley.groundA), toBox2d(pulley.groundB), toBox2d(pulley.anchorA),
                              toBox2d(pulley.anchorB), static_cast<float>(pulley.ratio));
        if (pulley.length) {
            definition.lengthA = static_cast<float>(*pulley.length) - definition.ratio * definition.lengthB;
        }
        definition.collideConnected = collideConnected;
        return world.CreateJoint(&definition);
    }

    // Box2D has no filter joint: a distance of any length does the same.
    b2Joint* operator()(const FilterJointDescription&) const {
        b2DistanceJointDef definition;
        definition.Initialize(bodyA, bodyB, bodyA->GetPosition(), bodyB->GetPosition());
        definition.collideConnected = false;
        definition.minLength = 0;
        definition.maxLength = b2_maxFloat;
        return world.CreateJoint(&definition);
    }

private:
    static b2Vec2 unit(DVec2 axis) {
        b2Vec2 direction = toBox2d((1 / length(axis)) * axis);
        direction.Normalize();
        return direction;
    }

    template <class Members>
    float referenceAngle(const Members& joint) const {
        return static_cast<float>(
            referenceAngleOf(joint, static_cast<double>(bodyB->GetAngle()) - static_cast<double>(bodyA->GetAngle())));
    }
    template <class Definition, class Members>
    void placeB(Definition& definition, const Members& joint) const {
        if (joint.anchorB) { definition.localAnchorB = bodyB->GetLocalPoint(toBox2d(*joint.anchorB)); }
    }
    template <class Definition, class Members>
    void place(Definition& definition, const Members& joint) const {
        placeB(definition, joint);
        if (joint.referenceAngle) { definition.referenceAngle = referenceAngle(joint); }
    }

    template <class Definition>
    static void setLimits(Definition& definition, const std::optional<double>& lower,
                          const std::optional<double>& upper) {
        definition.enableLimit = lower.has_value() || upper.has_value();
        definition.lowerTranslation = orElse(lower, -kAnyAngle);
        definition.upperTranslation = orElse(upper, kAnyAngle);
    }
};

/// Whether the joint holds its two anchors together.
bool isPin(const b2Joint& joint) { return joint.GetType() == e_revoluteJoint || joint.GetType() == e_weldJoint; }

}  // namespace

b2Joint* addJoint(b2World& world, const JointDescription& joint, const std::map<std::string, b2Body*>& bodies,
                  const std::map<std::string, b2Joint*>& joints) {
    return std::visit(JointMaker{world, bodies.at(joint.bodyA), bodies.at(joint.bodyB), joint.collideConnected, joints},
                      joint.joint);
}

double jointErrorOf(b2Joint& joint) {
    const double apart = length(fromBox2d(joint.GetAnchorB()) - fromBox2d(joint.GetAnchorA()));
    const auto* const distance = dynamic_cast<const b2DistanceJoint*>(&joint);
    if (distance == nullptr) { return isPin(joint) ? apart : 0; }
    return std::max({0.0, static_cast<double>(distance->GetMinLength()) - apart,
                     apart - static_cast<double>(distance->GetMaxLength())});
}

bool breaks(const b2Joint& joint, const JointDescription& description, double dt) {
    const auto rate = static_cast<float>(1 / dt);
    const double force = length(fromBox2d(joint.GetReactionForce(rate)));
    const double torque = std::abs(static_cast<double>(joint.GetReactionTorque(rate)));
    return (description.breakForce && force > *description.breakForce) ||
           (description.breakTorque && torque > *description.breakTorque);
}

}  // namespace swept

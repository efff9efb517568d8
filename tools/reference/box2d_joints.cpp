#include "box2d_joints.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "box2d_shapes.h"

namespace swept {
namespace {

// Stands for "no limit": beyond any angle that a run reaches (radians), or torque that a float times dt can hold.
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

    b2Joint* operator()(const RevoluteDescription& revolute) const {
        b2RevoluteJointDef definition;
        definition.Initialize(bodyA, bodyB, toBox2d(revolute.anchor));
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
        if (distance.length) {
            definition.length = static_cast<float>(*distance.length);
        }
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
};

}  // namespace

b2Joint* addJoint(b2World& world, const JointDescription& joint, const std::map<std::string, b2Body*>& bodies) {
    return std::visit(JointMaker{world, bodies.at(joint.bodyA), bodies.at(joint.bodyB), joint.collideConnected},
                      joint.joint);
}

double jointErrorOf(b2Joint& joint) {
    const double apart = length(fromBox2d(joint.GetAnchorB()) - fromBox2d(joint.GetAnchorA()));
    const auto* const distance = dynamic_cast<const b2DistanceJoint*>(&joint);
    if (distance == nullptr) {
        return apart;
    }
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

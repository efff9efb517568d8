#include "box2d3_joints.h"

#include <box2d/box2d.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>

#include "box2d3_numbers.h"

namespace swept {
namespace {

/// Stands for "no limit": metres, beyond any translation that a run reaches.
constexpr float kAnyTranslation = 1e6F;

/// How `body` is turned, backwards.
b2Rot unturned(b2BodyId body) { return b2InvertRot(b2Body_GetRotation(body)); }

/// A spring and limits along an axis. @param joint  prismatic or wheel
template <class Definition, class Members>
void setSlide(Definition& definition, const Members& joint) {
    definition.enableSpring = joint.hertz.has_value();
    definition.hertz = orElse(joint.hertz, 0);
    definition.dampingRatio = orElse(joint.dampingRatio, 0);
    definition.enableLimit = joint.lower || joint.upper;
    definition.lowerTranslation = orElse(joint.lower, -kAnyTranslation);
    definition.upperTranslation = orElse(joint.upper, kAnyTranslation);
}

struct JointMaker {
    b2WorldId world;
    b2BodyId bodyA;
    b2BodyId bodyB;
    bool collideConnected;
    bool isStiff;

    void operator()(const RevoluteDescription& revolute) const {
        b2RevoluteJointDef definition = b2DefaultRevoluteJointDef();
        placeTurned(definition.base, revolute);
        definition.enableSpring = revolute.hertz.has_value();
        definition.hertz = orElse(revolute.hertz, 0);
        definition.dampingRatio = orElse(revolute.dampingRatio, 0);
        definition.targetAngle = orElse(revolute.springTarget, 0);
        constexpr auto kHalfTurn = std::numbers::pi_v<float>;
        definition.enableLimit = revolute.lower || revolute.upper;
        definition.lowerAngle = orElse(revolute.lower, -kHalfTurn);
        definition.upperAngle = orElse(revolute.upper, kHalfTurn);
        definition.enableMotor = revolute.motorSpeed || revolute.maxMotorTorque;
        definition.motorSpeed = orElse(revolute.motorSpeed, 0);
        definition.maxMotorTorque = orElse(revolute.maxMotorTorque, 0);
        b2CreateRevoluteJoint(world, &definition);
    }
    void operator()(const DistanceDescription& distance) const {
        b2DistanceJointDef definition = b2DefaultDistanceJointDef();
        placeAt(definition.base, distance.anchorA, distance.anchorB);
        definition.length = orElse(distance.length, static_cast<float>(length(distance.anchorB - distance.anchorA)));
        // A spring of 0 Hz between limits is a rope; without either the joint is rigid.
        definition.enableLimit = distance.minLength || distance.maxLength;
        definition.enableSpring = distance.hertz || definition.enableLimit;
        definition.hertz = orElse(distance.hertz, 0);
        definition.dampingRatio = orElse(distance.dampingRatio, 0);
        if (definition.enableLimit) {
            definition.minLength = orElse(distance.minLength, definition.minLength);
            definition.maxLength = orElse(distance.maxLength, definition.maxLength);
        }
        b2CreateDistanceJoint(world, &definition);
    }
    void operator()(const WeldDescription& weld) const {
        b2WeldJointDef definition = b2DefaultWeldJointDef();
        placeTurned(definition.base, weld);
        definition.linearHertz = orElse(weld.linearHertz, 0);
        definition.angularHertz = orElse(weld.angularHertz, 0);
        definition.linearDampingRatio = definition.angularDampingRatio = orElse(weld.dampingRatio, 0);
        b2CreateWeldJoint(world, &definition);
    }
    void operator()(const PrismaticDescription& prismatic) const {
        b2PrismaticJointDef definition = b2DefaultPrismaticJointDef();
        placeTurned(definition.base, prismatic);
        placeAxis(definition.base, prismatic.axis);
        setSlide(definition, prismatic);
        definition.targetTranslation = orElse(prismatic.springTarget, 0);
        definition.enableMotor = prismatic.motorSpeed || prismatic.maxMotorForce;
        definition.motorSpeed = orElse(prismatic.motorSpeed, 0);
        definition.maxMotorForce = orElse(prismatic.maxMotorForce, 0);
        b2CreatePrismaticJoint(world, &definition);
    }
    void operator()(const WheelDescription& wheel) const {
        b2WheelJointDef definition = b2DefaultWheelJointDef();
        placeTurned(definition.base, wheel);
        placeAxis(definition.base, wheel.axis);
        setSlide(definition, wheel);
        definition.enableMotor = wheel.motorSpeed || wheel.maxMotorTorque;
        definition.motorSpeed = orElse(wheel.motorSpeed, 0);
        definition.maxMotorTorque = orElse(wheel.maxMotorTorque, 0);
        b2CreateWheelJoint(world, &definition);
    }
    /// To a velocity, which the engine has along the axes of the world. Its motors that seek a pose are springs.
    void operator()(const MotorDescription& motor) const {
        b2MotorJointDef definition = b2DefaultMotorJointDef();
        const DVec2 origin = fromPeer(b2Body_GetPosition(bodyB));
        placeAt(definition.base, origin, origin);
        definition.linearVelocity =
            b2RotateVector(b2Body_GetRotation(bodyA), toPeer(motor.linearVelocity.value_or(DVec2{})));
        definition.angularVelocity = orElse(motor.angularVelocity, 0);
        definition.maxVelocityForce = orElse(motor.maxForce, 0);
        definition.maxVelocityTorque = orElse(motor.maxTorque, 0);
        b2CreateMotorJoint(world, &definition);
    }
    /// The spring of a motor joint.
    void operator()(const MouseDescription& mouse) const {
        b2MotorJointDef definition = b2DefaultMotorJointDef();
        placeAt(definition.base, mouse.target, mouse.anchor.value_or(mouse.target));
        if (b2Body_GetType(bodyA) != b2_staticBody) { fixAt(definition.base, mouse.target); }
        definition.base.collideConnected = true;
        definition.linearHertz = orElse(mouse.hertz, kStiffHertz);
        definition.linearDampingRatio = orElse(mouse.dampingRatio, mouse.hertz ? 0.0F : 1.0F);
        definition.maxSpringForce = orElse(mouse.maxForce, std::numeric_limits<float>::max());
        b2CreateMotorJoint(world, &definition);
    }
    void operator()(const FilterJointDescription&) const {
        b2FilterJointDef definition = b2DefaultFilterJointDef();
        definition.base.bodyIdA = bodyA;
        definition.base.bodyIdB = bodyB;
        b2CreateFilterJoint(world, &definition);
    }
    void operator()(const GearDescription&) const { refuse("a gear joint"); }
    void operator()(const PulleyDescription&) const { refuse("a pulley joint"); }

private:
    template <class Members>
    void placeTurned(b2JointDef& base, const Members& joint) const {
        placeAt(base, joint.anchor, joint.anchorB.value_or(joint.anchor));
        if (!joint.referenceAngle) { return; }
        base.localFrameA.q = toPeer(*joint.referenceAngle);
        base.localFrameB.q = b2Rot_identity;
    }
    /// Frames that agree at the start: angles of the joint count from there.
    void placeAt(b2JointDef& base, DVec2 anchorA, DVec2 anchorB) const {
        base.bodyIdA = bodyA;
        base.bodyIdB = bodyB;
        base.localFrameA = {b2Body_GetLocalPoint(bodyA, toPeerPlace(anchorA)), unturned(bodyA)};
        base.localFrameB = {b2Body_GetLocalPoint(bodyB, toPeerPlace(anchorB)), unturned(bodyB)};
        base.collideConnected = collideConnected;
        base.constraintHertz = isStiff ? kStiffHertz : base.constraintHertz;
    }
    /// Turns both frames alike, until the x axis of A's is that of the joint.
    void placeAxis(b2JointDef& base, DVec2 axis) const {
        const b2Rot wanted = b2MulRot(unturned(bodyA), toPeer(std::atan2(axis.y, axis.x)));
        const b2Rot turn = b2InvMulRot(base.localFrameA.q, wanted);
        base.localFrameA.q = b2MulRot(base.localFrameA.q, turn);
        base.localFrameB.q = b2MulRot(base.localFrameB.q, turn);
    }
    /// To the world instead of A, which is to take no part.
    void fixAt(b2JointDef& base, DVec2 anchor) const {
        b2BodyDef fixed = b2DefaultBodyDef();
        fixed.position = toPeerPlace(anchor);
        base.bodyIdA = b2CreateBody(world, &fixed);
        base.localFrameA = b2Transform_identity;
    }
};

}  // namespace

void addBox2d3Joint(b2WorldId world, b2BodyId bodyA, b2BodyId bodyB, const JointDescription& joint, bool isStiff) {
    std::visit(JointMaker{world, bodyA, bodyB, joint.collideConnected, isStiff}, joint.joint);
}

}  // namespace swept

#include "motor_work.h"

#include <cmath>
#include <limits>
#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

double workOf(const AngularMotor& motor, double time) {
    return static_cast<double>(motor.maxTorque) * std::fabs(static_cast<double>(motor.speed)) * time;
}
double workOf(const LinearMotor& motor, double time) {
    return static_cast<double>(motor.maxForce) * std::fabs(static_cast<double>(motor.speed)) * time;
}

struct MostWork {
    double time;  ///< s

    double operator()(const JointPart<MotorJointDef, MotorConstraint>& part) const {
        const MotorDrive& drive = part.def.drive;
        double work = 0;
        if (drive.maxForce && *drive.maxForce > 0) {
            if (!drive.linearVelocity) { return kUnknown; }
            work += static_cast<double>(*drive.maxForce) * static_cast<double>(length(*drive.linearVelocity)) * time;
        }
        if (drive.maxTorque && *drive.maxTorque > 0) {
            if (!drive.angularVelocity) { return kUnknown; }
            work += workOf(AngularMotor{.speed = *drive.angularVelocity, .maxTorque = *drive.maxTorque}, time);
        }
        return work;
    }
    template <class Part>
    double operator()(const Part& part) const {
        if constexpr (requires { part.def.motor.has_value() && part.def.spring.has_value(); }) {
            if (!part.def.motor) { return 0; }
            return part.def.spring ? kUnknown : workOf(*part.def.motor, time);
        } else {
            return kUnknown;
        }
    }
};

/// Of a point of a body.
DVec2 wayOf(const WorldState& world, std::uint32_t slot, Vec2 localPoint, const BodyMotion& before,
            const BodyMotion& after) {
    const Vec2 arm = localPoint - world.bodies[slot].localCenter;
    return (after.center - before.center) +
           toDouble(rotate(after.pose.rotation, arm) - rotate(before.pose.rotation, arm));
}

/// In the frame of a body.
Vec2 localPlace(const WorldState& world, std::uint32_t slot, DVec2 place, const BodyMotion& motion) {
    return unrotate(motion.pose.rotation, toReal(place - motion.center)) + world.bodies[slot].localCenter;
}

struct WorkDone {
    const WorldState& world;
    const Joint& joint;
    const JointMoves& moves;

    double operator()(const JointPart<MouseJointDef, MouseConstraint>&) const { return dot(force(), wayOfB()); }
    double operator()(const JointPart<MotorJointDef, MotorConstraint>& part) const {
        const MotorDrive& drive = part.def.drive;
        const DVec2 anchorB =
            moves.beforeB.center +
            toDouble(rotate(moves.beforeB.pose.rotation, joint.localAnchorB - world.bodies[joint.bodyB].localCenter));
        const Vec2 localA = drive.linearVelocity ? localPlace(world, joint.bodyA, anchorB, moves.beforeA)
                                                 : drive.linearOffset.value_or(joint.localAnchorA);
        return dot(force(), wayOfB() - wayOfA(localA)) + turning();
    }
    double operator()(const JointPart<PrismaticJointDef, PrismaticConstraint>&) const { return alongAxis(); }
    double operator()(const JointPart<WheelJointDef, WheelConstraint>&) const { return alongAxis() + turning(); }
    template <class Part>
    double operator()(const Part&) const {
        return turning();
    }

private:
    DVec2 force() const { return toDouble(joint.reactionForce); }
    DVec2 wayOfA(Vec2 localPoint) const { return wayOf(world, joint.bodyA, localPoint, moves.beforeA, moves.afterA); }
    DVec2 wayOfB() const { return wayOf(world, joint.bodyB, joint.localAnchorB, moves.beforeB, moves.afterB); }
    double turning() const {
        const double turn = (moves.afterB.angle - moves.beforeB.angle) - (moves.afterA.angle - moves.beforeA.angle);
        return static_cast<double>(joint.reactionTorque) * turn;
    }
    double alongAxis() const {
        const DVec2 axis = toDouble(rotate(moves.afterA.pose.rotation, joint.localAxis));
        return dot(force(), axis) * dot(axis, wayOfB() - wayOfA(joint.localAnchorA));
    }
};

}  // namespace

double mostWorkOf(const Joint& joint, double time) { return std::visit(MostWork{time}, joint.parts); }

double workDoneBy(const WorldState& world, const Joint& joint, const JointMoves& moves) {
    return std::visit(WorkDone{world, joint, moves}, joint.parts);
}

}  // namespace swept::inline SWEPT_PRECISION

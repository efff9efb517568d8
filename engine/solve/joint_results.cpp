#include "joint_results.h"

#include <cmath>
#include <type_traits>

namespace swept::inline SWEPT_PRECISION {

void takeReaction(Joint& joint, const JointReaction& total, Real dt) {
    joint.reactionForce = (1 / dt) * total.impulse;
    joint.reactionTorque = (1 / dt) * total.twist;
    // A torque is a force times a lever, and overflows before its bodies do.
    if (!isFinite(joint.reactionForce) || !std::isfinite(joint.reactionTorque)) { forgetImpulses(joint); }
}

void takeHinge(Joint& joint, const RevoluteConstraint& constraint, Real dt) {
    joint.hinge = {constraint.linearImpulse, constraint.lowerImpulse, constraint.upperImpulse, constraint.motorImpulse,
                   constraint.springImpulse};
    takeReaction(joint, constraint.total, dt);
}

void forgetStart(Joint& joint) {
    visitPart(joint.parts, [](auto& part) {
        if constexpr (requires { part.memory; }) { part.memory = {}; }
    });
    joint.hinge = {};
    joint.restLoad = {};
}

void forgetImpulses(Joint& joint) {
    forgetStart(joint);
    joint.reactionForce = {};
    joint.reactionTorque = 0;
}

namespace {

/// What its point took of a motor joint. @pre the reaction of the hinge was read
void giveToHinge(WorldState& world, const HingeBeside& hinge, Real dt) {
    if (!hinge.isThere) { return; }
    Joint& joint = world.joints[hinge.source];
    joint.reactionForce += ((hinge.isReversed ? -1 : 1) / dt) * hinge.total;
    if (!isFinite(joint.reactionForce)) { forgetImpulses(joint); }
}

}  // namespace

void readConstraints(SolverBatch& batch, WorldState& world, Real dt) {
    batch.forEachJointKind([&](const auto& constraints) {
        using Constraint = typename std::remove_cvref_t<decltype(constraints)>::value_type;
        for (const Constraint& constraint : constraints) {
            Joint& joint = world.joints[constraint.source];
            if constexpr (std::is_same_v<Constraint, RevoluteConstraint>) {
                takeHinge(joint, constraint, dt);
            } else {
                visitPart(joint.parts, [&](auto& part) {
                    using Part = std::remove_cvref_t<decltype(part)>;
                    if constexpr (std::is_same_v<typename Part::Constraint, Constraint>) { part.memory = constraint; }
                });
                takeReaction(joint, constraint.total, dt);
            }
            if constexpr (std::is_same_v<Constraint, MotorConstraint>) { giveToHinge(world, constraint.hinge, dt); }
        }
    });
}

}  // namespace swept::inline SWEPT_PRECISION

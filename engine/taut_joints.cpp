#include "taut_joints.h"

namespace swept::inline SWEPT_PRECISION {

bool noteTaut(WorldState& world, SolverBatch& batch, Real h, Real length) {
    bool any = false;
    batch.forEachJointKind([&](const auto& joints) {
        for (const JointConstraint& joint : joints) {
            const Real square = phaseSquare(joint, (1 / length) * joint.total.impulse, batch.inertias, h);
            any = noteTaut(world.tautJoints[joint.source], square) || any;
        }
    });
    return any;
}

void stiffenTurns(WorldState& world, const TiedGroup& group, Real h) {
    SolverBatch& batch = group.desk.batch;
    std::vector<Real>& squares = group.desk.phaseSquares;
    squares.assign(batch.inertias.size(), 0);
    const auto add = [&](std::uint32_t body, Vec2 localAnchor, Vec2 force) {
        const BodySlot slot = world.solverSlots[body];
        const Vec2 arm = rotate(world.motions[body].pose.rotation, localAnchor - world.bodies[body].localCenter);
        squares[slot] += phaseSquare(arm, force, batch.inertias[slot].inverseInertia, h);
    };
    for (const std::uint32_t i : group.joints) {
        if (world.tautJoints[i] == 0) { continue; }
        const Joint& joint = world.joints[i];
        add(joint.bodyA, joint.localAnchorA, joint.reactionForce);
        add(joint.bodyB, joint.localAnchorB, joint.reactionForce);
    }
    for (std::size_t slot = 1; slot < squares.size(); ++slot) {
        if (squares[slot] > 1) { batch.inertias[slot].inverseInertia /= squares[slot]; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

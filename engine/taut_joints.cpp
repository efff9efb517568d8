#include "taut_joints.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

bool anyTaut(SolverBatch& batch, Real h, Real length) {
    bool any = false;
    const auto look = [&](const JointConstraint& joint) {
        any = any || isTaut(joint, (1 / length) * joint.total.impulse, batch.inertias, h);
    };
    batch.forEachJointKind([&look](const auto& joints) { std::for_each(joints.begin(), joints.end(), look); });
    return any;
}

bool stiffenTurns(WorldState& world, const TiedGroup& group, Real h) {
    SolverBatch& batch = group.desk.batch;
    std::vector<Real>& squares = group.desk.phaseSquares;
    squares.assign(batch.inertias.size(), 0);
    const auto add = [&](std::uint32_t body, Vec2 localAnchor, Vec2 force) {
        const BodySlot slot = world.solverSlots[body];
        const Vec2 arm = rotate(world.motions[body].pose.rotation, localAnchor - world.bodies[body].localCenter);
        squares[slot] += phaseSquare(arm, force, batch.inertias[slot].inverseInertia, h);
    };
    for (const std::uint32_t i : group.joints) {
        const Joint& joint = world.joints[i];
        add(joint.bodyA, joint.localAnchorA, joint.reactionForce);
        add(joint.bodyB, joint.localAnchorB, joint.reactionForce);
    }
    bool any = false;
    for (std::size_t slot = 1; slot < squares.size(); ++slot) {
        if (!(squares[slot] > 1)) { continue; }
        batch.inertias[slot].inverseInertia /= squares[slot];
        any = true;
    }
    return any;
}

}  // namespace swept::inline SWEPT_PRECISION

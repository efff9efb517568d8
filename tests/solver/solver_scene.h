#pragma once

#include <swept/solver/solver.h>

#include "numbers.h"

/// Small batches for the tests, filled as the engine fills them: anchors, separations and joint angles anew in each
/// step.

namespace swept::test {

/// What an engine would carry from step to step, for scenes of a few bodies.
struct SceneBody {
    double x = 0;
    double y = 0;
    double angle = 0;
    BodyState state;
    BodyInertia inertia;
    BodyDrive drive;
};

/// Constant acceleration (m/s²) over a sub-step.
inline BodyDrive driveOf(Vec2 acceleration, Real h) { return {h * acceleration, 0, 1, 1}; }

/// After a solve: takes the motion of a step into the pose and starts the next one.
inline void finishStep(SceneBody& body, const BodyState& solved) {
    body.x += static_cast<double>(solved.deltaPosition.x);
    body.y += static_cast<double>(solved.deltaPosition.y);
    body.angle += static_cast<double>(solved.deltaAngle);
    body.state = BodyState{solved.velocity, solved.angularVelocity, 0, {}, {}};
}

/// A body of unit mass and given inertia (kg·m²) that may be placed in a batch.
inline SceneBody bodyAt(double x, double y, double mass = 1, double inertia = 1) {
    SceneBody body;
    body.x = x;
    body.y = y;
    body.inertia = {real(1 / mass), real(1 / inertia)};
    return body;
}

/// Places the body in the batch and returns its slot.
inline BodySlot add(SolverBatch& batch, const SceneBody& body) {
    return batch.addBody(body.state, body.inertia, body.drive);
}

}  // namespace swept::test

#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// Which parts of a weld are springs. All of a block have the same.
struct WeldParts {
    bool hasLinearSpring = false;
    bool hasAngularSpring = false;
    bool isLinked = false;
};

/// As many welds as there are lanes, all with the same parts; see `WeldConstraint`.
struct WideWeld : WideJoint {
    WeldParts parts;
    alignas(kBlockBytes) LaneArray baseAngle;
    // As the bodies stand: changes only when they move.
    LaneArray armAX;
    LaneArray armAY;
    LaneArray armBX;
    LaneArray armBY;
    LaneArray gapX;
    LaneArray gapY;
    LaneArray matrixXX;
    LaneArray matrixXY;
    LaneArray matrixYY;
    LaneArray determinant;
    LaneArray spinMass;  ///< of the angle while the point is held
    LaneArray answerX;   ///< of the point to a twist
    LaneArray answerY;
    // The spring of the point, as A stands at the start of the step, and of the angle: not of rigid ones.
    LaneArray stiffnessXX;
    LaneArray stiffnessXY;
    LaneArray stiffnessYY;
    LaneArray stiffnessDeterminant;
    LaneArray springLoss;
    LaneArray springRate;
    LaneArray anglePush;
    LaneArray angleDrag;
    LaneArray angleLag;
    // As the bodies stand.
    LaneArray springPush;
    LaneArray springDrag;
    LaneArray springLag;
    LaneArray pushX;  ///< impulse of the spring of the point
    LaneArray pushY;
    // Accumulated.
    LaneArray impulseX;
    LaneArray impulseY;
    LaneArray angularImpulse;
    LaneArray totalX;
    LaneArray totalY;
    LaneArray totalTwist;
};

using WeldKernels = JointKernels<WideWeld>;

/// Null where there are none, see `contactKernels`.
const WeldKernels* weldKernels();

}  // namespace swept::inline SWEPT_PRECISION

#include <algorithm>
#include <cmath>

#include "../closeness.h"
#include "direct_parts.h"
#include "direct_solver.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Weaker than where speeds are solved: rows that contradict each other (a card wedged between planks) must give.
constexpr double kProjectionStrength = 1.0 / 4;
/// Friction holds with this part of that. What sticks has more rows than there are ways to move in any heap, so gaps
/// that were closed without a slip grew smaller by a hundredth a step: of heaps of 20 to 256 boxes, discs and capsules
/// that came to rest most were solved in every step of the next minutes, instead of being held.
constexpr double kTangentShare = 1.0 / 256;
/// Part of an overlap or gap that a projection closes.
constexpr Real kProjectionRate = Real(1) / 4;
/// Of many bodies, where each step of it costs a search. (With all of it at once, the first impulses took longer to
/// find.)
constexpr Real kProjectionRateOfPatient = Real(1) / 2;
/// Separations beyond this part of the distance to the centre of mass of the nearer body that can be moved are closed
/// within the step, smaller ones at its end. (With the farther one, static or not, bodies on ground that began ten
/// metres away were left with gaps that kept them from being held, and were solved in every step.)
constexpr Real kLargeRatio = Real(1) / 8192;
constexpr Real kSmallRatio = Real(1) / (1 << 20);
/// Of many bodies: 1275 boxes side by side took 60 more steps, 25 ms each, to come down to the other one.
constexpr Real kSmallRatioOfPatient = Real(1) / (1 << 14);

/// How far apart a point may stay, metres.
Real toleranceAt(const ContactConstraintPoint& point, bool movesA, bool movesB, Real ratio) {
    const Real a = length(point.anchorA);
    const Real b = length(point.anchorB);
    const Real lever = movesA && movesB ? std::min(a, b) : (movesA ? a : b);
    return std::max(ratio * lever, separationRounding(point.anchorA, point.anchorB));
}

bool isStuck(const ContactConstraint& contact, const ContactConstraintPoint& point) {
    return std::fabs(point.tangentImpulse) < contact.friction * point.normalImpulse;
}

}  // namespace

bool DirectSolver::gatherOverlaps(const SolverBatch& batch, Real h, bool isLast) {
    const Real rate = isPatient_ ? kProjectionRateOfPatient : kProjectionRate;
    const Real smallRatio = isPatient_ ? kSmallRatioOfPatient : kSmallRatio;
    bool anyLarge = false;
    for (ContactPoint& contact : contacts_) {
        const ContactConstraint& constraint = *contact.contact;
        const ContactConstraintPoint& point = *contact.point;
        const Real separation =
            currentSeparation(constraint, point, batch.states[constraint.slotA], batch.states[constraint.slotB]);
        const bool presses = point.normalImpulse > 0 || separation < 0;
        const Real tolerance = toleranceAt(point, nodeOf_[constraint.slotA] != kNoNode,
                                           nodeOf_[constraint.slotB] != kNoNode, isLast ? smallRatio : kLargeRatio);
        anyLarge = anyLarge || (presses && std::fabs(separation) > tolerance);
        contact.normalHold = presses ? Hold::held : Hold::free;
        contact.tangentHold = presses && isStuck(constraint, point) ? Hold::held : Hold::free;
        contact.normal.excess = static_cast<double>(std::max(rate * separation, -constraint.maxPushSpeed * h));
        contact.tangent.excess = contact.normal.guess = contact.tangent.guess = 0;
    }
    return anyLarge;
}

void DirectSolver::moveBodies(SolverBatch& batch) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        BodyState& state = batch.states[nodes_[i].slot];
        state.deltaPosition += {static_cast<Real>(change_[i][0]), static_cast<Real>(change_[i][1])};
        state.deltaAngle += static_cast<Real>(change_[i][2]);
        state.deltaRotation = rotationFromAngle(static_cast<double>(state.deltaAngle));
    }
}

template <bool kJoints>
void DirectSolver::project(SolverBatch& batch, Real h, bool always, DirectReport& report) {
    if (contacts_.empty() || !gatherOverlaps(batch, h, always)) { return; }
    if constexpr (kJoints) { gatherJoints(batch, h, false, true); }
    strength_ = kProjectionStrength;
    assemble<kJoints>(report, kTangentShare);
    computeChange<kJoints>();
    isFactorised_ = false;
    dropNoise();
    moveBodies(batch);
}

template void DirectSolver::project<false>(SolverBatch&, Real, bool, DirectReport&);
template void DirectSolver::project<true>(SolverBatch&, Real, bool, DirectReport&);

}  // namespace swept::inline SWEPT_PRECISION

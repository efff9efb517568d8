#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../joints/joint_rows.h"
#include "../solver_batch.h"

namespace swept::inline SWEPT_PRECISION {

/// One scalar row that the direct solver brings to a speed of −bias, and where its accumulated impulse is kept.
struct DirectRow {
    JointRow row;
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Real bias = 0;            ///< m/s or rad/s
    Real* impulse = nullptr;  ///< accumulated, N·s or N·m·s
};

/// A motor: brings its row to a speed as long as its impulse stays within a limit.
struct MotorRow {
    DirectRow held;         ///< bias: minus the speed that is wanted
    Real most = 0;          ///< of the impulse of a sub-step, to either side
    bool hasOther = false;  ///< the next row is the other direction of its point: the limit is that of both together
    bool isOfMotorJoint = false;
};

/// How a body moves.
struct Motion {
    Vec2 velocity{};  ///< m/s
    Real spin = 0;    ///< rad/s
};

/// Rows that joints hold rigidly, kind by kind: points, angles, rods. Springs and limits are not among them, nor gears
/// and pulleys: those are left to iteration.
/// @param motions  by slot, by which it is told how anchors bend away within the sub-step; empty: those of the states
/// @param closing  s, at least h: within which errors are closed
/// @param useBias  towards zero errors at the end of the sub-step; false: rest, or the pace of a rod
/// @pre the batch keeps its arrays while the rows are in use
void addJointRows(SolverBatch& batch, std::span<const Motion> motions, Real h, Real closing, bool useBias,
                  std::vector<DirectRow>& rows);

/// Motors of hinges, sliders and wheels, and motor joints that are held (`JointConstraint::isDriveHeld`).
/// @param isFirst  of the sub-step: what seeks a pose finds its speed. @pre likewise
void addMotorRows(SolverBatch& batch, Real h, bool isFirst, std::vector<MotorRow>& rows);

/// Calls `visit` with the array of each kind of joint that may have such rows.
template <class Batch, class Visit>
void forEachHeldKind(Batch& batch, Visit&& visit) {
    visit(batch.revolutes);
    visit(batch.distances);
    visit(batch.prismatics);
    visit(batch.wheels);
    visit(batch.welds);
}

}  // namespace swept::inline SWEPT_PRECISION

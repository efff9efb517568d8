#include <algorithm>
#include <cmath>

#include "direct_parts.h"
#include "direct_solver.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounds in which motors may be held again that were taken to push as hard as they may. After them each round lets go
/// of one or ends, so that there is an end.
constexpr int kRoundsToHold = 1;

/// Whether joints have anything that is left to iteration, but for motors.
bool isAnyIterated(const SolverBatch& batch) {
    if (!batch.motors.empty() || !batch.mice.empty() || !batch.gears.empty() || !batch.pulleys.empty()) { return true; }
    const auto isIterated = [](const FreedomParts& parts) { return parts.hasSpring || parts.hasLimits; };
    return std::any_of(batch.revolutes.begin(), batch.revolutes.end(), isIterated) ||
           std::any_of(batch.prismatics.begin(), batch.prismatics.end(), isIterated) ||
           std::any_of(batch.wheels.begin(), batch.wheels.end(),
                       [&](const WheelConstraint& joint) { return isIterated(joint.suspension); }) ||
           std::any_of(batch.distances.begin(), batch.distances.end(),
                       [](const DistanceConstraint& joint) { return !joint.isRigid; }) ||
           std::any_of(batch.welds.begin(), batch.welds.end(),
                       [](const WeldConstraint& joint) { return joint.hasLinearSpring || joint.hasAngularSpring; });
}

}  // namespace

/// A sub-step solves for its drives twice, each time for half of them. A motor is expected to give half of what the
/// sub-step before ended with, and then as much again: what holds at rest is found without the speed by which dampers
/// give way. (By the whole, braked arms rose by millimetres a second: at rest nothing closes what has turned.) It may
/// use half of its strength in the first half, so that what its strength does not hold moves as under a force.
void DirectSolver::gatherDrives(SolverBatch& batch, bool useBias) {
    drives_.clear();
    isFirstHalf_ = useBias;
    if (!holdsDrives(scope_)) { return; }
    drivenRows_.clear();
    addDrivenRows(batch, drivenRows_);
    const std::vector<std::int8_t>& ways = forced_[useBias ? 0 : 1];
    for (const DrivenRow& driven : drivenRows_) {
        Drive drive{.row = rowOf(batch, driven.held), .held = driven.held};
        if (!(drive.row.strength > 0)) { continue; }
        drive.before = static_cast<double>(*drive.held.impulse);
        drive.most = (useBias ? 0.5 : 1.0) * static_cast<double>(driven.most);
        const double expected = (useBias ? 0.5 : 2.0) * drive.before;
        drive.row.guess = std::clamp(expected, -drive.most, drive.most);
        drive.row.excess = excessOf(batch, driven.held);
        drive.row.impulse = drive.row.guess;
        drive.hold = std::fabs(expected) < drive.most ? Hold::held : Hold::forced;
        if (drives_.size() < ways.size()) {
            const std::int8_t way = ways[drives_.size()];
            drive.hold = way == 0 ? Hold::held : Hold::forced;
            if (way != 0) { drive.row.impulse = way * drive.most; }
        }
        drives_.push_back(drive);
    }
}

/// What its damper says at `change_`.
double DirectSolver::driveOf(const Drive& drive) const {
    return drive.row.guess - strength_ * drive.row.strength * changedExcess(drive.row);
}

/// @param mayHold  what was forced may be held again
/// @return whether anything is held otherwise than before
bool DirectSolver::classifyDrives(bool mayHold) {
    bool changed = false;
    for (Drive& drive : drives_) {
        const double pull = driveOf(drive);
        const bool isWithin = std::fabs(pull) < drive.most;
        if (drive.hold == Hold::held && !isWithin) {
            drive.hold = Hold::forced;
            drive.row.impulse = std::copysign(drive.most, pull);
            changed = true;
        } else if (drive.hold == Hold::forced && mayHold && !(pull * drive.row.impulse >= 0 && !isWithin)) {
            drive.hold = Hold::held;
            changed = true;
        }
    }
    return changed;
}

/// From the first solution on, until motors stay within their limits.
void DirectSolver::searchDrives(DirectReport& report) {
    if (drives_.empty()) { return; }
    for (int round = 0; classifyDrives(round < kRoundsToHold); ++round) {
        assemble<true>(report);
        computeChange<true>();
    }
    std::vector<std::int8_t>& ways = forced_[isFirstHalf_ ? 0 : 1];
    ways.clear();
    for (const Drive& drive : drives_) {
        const int way = drive.row.impulse < 0 ? -1 : 1;
        ways.push_back(static_cast<std::int8_t>(drive.hold == Hold::forced ? way : 0));
    }
}

/// Likewise, when its row was right before: what the change of speeds asks for.
double DirectSolver::pullOf(const Drive& drive) const {
    return drive.before - strength_ * drive.row.strength * (changedExcess(drive.row) - drive.row.excess);
}

/// Of scope `jointed`. @return whether contacts ask for more than some motor has
bool DirectSolver::letGoDrives() {
    bool changed = false;
    for (Drive& drive : drives_) {
        if (drive.hold != Hold::held) { continue; }
        const double pull = pullOf(drive);
        if (!(std::fabs(pull) > drive.most)) { continue; }
        drive.hold = Hold::forced;
        drive.row.impulse = std::copysign(drive.most, pull);
        changed = true;
    }
    return changed;
}

/// What motors change that push as hard as they may.
void DirectSolver::pushForced() {
    bool isPushed = false;
    for (const Drive& drive : drives_) {
        if (drive.hold != Hold::forced || drive.row.impulse == drive.before) { continue; }
        push(drive.row, drive.row.impulse - drive.before);
        isPushed = true;
    }
    if (isPushed) { matrix_.solve(change_); }
}

void DirectSolver::holdAgain(SolverBatch& batch, DirectReport& report) {
    // Where there are contacts, they have the last word.
    if (drives_.empty() || !batch.contacts.empty() || !isAnyIterated(batch)) { return; }
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        joints_[i].row.excess = excessOf(batch, jointRows_[i]);
        joints_[i].forgotten = 0;
    }
    for (Drive& drive : drives_) {
        drive.before = drive.row.guess = static_cast<double>(*drive.held.impulse);
        drive.row.excess = excessOf(batch, drive.held);
    }
    computeChange<true>();
    while (classifyDrives(false)) {
        assemble<true>(report);
        computeChange<true>();
    }
    applyToImpulses<true>();
    dropNoise();
    applyToBodies(batch);
}

}  // namespace swept::inline SWEPT_PRECISION

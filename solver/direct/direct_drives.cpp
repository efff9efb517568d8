#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "direct_parts.h"
#include "direct_solver.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounds in which motors may be held again that were taken to push as hard as they may. After them each round lets go
/// of one or ends, so that there is an end.
constexpr int kRoundsToHold = 1;

/// Rounds in which what drives a point may find out how it pushes; and the part of its limit by which it may be off.
/// (It is a damper that is cut off at a length, a convex function like the rest, and Newton's method takes two or
/// three.)
constexpr int kRoundsOfPoint = 8;
constexpr double kSmallTurn = 1.0 / 4096;

/// Whether joints have anything that is left to iteration, but for motors.
bool isAnyIterated(const SolverBatch& batch) {
    if (!batch.mice.empty() || !batch.gears.empty() || !batch.pulleys.empty()) { return true; }
    const auto isLeft = [](const MotorConstraint& joint) { return !joint.isDriveHeld; };
    if (std::any_of(batch.motors.begin(), batch.motors.end(), isLeft)) { return true; }
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

using Push2 = std::array<double, 2>;

double dotOf(const Push2& a, const Push2& b) { return a[0] * b[0] + a[1] * b[1]; }
double sizeOf(const Push2& push) { return push[1] == 0 ? std::fabs(push[0]) : std::sqrt(dotOf(push, push)); }
/// Of zero: any.
Push2 unitOf(const Push2& push) {
    const double size = sizeOf(push);
    return push[1] == 0 ? Push2{std::copysign(1.0, push[0]), 0} : Push2{push[0] / size, push[1] / size};
}
Push2 times(double factor, const Push2& push) { return {factor * push[0], factor * push[1]}; }
Push2 across(const Push2& unit) { return {-unit[1], unit[0]}; }

}  // namespace

/// Bodies that motor joints tie to others are part of the solve. Where one joint has its bodies for itself, iteration
/// has nothing to bring together (a thousand cars seen from above, each rubbing on the ground).
void DirectSolver::tieMotors(const SolverBatch& batch, std::uint32_t tied) {
    const std::uint32_t once = tied + 1;
    for (const MotorConstraint& joint : batch.motors) {
        for (const BodySlot slot : bodySlots(joint)) {
            if (isMovable(batch.inertias[slot])) { nodeOf_[slot] = nodeOf_[slot] == kNoNode ? once : tied; }
        }
    }
    for (const MotorConstraint& joint : batch.motors) {
        const auto isTied = [&](BodySlot slot) { return isMovable(batch.inertias[slot]) && nodeOf_[slot] == tied; };
        if (isTied(joint.slotA) || isTied(joint.slotB)) { nodeOf_[joint.slotA] = nodeOf_[joint.slotB] = tied; }
    }
}

void DirectSolver::markDrives(SolverBatch& batch) const {
    const bool areHeld = holdsDrives(scope_);
    batch.forEachJointKind([&](auto& joints) {
        for (auto& joint : joints) {
            const bool isTied = nodeOf_[joint.slotA] != kNoNode || nodeOf_[joint.slotB] != kNoNode;
            joint.isDriveHeld = areHeld && isTied;
        }
    });
}

/// A sub-step solves for its drives twice, each time for half of them. A motor is expected to give half of what the
/// sub-step before ended with, and then as much again: what holds at rest is found without the speed by which dampers
/// give way. (By the whole, braked arms rose by millimetres a second: at rest nothing closes what has turned.) It may
/// use half of its strength in the first half, so that what its strength does not hold moves as under a force.
///
/// A motor joint may drive what other joints hold anyway, and must not be made to work against them: it is expected to
/// give in the end what it gave before. (With twice what the first half found, a point drive beside a hinge grew by an
/// eighth in each sub-step, and what it drove crept by 2 mm/s.)
void DirectSolver::gatherDrives(SolverBatch& batch, Real h, bool useBias) {
    drives_.clear();
    isFirstHalf_ = useBias;
    if (!holdsDrives(scope_)) { return; }
    motorRows_.clear();
    addMotorRows(batch, h, useBias, motorRows_);
    bool continues = false;
    for (const MotorRow& motor : motorRows_) {
        DriveRow row{.row = rowOf(batch, motor.held), .held = motor.held};
        if (!(row.row.strength > 0)) {
            continues = false;
            continue;
        }
        row.before = static_cast<double>(*row.held.impulse);
        row.row.excess = excessOf(batch, motor.held);
        if (continues) {
            // Of one strength, or a push at its limit would pull to a side.
            Drive& drive = drives_.back();
            Row& first = drive.rows[0].row;
            first.strength = row.row.strength = std::min(first.strength, row.row.strength);
            drive.rows[drive.count++] = row;
        } else {
            Drive& drive = drives_.emplace_back();
            drive.rows[0] = row;
            drive.most = (useBias ? 0.5 : 1.0) * static_cast<double>(motor.most);
            drive.isPatient = motor.isOfMotorJoint;
        }
        continues = motor.hasOther;
    }
    expectDrives();
}

void DirectSolver::expectDrives() {
    const std::vector<DriveMemory>& remembered = remembered_[isFirstHalf_ ? 0 : 1];
    if (isFirstHalf_) { ended_.clear(); }
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        Drive& drive = drives_[i];
        const DrivePush before{drive.rows[0].before, drive.count > 1 ? drive.rows[1].before : 0};
        if (isFirstHalf_) { ended_.push_back(before); }
        const bool isPatient = !isFirstHalf_ && drive.isPatient;
        const DrivePush expected = isPatient ? ended_[i] : times(isFirstHalf_ ? 0.5 : 2.0, before);
        const bool isWithin = sizeOf(expected) < drive.most;
        const DrivePush guess = isWithin ? expected : times(drive.most, unitOf(expected));
        for (std::size_t k = 0; k < drive.count; ++k) { drive.rows[k].row.guess = guess[k]; }
        drive.hold = isWithin ? Hold::held : Hold::forced;
        drive.along = unitOf(expected);
        if (i >= remembered.size()) { continue; }
        drive.hold = remembered[i].hold;
        drive.along = remembered[i].along;
        drive.share = remembered[i].share;
    }
}

/// Speeds that are too much, at `change_`.
DirectSolver::DrivePush DirectSolver::excessesOf(const Drive& drive) const {
    return {changedExcess(drive.rows[0].row), drive.count > 1 ? changedExcess(drive.rows[1].row) : 0};
}

/// What its dampers say.
DirectSolver::DrivePush DirectSolver::pullAt(const Drive& drive, const DrivePush& excess) const {
    DrivePush pull{};
    for (std::size_t i = 0; i < drive.count; ++i) {
        const Row& row = drive.rows[i].row;
        pull[i] = row.guess - strength_ * row.strength * excess[i];
    }
    return pull;
}

/// What it gives: all of that, or where that is cut off, how it would turn.
DirectSolver::DrivePush DirectSolver::impulseAt(const Drive& drive, const DrivePush& excess) const {
    if (drive.hold == Hold::held) { return pullAt(drive, excess); }
    const DrivePush most = times(drive.most, drive.along);
    if (drive.count < 2) { return most; }
    const DrivePush aside = across(drive.along);
    const double turn = drive.share * dotOf(aside, pullAt(drive, excess));
    return {most[0] + turn * aside[0], most[1] + turn * aside[1]};
}

void DirectSolver::assembleDrives() {
    for (const Drive& drive : drives_) {
        if (drive.hold == Hold::held) {
            for (const DriveRow& row : drive.all()) { addToMatrix(row.row); }
        } else if (drive.count > 1) {
            const DrivePush aside = across(drive.along);
            Row row = drive.rows[0].row;
            const Row& other = drive.rows[1].row;
            for (std::size_t k = 0; k < 3; ++k) {
                row.ofA[k] = aside[0] * row.ofA[k] + aside[1] * other.ofA[k];
                row.ofB[k] = aside[0] * row.ofB[k] + aside[1] * other.ofB[k];
            }
            addToMatrix(row, drive.share);
        }
    }
}

/// Beyond what is applied.
void DirectSolver::pushDrives() {
    for (const Drive& drive : drives_) {
        const DrivePush excess{drive.rows[0].row.excess, drive.count > 1 ? drive.rows[1].row.excess : 0};
        const DrivePush impulse = impulseAt(drive, excess);
        for (std::size_t i = 0; i < drive.count; ++i) { push(drive.rows[i].row, impulse[i] - drive.rows[i].before); }
    }
}

void DirectSolver::writeDrives() {
    for (const Drive& drive : drives_) {
        const DrivePush impulse = impulseAt(drive, excessesOf(drive));
        for (std::size_t i = 0; i < drive.count; ++i) { *drive.rows[i].held.impulse = static_cast<Real>(impulse[i]); }
    }
}

/// @return whether it is held otherwise than before, or pushes another way
bool DirectSolver::classifyDrive(Drive& drive, int round) const {
    const DrivePush excess = excessesOf(drive);
    const DrivePush pull = pullAt(drive, excess);
    const double size = sizeOf(pull);
    const bool isWithin = size < drive.most;
    if (drive.hold == Hold::held) {
        if (isWithin) { return false; }
        drive.hold = Hold::forced;
        drive.along = unitOf(pull);
        drive.share = size > 0 ? drive.most / size : 0;
        return true;
    }
    if (drive.count < 2) {
        const bool isForced = round >= kRoundsToHold || (pull[0] * drive.along[0] >= 0 && !isWithin);
        drive.hold = isForced ? Hold::forced : Hold::held;
        return !isForced;
    }
    if (round >= kRoundsOfPoint) { return false; }
    if (isWithin) {
        drive.hold = Hold::held;
        return true;
    }
    const DrivePush given = impulseAt(drive, excess);
    const DrivePush along = unitOf(pull);
    const DrivePush off{given[0] - drive.most * along[0], given[1] - drive.most * along[1]};
    if (sizeOf(off) <= kSmallTurn * drive.most) { return false; }
    drive.along = along;
    drive.share = drive.most / size;
    return true;
}

bool DirectSolver::classifyDrives(int round) {
    bool changed = false;
    for (Drive& drive : drives_) { changed = classifyDrive(drive, round) || changed; }
    return changed;
}

/// From the first solution on, until motors stay within their limits.
void DirectSolver::searchDrives(DirectReport& report) {
    if (drives_.empty()) { return; }
    for (int round = 0; classifyDrives(round); ++round) {
        assemble<true>(report);
        computeChange<true>();
    }
    std::vector<DriveMemory>& remembered = remembered_[isFirstHalf_ ? 0 : 1];
    remembered.clear();
    for (const Drive& drive : drives_) { remembered.push_back({drive.hold, drive.along, drive.share}); }
}

/// What there is now is right: of it only changes are found.
void DirectSolver::takeUpDrives(const SolverBatch& batch) {
    for (Drive& drive : drives_) {
        for (DriveRow& row : drive.all()) {
            row.before = row.row.guess = static_cast<double>(*row.held.impulse);
            row.row.excess = excessOf(batch, row.held);
        }
        drive.given = {drive.rows[0].before, drive.count > 1 ? drive.rows[1].before : 0};
    }
}

/// Likewise, after `takeUpDrives`: what the change of speeds asks for.
DirectSolver::DrivePush DirectSolver::laterImpulseOf(const Drive& drive) const {
    DrivePush excess = excessesOf(drive);
    for (std::size_t i = 0; i < drive.count; ++i) { excess[i] -= drive.rows[i].row.excess; }
    const DrivePush pull = pullAt(drive, excess);
    if (drive.hold == Hold::held) { return pull; }
    if (drive.count < 2) { return drive.given; }
    const DrivePush aside = across(drive.along);
    const DrivePush change{pull[0] - drive.rows[0].before, pull[1] - drive.rows[1].before};
    const double turn = drive.share * dotOf(aside, change);
    return {drive.given[0] + turn * aside[0], drive.given[1] + turn * aside[1]};
}

/// Of scope `jointed`. @return whether contacts ask for more than some motor has
bool DirectSolver::letGoDrives() {
    bool changed = false;
    for (Drive& drive : drives_) {
        if (drive.hold != Hold::held) { continue; }
        const DrivePush pull = laterImpulseOf(drive);
        if (!(sizeOf(pull) > drive.most)) { continue; }
        drive.hold = Hold::forced;
        drive.along = unitOf(pull);
        drive.share = 0;
        drive.given = times(drive.most, drive.along);
        changed = true;
    }
    return changed;
}

/// What motors change that push as hard as they may.
void DirectSolver::pushForced() {
    bool isPushed = false;
    for (const Drive& drive : drives_) {
        if (drive.hold != Hold::forced) { continue; }
        for (std::size_t i = 0; i < drive.count; ++i) {
            const double change = drive.given[i] - drive.rows[i].before;
            if (change == 0) { continue; }
            push(drive.rows[i].row, change);
            isPushed = true;
        }
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
    takeUpDrives(batch);
    computeChange<true>();
    for (int round = kRoundsToHold; classifyDrives(round); ++round) {
        assemble<true>(report);
        computeChange<true>();
    }
    applyToImpulses<true>();
    dropNoise();
    applyToBodies(batch);
}

}  // namespace swept::inline SWEPT_PRECISION

#include "direct_drives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

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

void DirectDrives::tieBodies(const SolverBatch& batch, std::span<BodyTie> ties) {
    for (const MotorConstraint& joint : batch.motors) {
        for (const BodySlot slot : bodySlots(joint)) {
            if (!isMovable(batch.inertias[slot])) { continue; }
            ties[slot] = ties[slot] == BodyTie::none ? BodyTie::once : BodyTie::tied;
        }
    }
    for (const MotorConstraint& joint : batch.motors) {
        const auto isTied = [&](BodySlot slot) {
            return isMovable(batch.inertias[slot]) && ties[slot] == BodyTie::tied;
        };
        if (isTied(joint.slotA) || isTied(joint.slotB)) { ties[joint.slotA] = ties[joint.slotB] = BodyTie::tied; }
    }
}

void DirectDrives::mark(SolverBatch& batch, const DirectSystem& system, bool areHeld) {
    batch.forEachJointKind([&](auto& joints) {
        for (auto& joint : joints) {
            const bool isTied = system.nodeOf(joint.slotA) != kNoNode || system.nodeOf(joint.slotB) != kNoNode;
            joint.isDriveHeld = areHeld && isTied;
        }
    });
}

void DirectDrives::begin(bool isWhole) {
    isWhole_ = isWhole;
    drives_.clear();
    for (std::vector<Memory>& drives : remembered_) { drives.clear(); }
}

/// A sub-step solves for its drives twice, each time for half of them. A motor is expected to give half of what the
/// sub-step before ended with, and then as much again: what holds at rest is found without the speed by which dampers
/// give way. (By the whole, braked arms rose by millimetres a second: at rest nothing closes what has turned.) It may
/// use half of its strength in the first half, so that what its strength does not hold moves as under a force.
///
/// A motor joint may drive what other joints hold anyway, and must not be made to work against them: it is expected to
/// give in the end what it gave before. (With twice what the first half found, a point drive beside a hinge grew by an
/// eighth in each sub-step, and what it drove crept by 2 mm/s.)
///
/// Where all of the drive comes before the motion both solves are for all of it, and begin with what there is.
void DirectDrives::gather(SolverBatch& batch, DirectSystem& system, Real h, bool useBias) {
    drives_.clear();
    isFirstHalf_ = useBias;
    rows_.clear();
    addMotorRows(batch, h, useBias, rows_);
    bool continues = false;
    for (const MotorRow& motor : rows_) {
        DriveRow row{.row = system.rowOf(batch.inertias, motor.held), .held = motor.held};
        if (!(row.row.strength > 0)) {
            continues = false;
            continue;
        }
        row.before = static_cast<double>(*row.held.impulse);
        row.row.excess = DirectSystem::excessOf(batch.states, motor.held);
        if (continues) {
            // Of one strength, or a push at its limit would pull to a side.
            Drive& drive = drives_.back();
            SystemRow& first = drive.rows[0].row;
            first.strength = row.row.strength = std::min(first.strength, row.row.strength);
            drive.rows[drive.count++] = row;
        } else {
            Drive& drive = drives_.emplace_back();
            drive.rows[0] = row;
            drive.most = (useBias && !isWhole_ ? 0.5 : 1.0) * static_cast<double>(motor.most);
            drive.keepsLastPush = motor.isOfMotorJoint;
        }
        continues = motor.hasOther;
    }
    expect();
}

void DirectDrives::expect() {
    const std::vector<Memory>& remembered = remembered_[isFirstHalf_ ? 0 : 1];
    if (isFirstHalf_) { ended_.clear(); }
    const double share = isFirstHalf_ ? 0.5 : 2.0;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        Drive& drive = drives_[i];
        const Push before{drive.rows[0].before, drive.count > 1 ? drive.rows[1].before : 0};
        if (isFirstHalf_) { ended_.push_back(before); }
        const bool keepsLastPush = !isFirstHalf_ && drive.keepsLastPush;
        const Push expected = keepsLastPush ? ended_[i] : times(isWhole_ ? 1.0 : share, before);
        const bool isWithin = sizeOf(expected) < drive.most;
        const Push guess = isWithin ? expected : times(drive.most, unitOf(expected));
        for (std::size_t k = 0; k < drive.count; ++k) { drive.rows[k].row.guess = guess[k]; }
        drive.hold = isWithin ? Hold::held : Hold::forced;
        drive.along = unitOf(expected);
        if (i >= remembered.size()) { continue; }
        drive.hold = remembered[i].hold;
        drive.along = remembered[i].along;
        drive.share = remembered[i].share;
    }
}

/// Speeds that are too much, after the change.
DirectDrives::Push DirectDrives::excessesOf(const DirectSystem& system, const Drive& drive) {
    return {system.changedExcess(drive.rows[0].row), drive.count > 1 ? system.changedExcess(drive.rows[1].row) : 0};
}

/// What its dampers say.
DirectDrives::Push DirectDrives::pullAt(const DirectSystem& system, const Drive& drive, const Push& excess) {
    Push pull{};
    for (std::size_t i = 0; i < drive.count; ++i) {
        const SystemRow& row = drive.rows[i].row;
        pull[i] = system.pullOf(row, excess[i]);
    }
    return pull;
}

/// What it gives: all of that, or where that is cut off, how it would turn.
DirectDrives::Push DirectDrives::impulseAt(const DirectSystem& system, const Drive& drive, const Push& excess) {
    if (drive.hold == Hold::held) { return pullAt(system, drive, excess); }
    const Push most = times(drive.most, drive.along);
    if (drive.count < 2) { return most; }
    const Push aside = across(drive.along);
    const double turn = drive.share * dotOf(aside, pullAt(system, drive, excess));
    return {most[0] + turn * aside[0], most[1] + turn * aside[1]};
}

void DirectDrives::addTo(DirectSystem& system) const {
    for (const Drive& drive : drives_) {
        if (drive.hold == Hold::held) {
            for (const DriveRow& row : drive.all()) { system.add(row.row); }
        } else if (drive.count > 1) {
            const Push aside = across(drive.along);
            SystemRow row = drive.rows[0].row;
            const SystemRow& other = drive.rows[1].row;
            for (std::size_t k = 0; k < 3; ++k) {
                row.ofA[k] = aside[0] * row.ofA[k] + aside[1] * other.ofA[k];
                row.ofB[k] = aside[0] * row.ofB[k] + aside[1] * other.ofB[k];
            }
            system.add(row, drive.share);
        }
    }
}

/// Beyond what is applied.
void DirectDrives::push(DirectSystem& system) const {
    for (const Drive& drive : drives_) {
        const Push excess{drive.rows[0].row.excess, drive.count > 1 ? drive.rows[1].row.excess : 0};
        const Push impulse = impulseAt(system, drive, excess);
        for (std::size_t i = 0; i < drive.count; ++i) {
            system.push(drive.rows[i].row, impulse[i] - drive.rows[i].before);
        }
    }
}

void DirectDrives::write(const DirectSystem& system) {
    for (const Drive& drive : drives_) {
        const Push impulse = impulseAt(system, drive, excessesOf(system, drive));
        for (std::size_t i = 0; i < drive.count; ++i) { *drive.rows[i].held.impulse = static_cast<Real>(impulse[i]); }
    }
}

/// @return whether it is held otherwise than before, or pushes another way
bool DirectDrives::classify(const DirectSystem& system, Drive& drive, int round) {
    const Push excess = excessesOf(system, drive);
    const Push pull = pullAt(system, drive, excess);
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
    const Push given = impulseAt(system, drive, excess);
    const Push along = unitOf(pull);
    const Push off{given[0] - drive.most * along[0], given[1] - drive.most * along[1]};
    if (sizeOf(off) <= kSmallTurn * drive.most) { return false; }
    drive.along = along;
    drive.share = drive.most / size;
    return true;
}

bool DirectDrives::classifyAll(const DirectSystem& system, int round) {
    bool changed = false;
    for (Drive& drive : drives_) { changed = classify(system, drive, round) || changed; }
    return changed;
}

void DirectDrives::assemble(DirectSystem& system, const DirectJoints& joints, DirectReport& report) const {
    system.beginMatrix();
    joints.addTo(system);
    addTo(system);
    system.factorise();
    ++report.factorisations;
}

void DirectDrives::computeChange(DirectSystem& system, const DirectJoints& joints) const {
    system.beginChange();
    joints.push(system);
    push(system);
    system.solve();
}

void DirectDrives::search(DirectSystem& system, const DirectJoints& joints, DirectReport& report) {
    if (drives_.empty()) { return; }
    for (int round = 0; classifyAll(system, round); ++round) {
        assemble(system, joints, report);
        computeChange(system, joints);
    }
    std::vector<Memory>& remembered = remembered_[isFirstHalf_ ? 0 : 1];
    remembered.clear();
    for (const Drive& drive : drives_) { remembered.push_back({drive.hold, drive.along, drive.share}); }
}

void DirectDrives::searchAgain(DirectSystem& system, const DirectJoints& joints, DirectReport& report) {
    computeChange(system, joints);
    for (int round = kRoundsToHold; classifyAll(system, round); ++round) {
        assemble(system, joints, report);
        computeChange(system, joints);
    }
}

void DirectDrives::takeUp(std::span<const BodyState> states) {
    for (Drive& drive : drives_) {
        for (DriveRow& row : drive.all()) {
            row.before = row.row.guess = static_cast<double>(*row.held.impulse);
            row.row.excess = DirectSystem::excessOf(states, row.held);
        }
        drive.given = {drive.rows[0].before, drive.count > 1 ? drive.rows[1].before : 0};
    }
}

/// What the change of speeds asks for, after `takeUp`.
DirectDrives::Push DirectDrives::laterImpulseOf(const DirectSystem& system, const Drive& drive) {
    Push excess = excessesOf(system, drive);
    for (std::size_t i = 0; i < drive.count; ++i) { excess[i] -= drive.rows[i].row.excess; }
    const Push pull = pullAt(system, drive, excess);
    if (drive.hold == Hold::held) { return pull; }
    if (drive.count < 2) { return drive.given; }
    const Push aside = across(drive.along);
    const Push change{pull[0] - drive.rows[0].before, pull[1] - drive.rows[1].before};
    const double turn = drive.share * dotOf(aside, change);
    return {drive.given[0] + turn * aside[0], drive.given[1] + turn * aside[1]};
}

bool DirectDrives::letGo(const DirectSystem& system) {
    bool changed = false;
    for (Drive& drive : drives_) {
        if (drive.hold != Hold::held) { continue; }
        const Push pull = laterImpulseOf(system, drive);
        if (!(sizeOf(pull) > drive.most)) { continue; }
        drive.hold = Hold::forced;
        drive.along = unitOf(pull);
        drive.share = 0;
        drive.given = times(drive.most, drive.along);
        changed = true;
    }
    return changed;
}

void DirectDrives::pushForced(DirectSystem& system) const {
    bool isPushed = false;
    for (const Drive& drive : drives_) {
        if (drive.hold != Hold::forced) { continue; }
        for (std::size_t i = 0; i < drive.count; ++i) {
            const double change = drive.given[i] - drive.rows[i].before;
            if (change == 0) { continue; }
            system.push(drive.rows[i].row, change);
            isPushed = true;
        }
    }
    if (isPushed) { system.solve(); }
}

void DirectDrives::writeLater(const DirectSystem& system) {
    for (const Drive& drive : drives_) {
        const Push impulse = laterImpulseOf(system, drive);
        for (std::size_t i = 0; i < drive.count; ++i) { *drive.rows[i].held.impulse = static_cast<Real>(impulse[i]); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

#include "direct_joints.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of what joints carry, this part is to be found again in each solve: an error of 1/64 over their strength, 10⁻⁶. Two
/// joints that hold the same against a motor would else work against each other more and more, each solve by what the
/// motor gave: a weld and a slider went from 1 to 1350 N·m·s in a third of a second, and flew apart.
constexpr double kForgottenPart = 1.0 / 64;

void addUp(Real* impulse, double change) { *impulse = static_cast<Real>(static_cast<double>(*impulse) + change); }

}  // namespace

void DirectJoints::begin() {
    motions_.clear();
    joints_.clear();
    ties_.begin();
}

void DirectJoints::noteMotions(std::span<const BodyState> states) {
    motions_.clear();
    for (const BodyState& state : states) { motions_.push_back({state.velocity, state.angularVelocity}); }
}

void DirectJoints::listRows(SolverBatch& batch, Real h, bool useBias) {
    rows_.clear();
    addJointRows(batch, motions_, h, std::max(h, leastClosing_), useBias, rows_);
    joints_.clear();
}

SystemRow DirectJoints::rowOf(std::span<const BodyInertia> inertias, DirectSystem& system,
                              const DirectRow& held) const {
    SystemRow row = system.rowOf(inertias, held);
    ties_.stiffen(system, inertias, held, row);
    return row;
}

void DirectJoints::gather(SolverBatch& batch, DirectSystem& system, Real h, bool useBias) {
    listRows(batch, h, useBias);
    for (const DirectRow& held : rows_) {
        SystemRow row = rowOf(batch.inertias, system, held);
        row.excess = DirectSystem::excessOf(batch.states, held);
        joints_.push_back({row, held.impulse, kForgottenPart * static_cast<double>(*held.impulse)});
    }
}

void DirectJoints::gatherAtRest(SolverBatch& batch, DirectSystem& system, Real h) {
    listRows(batch, h, false);
    for (const DirectRow& held : rows_) { joints_.push_back({rowOf(batch.inertias, system, held), held.impulse, 0}); }
}

void DirectJoints::gatherAgain(std::span<const BodyState> states) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        joints_[i].row.excess = DirectSystem::excessOf(states, rows_[i]);
        joints_[i].forgotten = 0;
    }
}

void DirectJoints::addTo(DirectSystem& system) const {
    for (const HeldJoint& joint : joints_) { system.add(joint.row); }
}

void DirectJoints::push(DirectSystem& system) const {
    for (const HeldJoint& joint : joints_) {
        system.push(joint.row, -system.strength() * joint.row.strength * joint.row.excess - joint.forgotten);
    }
}

void DirectJoints::write(const DirectSystem& system) {
    for (const HeldJoint& joint : joints_) {
        const double excess = system.changedExcess(joint.row);
        addUp(joint.impulse, -system.strength() * joint.row.strength * excess - joint.forgotten);
    }
}

void DirectJoints::writeLater(const DirectSystem& system) {
    for (const HeldJoint& joint : joints_) {
        const double moved = system.changedExcess(joint.row) - joint.row.excess;
        addUp(joint.impulse, -system.strength() * joint.row.strength * moved);
    }
}

void DirectJoints::forget() {
    for (const HeldJoint& joint : joints_) { *joint.impulse = 0; }
}

}  // namespace swept::inline SWEPT_PRECISION

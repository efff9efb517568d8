#include "solve_preparation.h"

namespace swept::inline SWEPT_PRECISION {

void addUpImpulses(std::vector<ContactConstraint>& contacts) {
    for (ContactConstraint& contact : contacts) {
        for (ContactConstraintPoint& point : contact.points) { point.totalNormalImpulse += point.normalImpulse; }
    }
}

bool mayBeJointed(const SolverBatch& batch) {
    bool isSound = mayBeJointed(batch.contacts.size(), batch.states.size());
    forEachHeldKind(batch, [&isSound](const auto& joints) {
        for (const auto& joint : joints) {
            isSound = isSound && joint.slotA != kFixedSlot && joint.slotB != kFixedSlot;
        }
    });
    return isSound;
}

void makeContactsRigid(SolverBatch& batch, DirectScope scope) {
    for (ContactConstraint& contact : batch.contacts) {
        if (scope != DirectScope::all) { break; }
        contact.softness = {contact.softness.biasRate, 1, 0};
        contact.isHeld = true;
    }
}
void makeJointsRigid(SolverBatch& batch) {
    batch.forEachJointKind([](auto& joints) {
        for (auto& joint : joints) { joint.isHeld = true; }
    });
}

void prepareJoints(SolverBatch& batch) {
    batch.forEachJointKind([&batch](auto& joints) {
        for (auto& joint : joints) {
            joint.total = {};
            swept::prepare(joint, batch.inertias);
        }
    });
}

bool needsContactsPrepared(const SolverBatch& batch, const SolverSettings& settings) {
    return batch.store == nullptr && (settings.bounces || looksAtContacts(settings.direct));
}

/// In the order of colours: so the contacts of a store stand there, too, once they do. Others are listed before they
/// are laid into blocks, with the speed that they are given here.
void Solver::listBouncing(SolverBatch& batch, const SolverSettings& settings) {
    bouncing_.clear();
    if (!settings.bounces) { return; }
    const auto note = [&](ContactConstraint& contact) {
        if (!(contact.restitution > 0)) { return; }
        contact.bounceSpeed = settings.restitutionThreshold;
        bouncing_.push_back(&contact);
    };
    if (batch.store != nullptr) {
        for (ContactConstraint& contact : batch.contacts) { note(contact); }
        return;
    }
    for (const std::uint32_t place : graph_.contacts()) { note(batch.contacts[place]); }
}

void Solver::countJointBlocks(SolveReport& report) const {
    report.hingeBlocks = hinges_.blockCount();
    report.rodBlocks = rods_.blockCount();
    report.slideBlocks = slides_.blockCount();
    report.wheelBlocks = wheels_.blockCount();
    report.weldBlocks = welds_.blockCount();
    report.driveBlocks = drives_.blockCount();
}

}  // namespace swept::inline SWEPT_PRECISION

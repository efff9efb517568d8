#include "direct_solver.h"

#include <algorithm>

#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Weaker than where speeds are solved: rows that contradict each other (a card wedged between planks) must give.
constexpr double kProjectionStrength = 1.0 / 4;
/// Friction holds with this part of that. What sticks has more rows than there are ways to move in any heap, so gaps
/// that were closed without a slip grew smaller by a hundredth a step: of heaps of 20 to 256 boxes, discs and capsules
/// that came to rest most were solved in every step of the next minutes, instead of being held.
constexpr double kTangentShare = 1.0 / 256;

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

}  // namespace

bool DirectSolver::prepare(SolverBatch& batch, DirectScope scope, bool hasManyBodies) {
    isIdle_ = false;
    const bool isOfJoints =
        scope == DirectScope::softJoints || scope == DirectScope::freeJoints || scope == DirectScope::islands;
    if (isOfJoints && !batch.contacts.empty()) { return false; }
    isIdle_ = scope == DirectScope::softJoints;
    if (isIdle_) { return true; }
    scope_ = scope;
    hasGivenUp_ = false;
    joints_.begin();
    drives_.begin(takesTurns(scope, !batch.contacts.empty()));
    jointed_.begin();
    listNodes(batch);
    if (system_.nodes().empty() || !couple(batch)) { return false; }
    contacts_.begin(system_.nodes().size(), hasManyBodies);
    if (scope != DirectScope::all) { joints_.weigh(batch, system_, holdsDrives(scope)); }
    if (scope == DirectScope::all) { contacts_.list(batch, system_); }
    if (scope == DirectScope::jointed) { jointed_.list(batch, system_); }
    DirectDrives::mark(batch, system_, holdsDrives(scope));
    return true;
}

void DirectSolver::listNodes(const SolverBatch& batch) {
    // Where contacts are iterated, what no joint holds has no part in it.
    const bool areAllTied = scope_ == DirectScope::all || scope_ == DirectScope::jointed;
    ties_.assign(batch.inertias.size(), areAllTied ? BodyTie::tied : BodyTie::none);
    forEachHeldKind(batch, [this](const auto& joints) {
        for (const auto& joint : joints) { ties_[joint.slotA] = ties_[joint.slotB] = BodyTie::tied; }
    });
    if (holdsDrives(scope_)) { DirectDrives::tieBodies(batch, ties_); }
    system_.listNodes(batch.inertias, ties_);
}

bool DirectSolver::couple(const SolverBatch& batch) {
    bool hasJoints = false;
    forEachHeldKind(batch, [this, &hasJoints](const auto& joints) {
        system_.couple(joints);
        hasJoints = hasJoints || !joints.empty();
    });
    if (holdsDrives(scope_)) { system_.couple(batch.motors); }
    if (scope_ != DirectScope::all) { return system_.analyse({}, false); }
    system_.couple(batch.contacts);
    return system_.analyse(batch.contacts, true, !hasJoints);
}

bool DirectSolver::findImpulses(const SolverBatch& batch, DirectReport& report) {
    if (!contacts_.isEmpty()) {
        return contacts_.search(system_, joints_, report) && !contacts_.isSqueezed(batch, system_);
    }
    drives_.assemble(system_, joints_, report);
    drives_.computeChange(system_, joints_);
    drives_.search(system_, joints_, report);
    return true;
}

bool DirectSolver::solve(SolverBatch& batch, Real h, bool useBias, DirectReport& report) {
    if (isIdle_) { return true; }
    if (hasGivenUp_) { return false; }
    system_.setStrength(1);
    joints_.gather(batch, system_, h, useBias);
    if (holdsDrives(scope_)) { drives_.gather(batch, system_, h, useBias); }
    contacts_.gather(batch, h, useBias);
    if (!findImpulses(batch, report)) {
        ++report.givenUp;
        hasGivenUp_ = true;
        return false;
    }
    joints_.write(system_);
    drives_.write(system_);
    contacts_.write();
    system_.dropNoise();
    system_.changeVelocities(batch.states);
    return true;
}

bool DirectSolver::needsToHoldAgain(const SolverBatch& batch) const {
    const bool hasContacts = !batch.contacts.empty();
    if (takesTurns(scope_, hasContacts)) { return true; }
    return !hasContacts && !drives_.isEmpty() && isAnyIterated(batch);
}

void DirectSolver::holdAgain(SolverBatch& batch, DirectReport& report) {
    if (isIdle_ || !needsToHoldAgain(batch)) { return; }
    joints_.gatherAgain(batch.states);
    drives_.takeUp(batch.states);
    drives_.searchAgain(system_, joints_, report);
    joints_.write(system_);
    drives_.write(system_);
    system_.dropNoise();
    system_.changeVelocities(batch.states);
}

void DirectSolver::project(SolverBatch& batch, Real h, bool always, DirectReport& report) {
    if (contacts_.isEmpty() || !contacts_.gatherOverlaps(batch, system_, h, always)) { return; }
    joints_.gatherAtRest(batch, system_, h);
    system_.setStrength(kProjectionStrength);
    contacts_.computeProjection(system_, joints_, report, kTangentShare);
    system_.dropNoise();
    system_.changePlaces(batch.states);
}

void DirectSolver::solveJointed(SolverBatch& batch, const ContactPass& pass) {
    jointed_.solve(batch, system_, joints_, drives_, pass);
}

void DirectSolver::forgetBlows() {
    joints_.forget();
    jointed_.forget();
}

SearchEffort DirectSolver::effortOf(BodySlot slot) const {
    const std::uint32_t node = system_.nodeOf(slot);
    return node != kNoNode ? contacts_.effortOf(system_.islandOf(node)) : SearchEffort{};
}

}  // namespace swept::inline SWEPT_PRECISION

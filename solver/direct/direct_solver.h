#pragma once

#include <vector>

#include "../solve_report.h"
#include "../solver_batch.h"
#include "direct_contacts.h"
#include "direct_drives.h"
#include "direct_joints.h"
#include "direct_scope.h"
#include "direct_system.h"
#include "jointed_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// Solves rigid rows of a batch at once, in place of iteration: those that joints hold, and contacts.
///
/// The rows are dampers of strength k, far stronger than any mass in the island asks for, around the impulses they
/// carried before: a step of the method of multipliers (Hestenes 1969). The matrix M + Σ k·JᵀJ has a block per body, is
/// positive definite whatever rows depend on each other (four legs on a floor, a ring of wedges), and a chain or a
/// stack is factorised in time proportional to its length, for any ratio of masses. What is left of the speed of a row
/// is the change of its impulse over k: nothing at rest.
class DirectSolver {
public:
    /// Once a step: bodies, islands, rows. @pre contacts stay where they are until the step ends
    /// @param hasManyBodies  more rounds
    /// @return false when there is nothing to do, or the system is too tangled to pay
    bool prepare(SolverBatch& batch, DirectScope scope, bool hasManyBodies = false);

    /// Whether nothing is held in scope `softJoints`: there is nothing to do, but drives are halved.
    bool isIdle() const { return isIdle_; }

    /// Of sub-steps to come: errors of joints are closed within so long, s, or one of them, whichever is longer.
    void setLeastClosing(Real seconds) { joints_.setLeastClosing(seconds); }

    /// Before impulses of the sub-step before are applied: how bodies that are held move, which tells where they will
    /// be better than what those impulses made of it. (Of joints that depend on each other they may be as large as they
    /// like, and no longer cancel once the bodies have turned: two welds worked against each other more and more.)
    void noteMotions(const SolverBatch& batch) {
        if (!isIdle_) { joints_.noteMotions(batch.states); }
    }

    /// Changes velocities and impulses. Contacts come with the impulses expected, not yet applied; joints with theirs
    /// applied.
    /// @param useBias  as in the kernels of the constraints
    /// @return whether contacts, if any are in scope, are solved; else nothing was changed
    bool solve(SolverBatch& batch, Real h, bool useBias, DirectReport& report);
    /// Before bodies move: takes back what iteration did to the rows since they were solved. Where motors are rows,
    /// that of springs and limits: gaps of joints close anyway, but nothing brings back an angle that a brake held.
    /// Where contacts take turns with joints, that of contacts: a gap that they open would close within the next
    /// sub-step, with all the mass that hangs on the joint, while what a joint does to a contact is left to a soft
    /// spring.
    /// @pre `solve` with bias came before, and bodies stand where they did then
    void holdAgain(SolverBatch& batch, DirectReport& report);
    /// Moves the bodies, not their velocities, towards zero separation of all that presses or overlaps. (What a
    /// velocity does about a gap needs impulses, and those of a tower's lowest contact would tilt the tower.)
    /// @param always  else only if some separation is more than a small part of the contact's own size
    void project(SolverBatch& batch, Real h, bool always, DirectReport& report);

    /// Iterates over contacts of scope `jointed`. @pre `solve` came before; impulses of contacts are applied
    void solveJointed(SolverBatch& batch, const ContactPass& pass);

    /// What a blow took in the last sub-step is nothing to start the next solve from. (A pair on a rod that had struck
    /// a wall went back by six centimetres in the step after.) Totals stay.
    void forgetBlows();

    // See `DirectContacts`.
    void beginFirstHalf() { contacts_.beginFirstHalf(); }
    void beginSecondHalf() { contacts_.beginSecondHalf(); }
    void addHalves() { contacts_.addHalves(); }

    /// What the search cost a body in this step, in scope `all`.
    SearchEffort effortOf(BodySlot slot) const;

private:
    void listNodes(const SolverBatch& batch);
    bool couple(const SolverBatch& batch);
    bool needsToHoldAgain(const SolverBatch& batch) const;
    bool findImpulses(const SolverBatch& batch, DirectReport& report);

    DirectScope scope_ = DirectScope::none;
    bool hasGivenUp_ = false;    ///< in this step
    bool isIdle_ = false;        ///< likewise
    std::vector<BodyTie> ties_;  ///< by slot
    DirectSystem system_;
    DirectJoints joints_;
    DirectDrives drives_;      ///< where `holdsDrives`
    DirectContacts contacts_;  ///< in scope `all`
    JointedContacts jointed_;  ///< in scope `jointed`
};

}  // namespace swept::inline SWEPT_PRECISION

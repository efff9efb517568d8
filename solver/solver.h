#pragma once

#include <limits>
#include <span>
#include <vector>

#include "../shapes/task_system.h"
#include "contacts/contact_blocks.h"
#include "direct/direct_solver.h"
#include "graph/constraint_graph.h"
#include "impacts/impact.h"
#include "joint_blocks/drive_sort.h"
#include "joint_blocks/hinge_blocks.h"
#include "joint_blocks/joint_blocks.h"
#include "joint_blocks/rod_sort.h"
#include "joint_blocks/slide_sort.h"
#include "joint_blocks/weld_sort.h"
#include "joint_blocks/wheel_sort.h"
#include "joint_islands/joint_islands.h"
#include "joint_islands/undone_islands.h"
#include "solve_report.h"
#include "solver_batch.h"
#include "wide/wide_motion.h"

namespace swept::inline SWEPT_PRECISION {

struct SolverSettings {
    Real dt = 0;                                            ///< the step, s; greater than 0
    int subSteps = 1;                                       ///< at least 1
    int relaxPasses = 1;                                    ///< per sub-step, at least 0
    Real restitutionThreshold = 0;                          ///< slower approaches do not bounce, m/s
    Real maxSpeed = std::numeric_limits<Real>::infinity();  ///< m/s, of what can be moved
    bool joints = true;                                     ///< false: the batch holds none, and they cost nothing
    /// false: no contact there has restitution, likewise; of a batch with links those that have are alone
    bool bounces = true;
    /// Instead, and only of a batch with links: each contact bounces in its turn (`bounceContacts`). The `bounceSpeed`
    /// of those with more than `kLivelyRestitution` is set.
    bool bouncesInTurn = false;
    bool coarseImpacts = false;  ///< bounces in large piles are gone through a few times only, see `ImpactRule`
    bool wide = true;            ///< contacts in blocks where kernels are there; false: one by one, with the same bits
    /// What is solved all at once (`DirectSolver`), where that pays. Unless it is none, drives are halved: one half
    /// acts before the motion of a sub-step and one after it, or both before it, where joints take turns with contacts.
    DirectScope direct = DirectScope::none;
    /// Of `islandsWithDrives`: of islands whose drives do not go on smoothly, and where there are contacts.
    DirectScope left = DirectScope::freeJoints;
    /// Joints that are solved so close their errors within so long, s, at least: what shorter sub-steps leave of that
    /// speed would be energy. 0: within a sub-step.
    Real leastClosing = 0;
    bool hasManyBodies = false;  ///< of what is solved all at once: it gets more rounds
    /// All is at rest, with the right impulses: contacts hold what they have, without springs, in one sub-step.
    /// @pre no joints, nothing is solved all at once; separations are found, 0 where a point presses
    bool settled = false;
};

/// One sub-stepped solve of a batch, constraints in colour order: per sub-step bounce, integrate velocities, warm
/// start, solve with soft constraints, integrate positions, relax. "Small Steps" (Macklin et al. 2019) with soft
/// constraints and relaxation as in Catto's "Solver2D" (2024); bounces are resolved inside the sub-step in which a
/// contact closes, with the velocity it has there, instead of once at the end of the step.
class Solver {
public:
    /// @pre slots are valid, effective data (anchors, separations, limits) filled; masses are computed here (and of
    /// contacts that are solved side by side, only there).
    /// @param loops  runs what is independent: the constraints of a colour, the bodies
    SolveReport solve(SolverBatch& batch, const SolverSettings& settings, TaskSystem& loops);
    SolveReport solve(SolverBatch& batch, const SolverSettings& settings) {
        SerialTaskSystem loops;
        return solve(batch, settings, loops);
    }

    /// Finds the colours of the links of a batch, as the next `solve` would, which spares it that. In the meantime
    /// others may set its bodies; links stay as they are. @param standing  bodies that cannot be moved: all others are
    /// taken for movable. @pre nothing is solved all at once; the batch has its joints, if there are any
    void colourAhead(SolverBatch& batch, bool onlyContacts, std::span<const BodySlot> standing = {});

    /// Of the last solve. @pre its `SolveReport::isDirect`, of all contacts
    SearchEffort searchEffortOf(BodySlot slot) const { return direct_.effortOf(slot); }
    /// Likewise. @pre `SolveReport::isExact`
    bool gaveWay(BodySlot slot) const { return islands_.gaveWay(slot); }
    /// Likewise: whether its drives did not go on smoothly. @pre `SolveReport::anyLeft`
    bool isLeft(BodySlot slot) const { return islands_.isUndone(slot); }

private:
    /// A colour, and those that were joined to it.
    struct Run {
        int colour = 0;
        bool inOrder = false;   ///< one after the other
        std::size_t parts = 0;  ///< of all of them
    };

    void forBodies(const SolverBatch& batch, FunctionRef<void(std::size_t begin, std::size_t end)> body);
    int integrateVelocities(SolverBatch& batch, Real maxSpeed);
    int integrateAndRepeat(SolverBatch& batch, Real maxSpeed, bool isFirst);
    void integratePositions(SolverBatch& batch, Real h);
    void listBouncing(SolverBatch& batch, const SolverSettings& settings);
    // What is not there is left out of the loops, not asked for in each of their rounds.
    template <bool kJoints>
    void subStepIteratively(SolverBatch& batch, const SolverSettings& settings, Real h, bool isFirst,
                            SolveReport& report);
    void holdSettled(SolverBatch& batch, const SolverSettings& settings, SolveReport& report);
    template <bool kJoints>
    void subStepDirectly(SolverBatch& batch, const SolverSettings& settings, Real h, SolveReport& report);
    template <bool kJoints>
    void subStepOfContacts(SolverBatch& batch, const SolverSettings& settings, Real h, bool isLast,
                           SolveReport& report);
    template <bool kJoints>
    SolveReport solveWith(SolverBatch& batch, const SolverSettings& settings, bool isColoured, TaskSystem& loops);
    SolveReport solveIslands(SolverBatch& batch, const SolverSettings& settings, TaskSystem& loops);
    SolveReport solveDriven(SolverBatch& batch, const SolverSettings& settings, TaskSystem& loops);
    /// Of joints that stand in blocks; no other kind has one.
    HingeBlocks& blocksOf(const std::vector<RevoluteConstraint>&) { return hinges_; }
    JointBlocks<RodSort>& blocksOf(const std::vector<DistanceConstraint>&) { return rods_; }
    JointBlocks<SlideSort>& blocksOf(const std::vector<PrismaticConstraint>&) { return slides_; }
    JointBlocks<WheelSort>& blocksOf(const std::vector<WheelConstraint>&) { return wheels_; }
    JointBlocks<WeldSort>& blocksOf(const std::vector<WeldConstraint>&) { return welds_; }
    JointBlocks<DriveSort>& blocksOf(const std::vector<MotorConstraint>&) { return drives_; }
    template <class Joints>
    static constexpr bool standInBlocks() {
        return requires(Solver & solver, const Joints& joints) { solver.blocksOf(joints); };
    }
    /// All of these but hinges, which a store may keep.
    template <class Visit>
    void forEachPlainBlocks(const Visit& visit) {
        visit(rods_);
        visit(slides_);
        visit(wheels_);
        visit(welds_);
        visit(drives_);
    }
    void buildJointBlocks(SolverBatch& batch, bool isWide, TaskSystem& ofManyHinges);
    void countJointBlocks(SolveReport& report) const;
    template <class OfBlocks, class OfJoints>
    void forEachJointOf(SolverBatch& batch, int colour, RangeCut& cut, const OfBlocks& ofBlocks,
                        const OfJoints& ofJoints);
    template <bool kJoints>
    std::size_t partsOf(SolverBatch& batch, int colour);
    bool isWorthSharing() const;
    template <bool kJoints>
    void listRuns(SolverBatch& batch);
    template <bool kJoints>
    void listContacts();
    template <bool kJoints>
    void prepare(SolverBatch& batch, const SolverSettings& settings, bool isColoured);
    template <class Visit>
    void forEachRun(const Visit& visit);
    template <bool kJoints>
    void warmStart(SolverBatch& batch, bool hasMoved);
    template <bool kJoints>
    void solveColours(SolverBatch& batch, const ContactPass& pass);
    void bounceInTurn(SolverBatch& batch, int turns, const ContactPass& pass);
    template <bool kJoints, bool kBounces>
    void runSubSteps(SolverBatch& batch, const SolverSettings& settings, SolveReport& report);

    SerialTaskSystem serial_;
    TaskSystem* loops_ = &serial_;   ///< of the present solve
    std::size_t fewestToShare_ = 0;  ///< parts of a colour; fewer are gone through by one worker
    MoveBodies move_ = nullptr;      ///< likewise
    ConstraintGraph graph_;
    bool isColoured_ = false;  ///< ahead: for the next solve alone
    ContactBlocks contacts_;
    HingeBlocks hinges_;
    JointBlocks<RodSort> rods_;
    JointBlocks<SlideSort> slides_;
    JointBlocks<WheelSort> wheels_;
    JointBlocks<WeldSort> welds_;
    JointBlocks<DriveSort> drives_;
    DirectSolver direct_;
    JointIslands islands_;
    UndoneIslands undone_;
    std::vector<Run> runs_;
    RawVector<std::array<Real, 4>> free_;  ///< by body slot: speeds in this sub-step without constraints
    bool areJointed_ = false;              ///< the present solve: contacts are iterated by `DirectSolver`
    bool isMet_ = false;                   ///< likewise: of joints that met contacts within a step
    bool isListed_ = false;                ///< the present solve: `ContactBlocks::solveListed`
    bool isRepeated_ = false;              ///< the present solve: see `integrateAndRepeat`
    std::vector<ContactConstraint*> bouncing_;
    ImpactScratch impactScratch_;
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../graph/island_finder.h"
#include "../solve_report.h"
#include "../solver_batch.h"
#include "block_ldlt.h"
#include "direct_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// What is solved all at once.
enum class DirectScope : std::uint8_t {
    none,
    islands,     ///< islands of rigid joints and nothing else, each on its own (`JointIslands`)
    freeJoints,  ///< what joints hold rigidly, as long as there are no contacts
    joints,      ///< what joints hold rigidly
    jointed,     ///< that, always: contacts are iterated on what answers as the joints hold it together
    all,         ///< what joints hold rigidly, and all contacts
};

/// Whether motors are rows of that solve.
constexpr bool holdsDrives(DirectScope scope) {
    return scope == DirectScope::freeJoints || scope == DirectScope::joints || scope == DirectScope::jointed;
}

/// Whether scope `jointed` is worth its time: each contact is answered by every body, twice in a sub-step.
constexpr bool mayBeJointed(std::size_t contacts, std::size_t bodies) { return contacts * bodies <= 512; }

/// Solves rigid rows of a batch at once, in place of iteration: those that joints hold, and contacts.
///
/// The rows are dampers of strength k, far stronger than any mass in the island asks for, around the impulses they
/// carried before: a step of the method of multipliers (Hestenes 1969). The matrix M + Σ k·JᵀJ has a block per body, is
/// positive definite whatever rows depend on each other (four legs on a floor, a ring of wedges), and a chain or a
/// stack is factorised in time proportional to its length, for any ratio of masses. What is left of the speed of a row
/// is the change of its impulse over k: nothing at rest.
///
/// The damper of a contact only pushes, that of its friction gives way at a limit. As long as that limit is given, the
/// velocities are the minimum of a convex function that is quadratic piece by piece,
///     ½ ΔvᵀMΔv + Σ ψ(J·(v + Δv) + bias),  −ψ′(e) = clamp(λ₀ − k·e, least, most),
/// which Newton's method with a line search finds from anywhere (after Castro, Permenter & Han, "An unconstrained
/// convex formulation of compliant contact", 2022). Limits of friction follow the normal impulses in a few rounds
/// around it. Motors are such dampers, too, with limits that are given: what is within them is held, the rest pushes as
/// hard as it may.
class DirectSolver {
public:
    /// Once a step: bodies, islands, rows. @pre contacts stay where they are until the step ends
    /// @param isPatient  of many bodies: more rounds
    /// @param isTakenBack  what was searched in vain once is not again: the step will be taken back
    /// @return false when there is nothing to do, or the system is too tangled to pay
    bool prepare(SolverBatch& batch, DirectScope scope, bool isPatient = false, bool isTakenBack = false);

    /// Of sub-steps to come: errors of joints are closed within so long, s, or one of them, whichever is longer.
    void setLeastClosing(Real seconds) { leastClosing_ = seconds; }

    /// Before impulses of the sub-step before are applied: how bodies that are held move, which tells where they will
    /// be better than what those impulses made of it. (Of joints that depend on each other they may be as large as they
    /// like, and no longer cancel once the bodies have turned: two welds worked against each other more and more.)
    void noteMotions(const SolverBatch& batch);

    /// Changes velocities and impulses. Contacts come with the impulses expected, not yet applied; joints with theirs
    /// applied.
    /// @param useBias  as in the kernels of the constraints
    /// @return whether contacts, if any are in scope, are solved; else nothing was changed
    template <bool kJoints>
    bool solve(SolverBatch& batch, Real h, bool useBias, DirectReport& report);
    /// Before bodies move, where motors are rows and something was iterated after them (springs, limits): takes back
    /// what that did to the rows. Gaps of joints close anyway, but nothing brings back an angle that a brake held.
    /// @pre `solve` with bias came before, and bodies stand where they did then
    void holdAgain(SolverBatch& batch, DirectReport& report);
    /// Moves the bodies, not their velocities, towards zero separation of all that presses or overlaps. (What a
    /// velocity does about a gap needs impulses, and those of a tower's lowest contact would tilt the tower.)
    /// @param always  else only if some separation is more than a small part of the contact's own size
    template <bool kJoints>
    void project(SolverBatch& batch, Real h, bool always, DirectReport& report);

    /// Iterates over contacts of scope `jointed`: an impulse at a point moves all that joints tie to its bodies, so the
    /// joints hold on, and need not take turns with contacts. Changes velocities and impulses, of joints as well.
    /// @pre `solve` came before; impulses of contacts are applied
    void solveJointed(SolverBatch& batch, const ContactPass& pass);

    /// What a blow took in the last sub-step is nothing to start the next solve from. (A pair on a rod that had struck
    /// a wall went back by six centimetres in the step after.) Totals stay.
    void forgetBlows();

    // A sub-step solves contacts twice, each time for a half of what gravity does. These share out their impulses: each
    // solve expects half of what the sub-step before ended with, and at rest finds just that.
    void beginFirstHalf();
    void beginSecondHalf();
    void addHalves();

    /// Whether contacts of the body's island took more rounds than usual in this step: what cost the others of the
    /// batch theirs, too.
    bool tookLong(BodySlot slot) const;

private:
    struct Node {
        BodySlot slot = kFixedSlot;
        double mass = 0;  ///< 0: cannot be moved
        double inertia = 0;
    };
    struct TiedLoad {
        std::uint32_t bodies = 0;
        std::uint32_t contacts = 0;
        double lightest = 0;  ///< kg
        double heaviest = 0;
        double strength = 0;  ///< of its rows, see `rowOf`
    };
    /// A row as the matrix sees it.
    struct Row {
        std::uint32_t nodeA = 0;
        std::uint32_t nodeB = 0;
        Block3 ofA{};  ///< zero where the body cannot be moved
        Block3 ofB{};
        double strength = 0;  ///< k, impulse per speed; 0: nothing can move
        double excess = 0;    ///< speed plus bias before the solve
        double guess = 0;     ///< λ₀
        double impulse = 0;   ///< λ: found where it is held, given where it is forced
        double at = 0;        ///< excess at the present place of the search
        double along = 0;     ///< what its direction adds to that
    };
    struct HeldJoint {
        Row row;
        Real* impulse = nullptr;
        double forgotten = 0;  ///< of the impulse, N·s or N·m·s; taken back, to be found again
    };
    enum class Hold : std::uint8_t {
        free,    ///< carries nothing, whatever it does
        held,    ///< its damper is part of the matrix
        forced,  ///< at a limit: carries a given impulse
    };
    /// Of a motor: of its direction and zero, or of its two.
    using DrivePush = std::array<double, 2>;
    /// One direction of a motor.
    struct DriveRow {
        Row row;
        DirectRow held;
        double before = 0;  ///< impulse that was applied before the solve
    };
    /// A motor. One that drives a point has two directions, and its limit is of the length of both.
    struct Drive {
        std::array<DriveRow, 2> rows;
        std::size_t count = 1;
        double most = 0;         ///< in this solve, to any side
        bool isPatient = false;  ///< expects what the sub-step before ended with, see `gatherDrives`
        Hold hold = Hold::held;
        DrivePush along{};  ///< forced: in which direction, of unit length
        double share = 0;   ///< forced, with two: what is left of its strength across that
        DrivePush given{};  ///< forced, in scope `jointed`: N·s or N·m·s

        std::span<DriveRow> all() { return std::span(rows).first(count); }
        std::span<const DriveRow> all() const { return std::span(rows).first(count); }
    };
    /// How a motor was held in the same half of the sub-step before.
    struct DriveMemory {
        Hold hold = Hold::held;
        DrivePush along{};
        double share = 0;
    };
    /// A point of a contact of scope `jointed`. A tie is named by its root in `islands_`, a pile by its own.
    struct JointedPoint {
        ContactConstraint* contact = nullptr;
        ContactConstraintPoint* point = nullptr;
        std::uint32_t pile = 0;
        std::uint32_t tieA = 0;
        std::uint32_t tieB = 0;   ///< `kNoNode` where it is that of A, too
        std::uint32_t round = 0;  ///< in which its answers are found
        std::size_t nodes = 0;    ///< of its ties
        std::size_t answers = 0;  ///< of these nodes to the normal, and after them to the tangent
        double normalMass = 0;    ///< impulse per speed, 0 when nothing can move
        double tangentMass = 0;
        Real pushShare = 1;     ///< of the speed at which an overlap is pushed out
        Real normalBefore = 0;  ///< impulses before the pass
        Real tangentBefore = 0;
        DirectRow heldNormal;
        DirectRow heldTangent;
        Row normal;
        Row tangent;
    };
    /// Nodes that joints tie together, or one that none does.
    struct Tie {
        std::uint32_t first = 0;  ///< in `tieNodes_`
        std::uint32_t nodes = 0;
        std::uint32_t rounds = 0;
        double mass = 0;  ///< of all of them, kg
    };
    struct ContactPoint {
        ContactConstraint* contact = nullptr;
        ContactConstraintPoint* point = nullptr;
        std::uint32_t island = 0;
        Row normal;
        Row tangent;
        Hold normalHold = Hold::free;
        Hold tangentHold = Hold::free;
        double limit = 0;         ///< of friction
        bool isExpected = false;  ///< to press
        int partings = 0;         ///< of a point without a known limit, in this solve
        Real half = 0;            ///< expected normal impulse of half a sub-step
        Real tangentHalf = 0;
        Real first = 0;  ///< impulses of the first half
        Real tangentFirst = 0;
    };

    // direct_solver.cpp
    void listNodes(const SolverBatch& batch);
    bool listEdges(const SolverBatch& batch);
    void weighIslands(const SolverBatch& batch);
    Row rowOf(const SolverBatch& batch, const DirectRow& held);
    double excessOf(const SolverBatch& batch, const DirectRow& held) const;
    void gatherJoints(SolverBatch& batch, Real h, bool useBias, bool atRest);
    // Without joints nothing of theirs is looked at.
    /// @param tangentShare  of their strength that rows of friction have
    template <bool kJoints>
    void assemble(DirectReport& report, double tangentShare = 1);
    void addToMatrix(const Row& row, double share = 1);
    bool holdsAsBefore() const;
    void push(const Row& row, double impulse);
    double changedExcess(const Row& row) const;
    template <bool kJoints>
    void computeChange();
    void dropNoise();
    void applyToBodies(SolverBatch& batch) const;
    template <bool kJoints>
    void applyToImpulses();

    // direct_drives.cpp
    void tieMotors(const SolverBatch& batch, std::uint32_t tied);
    void markDrives(SolverBatch& batch) const;
    void gatherDrives(SolverBatch& batch, Real h, bool useBias);
    void expectDrives();
    void searchDrives(DirectReport& report);
    bool classifyDrives(int round);
    bool classifyDrive(Drive& drive, int round) const;
    DrivePush excessesOf(const Drive& drive) const;
    DrivePush pullAt(const Drive& drive, const DrivePush& excess) const;
    DrivePush impulseAt(const Drive& drive, const DrivePush& excess) const;
    DrivePush laterImpulseOf(const Drive& drive) const;
    void assembleDrives();
    void pushDrives();
    void writeDrives();
    void takeUpDrives(const SolverBatch& batch);
    bool letGoDrives();
    void pushForced();

    // direct_contacts.cpp
    void listContacts(SolverBatch& batch);
    void gatherContacts(const SolverBatch& batch, Real h, bool useBias);
    bool isSqueezed(const SolverBatch& batch);
    template <bool kJoints>
    bool findImpulses(DirectReport& report);
    template <bool kJoints>
    bool searchImpulses(DirectReport& report);
    template <bool kJoints>
    bool settle(DirectReport& report);
    bool classify(bool isFirm);
    bool noted(const ContactPoint& contact, bool isOther);
    bool followLimits();
    bool tighten();
    void guessHolds();
    void findNoise();
    double slopeAt(double part) const;
    double searchLine();

    // direct_jointed.cpp
    void listTies(const SolverBatch& batch);
    void listJointed(SolverBatch& batch);
    void findAnswers();
    void readAnswers(JointedPoint& point, bool isTangent);
    static bool isWithinTie(const JointedPoint& point);
    template <class Visit>
    void forEachNode(const JointedPoint& point, const Visit& visit) const;
    void pushTies(const JointedPoint& point, std::size_t answers, double impulse);
    Real solvePoint(JointedPoint& point, const ContactPass& pass);
    void solvePile(std::span<JointedPoint> points, const ContactPass& pass);
    void solvePiles(const ContactPass& pass);

    // direct_projection.cpp
    bool gatherOverlaps(const SolverBatch& batch, Real h, bool isLast);
    void moveBodies(SolverBatch& batch) const;

    DirectScope scope_ = DirectScope::none;
    bool isPatient_ = false;
    bool isTakenBack_ = false;
    bool hasGivenUp_ = false;            ///< in this step
    bool hasTightened_ = false;          ///< in the last search
    Real leastClosing_ = 0;              ///< s
    std::vector<std::uint32_t> nodeOf_;  ///< by slot
    std::vector<Node> nodes_;
    IslandFinder islands_;         ///< of nodes
    std::vector<TiedLoad> loads_;  ///< by their first node
    std::vector<BlockEdge> edges_;
    std::vector<Motion> motions_;  ///< by slot; empty: not noted
    std::vector<DirectRow> jointRows_;
    std::vector<HeldJoint> joints_;
    std::vector<MotorRow> motorRows_;
    std::vector<Drive> drives_;
    std::array<std::vector<DriveMemory>, 2> remembered_;  ///< of them, with bias and without, in this step
    std::vector<DrivePush> ended_;                        ///< with what they ended the sub-step before
    bool isFirstHalf_ = true;                             ///< the present solve is the one with bias
    std::vector<ContactPoint> contacts_;
    std::vector<JointedPoint> jointed_;  ///< pile by pile
    std::uint32_t jointedRounds_ = 0;
    IslandFinder piles_;     ///< of nodes
    std::vector<Tie> ties_;  ///< by their root
    std::vector<std::uint32_t> tieNodes_;
    std::vector<Block3> answers_;      ///< velocities per impulse, row by row
    bool areAnswersCurrent_ = false;   ///< those of the present matrix
    std::vector<std::uint8_t> holds_;  ///< which of them were held when the matrix was factorised
    bool isFactorised_ = false;
    double factorised_ = 0;                ///< strength with which
    int roundsLeft_ = 0;                   ///< of this solve
    int notedFrom_ = 0;                    ///< from so many left on it is noted who takes them
    int spareRounds_ = 0;                  ///< since `prepare`, for what takes more than the usual
    std::vector<std::uint8_t> takesLong_;  ///< by the first node of an island
    double strength_ = 1;                  ///< of all rows, in units of their own
    BlockLdlt matrix_;
    std::vector<Block3> change_;   ///< of the velocities, by node
    std::vector<Block3> place_;    ///< where the search stands: the last change that was tried
    std::vector<Block3> largest_;  ///< of the changes in an island: linear, angular; by its first node
    std::vector<double> noise_;    ///< impulses of no meaning in an island, by its first node
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <vector>

#include "block_ldlt.h"
#include "direct_rows.h"
#include "island_finder.h"
#include "solver_batch.h"

namespace swept::inline SWEPT_PRECISION {

/// What is solved all at once.
enum class DirectScope : std::uint8_t {
    none,
    freeJoints,  ///< what joints hold rigidly, as long as there are no contacts
    joints,      ///< what joints hold rigidly
    all,         ///< that, and what presses or sticks
};

/// What the direct solver did in a step.
struct DirectReport {
    int factorisations = 0;
    int givenUp = 0;  ///< solves in which no set of contacts was found that agrees with itself: left to iteration
};

/// Solves rigid rows of a batch at once, in place of iteration: those that joints hold, and of the contacts those that
/// press or stick. Which contacts these are is guessed from the impulses they carry, and corrected in a few rounds;
/// what slides, is limited or springs is left to the iterations around it. (Subspace minimisation after Silcowitz,
/// Niebe & Erleben, "Projected Gauss–Seidel subspace minimization method for interactive rigid body dynamics", 2010, in
/// terms of the bodies instead of the impulses.)
///
/// The rows are dampers of strength k, far stronger than any mass in the island asks for, around the impulses they
/// carried before: a step of the method of multipliers (Hestenes 1969), (M + Σ k·JᵀJ)·Δv = −Σ k·Jᵀ(J·v + bias), then λ
/// ← λ − k·(J·(v + Δv) + bias). The matrix has a block per body, is positive definite whatever rows depend on each
/// other (four legs on a floor), and a chain or a stack is factorised in time proportional to its length, for any ratio
/// of masses. What is left of the speed of a row is the change of its impulse over k: nothing at rest.
class DirectSolver {
public:
    /// Once a step: bodies and islands. @return false when there is nothing to do, or the system is too tangled to pay
    bool prepare(const SolverBatch& batch, DirectScope scope);
    /// Changes velocities and impulses. @param useBias  as in the kernels of the constraints
    void solve(SolverBatch& batch, Real h, bool useBias, DirectReport& report);
    /// Moves the bodies, not their velocities, towards zero separation of all that presses or overlaps. (What a
    /// velocity does about a gap needs impulses, and those of a tower's lowest contact would tilt the tower.)
    /// @param always  else only if some separation is more than a small part of the contact's own size
    void project(SolverBatch& batch, Real h, bool always, DirectReport& report);

private:
    struct Node {
        BodySlot slot = kFixedSlot;
        double mass = 0;  ///< 0: cannot be moved
        double inertia = 0;
    };
    /// A row as the matrix sees it.
    struct Row {
        std::uint32_t nodeA = 0;
        std::uint32_t nodeB = 0;
        Block3 ofA{};  ///< zero where the body cannot be moved
        Block3 ofB{};
        double strength = 0;  ///< k, impulse per speed; 0: nothing can move
        double excess = 0;    ///< speed plus bias: before the change, then after it
        double change = 0;    ///< of the impulse: found where it is held, given where it is forced
        Real* impulse = nullptr;
    };
    enum class Hold : std::uint8_t { free, held, forced };
    /// The normal of a contact point, or the tangent that follows it.
    struct ContactRow {
        Row row;
        Hold hold = Hold::free;
        double friction = 0;
    };

    void listNodes(const SolverBatch& batch);
    bool listEdges(const SolverBatch& batch);
    Row rowOf(const SolverBatch& batch, const DirectRow& row, bool atRest) const;
    void gatherJoints(SolverBatch& batch, Real h, bool useBias, bool atRest);
    void gatherContacts(SolverBatch& batch, Real h, bool useBias);
    bool gatherOverlaps(SolverBatch& batch, Real h);
    void addPoint(const SolverBatch& batch, ContactConstraint& contact, ContactConstraintPoint& point, Real bias,
                  bool presses, bool sticks, bool atRest);
    bool holdsAsBefore() const;
    void assemble(double strength, DirectReport& report);
    void addToMatrix(const Row& row, double strength);
    void computeChange(double strength);
    double changedExcess(const Row& row) const;
    bool correct(bool mayTakeIn);
    void dropNoise();
    void applyToBodies(SolverBatch& batch) const;
    void applyToImpulses() const;
    void moveBodies(SolverBatch& batch) const;

    DirectScope scope_ = DirectScope::none;
    std::vector<std::uint32_t> nodeOf_;  ///< by slot
    std::vector<Node> nodes_;
    IslandFinder islands_;          ///< of nodes
    std::vector<double> heaviest_;  ///< mass in the island, by node
    std::vector<BlockEdge> edges_;
    std::vector<DirectRow> jointRows_;
    std::vector<Row> joints_;
    std::vector<ContactRow> contacts_;  ///< normal and tangent of each point in turn
    std::vector<std::uint8_t> holds_;   ///< which of them were held when the matrix was factorised
    bool isFactorised_ = false;
    BlockLdlt matrix_;
    std::vector<Block3> change_;   ///< of the velocities, by node
    std::vector<Block3> largest_;  ///< of the changes in an island: linear, angular, impulse; by its first node
};

}  // namespace swept::inline SWEPT_PRECISION

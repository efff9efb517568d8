#pragma once

#include <cstdint>
#include <vector>

#include "../solver_batch.h"
#include "block_ldlt.h"
#include "direct_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// Impulses with which joints, and contacts beside them, hold their bodies against what drives these in a sub-step, as
/// if all stood still: what joints that carried nothing yet begin with. Iteration would find them in many sub-steps,
/// while what hangs there falls, and is caught with up to twice the load.
///
/// Rows are strong dampers around the impulses that they have, round after round (the method of multipliers, as in
/// `DirectSolver`): of all impulses that balance the bodies those are found that differ least from these. What is
/// in balance already stands fast: a heap is not sought anew for a joint that is made in it. Everything is computed in
/// double: what a round leaves is a difference of loads that are thousands of times as large.
class StartBalance {
public:
    /// Changes impulses alone, and leaves bodies without speed; what limits, motors and springs give stays.
    /// @pre bodies stand where the step begins. Of contacts what gapes carries nothing
    /// @return false when no balance was found, or there is none (a pendulum that is let go): what the impulses then
    /// are is of no use
    bool find(SolverBatch& batch);

private:
    enum class Hold : std::uint8_t {
        held,   ///< its damper is part of the matrix
        given,  ///< friction at its limit: its impulse is that of the last round
        free,   ///< carries nothing
    };
    struct Row {
        std::uint32_t nodeA = 0;
        std::uint32_t nodeB = 0;
        Block3 ofA{};  ///< speed of the row per velocity; zero of what cannot be moved
        Block3 ofB{};
        double strength = 0;  ///< of its damper, impulse per speed
        double impulse = 0;
        double perLever = 1;  ///< makes a force of its impulse: of an angle 1/m, by the radius of gyration
        Real* to = nullptr;
        Hold hold = Hold::held;
    };
    /// A point of a contact: its rows, the normal and after it the tangent.
    struct Point {
        std::size_t row = 0;
        double friction = 0;
        int turns = 0;  ///< so often it began to press, or no longer did
    };

    /// Whether the balance of a body is sought, and of what rests on it.
    enum class Search : std::uint8_t { none, alone, withLoad };

    bool listBodies(const SolverBatch& batch);
    void addRow(const SolverBatch& batch, const DirectRow& row);
    void listRows(SolverBatch& batch);
    void findDrives(SolverBatch& batch);
    bool isBalanced(std::uint32_t node, double mostOfAll) const;
    void spread(std::vector<Search>& searches) const;
    bool leaveCarried();
    void push(const Row& row, double impulse);
    double speedOf(const Row& row) const;
    void assemble();
    double changeImpulses();
    bool holdPoints();
    double squaredSpeed(std::uint32_t node, const Block3& speed) const;
    double squaredSpeedOfDrives() const;
    bool isStill() const;

    std::vector<std::uint32_t> nodes_;   ///< by slot
    std::vector<BodyInertia> inertias_;  ///< by node
    double heaviest_ = 0;                ///< kg
    std::vector<DirectRow> jointRows_;
    std::vector<Row> rows_;
    std::vector<Point> points_;
    std::vector<BlockEdge> edges_;
    BlockLdlt matrix_;
    std::vector<Block3> drives_;  ///< by node: impulses of gravity and of what is not held
    std::vector<Block3> speeds_;
};

}  // namespace swept::inline SWEPT_PRECISION

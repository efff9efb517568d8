#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../contacts/contact_constraint.h"
#include "../graph/island_finder.h"
#include "../solver_batch.h"
#include "direct_drives.h"
#include "direct_joints.h"
#include "direct_system.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts of scope `jointed`. They are iterated after joints were solved all at once: an impulse at a point moves all
/// that joints tie to its bodies, so the joints hold on, and need not take turns with contacts.
class JointedContacts {
public:
    /// Once a step.
    void begin() { points_.clear(); }
    /// @pre contacts stay where they are until the step ends
    void list(SolverBatch& batch, DirectSystem& system);
    /// Changes velocities and impulses, of joints as well. @pre joints were solved; impulses of contacts are applied
    void solve(SolverBatch& batch, DirectSystem& system, DirectJoints& joints, DirectDrives& drives,
               const ContactPass& pass);
    /// They carry nothing. Totals stay.
    void forget();

private:
    struct Row {
        DirectRow held;
        SystemRow row;
        double mass = 0;          ///< impulse per speed, 0 when nothing can move
        Real before = 0;          ///< impulse before the pass
        std::size_t answers = 0;  ///< of the nodes of its ties
    };
    enum RowKind : std::size_t { kNormal, kTangent, kRolling, kRowKinds };
    /// A point of a contact. A tie is named by its root, a pile by its own.
    struct Point {
        ContactConstraint* contact = nullptr;
        ContactConstraintPoint* point = nullptr;
        std::uint32_t pile = 0;
        std::uint32_t tieA = 0;
        std::uint32_t tieB = 0;   ///< `kNoNode` where it is that of A, too
        std::uint32_t round = 0;  ///< in which its answers are found
        std::size_t nodes = 0;    ///< of its ties
        Real pushShare = 1;       ///< of the speed at which an overlap is pushed out
        std::size_t rowCount = 0;
        std::array<Row, kRowKinds> rows{};  ///< the last one of what resists rolling alone

        std::span<Row> used() { return std::span(rows).first(rowCount); }
    };
    /// Nodes that joints tie together, or one that none does.
    struct Tie {
        std::uint32_t first = 0;  ///< in `tieNodes_`
        std::uint32_t nodes = 0;
        std::uint32_t rounds = 0;
        double mass = 0;  ///< of all of them, kg
    };

    void listTies(const SolverBatch& batch, DirectSystem& system);
    void findAnswers(DirectSystem& system);
    void readAnswers(const DirectSystem& system, Point& point, RowKind kind);
    static bool isWithinTie(const Point& point);
    template <class Visit>
    void forEachNode(const Point& point, const Visit& visit) const;
    Real change(DirectSystem& system, const Point& point, RowKind kind, Real total) const;
    Real hold(DirectSystem& system, const Point& point, RowKind kind, Real limit) const;
    Real solvePoint(DirectSystem& system, Point& point, const ContactPass& pass) const;
    void solvePile(DirectSystem& system, std::span<Point> points, const ContactPass& pass) const;
    void solvePiles(DirectSystem& system, const DirectDrives& drives, const ContactPass& pass);

    std::vector<Point> points_;  ///< pile by pile
    std::uint32_t rounds_ = 0;
    IslandFinder piles_;     ///< of nodes
    std::vector<Tie> ties_;  ///< by their root
    std::vector<std::uint32_t> tieNodes_;
    std::vector<Block3> answers_;  ///< velocities per impulse, row by row
    std::uint64_t answersOf_ = 0;  ///< `DirectSystem::factorNumber` that they are of
};

}  // namespace swept::inline SWEPT_PRECISION

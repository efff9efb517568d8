#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../graph/island_finder.h"
#include "../solver_batch.h"
#include "block_ldlt.h"
#include "direct_parts.h"
#include "direct_rows.h"
#include "row_changes.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether a body of the batch has a part in the solve.
enum class BodyTie : std::uint8_t {
    none,
    once,  ///< by a motor joint that may have it for itself
    tied,
};

/// How a row that may give way is held.
enum class Hold : std::uint8_t {
    free,    ///< carries nothing, whatever it does
    held,    ///< its damper is part of the matrix
    forced,  ///< at a limit: carries a given impulse
};

/// A row as the matrix sees it.
struct SystemRow {
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

/// The bodies of a direct solve as nodes, the matrix M + Σ k·JᵀJ of the rows that hold them, and the change of their
/// velocities that is sought. Each kind of row is kept by a class of its own (`DirectJoints`, `DirectDrives`,
/// `DirectContacts`, `JointedContacts`).
class DirectSystem {
public:
    struct Node {
        BodySlot slot = kFixedSlot;
        double mass = 0;  ///< kg; 0: cannot be moved
        double inertia = 0;
    };
    /// What is coupled.
    struct Load {
        std::uint32_t bodies = 0;
        std::uint32_t contacts = 0;
        double lightest = 0;  ///< kg
        double heaviest = 0;
        double mass = 0;      ///< of all of them, kg
        double strength = 0;  ///< of its rows, see `rowOf`
    };

    // --- once a step
    /// Bodies that have a part in it and can be moved become nodes. @param ties  by slot
    void listNodes(std::span<const BodyInertia> inertias, std::span<const BodyTie> ties);
    /// Bodies of the same constraint have a block in common. @pre listNodes
    template <class Constraints>
    void couple(const Constraints& constraints) {
        for (const auto& constraint : constraints) {
            const std::uint32_t a = nodeOf_[constraint.slotA];
            const std::uint32_t b = nodeOf_[constraint.slotB];
            if (a == kNoNode || b == kNoNode || a == b) { continue; }
            edges_.push_back({a, b});
            islands_.unite(a, b);
        }
    }
    /// Finds how strong the rows of each island are, and the order in which nodes are eliminated. @pre all is coupled
    /// @param contacts  those that have rows in it
    /// @param hasParts  islands become parts: their nodes are numbered one after another, and each may be factorised
    /// and solved by itself
    /// @return false where the factor would have too many blocks for this to pay
    bool analyse(std::span<const ContactConstraint> contacts, bool holdsContacts, bool hasParts = false);

    std::span<const Node> nodes() const { return nodes_; }
    /// Islands, or all as one.
    std::span<const NodeRange> parts() const { return parts_; }
    NodeRange whole() const { return {0, static_cast<std::uint32_t>(nodes_.size())}; }
    /// `kNoNode` of what has no part in it.
    std::uint32_t nodeOf(BodySlot slot) const { return nodeOf_[slot]; }
    /// The first node of those that are coupled with it.
    std::uint32_t islandOf(std::uint32_t node) { return islands_.find(node); }
    std::uint32_t islandOf(std::uint32_t node) const { return islands_.rootOf(node); }

    /// @param island  its first node
    const Load& loadOf(std::uint32_t island) const { return loads_[island]; }

    SystemRow rowOf(std::span<const BodyInertia> inertias, const DirectRow& held);
    /// The speed of a row at the present velocities, plus its bias.
    static double excessOf(std::span<const BodyState> states, const DirectRow& held);

    // --- the matrix
    /// Of all rows that are added from now on, in units of their own; also of those that `pullOf` tells.
    void setStrength(double strength) { strength_ = strength; }
    double strength() const { return strength_; }
    /// Masses alone. `factorise` comes after all rows were added.
    void beginMatrix() { beginMatrix(whole()); }
    void beginMatrix(NodeRange part);
    void add(const SystemRow& row, double share = 1);
    void factorise() { factorise(whole()); }
    void factorise(NodeRange part);
    /// Whether there is a factor, of the present strength.
    bool isFactorised(NodeRange part) const { return factorised_[part.begin] == strength_; }
    void forgetFactor() { factorised_.assign(nodes_.size(), 0); }
    void forgetFactor(NodeRange part) { factorised_[part.begin] = 0; }
    /// The matrix is that of the factor from now on, before rows are changed.
    void forgetChanges() { changes_.clear(); }
    /// A row of the part that was not there when the matrix was factorised, or no longer is. @pre there is a factor
    void change(const SystemRow& row, bool isAdded, NodeRange part);
    /// Another number whenever there is another factor.
    std::uint64_t factorNumber() const { return factorNumber_; }

    // --- what is sought
    /// Of the velocities, by node; after `solve`. Before, what pushes at them.
    std::span<Block3> change() { return change_; }
    std::span<const Block3> change() const { return change_; }
    void beginChange() { beginChange(whole()); }
    void beginChange(NodeRange part);
    void push(const SystemRow& row, double impulse);
    void solve() { matrix_.solve(change_); }
    void solve(NodeRange part) {
        if (changes_.count() == 0) { return matrix_.solve(change_, part); }
        changes_.solve(matrix_, change_, part);
    }
    /// The excess of a row after a change of velocities.
    static double excessAfter(const SystemRow& row, std::span<const Block3> change);
    double changedExcess(const SystemRow& row) const { return excessAfter(row, change_); }
    /// What its damper says.
    double pullOf(const SystemRow& row, double excess) const { return row.guess - strength_ * row.strength * excess; }

    /// What is so small against the largest change in its island is the rounding of the solution; left in, it would
    /// multiply with its like until it underflows.
    void dropNoise();
    /// Adds the change to velocities.
    void changeVelocities(std::span<BodyState> states) const;
    /// Moves bodies by it.
    void changePlaces(std::span<BodyState> states) const;

private:
    void numberByIslands();
    void weighIslands(std::span<const ContactConstraint> contacts, bool holdsContacts);

    std::vector<std::uint32_t> nodeOf_;  ///< by slot
    std::vector<Node> nodes_;
    IslandFinder islands_;     ///< of nodes
    std::vector<Load> loads_;  ///< by their first node
    std::vector<BlockEdge> edges_;
    std::vector<NodeRange> parts_;
    std::vector<std::uint32_t> numbers_;  ///< scratch of `numberByIslands`, as the next two: by old number the new one
    std::vector<std::uint32_t> nextNumbers_;
    std::vector<Node> oldNodes_;
    BlockLdlt matrix_;
    RowChanges changes_;
    double strength_ = 1;
    std::vector<double> factorised_;  ///< by the first node of a part: with which strength; 0: not
    std::uint64_t factorNumber_ = 0;
    std::vector<Block3> change_;
    std::vector<Block3> largest_;  ///< of the changes in an island: linear, angular; by its first node
};

}  // namespace swept::inline SWEPT_PRECISION

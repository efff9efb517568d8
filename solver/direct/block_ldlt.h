#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "../wide/wide_columns.h"
#include "block33.h"

namespace swept::inline SWEPT_PRECISION {

/// Two nodes that are coupled.
struct BlockEdge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

/// Nodes from one to before another.
struct NodeRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// Direct solver of a sparse, symmetric, positive definite system of 3×3 blocks, one row of blocks per node: A = L·D·Lᵀ
/// with unit blocks on the diagonal of L (George & Liu, "Computer Solution of Large Sparse Positive Definite Systems",
/// 1981). Nodes are eliminated by minimum degree, the lower index first: trees and chains are factorised without any
/// fill, in time proportional to the number of nodes. The order depends on the edges alone.
class BlockLdlt {
public:
    /// Order and places of all blocks. When nodes, edges and `mostBlocks` are those of the last call they are compared,
    /// and nothing else is done.
    /// @param mostBlocks  the factor may have no more blocks below the diagonal
    /// @return false when it would; the matrix is then not to be used
    bool analyse(std::uint32_t nodes, std::span<const BlockEdge> edges, std::size_t mostBlocks);
    /// The same of nodes in parts that no edge joins: each of these may then be factorised and solved by itself.
    /// @param parts  all nodes, in order
    bool analyse(std::span<const NodeRange> parts, std::span<const BlockEdge> edges, std::size_t mostBlocks);

    /// All blocks zero, or those of a part.
    void clear() { clear(all()); }
    void clear(NodeRange part);
    Block33& diagonal(std::uint32_t node) { return diagonal_[position_[node]]; }
    /// The block of two coupled nodes, and whether its row is that of the second.
    struct OffDiagonal {
        Block33& block;
        bool rowIsB;
    };
    OffDiagonal offDiagonal(std::uint32_t a, std::uint32_t b);

    /// @pre all blocks are filled in. Overwrites them.
    void factorise() { factorise(all()); }
    void factorise(NodeRange part);
    /// Solves in place, by node. @pre factorised
    void solve(std::span<Block3> values) const { solve(values, all()); }
    /// Those of a part among the values of all.
    void solve(std::span<Block3> values, NodeRange part) const;

    // --- for who solves with a factor that is no longer all of it, in the order of elimination. @pre factorised
    std::uint32_t positionOf(std::uint32_t node) const { return position_[node]; }
    /// Takes a value off those of all nodes that come later, as L asks for.
    void eliminate(std::uint32_t position, std::span<Block3> ordered) const;
    /// D⁻¹ of a value.
    Block3 divided(std::uint32_t position, const Block3& value) const;
    /// L⁻¹ of values by node.
    void beginSolve(std::span<const Block3> values, std::span<Block3> ordered, NodeRange part) const;
    /// L⁻ᵀ·D⁻¹ of that, by node.
    void endSolve(std::span<Block3> values, std::span<Block3> ordered, NodeRange part) const;

    std::size_t blockCount() const { return rows_.size(); }

private:
    NodeRange all() const { return {0, static_cast<std::uint32_t>(diagonal_.size())}; }
    bool order(NodeRange part, std::size_t mostBlocks);
    void eliminate(std::uint32_t node);
    void place();
    std::uint32_t blockAt(std::uint32_t row, std::uint32_t column) const;

    std::vector<BlockEdge> edges_;  ///< of the last analysis
    std::vector<NodeRange> parts_;  ///< likewise
    std::size_t mostBlocks_ = 0;    ///< likewise
    bool fits_ = false;
    std::vector<std::vector<std::uint32_t>> neighbours_;  ///< by node, those not yet eliminated; scratch
    std::vector<std::uint32_t> merged_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> heap_;  ///< degree, node
    std::vector<std::uint32_t> position_;                        ///< in the order of elimination, by node
    std::vector<std::uint32_t> begins_;                          ///< by column: its blocks in `rows_`
    std::vector<std::uint32_t> rows_;                            ///< positions, ascending within a column
    std::vector<std::size_t> targetBegins_;                      ///< by column: its part of `targets_`
    std::vector<std::uint32_t> targets_;  ///< block that each pair of blocks of a column is subtracted from, in order
    std::vector<Block33> diagonal_;       ///< by position; factorised: L·D·Lᵀ of the block itself
    std::vector<Block33> blocks_;
    std::vector<SpreadBlock> spread_;      ///< scratch: blocks of one column before they were divided by D
    mutable std::vector<Block3> scratch_;  ///< right-hand side in the order of elimination
};

}  // namespace swept::inline SWEPT_PRECISION

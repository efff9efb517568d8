#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "block33.h"
#include "block_ldlt.h"

namespace swept::inline SWEPT_PRECISION {

/// Rows that came into a matrix, or left it, since it was factorised: A + Σ k·jᵀj, with k < 0 of what left. It is
/// solved with the old factor (Woodbury 1950): L⁻¹ of each row costs what the columns on its way to the last one hold,
/// which is much less than a factorisation as long as the rows are few.
class RowChanges {
public:
    void clear() { count_ = 0; }
    std::size_t count() const { return count_; }

    /// Coordinates of a node in a row.
    struct End {
        std::uint32_t node;
        Block3 of;
    };
    /// @param factor  of the matrix as it was, which stays until `clear`
    /// @param part  in which the row is
    /// @param k  not zero
    /// @pre no row twice: what comes and goes again is lost in rounding
    void add(const BlockLdlt& factor, NodeRange part, std::span<const End> ends, double k);
    /// As `BlockLdlt::solve`, of the matrix as it is with the changes. @pre there are some, all of this part
    void solve(const BlockLdlt& factor, std::span<Block3> values, NodeRange part);

private:
    /// What a row changes.
    struct Change {
        double k = 0;
        std::vector<std::uint32_t> places;  ///< by position, where L⁻¹·jᵀ is not zero
        std::vector<Block3> reduced;        ///< L⁻¹·jᵀ there
        std::vector<Block3> divided;        ///< D⁻¹ of that
    };

    double along(const Change& change, std::span<const Block3> ordered) const;
    bool findShares();

    std::size_t count_ = 0;
    std::vector<Change> changes_;    ///< as many as there ever were: their memory is used again
    std::vector<Block3> ordered_;    ///< by position
    std::vector<double> couplings_;  ///< scratch: k⁻¹ + J·A⁻¹·Jᵀ, row by row
    std::vector<double> shares_;     ///< right-hand side of that, then its solution
};

}  // namespace swept::inline SWEPT_PRECISION

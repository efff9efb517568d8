#pragma once

#include <cstdint>
#include <span>

#include "../direct/block33.h"

namespace swept::inline SWEPT_PRECISION {

/// A block of a column before it is divided, also spread so that the product of another one with its transposed is
/// found four numbers at a time: what the numbers 0 to 3, and 4 to 7, of such a product are sums of, column by column.
struct SpreadBlock {
    Block33 block;
    double low[3][4];
    double high[3][4];
};

/// One column in the course of a factorisation.
struct BlockColumn {
    const Block33& diagonal;       ///< its own, factorised
    std::span<Block33> blocks;     ///< below it: those of A before, of L afterwards
    const std::uint32_t* targets;  ///< of each pair of them, see `BlockLdlt`
    Block33* diagonals;            ///< of all columns
    Block33* all;                  ///< blocks of all columns
};

/// A target on the diagonal, told from the others by this bit.
inline constexpr std::uint32_t kDiagonalBit = std::uint32_t{1} << 31;

/// Divides a column by its diagonal, and takes what it contributes off the columns to its right.
/// @param scratch  as many as there are blocks
using EliminateColumn = void (*)(const BlockColumn& column, std::span<SpreadBlock> scratch);

/// Number by number.
void eliminateColumn(const BlockColumn& column, std::span<SpreadBlock> scratch);
/// The same to the bit, four numbers at once; null where there are no kernels, or no four doubles side by side.
EliminateColumn columnKernel();

}  // namespace swept::inline SWEPT_PRECISION

// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_columns.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_columns_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || HWY_MAX_BYTES < 32
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
EliminateColumn kernelForColumns() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 4>;
using Lanes = hn::Vec<Tag>;

/// The columns of a block, its rows in the first three lanes.
struct Columns {
    Lanes c0, c1, c2;
};

HWY_INLINE void spread(const Block33& block, SpreadBlock& spread) {
    spread.block = block;
    for (std::size_t c = 0; c < 3; ++c) {
        const double column[3] = {block[c], block[3 + c], block[6 + c]};
        for (std::size_t i = 0; i < 4; ++i) {
            spread.low[c][i] = column[i % 3];
            spread.high[c][i] = column[(i + 1) % 3];
        }
    }
}

/// `solveBlock` of all rows.
HWY_INLINE Columns divided(const SpreadBlock& block, const Block33& by) {
    const Tag tag;
    const auto all = [tag, &by](std::size_t i) HWY_ATTR { return hn::Set(tag, by[i]); };
    Columns v{hn::LoadU(tag, block.low[0]), hn::LoadU(tag, block.low[1]), hn::LoadU(tag, block.low[2])};
    v.c1 = hn::Sub(v.c1, hn::Mul(all(3), v.c0));
    v.c2 = hn::Sub(v.c2, hn::Add(hn::Mul(all(6), v.c0), hn::Mul(all(7), v.c1)));
    v.c0 = hn::Div(v.c0, all(0));
    v.c1 = hn::Div(v.c1, all(4));
    v.c2 = hn::Div(v.c2, all(8));
    v.c1 = hn::Sub(v.c1, hn::Mul(all(7), v.c2));
    v.c0 = hn::Sub(v.c0, hn::Add(hn::Mul(all(3), v.c1), hn::Mul(all(6), v.c2)));
    return v;
}

HWY_INLINE void store(const Columns& from, Block33& block) {
    const Tag tag;
    alignas(32) double columns[3][4];
    hn::Store(from.c0, tag, columns[0]);
    hn::Store(from.c1, tag, columns[1]);
    hn::Store(from.c2, tag, columns[2]);
    for (std::size_t i = 0; i < 9; ++i) { block[i] = columns[i % 3][i / 3]; }
}

HWY_INLINE Lanes less(Lanes from, const Columns& a, const double (&b)[3][4]) {
    const Tag tag;
    const Lanes first = hn::Add(hn::Mul(a.c0, hn::LoadU(tag, b[0])), hn::Mul(a.c1, hn::LoadU(tag, b[1])));
    return hn::Sub(from, hn::Add(first, hn::Mul(a.c2, hn::LoadU(tag, b[2]))));
}

void eliminate(const BlockColumn& column, std::span<SpreadBlock> scratch) {
    const Tag tag;
    alignas(32) static constexpr std::int64_t kLow[4] = {0, 0, 0, 1};  // rows of the numbers 0 to 3 of a block
    alignas(32) static constexpr std::int64_t kHigh[4] = {1, 1, 2, 2};
    const auto low = hn::SetTableIndices(tag, kLow);
    const auto high = hn::SetTableIndices(tag, kHigh);
    for (std::size_t i = 0; i < column.blocks.size(); ++i) { spread(column.blocks[i], scratch[i]); }
    const std::uint32_t* target = column.targets;
    for (std::size_t i = 0; i < column.blocks.size(); ++i) {
        const Columns a = divided(scratch[i], column.diagonal);
        Block33& block = column.blocks[i];
        store(a, block);
        const Columns lowA{hn::TableLookupLanes(a.c0, low), hn::TableLookupLanes(a.c1, low),
                           hn::TableLookupLanes(a.c2, low)};
        const Columns highA{hn::TableLookupLanes(a.c0, high), hn::TableLookupLanes(a.c1, high),
                            hn::TableLookupLanes(a.c2, high)};
        for (std::size_t k = 0; k <= i; ++k, ++target) {
            const std::uint32_t t = *target;
            double* const into = ((t & kDiagonalBit) != 0 ? column.diagonals[t & ~kDiagonalBit] : column.all[t]).data();
            const SpreadBlock& b = scratch[k];
            hn::StoreU(less(hn::LoadU(tag, into), lowA, b.low), tag, into);
            hn::StoreU(less(hn::LoadU(tag, into + 4), highA, b.high), tag, into + 4);
            into[8] -= block[6] * b.block[6] + block[7] * b.block[7] + block[8] * b.block[8];
        }
    }
}

EliminateColumn kernelForColumns() { return eliminate; }

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelForColumns);
}  // namespace

EliminateColumn columnKernel() { return HWY_DYNAMIC_DISPATCH(kernelForColumns)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

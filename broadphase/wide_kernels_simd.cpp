// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_kernels.h"

#include "../shapes/wide_targets.h"

#ifndef SWEPT_SIMD_FEW
// AVX-512 besides: eight floats fill a register of AVX2. (For ten thousand boxes queries and rays took the same with
// and without it to within 6 %, in double rays 2 to 6 % less with it; pairs scattered by up to 30 %, without a winner.)
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_AVX3 | HWY_AVX3_DL)
#endif
#if defined(__wasm__) && defined(SWEPT_F64)
#undef HWY_COMPILE_ONLY_STATIC
#define HWY_COMPILE_ONLY_SCALAR  // no doubles side by side
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
#undef SWEPT_LANES
#define SWEPT_LANES HWY_NAMESPACE
#include "wide_walks.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One bit per lane.
template <class Tag>
HWY_INLINE std::uint32_t bitsOf(Tag tag, hn::Mask<Tag> mask) {
    std::uint8_t bytes[8];  // as many as may be written at once
    hn::StoreMaskBits(tag, mask, bytes);
    return bytes[0];
}

/// Compares as many lanes at once as a register holds: the same comparisons as the scalar twin's, so the same bits.
class LaneQuery {
    using Tag = hn::CappedTag<Real, kWide>;
    using Lanes = hn::Vec<Tag>;

public:
    explicit LaneQuery(const Aabb& box)
        : lowerX_(hn::Set(Tag(), box.lower.x)),
          lowerY_(hn::Set(Tag(), box.lower.y)),
          upperX_(hn::Set(Tag(), box.upper.x)),
          upperY_(hn::Set(Tag(), box.upper.y)) {}

    std::uint32_t overlapping(const WideBoxes& boxes) const {
        const Tag tag;
        std::uint32_t lanes = 0;
        for (std::size_t i = 0; i < kWide; i += hn::MaxLanes(tag)) {
            const auto x = hn::And(hn::Le(hn::Load(tag, boxes.lowerX.data() + i), upperX_),
                                   hn::Le(lowerX_, hn::Load(tag, boxes.upperX.data() + i)));
            const auto y = hn::And(hn::Le(hn::Load(tag, boxes.lowerY.data() + i), upperY_),
                                   hn::Le(lowerY_, hn::Load(tag, boxes.upperY.data() + i)));
            lanes |= bitsOf(tag, hn::And(x, y)) << i;
        }
        return lanes;
    }

private:
    Lanes lowerX_;
    Lanes lowerY_;
    Lanes upperX_;
    Lanes upperY_;
};

/// The scalar twin's operations in the same order.
class LaneStrip {
    using Tag = hn::CappedTag<Real, kWide>;
    using Lanes = hn::Vec<Tag>;

public:
    explicit LaneStrip(const SweepFilter& filter)
        : acrossX_(hn::Set(Tag(), filter.across.x)),
          acrossY_(hn::Set(Tag(), filter.across.y)),
          middleX_(hn::Set(Tag(), filter.middle.x)),
          middleY_(hn::Set(Tag(), filter.middle.y)),
          reach_(hn::Set(Tag(), filter.reach)) {}

    std::uint32_t overlapping(const WideBoxes& boxes) const {
        const Tag tag;
        const Lanes half = hn::Set(tag, SweepFilter::kHalf);
        const Lanes rounding = hn::Set(tag, SweepFilter::kRounding);
        std::uint32_t lanes = 0;
        for (std::size_t i = 0; i < kWide; i += hn::MaxLanes(tag)) {
            const Lanes lowerX = hn::Mul(half, hn::Load(tag, boxes.lowerX.data() + i));
            const Lanes lowerY = hn::Mul(half, hn::Load(tag, boxes.lowerY.data() + i));
            const Lanes upperX = hn::Mul(half, hn::Load(tag, boxes.upperX.data() + i));
            const Lanes upperY = hn::Mul(half, hn::Load(tag, boxes.upperY.data() + i));
            const Lanes centerX = hn::Add(lowerX, upperX);
            const Lanes centerY = hn::Add(lowerY, upperY);
            const Lanes halfX = hn::Sub(upperX, lowerX);
            const Lanes halfY = hn::Sub(upperY, lowerY);
            const Lanes away = hn::Abs(
                hn::Add(hn::Mul(acrossX_, hn::Sub(centerX, middleX_)), hn::Mul(acrossY_, hn::Sub(centerY, middleY_))));
            const Lanes span = hn::Add(hn::Mul(hn::Abs(acrossX_), halfX), hn::Mul(hn::Abs(acrossY_), halfY));
            const Lanes sizes = hn::Add(hn::Add(hn::Abs(centerX), hn::Abs(centerY)), hn::Add(halfX, halfY));
            const auto misses = hn::Gt(away, hn::Add(hn::Add(span, reach_), hn::Mul(rounding, sizes)));
            lanes |= bitsOf(tag, hn::Not(misses)) << i;
        }
        return lanes;
    }

private:
    Lanes acrossX_;
    Lanes acrossY_;
    Lanes middleX_;
    Lanes middleY_;
    Lanes reach_;
};

std::uint64_t join(const WideJoin& task) { return JoinWalk<LaneQuery>(task).run(); }
std::uint64_t query(const WideTree& tree, const Aabb& box, bool& goOn, FunctionRef<bool(ProxyId)> visit) {
    return walkQuery<LaneQuery>(tree, box, goOn, visit);
}
std::uint64_t queries(const WideTree& tree, const WideBoxes& boxes, FunctionRef<void(std::uint32_t, ProxyId)> visit) {
    return walkQueries<LaneQuery>(tree, boxes, visit);
}
std::uint64_t intervals(const IntervalScan& scan) { return scanIntervals<LaneQuery>(scan); }
void sweep(const WideTree& tree, SweepVisit& visit) { SweepWalk<LaneQuery, LaneStrip>(tree, visit).run(); }

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {

HWY_EXPORT(join);
HWY_EXPORT(query);
HWY_EXPORT(queries);
HWY_EXPORT(intervals);
HWY_EXPORT(sweep);

std::uint64_t joinOnThisMachine(const WideJoin& task) { return HWY_DYNAMIC_DISPATCH(join)(task); }
std::uint64_t queryOnThisMachine(const WideTree& tree, const Aabb& box, bool& goOn, FunctionRef<bool(ProxyId)> visit) {
    return HWY_DYNAMIC_DISPATCH(query)(tree, box, goOn, visit);
}

std::uint64_t queriesOnThisMachine(const WideTree& tree, const WideBoxes& boxes,
                                   FunctionRef<void(std::uint32_t, ProxyId)> visit) {
    return HWY_DYNAMIC_DISPATCH(queries)(tree, boxes, visit);
}

std::uint64_t intervalsOnThisMachine(const IntervalScan& scan) { return HWY_DYNAMIC_DISPATCH(intervals)(scan); }

void sweepOnThisMachine(const WideTree& tree, SweepVisit& visit) { HWY_DYNAMIC_DISPATCH(sweep)(tree, visit); }

}  // namespace

const WideKernels& widestKernels() {
    static constexpr WideKernels kKernels = {
        "widest",          joinOnThisMachine, queryOnThisMachine, queriesOnThisMachine, intervalsOnThisMachine,
        sweepOnThisMachine};
    return kKernels;
}

}  // namespace swept::inline SWEPT_PRECISION
#endif

#include <cmath>
#include <cstdint>

#include "../shapes/real.h"
#include "wide_walks.inc"

namespace swept::inline SWEPT_PRECISION {

namespace {

class ScalarQuery {
public:
    explicit ScalarQuery(const Aabb& box) : box_(box) {}

    std::uint32_t overlapping(const WideBoxes& boxes) const {
        std::uint32_t lanes = 0;
        for (std::uint32_t lane = 0; lane < kWide; ++lane) {
            // Without branches: the outcome of each comparison is as good as random.
            const auto x = static_cast<std::uint32_t>(boxes.lowerX[lane] <= box_.upper.x) &
                           static_cast<std::uint32_t>(box_.lower.x <= boxes.upperX[lane]);
            const auto y = static_cast<std::uint32_t>(boxes.lowerY[lane] <= box_.upper.y) &
                           static_cast<std::uint32_t>(box_.lower.y <= boxes.upperY[lane]);
            lanes |= (x & y) << lane;
        }
        return lanes;
    }

private:
    Aabb box_;
};

class ScalarStrip {
public:
    explicit ScalarStrip(const SweepFilter& filter) : filter_(filter) {}

    std::uint32_t overlapping(const WideBoxes& boxes) const {
        std::uint32_t lanes = 0;
        for (std::uint32_t lane = 0; lane < kWide; ++lane) {
            const Real lowerX = SweepFilter::kHalf * boxes.lowerX[lane];
            const Real lowerY = SweepFilter::kHalf * boxes.lowerY[lane];
            const Real upperX = SweepFilter::kHalf * boxes.upperX[lane];
            const Real upperY = SweepFilter::kHalf * boxes.upperY[lane];
            const Real centerX = lowerX + upperX;
            const Real centerY = lowerY + upperY;
            const Real halfX = upperX - lowerX;
            const Real halfY = upperY - lowerY;
            const Real away = std::fabs(filter_.across.x * (centerX - filter_.middle.x) +
                                        filter_.across.y * (centerY - filter_.middle.y));
            const Real span = std::fabs(filter_.across.x) * halfX + std::fabs(filter_.across.y) * halfY;
            const Real rounding =
                SweepFilter::kRounding * ((std::fabs(centerX) + std::fabs(centerY)) + (halfX + halfY));
            // Not the other way round: what is not a number is let through.
            lanes |= static_cast<std::uint32_t>(!(away > (span + filter_.reach) + rounding)) << lane;
        }
        return lanes;
    }

private:
    SweepFilter filter_;
};

std::uint64_t join(const WideJoin& task) { return scalar_lanes::JoinWalk<ScalarQuery>(task).run(); }

void sweep(const WideTree& tree, SweepVisit& visit) {
    scalar_lanes::SweepWalk<ScalarQuery, ScalarStrip>(tree, visit).run();
}

}  // namespace

const WideKernels& scalarKernels() {
    static constexpr WideKernels kKernels = {"scalar",
                                             join,
                                             scalar_lanes::walkQuery<ScalarQuery>,
                                             scalar_lanes::walkQueries<ScalarQuery>,
                                             scalar_lanes::scanIntervals<ScalarQuery>,
                                             sweep};
    return kKernels;
}

#ifndef SWEPT_SIMD
const WideKernels& widestKernels() { return scalarKernels(); }
#endif

}  // namespace swept::inline SWEPT_PRECISION

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

std::uint64_t join(const WideJoin& task) { return scalar_lanes::JoinWalk<ScalarQuery>(task).run(); }

}  // namespace

const WideKernels& scalarKernels() {
    static constexpr WideKernels kKernels = {"scalar", join, scalar_lanes::walkQuery<ScalarQuery>,
                                       scalar_lanes::scanIntervals<ScalarQuery>};
    return kKernels;
}

#ifndef SWEPT_SIMD
const WideKernels& widestKernels() { return scalarKernels(); }
#endif

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "bit_cast.h"
#include "compiler.h"
#include "lanes.h"
#include "polygon.h"

namespace swept::inline SWEPT_PRECISION::gjk {

/// The vertex of a polygon that lies farthest along a direction, to begin a search with: all eight places at once in
/// registers of the baseline instruction set, 60 instructions in float and 96 in double, and no branch to mispredict,
/// where a loop over the vertices mispredicts its end whenever their number changes (it took a third longer for a cold
/// query). Written by lanes since GCC 12 makes of the plain loop a jump per vertex. A template, since only one of the
/// two layouts compiles.
template <typename T>
class FacingVertexOf {
    using Bits = std::conditional_t<std::is_same_v<T, float>, std::int32_t, std::int64_t>;
    static constexpr std::size_t kLanes = 16 / sizeof(T);
    using Lanes = LanesOf<T, kLanes>;
    using BitLanes = LanesOf<Bits, kLanes>;

public:
    /// Index of the farthest vertex along `direction`. Projections that differ in their last three bits only (these
    /// bits carry the index) count as equal; then any of them.
    SWEPT_FORCE_INLINE static int along(const Polygon& p, Vec2 direction) {
        const T* const v = &p.vertices[0].x;
        const Bits n = p.count;
        T best;
        if constexpr (std::is_same_v<T, float>) {
            const Lanes four = largerOf(labelled(heights(v, direction), BitLanes{0, 1, 2, 3}, n),
                                        labelled(heights(v + 8, direction), BitLanes{4, 5, 6, 7}, n));
            best = largerOf(largerOf(four[0], four[1]), largerOf(four[2], four[3]));
        } else {
            const Lanes two = largerOf(largerOf(labelled(heights(v, direction), BitLanes{0, 1}, n),
                                                labelled(heights(v + 4, direction), BitLanes{2, 3}, n)),
                                       largerOf(labelled(heights(v + 8, direction), BitLanes{4, 5}, n),
                                                labelled(heights(v + 12, direction), BitLanes{6, 7}, n)));
            best = largerOf(two[0], two[1]);
        }
        const int index = static_cast<int>(bitCast<Bits>(best) & kLabel);
        return index < p.count ? index : 0;  // beyond the range of numbers: any vertex will do
    }

private:
    static constexpr Bits kLabel = kMaxPolygonVertices - 1;

    /// Heights of as many vertices as a register holds, from interleaved coordinates.
    SWEPT_FORCE_INLINE static Lanes heights(const T* v, Vec2 direction) {
        Lanes first;
        Lanes second;
        std::memcpy(&first, v, sizeof(Lanes));
        std::memcpy(&second, v + kLanes, sizeof(Lanes));
        if constexpr (std::is_same_v<T, float>) {
            return direction.x * shuffled<0, 2, 4, 6>(first, second) +
                   direction.y * shuffled<1, 3, 5, 7>(first, second);
        } else {
            return direction.x * shuffled<0, 2>(first, second) + direction.y * shuffled<1, 3>(first, second);
        }
    }

    /// Heights with the index of the vertex for their last bits, so that the highest knows whose it is; unused places
    /// lie lowest.
    SWEPT_FORCE_INLINE static Lanes labelled(Lanes height, BitLanes index, Bits count) {
        constexpr Bits kLowest = bitCast<Bits>(std::numeric_limits<T>::lowest());
        const BitLanes isUsed = index < (BitLanes{} + count);
        const BitLanes bits = (bitCast<BitLanes>(height) & isUsed) | (~isUsed & kLowest);
        return bitCast<Lanes>((bits & ~kLabel) | index);
    }
};
using FacingVertex = FacingVertexOf<Real>;

}  // namespace swept::inline SWEPT_PRECISION::gjk

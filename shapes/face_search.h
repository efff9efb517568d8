#pragma once

#include <cstring>

#include "compiler.h"
#include "lanes.h"
#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Of the faces of a polygon, that along whose normal another one lies farthest away.
struct FaceChoice {
    int face = 0;         ///< the first of several
    Real separation = 0;  ///< along its normal, metres; negative when overlapping
    Real lead = 0;        ///< over the next best, metres
};

/// Separating axes of two polygons in the arithmetic of `Real`, a register of faces at once in the baseline instruction
/// set: a choice with what rounding makes of it, some units of the coordinates that go in, where core_axis.h measures
/// in double. Two boxes take a sixth of the instructions. Each lane does what a loop over the faces would.
template <typename T>
class FaceSearchOf {
    static constexpr int kLanes = 16 / sizeof(T);
    using Lanes = LanesOf<T, kLanes>;
    static constexpr int kRegisters = kMaxPolygonVertices / kLanes;

    /// As many points as a register holds, coordinates apart.
    struct Points {
        Lanes x;
        Lanes y;
    };

public:
    /// The vertices of a polygon in the frame of another one.
    struct Placed {
        alignas(16) T x[kMaxPolygonVertices];
        alignas(16) T y[kMaxPolygonVertices];
        int count;
    };

    /// @param pose  takes the coordinates of the polygon to those that are wanted
    SWEPT_FORCE_INLINE static void place(const Polygon& polygon, const Transform& pose, Placed& placed) {
        const T c = pose.rotation.c;
        const T s = pose.rotation.s;
        placed.count = polygon.count;
        for (int i = 0; i < polygon.count; i += kLanes) {
            const Points p = load(&polygon.vertices[static_cast<std::size_t>(i)]);
            store(placed, i, c * p.x - s * p.y + pose.translation.x, s * p.x + c * p.y + pose.translation.y);
        }
    }
    /// The other way round.
    SWEPT_FORCE_INLINE static void placeInverse(const Polygon& polygon, const Transform& pose, Placed& placed) {
        const T c = pose.rotation.c;
        const T s = pose.rotation.s;
        placed.count = polygon.count;
        for (int i = 0; i < polygon.count; i += kLanes) {
            const Points p = load(&polygon.vertices[static_cast<std::size_t>(i)]);
            const Lanes x = p.x - pose.translation.x;
            const Lanes y = p.y - pose.translation.y;
            store(placed, i, c * x + s * y, c * y - s * x);
        }
    }

    /// @param others  in the frame of the polygon
    SWEPT_FORCE_INLINE static FaceChoice best(const Polygon& polygon, const Placed& others) {
        alignas(16) T separations[kMaxPolygonVertices];
        constexpr int kFew = kRegisters / 2;
        if (polygon.count <= kFew * kLanes) {
            separate<kFew>(polygon, others, separations);
        } else {
            separate<kRegisters>(polygon, others, separations);
        }
        return choose(separations, polygon.count);
    }

private:
    SWEPT_FORCE_INLINE static Points load(const Vec2* from) {
        Lanes first;
        Lanes second;
        std::memcpy(&first, from, sizeof(Lanes));
        std::memcpy(&second, &from->x + kLanes, sizeof(Lanes));
        if constexpr (kLanes == 4) {
            return {shuffled<0, 2, 4, 6>(first, second), shuffled<1, 3, 5, 7>(first, second)};
        } else {
            return {shuffled<0, 2>(first, second), shuffled<1, 3>(first, second)};
        }
    }
    SWEPT_FORCE_INLINE static void store(Placed& placed, int i, Lanes x, Lanes y) {
        std::memcpy(placed.x + i, &x, sizeof(Lanes));
        std::memcpy(placed.y + i, &y, sizeof(Lanes));
    }

    /// Of so many registers of faces; of places without a face, anything.
    template <int kCount>
    SWEPT_FORCE_INLINE static void separate(const Polygon& polygon, const Placed& others, T* separations) {
        Points normals[kCount];
        Lanes lowest[kCount];
        for (int r = 0; r < kCount; ++r) {
            normals[r] = load(&polygon.normals[static_cast<std::size_t>(r * kLanes)]);
            lowest[r] = others.x[0] * normals[r].x + others.y[0] * normals[r].y;
        }
        for (int i = 1; i < others.count; ++i) {
            for (int r = 0; r < kCount; ++r) {
                const Lanes height = others.x[i] * normals[r].x + others.y[i] * normals[r].y;
                lowest[r] = smallerOf(height, lowest[r]);
            }
        }
        for (int r = 0; r < kCount; ++r) {
            const Points starts = load(&polygon.vertices[static_cast<std::size_t>(r * kLanes)]);
            const Lanes separation = lowest[r] - (normals[r].x * starts.x + normals[r].y * starts.y);
            std::memcpy(separations + r * kLanes, &separation, sizeof(Lanes));
        }
    }

    SWEPT_FORCE_INLINE static FaceChoice choose(const T* separations, int count) {
        FaceChoice choice{0, separations[0], 0};
        T second = std::numeric_limits<T>::lowest();
        for (int i = 1; i < count; ++i) {
            const T candidate = separations[i];
            const bool isBetter = candidate > choice.separation;
            const T behind = isBetter ? choice.separation : candidate;
            second = behind > second ? behind : second;
            choice.face = isBetter ? i : choice.face;
            choice.separation = isBetter ? candidate : choice.separation;
        }
        choice.lead = choice.separation - second;
        return choice;
    }
};
using FaceSearch = FaceSearchOf<Real>;

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cmath>
#include <cstdint>

#include "pair_view.h"

namespace swept::inline SWEPT_PRECISION {

/// What manifold queries found out about two shapes that stays true for a while. A later query about the same shapes,
/// at a pose that does not differ much, then spares the search for separating axes, or all of its work, and gives the
/// same manifold bit for bit: what is kept are decisions, each with the motion up to which it is certain, never
/// numbers. So it is no part of a world's state: without it every result is the same.
struct ManifoldMemory {
    enum class Verdict : std::uint8_t {
        none,
        apart,  ///< they are
        face,   ///< what they touch with is a face of one of them
    };

    Transform bInA{};  ///< at which it was found
    Real reaches = 0;  ///< farthest that the vertices of both are from their origins, summed; metres; 0: not asked yet
    Real lever = 0;    ///< no vertex of either shape is farther from the other's origin, metres
    Real room = 0;     ///< of `apart`: separation; of `face`: motion up to which it is that face; metres
    Verdict verdict = Verdict::none;
    std::uint8_t face = 0;
    bool isOfA = false;  ///< the face is

    /// Longest way of any point of one shape in the frame of the other since then, at most, metres. Sums of magnitudes
    /// instead of lengths: never less. (A difference of rotations moves no point farther than its own norm times the
    /// distance from the origin.)
    Real motionTo(const Transform& now) const {
        const Vec2 moved = now.translation - bInA.translation;
        const Real turned = std::fabs(now.rotation.c - bInA.rotation.c) + std::fabs(now.rotation.s - bInA.rotation.s);
        return std::fabs(moved.x) + std::fabs(moved.y) + turned * lever;
    }
    /// Whether nothing can be nearer than the margin.
    bool isApart(const Transform& now, Real margin) const {
        return verdict == Verdict::apart && motionTo(now) + margin < room;
    }
};

/// What a query finds out; room without what rounding may take of it.
struct PairVerdict {
    ManifoldMemory::Verdict verdict = ManifoldMemory::Verdict::none;
    int face = 0;
    bool isOfA = false;
    double room = 0;
};

/// Farthest that a vertex is from the origin, at most.
inline Real vertexReach(const Polygon& polygon) {
    Real farthest = 0;
    for (const Vec2 v : polygon.points()) {
        const Real away = std::fabs(v.x) + std::fabs(v.y);
        farthest = away > farthest ? away : farthest;
    }
    return farthest;
}

/// Axes are chosen with stored normals, each coordinate of which is off by half a unit: up to this part of the lever
/// (with all that follows rounded too) nothing is certain.
inline constexpr Real kVerdictRounding = 64 * kEpsilon;

/// Keeps what was found out at this pose.
inline void remember(ManifoldMemory& memory, const PairVerdict& found, const Polygon& a, const Polygon& b,
                     const Transform& bInA) {
    memory.verdict = found.verdict;
    if (found.verdict == ManifoldMemory::Verdict::none) { return; }
    memory.bInA = bInA;
    if (!(memory.reaches > 0)) { memory.reaches = vertexReach(a) + vertexReach(b); }
    memory.lever = memory.reaches + std::fabs(bInA.translation.x) + std::fabs(bInA.translation.y);
    memory.face = static_cast<std::uint8_t>(found.face);
    memory.isOfA = found.isOfA;
    memory.room = clampedReal(found.room) - kVerdictRounding * memory.lever;
}

}  // namespace swept::inline SWEPT_PRECISION

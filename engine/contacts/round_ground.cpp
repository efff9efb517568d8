#include "round_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Circles have at least this radius, in slops: about the extent of what lies there. What is larger than its ground
/// balances on it.
constexpr Real kLeastRadius = 1024;
/// Of the length between two points that are not one, in slops.
constexpr Real kLeastLength = 8;
/// Cosine: a face that is steeper than this lies on nothing.
constexpr Real kLyingCosine = Real(0.875);

int faceAlong(const Polygon& polygon, Vec2 normal) {
    int best = 0;
    for (int i = 1; i < polygon.count; ++i) {
        const auto along = [&](int face) { return dot(polygon.normals[static_cast<std::size_t>(face)], normal); };
        best = along(i) > along(best) ? i : best;
    }
    return best;
}

/// The vertex that touches is one end of the face; an end of it, as seen from the point that touches.
struct FaceEnd {
    Real along = 0;   ///< across the normal, as the face runs, metres
    Real height = 0;  ///< along the normal
    int vertex = 0;
};

class Lying {
public:
    Lying(const Polygon& circle, const Polygon& b, const Transform& bInA, Real slop, const Manifold& closest)
        : b_(b), bInA_(bInA), closest_(closest), radius_(circle.radius + b.radius), along_(rightPerp(closest.normal)) {
        reach_ = std::sqrt(slop * (2 * radius_ - slop));  // where the circle fell by the slop
    }

    Manifold manifold(Real margin, Real shortest) const {
        const Vec2 down = -unrotate(bInA_.rotation, closest_.normal);
        const int face = faceAlong(b_, down);
        if (!(dot(b_.normals[static_cast<std::size_t>(face)], down) >= kLyingCosine)) { return closest_; }
        const bool isFace = closest_.isNormalOfB;
        const std::array<FaceEnd, 2> ends =
            isFace ? endsOfFace(face) : endsFromVertex(face, closest_.points[0].id & kVertexMask);
        if (!(ends[1].along - ends[0].along >= shortest)) { return closest_; }
        if (!isFace && !(ends[1].along - ends[0].along <= 2 * reach_)) { return closest_; }
        Manifold lying = closest_;
        lying.count = 2;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            lying.points[i] = pointAt(ends[i]);
            if (!(lying.points[i].separation <= margin)) { return closest_; }
        }
        return lying;
    }

private:
    static constexpr int kVertexMask = 0x7F;

    /// Within reach of the point that touches.
    std::array<FaceEnd, 2> endsOfFace(int face) const {
        const int next = b_.next(face);
        const auto along = [this](int vertex) {
            return dot(apply(bInA_, b_.vertices[static_cast<std::size_t>(vertex)]) - closest_.points[0].point, along_);
        };
        return {FaceEnd{.along = std::max(-reach_, along(face)), .vertex = face},
                FaceEnd{.along = std::min(reach_, along(next)), .vertex = next}};
    }
    /// A vertex touches, so the face is tilted by more than the circle turns below it.
    std::array<FaceEnd, 2> endsFromVertex(int face, int vertex) const {
        const int next = b_.next(face);
        if (vertex != face && vertex != next) { return {}; }
        const int other = vertex == face ? next : face;
        const Vec2 edge = rotate(bInA_.rotation, b_.vertices[static_cast<std::size_t>(other)] -
                                                     b_.vertices[static_cast<std::size_t>(vertex)]);
        const FaceEnd here{.vertex = vertex};
        const FaceEnd there{.along = dot(edge, along_), .height = dot(edge, closest_.normal), .vertex = other};
        return vertex == face ? std::array{here, there} : std::array{there, here};
    }
    ManifoldPoint pointAt(const FaceEnd& end) const {
        const ManifoldPoint& top = closest_.points[0];
        const Real square = end.along * end.along;
        const Real fall = square / (radius_ + std::sqrt(std::max(radius_ * radius_ - square, Real(0))));
        const Real apart = end.height + fall;
        return {.point = top.point + end.along * along_ + (end.height - apart / 2) * closest_.normal,
                .separation = top.separation + apart,
                .id = static_cast<FeatureId>(end.vertex)};
    }

    const Polygon& b_;
    const Transform& bInA_;
    const Manifold& closest_;
    Real radius_;
    Vec2 along_;  ///< as the face runs
    Real reach_ = 0;
};

}  // namespace

Manifold lyingOnRound(const Polygon& circle, const Polygon& b, const Transform& bInA, Real margin, Real slop,
                      const Manifold& closest) {
    const bool isLarge = circle.radius + b.radius >= kLeastRadius * slop;
    if (closest.count != 1 || b.count < 2 || !isLarge) { return closest; }
    return Lying(circle, b, bInA, slop, closest).manifold(margin, kLeastLength * slop);
}

}  // namespace swept::inline SWEPT_PRECISION

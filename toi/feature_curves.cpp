#include "feature_curves.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Vec2 vertexOf(const MethodBody& body, int i) { return body.polygon.vertices[static_cast<std::size_t>(i)]; }
double reachOf(const MethodBody& body, int i) { return body.reach[static_cast<std::size_t>(i)]; }

}  // namespace

VertexEdgeCurve::VertexEdgeCurve(const FeatureFrame& frame, int edge, int vertex)
    : frame_(frame),
      normal_(frame.owner.polygon.normals[static_cast<std::size_t>(edge)]),
      start_(vertexOf(frame.owner, edge)),
      length_(length(vertexOf(frame.owner, frame.owner.polygon.next(edge)) - start_)),
      vertex_(vertexOf(frame.other, vertex)) {
    const double spin = frame.ownerSpin();
    const double relative = frame.otherSpin() - spin;
    bend_ = spin * spin * frame.farthest + 2 * std::fabs(spin) * frame.fastest + 2 * length(frame.motion.curvature) +
            relative * relative * reachOf(frame.other, vertex);
}

Vec2 VertexEdgeCurve::vertexAt(double fraction) const {
    return frame_.offsetAt(fraction) + rotate(frame_.otherRotation(fraction), vertex_);
}

CurveSample VertexEdgeCurve::at(double fraction) const {
    const Vec2 normal = rotate(frame_.ownerRotation(fraction), normal_);
    const Vec2 offset = frame_.offsetAt(fraction);
    const Vec2 arm = rotate(frame_.otherRotation(fraction), vertex_);
    const Vec2 velocity = frame_.velocityAt(fraction) + cross(frame_.otherSpin(), arm);
    CurveSample sample{fraction, 0, 0};
    sample.value = dot(normal, offset + arm) - dot(normal_, start_) - frame_.level;
    sample.rate = dot(normal, velocity) + dot(cross(frame_.ownerSpin(), normal), offset + arm);
    return sample;
}

bool VertexEdgeCurve::accepts(double fraction) const {
    const Vec2 fromStart = unrotate(frame_.ownerRotation(fraction), vertexAt(fraction)) - start_;
    const double foot = dot(leftPerp(normal_), fromStart);
    return foot >= -frame_.resolution && foot <= length_ + frame_.resolution;
}

VertexVertexCurve::VertexVertexCurve(const FeatureFrame& frame, int ownVertex, int otherVertex)
    : frame_(frame), own_(vertexOf(frame.owner, ownVertex)), other_(vertexOf(frame.other, otherVertex)) {
    const double ownReach = reachOf(frame.owner, ownVertex);
    const double otherReach = reachOf(frame.other, otherVertex);
    const double ownSpin = std::fabs(frame.ownerSpin());
    const double otherSpin = std::fabs(frame.otherSpin());
    const double farthest = frame.farthest + ownReach + otherReach;
    const double fastest = frame.fastest + ownSpin * ownReach + otherSpin * otherReach;
    const double acceleration =
        2 * length(frame.motion.curvature) + ownSpin * ownSpin * ownReach + otherSpin * otherSpin * otherReach;
    bend_ = 2 * (fastest * fastest + farthest * acceleration);
}

CurveSample VertexVertexCurve::at(double fraction) const {
    const Vec2 own = rotate(frame_.ownerRotation(fraction), own_);
    const Vec2 other = rotate(frame_.otherRotation(fraction), other_);
    const Vec2 gap = frame_.offsetAt(fraction) + other - own;
    const Vec2 velocity =
        frame_.velocityAt(fraction) + cross(frame_.otherSpin(), other) - cross(frame_.ownerSpin(), own);
    return {fraction, dot(gap, gap) - frame_.level * frame_.level, 2 * dot(gap, velocity)};
}

}  // namespace swept::inline SWEPT_PRECISION

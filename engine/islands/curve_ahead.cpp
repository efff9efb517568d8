#include "curve_ahead.h"

#include <algorithm>

#include "../bodies/body_form.h"
#include "../state/tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The next piece, seen from the one before it, in the frame of their body.
struct NextPiece {
    bool isThere = false;
    Vec2 begin{};
    Vec2 way{};
};

NextPiece nextPiece(const ChainSegment& segment, Vec2 velocity) {
    if (dot(velocity, segment.q - segment.p) > 0) { return {segment.hasAfter, segment.q, segment.after - segment.q}; }
    return {segment.hasBefore, segment.p, segment.before - segment.p};
}

}  // namespace

bool meetsCurve(const WorldState& world, const Contact& contact, Real dt) {
    if (!contact.ofChain || contact.resistsRolling || !isRound(world.bodies[contact.bodyB])) { return false; }
    if (world.bodies[contact.bodyA].def.type != BodyType::fixed) { return false; }
    const ChainSegment& segment = world.shapes[contact.shapeA].segment;
    const Vec2 velocity = unrotate(world.motions[contact.bodyA].pose.rotation, world.motions[contact.bodyB].velocity);
    const NextPiece next = nextPiece(segment, velocity);
    const Real speed = length(velocity);
    const bool getsThere = dot(next.begin - contact.manifold.points[0].point, velocity) < square(speed) * dt;
    if (!next.isThere || !getsThere) { return false; }
    const Real span = length(next.way);
    const Real sine = dot(next.way, normalOf(segment)) / span;
    if (!(sine > 0) || !(sine < kMostCurve) || !(dot(next.way, velocity) > 0)) { return false; }
    const Real way = speed * dt;
    return way * sine * std::max(way / span, Real(1)) > 2 * kShallowRatio * contact.extent;
}

}  // namespace swept::inline SWEPT_PRECISION

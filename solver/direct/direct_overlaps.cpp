#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "../closeness.h"
#include "direct_contacts.h"
#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Part of an overlap or gap that a projection closes.
constexpr Real kProjectionRate = Real(1) / 4;
/// Of many bodies, where each step of it costs a search. (With all of it at once, the first impulses took longer to
/// find.)
constexpr Real kProjectionRateOfMany = Real(1) / 2;
/// Separations beyond this part of the distance to the centre of mass of the nearer body that can be moved are closed
/// within the step, smaller ones at its end. (With the farther one, static or not, bodies on ground that began ten
/// metres away were left with gaps that kept them from being held, and were solved in every step.)
constexpr Real kLargeRatio = Real(1) / 8192;
constexpr Real kSmallRatio = Real(1) / (1 << 20);
/// Of many bodies: 1275 boxes side by side took 60 more steps, 25 ms each, to come down to the other one.
constexpr Real kSmallRatioOfMany = Real(1) / (1 << 14);

/// How far apart a point may stay, metres.
Real toleranceAt(const ContactConstraintPoint& point, bool movesA, bool movesB, Real ratio) {
    return std::max(ratio * leverAt(point, movesA, movesB), separationRounding(point.anchorA, point.anchorB));
}

bool isStuck(const ContactConstraint& contact, const ContactConstraintPoint& point) {
    return std::fabs(point.tangentImpulse) < contact.friction * point.normalImpulse;
}

/// By so many pushes of a contact all of them together may move a body. (Where 22 x 22 discs were made in a room for 20
/// x 20, those at the walls moved by the sum of all overlaps, into others that no contact knew of: they stayed 0.95 of
/// their width deep. With twice as many they still do.)
constexpr double kMostPushes = 2;
/// Where so large a part of all points are deeper than is pushed out in a step, and a projection would leave more than
/// this part of what it is to close, there is no room for the bodies: they are iterated, which shares out what is left.
/// (Rows of discs that are moved again and again by what is left buckle, until some are in others.)
constexpr double kStuckPoints = 0.25;
constexpr double kStuckPart = 0.5;

}  // namespace

bool DirectContacts::isOverfull(const Part& part, const DirectSystem& system) const {
    const auto isStuckDeep = [&system](const Point& contact) {
        return contact.isDeep && system.changedExcess(contact.normal) < kStuckPart * contact.normal.excess;
    };
    const std::span<const Point> points = pointsOf(part);
    const auto stuck = std::count_if(points.begin(), points.end(), isStuckDeep);
    return stuck > 0 && static_cast<double>(stuck) >= kStuckPoints * static_cast<double>(points.size());
}

/// All of them alike: what a projection leaves is closed by the next ones.
void DirectContacts::limitMoves(const Part& part, DirectSystem& system) {
    const std::span<Block3> moves = system.change().subspan(part.nodes.begin, part.nodes.end - part.nodes.begin);
    double farthest = 0;
    for (const Block3& move : moves) { farthest = std::max(farthest, std::hypot(move[0], move[1])); }
    if (!(farthest > part.mostMoved)) { return; }
    const double share = part.mostMoved / farthest;
    for (Block3& move : moves) {
        for (double& x : move) { x *= share; }
    }
}

bool DirectContacts::gatherOverlaps(const SolverBatch& batch, const DirectSystem& system, Real h, bool isLast) {
    const Real rate = hasManyBodies_ ? kProjectionRateOfMany : kProjectionRate;
    const Real smallRatio = hasManyBodies_ ? kSmallRatioOfMany : kSmallRatio;
    bool anyLarge = false;
    for (Part& part : parts_) {
        part.isFar =
            gatherOverlapsOf(part, batch, system, {.rate = rate, .smallest = isLast ? smallRatio : kLargeRatio}, h);
        anyLarge = anyLarge || part.isFar;
    }
    return anyLarge;
}

bool DirectContacts::gatherOverlapsOf(Part& part, const SolverBatch& batch, const DirectSystem& system,
                                      const Projection& projection, Real h) {
    bool anyLarge = false;
    part.mostMoved = std::numeric_limits<double>::infinity();
    for (Point& contact : pointsOf(part)) {
        const ContactConstraint& constraint = *contact.contact;
        const ContactConstraintPoint& point = *contact.point;
        const Real separation =
            currentSeparation(constraint, point, batch.states[constraint.slotA], batch.states[constraint.slotB]);
        const bool presses = point.normalImpulse > 0 || separation < 0;
        const Real tolerance = toleranceAt(point, system.nodeOf(constraint.slotA) != kNoNode,
                                           system.nodeOf(constraint.slotB) != kNoNode, projection.smallest);
        anyLarge = anyLarge || (presses && std::fabs(separation) > tolerance);
        contact.normalHold = presses ? Hold::held : Hold::free;
        contact.tangentHold = presses && isStuck(constraint, point) ? Hold::held : Hold::free;
        const Real fastest = constraint.maxPushSpeed * h;
        part.mostMoved = std::min(part.mostMoved, kMostPushes * static_cast<double>(fastest));
        contact.isDeep = projection.rate * separation < -fastest;
        contact.normal.excess = static_cast<double>(std::max(projection.rate * separation, -fastest));
        contact.tangent.excess = contact.normal.guess = contact.tangent.guess = 0;
    }
    return anyLarge;
}

}  // namespace swept::inline SWEPT_PRECISION

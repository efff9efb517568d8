#include "curved_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../bodies/body_form.h"
#include "../state/tolerances.h"
#include "flight_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

const Shape& shapeMet(const Flight& flight, const ContactConstraint& constraint) {
    return flight.world->shapes[flight.scratch->obstacles[constraint.source].other];
}

/// Where the flyer is after an impact: along which of its contacts, all of one static body, it goes on.
GroundMetLast groundHere(const Flight& flight) {
    GroundMetLast ground;
    Real slowest = std::numeric_limits<Real>::infinity();
    for (const ContactConstraint& constraint : flight.scratch->constraints) {
        const std::uint32_t body = shapeMet(flight, constraint).body;
        const bool isOther = ground.body != kNoIndex && body != ground.body;
        if (isOther || constraint.slotA != kFixedSlot) { return {}; }
        const Real parting = dot(flight.motion.velocity, constraint.normal);
        if (!(parting < slowest)) { continue; }
        slowest = parting;
        ground = {body, constraint.normal, flight.motion.center, true};
    }
    return ground;
}

/// Of the energy that an impact took, twice what turning from one piece to the next did, per kilogram: all but what it
/// bounces with, and what it had from falling towards the piece before.
Real lostByTurning(const GroundMetLast& from, const GroundMetLast& to, Vec2 before, Vec2 after) {
    if (from.body != to.body || from.body == kNoIndex) { return 0; }
    const Real sine = std::fabs(cross(from.normal, to.normal));
    const bool isCurve = sine < kMostCurve && dot(from.normal, to.normal) > 0;
    const Real approach = -dot(before, to.normal);
    if (!isCurve || !(approach > 0)) { return 0; }
    const Real fall = std::max(-dot(before, from.normal), Real(0));
    return square(approach) - square(dot(after, to.normal)) - square(fall);
}

/// Whether the ground that the flyer met last is hardly farther away than then: it did not bounce off.
bool isAlong(const Flight& flight, const GroundMetLast& ground) {
    const double gap = dot(flight.motion.center - ground.center, toDouble(ground.normal));
    return gap < static_cast<double>(kShallowRatio * flight.body().extent);
}

/// What it met last. What the solver held it on is known by its normal alone: it is what it still touches as it begins.
GroundMetLast groundBefore(const Flight& flight, const GroundMetLast& here) {
    GroundMetLast ground = flight.metLast;
    if (ground.body == kNoIndex && ground.normal != Vec2{} && flight.elapsed == 0) { ground.body = here.body; }
    return isAlong(flight, ground) ? ground : GroundMetLast{};
}

}  // namespace

void goAlongCurve(Flight& flight, Vec2 before, Vec2 setBack) {
    const GroundMetLast here = groundHere(flight);
    const GroundMetLast from = groundBefore(flight, here);
    flight.metLast = here;
    if (!isRound(flight.body())) { return; }
    const Real lift = -dot(accelerationOf(*flight.world, flight.body()), setBack);
    const Real lost = lostByTurning(from, here, before, flight.motion.velocity) - 2 * std::max(lift, Real(0));
    const Real left = lengthSquared(flight.motion.velocity);
    if (lost > 0 && left > 0) { flight.motion.velocity *= std::sqrt(1 + lost / left); }
}

GroundMetLast groundOfStepBefore(const Body& body, DVec2 center) {
    const UnitAndLength normal = normalized(body.groundNormal);
    return normal.length > 0 ? GroundMetLast{.body = body.ground, .normal = normal.unit, .center = center}
                             : GroundMetLast{};
}

void rememberGround(const Flight& flight, Body& body) {
    const GroundMetLast& ground = flight.metLast;
    const bool isThere = ground.isOfThisStep && ground.body != kNoIndex && isAlong(flight, ground);
    body.ground = isThere ? ground.body : kNoIndex;
    body.groundNormal = isThere ? ground.normal : Vec2{};
}

}  // namespace swept::inline SWEPT_PRECISION

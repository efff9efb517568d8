#include "turning_ride.h"

#include <algorithm>
#include <cmath>

#include "../contacts/ghosts.h"
#include "../contacts/hit_event.h"
#include "flight_state.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// This part of `maxImpacts` is spent before it sinks in any farther, ...
constexpr int kPartAsUsual = 4;
/// ... and with this part more it does so twice as far: in 64 impacts it gets on 20 times as far as it would else.
constexpr int kPartToDouble = 16;
constexpr double kFirstSag = 0.25;  ///< slops
constexpr double kMostSag = 32;     ///< slops, a 32nd of the extent
/// Speed times time of what falls from rest is twice its height; this is for the roughness of both.
constexpr double kSinkingSpeed = 4;

double sagAfter(int impacts, int maxImpacts) {
    const int more = impacts - maxImpacts / kPartAsUsual;
    if (more < 0) { return 0; }
    return std::min(std::ldexp(kFirstSag, more / std::max(maxImpacts / kPartToDouble, 1)), kMostSag);
}

const Shape& groundOf(const Flight& flight, const ContactConstraint& constraint) {
    return flight.world->shapes[flight.scratch->obstacles[constraint.source].other];
}

/// The body that turns, of which all contacts of this moment are, along one normal; `kNoIndex`: there is none.
std::uint32_t turningBody(const Flight& flight) {
    const std::vector<ContactConstraint>& all = flight.scratch->constraints;
    const ContactConstraint& first = all.front();
    const std::uint32_t body = groundOf(flight, first).body;
    if (flight.world->bodies[body].def.type != BodyType::kinematic) { return kNoIndex; }
    if (flight.world->motions[body].angularVelocity == 0) { return kNoIndex; }
    const bool areAlike = std::all_of(all.begin(), all.end(), [&](const ContactConstraint& constraint) {
        return groundOf(flight, constraint).body == body && dot(constraint.normal, first.normal) > kSameNormal;
    });
    return areAlike ? body : kNoIndex;
}

Real fastestApproach(const FlightScratch& scratch, const ContactConstraint& constraint) {
    Real fastest = 0;
    const BodyState& a = scratch.states[constraint.slotA];
    const BodyState& b = scratch.states[constraint.slotB];
    for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
        const ContactConstraintPoint& point = constraint.points[k];
        const Vec2 velocity = velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA);
        fastest = std::max(fastest, -dot(velocity, constraint.normal));
    }
    return fastest;
}

/// How far it may have sunk since the last impact, metres: what carries it lets it sag, too (`allowSag`).
double sunkSince(const Flight& flight, const FlightObstacle& obstacle) {
    const WorldState& world = *flight.world;
    const double target = targetOf(world, obstacle);
    const double sag = std::max(flight.ride.sag, kSagSlops) * static_cast<double>(slopOf(world, obstacle));
    return sag + target - levelInContact(world, obstacle, target);
}

}  // namespace

bool slidesOn(Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    if (turningBody(flight) != flight.ride.body) { return false; }
    const double time = flight.elapsed - flight.ride.since;
    const bool isSlow =
        std::all_of(scratch.constraints.begin(), scratch.constraints.end(), [&](const auto& constraint) {
            const double way = static_cast<double>(fastestApproach(scratch, constraint)) * time;
            return way <= kSinkingSpeed * sunkSince(flight, scratch.obstacles[constraint.source]);
        });
    if (!isSlow) { return false; }
    for (ContactConstraint& constraint : scratch.constraints) { constraint.restitution = 0; }
    return true;
}

void followRide(Flight& flight, bool slides) {
    TurningRide& ride = flight.ride;
    const std::uint32_t body = turningBody(flight);
    if (body == kNoIndex) {
        ride = {};
        return;
    }
    const std::vector<ContactConstraint>& all = flight.scratch->constraints;
    ride.impacts = slides ? ride.impacts + 1 : 0;
    ride.body = body;
    ride.since = flight.elapsed;
    ride.normal = all.front().normal;
    ride.sag = sagAfter(ride.impacts, flight.world->settings.maxImpacts);
}

void endRide(Flight& flight) {
    if (flight.ride.sag > 0) { resolveStanding(flight); }
}

}  // namespace swept::inline SWEPT_PRECISION

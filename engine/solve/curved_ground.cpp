#include "curved_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "../bodies/body_form.h"
#include "../containers/any_of.h"
#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Ground bears what rides on it: with this part of its weight at least.
constexpr double kLeastBorne = 1.0 / 4;
/// What turns by less of a speed than this part of what it would fall by in the time goes straight on.
constexpr double kLeastTurned = 1.0 / 1024;
/// This part of the way into the curve is bent back at once; the rest is left to contacts, so that what comes to where
/// the ground is straight again hardly leaves it.
constexpr double kBent = 1.0 / 2;

/// Of one body and one solve, per kilogram.
struct Ride {
    DVec2 before{};  ///< velocity, m/s
    DVec2 after{};
    DVec2 pull{};  ///< m/s²
    double time = 0;

    DVec2 push() const { return after - before - time * pull; }
    bool isBorne() const {
        const double borne = squared(push());
        return borne > squared(kLeastBorne * time) * squared(pull) && borne > kGainRounding * squared(after);
    }
    /// Of the ground, towards the body, of any length: across its way, for friction pushes, too.
    Vec2 normal() const {
        const DVec2 across{-after.y, after.x};
        const double side = dot(across, push());
        return toReal(side == 0 ? push() : (side < 0 ? -1 : 1) * across);
    }
    /// Radians that it turned; 0: hardly any, too many for a curve, or it is as good as at rest.
    double turn() const {
        const double square = dot(before, after);
        const double turned = cross(before, after);
        const double least = squared(kLeastTurned * time) * squared(pull) + kGainRounding * squared(after);
        const bool isCurve =
            std::fabs(turned) < static_cast<double>(kMostCurve) * square && squared(turned) > least * square;
        return isCurve ? turned / square : 0;
    }
    /// How far it has gone into the curve, as a vector out of it, metres.
    DVec2 wayOut(double turn) const { return (0.5 * time * turn) * DVec2{-after.y, after.x}; }
};

/// What has corners turns as its way does; else it lands, or tips over one of them.
bool goesAlong(const BodyState& state, double turn) {
    return std::fabs(static_cast<double>(state.deltaAngle) - turn) < 0.5 * std::fabs(turn);
}

/// Members of islands that ride on a chain together.
template <class Visit>
void forEachRider(WorldState& world, const SolveDesk& desk, const Visit& visit) {
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        const Body& body = world.bodies[desk.bodies[i]];
        if (!isMovable(desk.batch.inertias[i + 1]) || !(body.inverseMass > 0) || mayRide(body)) { continue; }
        EnergyAccount& account = accountOf(world, desk.bodies[i]);
        if (account.solve == desk.energySolve && account.isOnChain && !account.isFed) { visit(i, body, account); }
    }
}

}  // namespace

void followCurve(const WorldState& world, std::uint32_t slot, Body& body, BodyState& state, Real time) {
    const BodyMotion& motion = world.motions[slot];
    const Ride ride{.before = toDouble(motion.velocity),
                    .after = toDouble(state.velocity),
                    .pull = toDouble(accelerationOf(world, body)),
                    .time = static_cast<double>(time)};
    const bool isBorne = ride.isBorne();
    const Vec2 before = std::exchange(body.groundNormal, isBorne ? ride.normal() : Vec2{});
    body.ground = kNoIndex;
    if (before == Vec2{} || !isBorne) { return; }
    const double turn = ride.turn();
    if (turn == 0) { return; }
    const bool round = isRound(body);
    if (!round && !goesAlong(state, turn)) { return; }
    const DVec2 out = ride.wayOut(turn);
    if (round) { state.deltaPosition += toReal(kBent * out); }
    const double turning = 0.5 * inertiaOf(body) * static_cast<double>(body.inverseMass);
    const double spins =
        squared(static_cast<double>(state.angularVelocity)) - squared(static_cast<double>(motion.angularVelocity));
    const double excess = 0.5 * (squared(ride.after) - squared(ride.before)) + turning * spins -
                          dot(ride.pull, toDouble(state.deltaPosition)) -
                          static_cast<double>(body.torque * body.inverseMass * state.deltaAngle);
    const double lift = -dot(ride.pull, out);
    const double lost = 0.5 * squared(turn) * squared(ride.before);
    const double wanted = round ? lost - lift : std::min(lost - lift, 0.0);
    const double change = std::max(std::min(wanted, -excess), std::min(-lift, 0.0));
    const double share = 1 + 2 * change / squared(ride.after);
    state.velocity = toReal(std::sqrt(std::max(share, 0.0)) * ride.after);
}

bool mayRideTogether(const WorldState& world, const SolveDesk& desk) {
    if (world.chainShapes == 0) { return false; }
    return anyOf(desk.energyRoots, [&world](std::uint32_t root) {
        const EnergyAccount& account = world.energyAccounts[root];
        return account.gained - account.work > kGainRounding * account.kinetic + kGainTremble * account.fall;
    });
}

void payForLift(WorldState& world, SolveDesk& desk, double time) {
    std::vector<IslandMotion>& islands = desk.islandMotions;
    islands.clear();
    forEachRider(world, desk, [&](std::size_t i, const Body& body, EnergyAccount& account) {
        const DVec2 before = toDouble(desk.energyEntries[i].velocityBefore);
        const Ride ride{.before = before,
                        .after = toDouble(world.motions[desk.bodies[i]].velocity),
                        .pull = toDouble(accelerationOf(world, body)),
                        .time = time};
        if (account.motion == kNoIndex) {
            account.motion = static_cast<std::uint32_t>(islands.size());
            islands.push_back({.root = world.islands.find(desk.bodies[i])});
        }
        if (!ride.isBorne()) { return; }
        islands[account.motion].lift -= body.mass * dot(ride.pull, ride.wayOut(ride.turn()));
    });
    for (IslandMotion& island : islands) {
        EnergyAccount& account = world.energyAccounts[island.root];
        const double excess = account.gained - account.springs - account.motors - account.work;
        const double paid = std::clamp(std::min(excess, island.lift), 0.0, account.kinetic);
        if (paid > 0) { island.share = std::sqrt(1 - paid / account.kinetic); }
        account.kinetic -= paid;
        account.gained -= paid;
    }
    forEachRider(world, desk, [&](std::size_t i, const Body&, const EnergyAccount& account) {
        const auto share = static_cast<Real>(islands[account.motion].share);
        BodyMotion& motion = world.motions[desk.bodies[i]];
        motion.velocity = share * motion.velocity;
        motion.angularVelocity *= share;
    });
    for (const IslandMotion& island : islands) { world.energyAccounts[island.root].motion = kNoIndex; }
}

}  // namespace swept::inline SWEPT_PRECISION

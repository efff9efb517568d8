#include "chain_balance.h"

#include <algorithm>
#include <cmath>

#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The part that damping, 1/s, takes of a kinetic energy that is the mean of that before and after. At most tanh(c·t),
/// which is exact of what nothing else moves.
double dampedPart(Real damping, double time) {
    if (damping == 0) { return 0; }
    const double x = static_cast<double>(damping) * time;
    return x / std::sqrt(1 + x * x);
}

void add(ChainSums& sums, const WorldState& world, const EnergyEntry& entry, std::uint32_t slot, double time) {
    const Body& body = world.bodies[slot];
    const BodyMotion& after = world.motions[slot];
    if (body.inverseMass > 0) {
        const double mass = body.mass;
        const DVec2 before = mass * toDouble(entry.velocityBefore);
        const DVec2 now = mass * toDouble(after.velocity);
        sums.mass += mass;
        sums.before += before;
        sums.after += now;
        sums.moved += mass * toDouble(entry.moved);
        sums.pull += mass * toDouble(accelerationOf(world, body));
        const double part = dampedPart(body.def.linearDamping, time);
        sums.damped += part * (2 * entry.kinetic - entry.gained);
        sums.dampedBefore += part * before;
        sums.dampedAfter += part * now;
        sums.leastDamping = std::min(sums.leastDamping, part);
        sums.mostDamping = std::max(sums.mostDamping, part);
    } else {
        sums.isHeld = true;
    }
    sums.damped += dampedPart(body.def.angularDamping, time) * (2 * entry.turningKinetic - entry.turningGained);
}

/// Such as parachutes: what takes much of a speed within a solve does so as the speed is then, which nobody knows.
bool isDampedUnevenly(const ChainSums& sums) {
    constexpr double kMuch = 1.0 / 8;
    return sums.mostDamping > kMuch && sums.leastDamping < sums.mostDamping;
}

/// Of what a free fall gives in a step.
constexpr double kFallsKept = 1;
/// In each step, of what was lost, and of what was gained beyond what may be by now: what swings opens its joints and
/// closes them again, in seconds; what they lost otherwise is not theirs for ever. (With an eighth of the losses the
/// waves of a bridge ended within four seconds.)
constexpr double kForgotten = 1.0 / 512;

}  // namespace

void addUpChains(WorldState& world, const TiedGroup& group, Real time) {
    SolveDesk& desk = group.desk;
    const JointChains& chains = world.jointChains;
    const bool isOne = group.role != BodyRole::solved;
    desk.chainSums.assign(isOne ? 1 : chains.list.size(), {});
    forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
        if (world.bodies[slot].holdingJoints == 0) { return; }
        const std::uint32_t place = chains.places[chains.finder.rootOf(slot)];
        const JointChain& chain = chains.list[place];
        if (!chain.lends || (!chain.isDamped && chain.anchors > 0)) { return; }
        add(desk.chainSums[isOne ? 0 : place], world, desk.energyEntries[i], slot, static_cast<double>(time));
    });
}

void noteBalance(JointChain& chain, const ChainSums* sums, EnergyAccount& account, const SolvedPart& part) {
    double kinetic = account.kinetic;
    double gained = account.gained - account.work;
    if (sums != nullptr) {
        gained += sums->damped;
        if (chain.anchors == 0) {
            if (sums->isHeld || !(sums->mass > 0) || isDampedUnevenly(*sums)) {
                chain.lent.gained = 0;
                return;
            }
            const double half = 0.5 / sums->mass;
            kinetic -= half * squared(sums->after);
            gained -= half * (squared(sums->after) - squared(sums->before));
            gained += 2 * half * dot(sums->moved, sums->pull);
            gained -= half * (dot(sums->before, sums->dampedBefore) + dot(sums->after, sums->dampedAfter));
        }
    }
    kinetic = std::max(kinetic, 0.0);
    const double falls = chain.anchors > 0 ? kFallsKept * squared(part.parts) * account.fall : 0;
    const double most = kJointedGain * kinetic + falls + kGainRounding * account.kinetic;
    double& balance = chain.lent.gained;
    if (part.isFirst) { balance -= kForgotten * (balance > 0 ? std::max(balance - most, 0.0) : balance); }
    balance += gained;
    const double beyond = std::min(gained, balance - most);
    if (!(beyond > 0)) { return; }
    balance -= beyond;
    account.owed = beyond + std::min(beyond, kJointedGain * kinetic);
}

}  // namespace swept::inline SWEPT_PRECISION

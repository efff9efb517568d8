#include "lent_energy.h"

#include <algorithm>

#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of what was taken, after each step. Gaps that opened within ten steps take three to close; with half of it the last
/// of these gave nothing back.
constexpr double kLentKept = 7.0 / 8;

/// Motors that brake, and springs, take energy for good or keep it themselves; contacts that press on joints feed on
/// what these may give. What a kinematic body leads, or a call moved, has what that gave it.
bool mayGetBack(const EnergyAccount& account) {
    const bool isHeld = account.isAnchored && !account.isTouching && !account.isLed;
    return isHeld && !account.hasMotors && !account.isSprung && !account.isFed && !account.isYanked;
}

}  // namespace

void noteLent(WorldState& world, const TiedGroup& group) {
    for (const std::uint32_t root : group.desk.energyRoots) {
        EnergyAccount& account = world.energyAccounts[root];
        LentEnergy& lent = account.lent;
        const bool isOfLastStep = lent.step + 1 >= world.steps;
        lent.before = isOfLastStep ? lent.now : 0;
        lent.now = std::max(kLentKept * lent.before + account.work - account.gained, 0.0);
        lent.step = world.steps;
    }
}

void giveBackLent(WorldState& world, const TiedGroup& group) {
    for (const std::uint32_t root : group.desk.energyRoots) {
        EnergyAccount& account = world.energyAccounts[root];
        if (mayGetBack(account)) { account.returned = kLentKept * account.lent.before; }
    }
}

void forgetLent(WorldState& world, std::uint32_t slot) {
    LentEnergy& lent = accountOf(world, slot).lent;
    lent.now = lent.before;
}

}  // namespace swept::inline SWEPT_PRECISION

#include "energy_calm.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "../bodies/swap_places.h"
#include "energy_gain.h"
#include "joint_builder.h"
#include "joint_results.h"
#include "torn_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Whether a solve may have gone off: what joints and contacts carry against each other fed itself. By more than so
/// many times the energy that there was, and that a fall gives, nothing else adds, but for what closes gaps that calls
/// made.
bool mayHaveBurst(const EnergyAccount& account) {
    constexpr double kBurst = 64;
    if (!account.isJointed) { return false; }
    const double before = std::max(ownKinetic(account) - account.gained, 0.0);
    return excessOf(account) > kBurst * (before + account.fall);
}

/// Whether what moved it left it a speed, and not only another place: overlaps are pushed out without any. (A box that
/// was at rest in a post, without gravity, stayed in it for ever once a slack rope tied the two: of no energy rounding
/// is many times as much.)
bool goesOn(const EnergyAccount& account) {
    constexpr double kLeastPart = 1.0 / 4096;
    return account.kinetic > kLeastPart * account.way;
}

/// What closed the gaps of its joints had a reason to be fast, and what hardly opened them was not led by them:
/// contacts push bodies apart that were made in each other. (Three crates on brakes, or on springs with a rigid angle,
/// stayed so.)
bool opens(const EnergyAccount& account) {
    constexpr Real kOpened = Real(1) / 256;  // of their extents, all together
    constexpr Real kOpenedByCalls =
        Real(1) / 8;  // of the gaps that calls made: what closes one of them may open others
    const Real more = account.isYanked ? kOpenedByCalls * account.gapBefore : Real(0);
    return account.gapAfter > account.gapBefore + more + kOpened;
}

class Calmer {
public:
    Calmer(WorldState& world, const TiedGroup& group) : world_(world), group_(group) {}

    void calm(double time) {
        const auto mayBe = [](const EnergyAccount& account) { return account.isTorn || mayHaveBurst(account); };
        if (!noteGaps(mayBe, &EnergyAccount::gapAfter)) { return; }
        noteWays(time, mayBe);
        const auto isOff = [&mayBe](const EnergyAccount& account) {
            const bool isBurst = goesOn(account) && opens(account);
            return mayBe(account) && (account.isTorn || isBurst);
        };
        findPlacesBack(time, mayBe);
        swapPlaces(world_, places_);
        noteGaps(mayBe, &EnergyAccount::gapBefore);
        for (const std::uint32_t root : group_.desk.energyRoots) {
            EnergyAccount& account = world_.energyAccounts[root];
            account.isCalmed = pays(account) && isOff(account);
        }
        std::erase_if(places_, [this](const SwappedPlace& place) { return accountOf(world_, place.slot).isCalmed; });
        swapPlaces(world_, places_);  // the others are there again
        payForWays();
        forget();
    }

private:
    bool pays(const EnergyAccount& account) const {
        return account.solve == group_.desk.energySolve && !account.isFed && account.motion != kNoIndex;
    }

    /// Of all joints of an island, added up: what closes one of them has a reason, whatever the others do. And how far
    /// they are beyond their limits.
    /// @return whether there are any
    template <class IsMeant>
    bool noteGaps(const IsMeant& isMeant, Real EnergyAccount::*gap) {
        bool any = false;
        for (const std::uint32_t i : group_.joints) {
            EnergyAccount& account = accountOf(world_, world_.jointTies[i]);
            if (!pays(account) || !isMeant(account)) { continue; }
            const Joint& joint = world_.joints[i];
            account.*gap += gapOf(world_, joint) + errorRatio(world_, joint, limitErrorsOf(world_, joint));
            any = true;
        }
        return any;
    }

    /// What they would have of energy if they had gone evenly to where they are.
    template <class IsMeant>
    void noteWays(double time, const IsMeant& isMeant) {
        const SolveDesk& desk = group_.desk;
        forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
            EnergyAccount& account = accountOf(world_, slot);
            if (!pays(account) || !isMeant(account)) { return; }
            const EnergyEntry& entry = desk.energyEntries[i];
            const Body& body = world_.bodies[slot];
            const double turned = inertiaOf(body) * squared(static_cast<double>(entry.turned));
            account.way += 0.5 * (body.mass * squared(toDouble(entry.moved)) + turned) / squared(time);
        });
    }

    /// Where a body gets with what is left of its motion relative to its island, as the island goes as a whole.
    template <class IsMeant>
    void findPlacesBack(double time, const IsMeant& isMeant) {
        SolveDesk& desk = group_.desk;
        forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
            const EnergyAccount& account = accountOf(world_, slot);
            if (!pays(account) || !isMeant(account)) { return; }
            const Body& body = world_.bodies[slot];
            const IslandMotion& island = desk.islandMotions[account.motion];
            const DVec2 arm = world_.motions[slot].center - world_.motions[island.root].center - island.center;
            const DVec2 whole = island.keptVelocity + island.keptSpin * DVec2{-arm.y, arm.x};
            const double part = mayHaveBurst(account) ? 1 : 1 - island.share;
            const BodyMotion& motion = world_.motions[slot];
            EnergyEntry& entry = desk.energyEntries[i];
            const DVec2 back = part * (time * whole - toDouble(entry.moved));
            const double turned = part * (time * island.keptSpin - static_cast<double>(entry.turned));
            places_.push_back({slot, motion.center + back, motion.angle + turned});
            entry.work += body.mass * dot(toDouble(accelerationOf(world_, body)), back);
            entry.turningWork += static_cast<double>(body.torque) * turned;
        });
    }

    double kineticOf(std::uint32_t slot) const {
        const Body& body = world_.bodies[slot];
        const BodyMotion& motion = world_.motions[slot];
        return 0.5 * (body.mass * squared(toDouble(motion.velocity)) +
                      inertiaOf(body) * squared(static_cast<double>(motion.angularVelocity)));
    }

    template <class Visit>
    void forEachCalmed(const Visit& visit) {
        const SolveDesk& desk = group_.desk;
        forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
            EnergyAccount& account = accountOf(world_, slot);
            if (account.isCalmed) { visit(account, desk.energyEntries[i], slot); }
        });
    }

    /// Gravity gave nothing for ways that were not gone. (Twelve boxes on hinges that did not fit each other were
    /// thrown down by a kilometre, put back, and left with the energy of that fall.) @pre they are put back
    void payForWays() {
        SolveDesk& desk = group_.desk;
        for (const std::uint32_t root : desk.energyRoots) {
            EnergyAccount& account = world_.energyAccounts[root];
            if (!account.isCalmed) { continue; }
            account.gained -= account.kinetic;
            account.kinetic = account.work = 0;
        }
        forEachCalmed([this](EnergyAccount& account, const EnergyEntry& entry, std::uint32_t slot) {
            const double kinetic = kineticOf(slot);
            account.kinetic += kinetic;
            account.gained += kinetic;
            account.work += entry.work + entry.turningWork;
        });
        forEachCalmed([&](const EnergyAccount& account, const EnergyEntry&, std::uint32_t slot) {
            const double excess = excessOf(account);
            if (!(excess > 0)) { return; }
            const IslandMotion& island = desk.islandMotions[account.motion];
            const double whole = 0.5 * island.mass * squared(island.keptVelocity);
            const double own = account.kinetic - whole;
            const double left = speedLeft(own, excess, account.kinetic);
            const double wholeLeft = speedLeft(whole, std::max(excess - std::max(own, 0.0), 0.0), account.kinetic);
            BodyMotion& motion = world_.motions[slot];
            const DVec2 relative = toDouble(motion.velocity) - island.keptVelocity;
            motion.velocity = toReal(wholeLeft * island.keptVelocity + left * relative);
            motion.angularVelocity *= static_cast<Real>(left);
        });
    }

    /// What the next step would begin with.
    void forget() {
        const auto isCalmed = [this](const EnergyAccount& account) {
            return account.solve == group_.desk.energySolve && account.isCalmed;
        };
        for (const std::uint32_t i : group_.joints) {
            if (isCalmed(accountOf(world_, world_.jointTies[i]))) { forgetStart(world_.joints[i]); }
        }
        const auto forgetContact = [&](Contact& contact) {
            if (!isCalmed(accountOf(world_, contact.dynamicBody()))) { return; }
            contact.normalImpulse = contact.tangentImpulse = {};
        };
        if (group_.role == BodyRole::solved) {
            for (const TouchingPair& pair : world_.touching) { forgetContact(world_.contacts[pair.contact]); }
        } else {
            for (Contact& contact : group_.contacts) { forgetContact(contact); }
        }
    }

    WorldState& world_;
    const TiedGroup& group_;
    std::vector<SwappedPlace> places_;
};

}  // namespace

Real gapOf(const WorldState& world, const Joint& joint) { return errorRatio(world, joint, errorsOf(world, joint)); }

void calmTorn(WorldState& world, const TiedGroup& group, double time) { Calmer(world, group).calm(time); }

}  // namespace swept::inline SWEPT_PRECISION

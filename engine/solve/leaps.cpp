#include "leaps.h"

#include <cstdint>
#include <vector>

#include "../bodies/body_joints.h"
#include "../bodies/body_mass.h"
#include "../bodies/swap_places.h"
#include "energy_calm.h"
#include "energy_gain.h"
#include "joint_results.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of the energy that an island has, and that a fall gives it: so much it would have if it went evenly to where it is.
constexpr double kLeap = 64;
/// Of the gaps of its joints, all together: by so much they grow, ...
constexpr Real kGrowth = Real(5) / 4;
/// ... and so wide they are in the mean, extents or radians: nearer than that they may settle how they like.
constexpr Real kWide = 2;

struct Leap {
    double mass = 0;
    bool isAnchored = false;
    DVec2 momentum{};  ///< before the solve
    double way = 0;    ///< J, see `kLeap`
    double kinetic = 0;
    Real gapBefore = 0;
    Real gapAfter = 0;
    Real joints = 0;

    bool isFar() const { return way > kLeap * kinetic; }
    bool opens() const { return gapAfter > kGrowth * gapBefore && gapAfter > kWide * joints; }
};

class LeapFinder {
public:
    LeapFinder(WorldState& world, const TiedGroup& group) : world_(world), group_(group) {}

    void undo(double time) {
        listIslands();
        addUp(time);
        noteGaps(&Leap::gapAfter);
        listBack();
        if (back_.empty()) { return; }
        swapPlaces(world_, back_);
        noteGaps(&Leap::gapBefore);
        std::erase_if(back_, [this](const SwappedPlace& place) { return leapOf(place.slot)->opens(); });
        swapPlaces(world_, back_);  // those that open no joints are there again
        goOn(time);
    }

private:
    Leap* leapOf(std::uint32_t slot) {
        const EnergyAccount& account = accountOf(world_, slot);
        const bool isTold = account.solve == group_.desk.energySolve && account.motion < leaps_.size();
        // What was calmed is back where it was, and is not where its entries lead from.
        return isTold && !account.isCalmed ? &leaps_[account.motion] : nullptr;
    }

    /// Those with joints.
    void listIslands() {
        for (const std::uint32_t root : group_.desk.energyRoots) { world_.energyAccounts[root].motion = kNoIndex; }
        for (const std::uint32_t i : group_.joints) {
            const JointTie& tie = world_.jointTies[i];
            EnergyAccount& account = accountOf(world_, tie);
            if (account.solve != group_.desk.energySolve) { continue; }
            if (account.motion == kNoIndex) {
                account.motion = static_cast<std::uint32_t>(leaps_.size());
                leaps_.emplace_back();
            }
            Leap& leap = leaps_[account.motion];
            leap.joints += 1;
            const bool isAnchor = !world_.bodies[tie.bodyA].isDynamic() || !world_.bodies[tie.bodyB].isDynamic();
            leap.isAnchored = leap.isAnchored || isAnchor;
        }
    }

    void addUp(double time) {
        const SolveDesk& desk = group_.desk;
        forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
            Leap* const leap = leapOf(slot);
            if (leap == nullptr) { return; }
            const EnergyEntry& entry = desk.energyEntries[i];
            const Body& body = world_.bodies[slot];
            const double inertia = inertiaOf(body);
            const double turned = inertia * squared(static_cast<double>(entry.turned));
            leap->mass += body.mass;
            leap->momentum += body.mass * toDouble(entry.velocityBefore);
            leap->way += 0.5 * (body.mass * squared(toDouble(entry.moved)) + turned) / squared(time);
            leap->kinetic += entry.kinetic + entry.turningKinetic + entry.fall +
                             0.5 * (body.mass * squared(toDouble(entry.velocityBefore)) +
                                    inertia * squared(static_cast<double>(entry.spinBefore)));
        });
    }

    void noteGaps(Real Leap::*gap) {
        for (const std::uint32_t i : group_.joints) {
            Leap* const leap = leapOf(dynamicBodyOf(world_, world_.jointTies[i]));
            if (leap != nullptr && leap->isFar()) { leap->*gap += gapOf(world_, world_.joints[i]); }
        }
    }

    void listBack() {
        const SolveDesk& desk = group_.desk;
        forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
            const Leap* const leap = leapOf(slot);
            if (leap == nullptr || !leap->isFar()) { return; }
            const BodyMotion& motion = world_.motions[slot];
            const EnergyEntry& entry = desk.energyEntries[i];
            back_.push_back(
                {slot, motion.center - toDouble(entry.moved), motion.angle - static_cast<double>(entry.turned)});
        });
    }

    /// Those that stay back.
    void goOn(double time) {
        for (const std::uint32_t i : group_.joints) {
            const Leap* const leap = leapOf(dynamicBodyOf(world_, world_.jointTies[i]));
            if (leap != nullptr && leap->isFar() && leap->opens()) { forgetStart(world_.joints[i]); }
        }
        const SolveDesk& desk = group_.desk;
        forEachMoved(desk, [&](std::size_t, std::uint32_t slot) {
            const Leap* const leap = leapOf(slot);
            if (leap == nullptr || !leap->isFar() || !leap->opens() || leap->isAnchored) { return; }
            world_.motions[slot].center += (time / leap->mass) * leap->momentum;
            updatePose(world_, slot);
        });
    }

    WorldState& world_;
    const TiedGroup& group_;
    std::vector<Leap> leaps_;
    std::vector<SwappedPlace> back_;  ///< where bodies were, or are
};

}  // namespace

void undoLeaps(WorldState& world, const TiedGroup& group, double time) {
    if (!group.joints.empty()) { LeapFinder(world, group).undo(time); }
}

}  // namespace swept::inline SWEPT_PRECISION

#include "effort_budget.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "../solve/joint_builder.h"
#include "../state/profile.h"
#include "../state/world_state.h"
#include "blows.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Sub-steps are doubled from this part of the budget on: where a step is no longer good (effort_trial.h).
constexpr Real kRaiseRatio = kGoodBudgetRatio;
/// They are halved below this one. Four times the error is then still seven eighths of what would double them again:
/// what is steady does not go to and fro. One halving a step: a taut bridge whose joints became softer and stiffer by
/// sixteen in turns was pumped up.
constexpr Real kLowerRatio = kRaiseRatio * Real(7) / 32;
/// Blows and forces may take this part of the budget, beside what was there before them.
constexpr Real kBlowRatio = Real(1) / 4;
constexpr Real kForceRatio = Real(1) / 4;
/// The error falls with the square of the sub-steps.
constexpr Real kErrorOfDoubling = 4;
/// The fewest are a quarter of what the island is given without budget.
constexpr std::int8_t kMostHalvings = 2;

/// Metres that a blow of this step would go on in it. What is struck takes over the part M/(M + m) of the speed and
/// strikes what is behind it, which iteration tells no sooner than a sub-step later: each goes in as far as a sub-step
/// takes it. A body on its own that lands on what does not yield is met by velocities alone, exactly.
Real blowOf(const WorldState& world, const Contact& contact, Real dt) {
    const Body& bodyA = world.bodies[contact.bodyA];
    const Body& bodyB = world.bodies[contact.bodyB];
    const bool alone = !bodyA.isDynamic() ? !bodyB.touchesDynamic : !bodyB.isDynamic() && !bodyA.touchesDynamic;
    if (alone) { return 0; }
    const Real fastest = closingSpeedOf(world, contact, dt);
    const Real heavier = std::min(bodyA.inverseMass, bodyB.inverseMass);
    return fastest * dt * (1 - heavier / (bodyA.inverseMass + bodyB.inverseMass));
}

/// Metres that the user's forces would take a body in the step if nothing held it: what holds it gives way by this over
/// the square of the sub-steps, at once.
Real pushOf(const Body& body, Real dt) {
    const Real turning = std::fabs(body.torque) * body.inverseInertia * body.radius;
    return (length(body.force) * body.inverseMass + turning) * dt * dt;
}

void measureBodies(WorldState& world, Real dt) {
    for (const std::uint32_t slot : world.awake) { world.islandErrors[slot] = {}; }
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        if (body.role != BodyRole::solved) { continue; }
        IslandErrors& errors = world.islandErrors[world.islands.find(slot)];
        // What was solved all at once had few sub-steps and no error: that tells nothing about what iteration needs.
        const bool tells = body.effort.direct != DirectScope::all;
        const std::int8_t doublings = tells ? body.effort.doublings : std::max(body.effort.doublings, std::int8_t{0});
        errors.doublings = std::max(errors.doublings, doublings);
        errors.push = std::max(errors.push, pushOf(body, dt));
    }
}

void measureContacts(WorldState& world, Real dt) {
    const Real budget = world.settings.maxPenetration;
    for (const ContactProbe& probe : world.probes) {
        const Contact& contact = world.contacts[probe.contact];
        if (!contact.isSolid()) { continue; }
        const std::uint32_t slot = contact.dynamicBody();
        if (!world.bodies[slot].awake) { continue; }
        IslandErrors& errors = world.islandErrors[world.islands.find(slot)];
        const Real depth = -deepestSeparation(contact.manifold);
        errors.hasContacts = true;
        errors.penetration = std::max(errors.penetration, depth);
        errors.blow = std::max(errors.blow, blowOf(world, contact, dt));
        world.counters.overPenetration += depth > budget ? 1 : 0;
    }
}

void measureJoints(WorldState& world) {
    const Real budget = world.settings.maxJointError;
    for (const std::uint32_t i : world.activeJoints) {
        const Joint& joint = world.joints[i];
        const auto bodies = joint.allBodies();
        const auto moves = [&world](std::uint32_t slot) { return world.bodies[slot].isDynamic(); };
        IslandErrors& errors =
            world.islandErrors[world.islands.find(*std::find_if(bodies.begin(), bodies.end(), moves))];
        const Real error = errorsOf(world, joint).length;
        errors.hasJoints = true;
        errors.jointError = std::max(errors.jointError, error);
        world.counters.overJointError += error > budget ? 1 : 0;
    }
}

/// Towards the budgets of one island.
class Search {
public:
    Search(const WorldSettings& settings, std::int8_t before)
        : subSteps_(subStepsOf(settings)), most_(std::max(kMostSubSteps, subSteps_)), before_(before) {
        while (subStepsFor({.doublings = before_}, subSteps_) > most_) { --before_; }  // other settings, before
    }

    /// What an error becomes that the sub-steps of the last step left.
    std::int8_t doublingsForError(Real error, Real budget) const {
        std::int8_t doublings = before_;
        if (error < kLowerRatio * budget) { return --doublings; }
        for (; error > kRaiseRatio * budget && mayDouble(doublings); error /= kErrorOfDoubling) { ++doublings; }
        return doublings;
    }
    /// What comes anew in this step, and falls with the sub-steps or with their square.
    std::int8_t doublingsForNews(Real blow, Real push, Real budget, std::int8_t fewest) const {
        std::int8_t doublings = fewest;
        const auto goesFar = [&] {
            const auto n = static_cast<Real>(subStepsFor({.doublings = doublings}, subSteps_));
            return blow > kBlowRatio * budget * n || push > kForceRatio * budget * n * n;
        };
        while (goesFar() && mayDouble(doublings)) { ++doublings; }
        return doublings;
    }

private:
    bool mayDouble(std::int8_t doublings) const {
        return subStepsFor({.doublings = static_cast<std::int8_t>(doublings + 1)}, subSteps_) <= most_;
    }

    int subSteps_;  ///< that the settings ask for
    int most_;
    std::int8_t before_;
};

/// @param usual  the effort without budget
std::int8_t doublingsFor(const WorldSettings& settings, const IslandErrors& errors, Effort usual) {
    constexpr Real kNone = std::numeric_limits<Real>::infinity();
    const bool holdsContacts = errors.hasContacts && settings.maxPenetration < kNone;
    const bool holdsJoints = errors.hasJoints && settings.maxJointError < kNone;
    // What no budget bounds gets no worse. Contacts that are solved all at once have their few sub-steps for other
    // reasons, and what whips about at the end of a chain has its many.
    const bool isBounded = holdsContacts == errors.hasContacts && holdsJoints == errors.hasJoints;
    const bool isFree = usual.direct == DirectScope::none || (usual.direct != DirectScope::all && usual.doublings == 0);
    const bool mayLower = isBounded && isFree;
    const Search search(settings, usual.direct == DirectScope::all ? usual.doublings : errors.doublings);
    auto doublings = static_cast<std::int8_t>(usual.doublings - (mayLower ? kMostHalvings : 0));
    if (holdsJoints) {
        doublings = std::max(doublings, search.doublingsForError(errors.jointError, settings.maxJointError));
        doublings = search.doublingsForNews(0, errors.push, settings.maxJointError, doublings);
    }
    if (holdsContacts) {
        doublings = std::max(doublings, search.doublingsForError(errors.penetration, settings.maxPenetration));
        doublings = search.doublingsForNews(errors.blow, errors.push, settings.maxPenetration, doublings);
    }
    return doublings;
}

}  // namespace

void keepErrorBudgets(WorldState& world, double dt) {
    world.islandErrors.resize(std::max<std::size_t>(world.islandErrors.size(), world.bodies.slotCount()));
    measureBodies(world, static_cast<Real>(dt));
    measureContacts(world, static_cast<Real>(dt));
    measureJoints(world);
    for (const std::uint32_t slot : world.tied) {
        IslandLoad& load = world.islandLoads[slot];
        if (load.bodies == 0) { continue; }
        load.effort.doublings = doublingsFor(world.settings, world.islandErrors[slot], load.effort);
    }
}

}  // namespace swept::inline SWEPT_PRECISION

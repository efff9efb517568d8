#include "part_sub_steps.h"

#include <algorithm>
#include <cmath>

#include "../bodies/body_form.h"
#include "../flight/whirls.h"
#include "../islands/hard_pull.h"
#include "../islands/rod_turn.h"
#include "../state/profile.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Radians in a sub-step that joints still follow well.
constexpr double kMaxTurnOfSubStep = 1.0 / 16;
/// Sub-steps of any part of an island with joints between its members: what an impact gives to one body goes through
/// one or two joints in each. With one, ragdolls at 100 m/s came apart by 9 cm, with four by 5 to 8, with eight by 4,
/// and waited a tenth of the time. A joint to the ground passes nothing on.
constexpr int kFewestJointedSubSteps = 8;

/// What is this part of its radius beside the centre of a wheel is on its axle.
constexpr Real kAxleRatio = Real(1) / 256;

/// Whether a joint ties members to each other, and not only to what does not yield.
bool areMembersJoined(const WorldState& world, const AdvancingIsland& island) {
    const auto yields = [&world](std::uint32_t slot) { return world.bodies[slot].isDynamic(); };
    return std::any_of(island.jointSlots.begin(), island.jointSlots.end(), [&](std::uint32_t joint) {
        const auto bodies = world.joints[joint].allBodies();
        return std::count_if(bodies.begin(), bodies.end(), yields) > 1;
    });
}

/// Whether a joint holds a wheel beside its axle: then it goes round as that turns.
bool isCrank(const Body& body, Vec2 localAnchor) {
    return body.isDynamic() && isRound(body) &&
           lengthSquared(localAnchor - body.localCenter) > square(kAxleRatio * body.radius);
}

/// Whether what it holds goes round as A turns, wherever that is held.
bool leadsByAxis(const Joint& joint) {
    const JointType type = joint.type();
    return type == JointType::prismatic || type == JointType::wheel || type == JointType::motor;
}

/// Whether it is a body on its own whose pull is for short sub-steps.
bool isOneHard(const WorldState& world, const AdvancingIsland& island, double dt) {
    const std::vector<std::uint32_t>& members = island.members;
    return members.size() == 1 && island.jointSlots.empty() &&
           isPulledHard(world, world.bodies[members[0]], static_cast<Real>(dt));
}

}  // namespace

double fastestSpin(const WorldState& world, std::span<const std::uint32_t> members,
                   std::span<const std::uint32_t> joints, Spinners which) {
    double fastest = 0;
    const auto count = [&](std::uint32_t slot) {
        fastest = std::max(fastest, std::fabs(static_cast<double>(world.motions[slot].angularVelocity)));
    };
    for (const std::uint32_t slot : members) {
        const Body& body = world.bodies[slot];
        const bool isHeld = body.holdingJoints > 0;
        if (isHeld ? !isRound(body) : which == Spinners::all) { count(slot); }
    }
    for (const std::uint32_t slot : joints) {
        const Joint& joint = world.joints[slot];
        if (leadsByAxis(joint) || isCrank(world.bodies[joint.bodyA], joint.localAnchorA)) { count(joint.bodyA); }
        if (isCrank(world.bodies[joint.bodyB], joint.localAnchorB)) { count(joint.bodyB); }
        fastest = std::max(fastest, rodTurnOf(world, joint));
    }
    return fastest;
}

bool isOnePart(const WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> joints,
               double dt) {
    if (fastestWhirl(world, members) > 0) { return false; }
    return fastestSpin(world, members, joints, Spinners::all) * dt <= (joints.empty() ? kMaxLooseTurn : kMaxTurn);
}

int subStepsOfPart(const WorldState& world, const AdvancingIsland& island, double time, double dt) {
    const Effort effort = world.bodies[island.members[0]].effort;
    const int usual = subStepsOf(world.settings);
    const int asked = effort.isCrowd() || isOneHard(world, island, dt) ? subStepsFor(effort, usual) : usual;
    const bool isJointed = !island.jointSlots.empty();
    const bool isBudgeted = hasErrorBudget(world.settings);
    // Light links that heavy bodies swing past whip round within a part, unforeseen by the spin at its start: what the
    // effort says of the whole step (doublingsForWhips) goes for its parts. With a budget it may be fewer sub-steps
    // than asked for: joints that then open too far are advanced again (effort_trial.h).
    const int chosen = subStepsFor(effort, usual);
    const int atLeast = isJointed && isBudgeted ? 1 : asked;
    const int standard = isJointed || isBudgeted ? std::max(atLeast, chosen) : asked;
    const double share = std::ceil(standard * time / dt * (1 - kShortestPart));
    if (!isJointed) { return std::clamp(static_cast<int>(share), 1, standard); }
    const bool areJoined = areMembersJoined(world, island);
    // What is loose may whirl beside joints that lead to the ground alone: none of these has to follow that.
    const double spin =
        fastestSpin(world, island.members, island.jointSlots, areJoined ? Spinners::all : Spinners::heldByJoints);
    const double turns = std::ceil(spin * time / kMaxTurnOfSubStep);
    const int fewest = areJoined ? std::min(kFewestJointedSubSteps, standard) : 1;
    return std::clamp(static_cast<int>(std::min<double>(standard, std::max(turns, share))), fewest, standard);
}

}  // namespace swept::inline SWEPT_PRECISION

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <swept/engine/islands/effort_trial.h>

#include "joint_support.h"
#include "state_of.h"

/// What was solved and is solved again, with more sub-steps or from impact to impact, begins as if it were the first
/// time.

namespace swept::test {
namespace {

/// The method stays what it was, with all that the solver is told of it: a large web is searched as patiently, and what
/// takes turns is in no class with what does not.
TEST(TakenBack, MoreSubStepsChangeNothingElse) {
    WorldSettings settings = awakeSettings(0);
    settings.maxJointError = real(1e-4);
    World world = makeWorld(settings);
    const BodyId ground = anchorOf(world);
    const BodyId body = addBody(world, dynamicAt({1, 0}), circle(0.5));
    const JointId joint = must(world.createJoint(RevoluteJointDef{.base = between(ground, body)}));
    run(world, 1);
    WorldState& state = stateOf(world);
    const Effort before{.direct = DirectScope::joints, .isInTurns = true, .isLarge = true, .retry = 3};
    state.bodies[body.index].effort = before;
    state.motions[body.index].center.x += 0.01;
    state.motions[body.index].pose.position.x += 0.01;
    const std::vector<std::uint32_t> members{body.index};
    const std::vector<std::uint32_t> joints{joint.index};
    ASSERT_TRUE(raiseMissedJoints(state, members, joints, kStep));
    Effort after = state.bodies[body.index].effort;
    EXPECT_GT(after.doublings, before.doublings);
    after.doublings = before.doublings;
    EXPECT_EQ(after, before);
}

/// A ball lands in a bowl of straight pieces, and in the same step meets the next one: it loses what goes across the
/// piece that it lands on, as any that comes down. What the solve that was taken back took it to be borne by is no
/// ground of the step before, of which a curve would give that back.
TEST(TakenBack, WhatLandsWasNotBorneBefore) {
    constexpr double kRadius = 5;
    constexpr double kPiece = 0.24;  // radians
    constexpr double kEnd = 1.2;
    constexpr double kDown = 0.2;
    constexpr double kSpeed = 50;
    constexpr double kGap = 0.03;
    for (const Profile profile : kProfiles) {
        for (int i = 0; i < 10; ++i) {
            World world = makeWorld(profile);
            std::vector<Vec2> points;
            for (double at = -kEnd; at < kEnd + 0.5 * kPiece; at += kPiece) {
                points.push_back(vec(-kRadius * std::sin(at), -kRadius * std::cos(at)));
            }
            must(world.addChain(must(world.createBody({})), points, false, material(0)));
            const double middle = kPiece * (2.5 + static_cast<double>(i / 2)) - kEnd;
            const double place = middle + (i % 2 == 0 ? -0.01 : 0.02);
            const DVec2 start = turned({0, -(kRadius - 0.25 - kGap)}, place);
            const Vec2 velocity = toReal(turned({kSpeed, 0}, place - kDown));
            const BodyId ball = addBody(world, dynamicAt(start, velocity), circle(0.25), material(0));
            const double before = 0.5 * kSpeed * kSpeed + kGravity * start.y;
            must(world.step(kStep));
            const DVec2 after = velocityOf(world, ball);
            const double lost = before - 0.5 * dot(after, after) - kGravity * world.position(ball).y;
            const double across = kSpeed * std::sin(middle - place + kDown);
            EXPECT_NEAR(lost, 0.5 * across * across, 0.5) << profileName(profile) << ' ' << i;
        }
    }
}

/// A pair on a hinge comes through a floor from below, and is solved several times for a budget that it misses: what it
/// crosses as the step ends it crosses once.
TEST(TakenBack, NothingIsCrossedTwice) {
    std::uint64_t again = 0;
    std::size_t crossed = 0;
    for (int i = 0; i < 40; ++i) {
        WorldSettings settings = awakeSettings();
        settings.maxJointError = real(kIsDouble ? 1e-16 : 1e-7);
        World world = makeWorld(settings);
        std::vector<Vec2> points;
        for (int k = 0; k <= 40; ++k) { points.push_back(vec(10 - 0.5 * k, 0)); }
        must(world.addChain(must(world.createBody({})), points, false, material(0)));
        std::vector<BodyId> balls;
        for (const double x : {-0.6, 0.6}) {
            balls.push_back(addBody(world, dynamicAt({x, -0.55 - 0.02 * i}, vec(3 * x, 40), 20), circle(0.5)));
        }
        must(world.createJoint(RevoluteJointDef{.base = between(balls[0], balls[1]), .anchor = {0, -0.55 - 0.02 * i}}));
        for (int step = 0; step < 2; ++step) {
            run(world, 1);
            again += world.counters().bodiesAgain;
            const std::vector<ChainPasser>& passers = stateOf(world).crossed;
            crossed += passers.size();
            EXPECT_EQ(std::adjacent_find(passers.begin(), passers.end()), passers.end()) << i << ", step " << step;
        }
    }
    EXPECT_GT(again, 0U);
    EXPECT_GT(crossed, 0U);
}

}  // namespace
}  // namespace swept::test

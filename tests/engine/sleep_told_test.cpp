#include <algorithm>
#include <cstddef>
#include <vector>

#include "sleeping_stack.h"
#include "world_support.h"

/// Who may sleep, and who is told to have fallen asleep.

namespace swept::test {
namespace {

TEST(Sleep, WhatMayNotSleepKeepsAwakeWhatTouchesItOrIsJointedToIt) {
    SleepingStack stack;
    World& world = stack.world;
    const BodyId loner = addBody(world, dynamicAt({5, 0.5}), box(0.5, 0.5), material(0.6));
    const BodyId hung = addBody(world, dynamicAt({10, 3}), box(0.5, 0.5), material(0.6));
    RevoluteJointDef hinge;
    hinge.base.bodyA = stack.ground;
    hinge.base.bodyB = hung;
    hinge.anchor = {10, 3};
    ASSERT_TRUE(world.createJoint(hinge).ok());
    const auto allow = [&world](BodyId body, bool may) {
        BodyDef def = world.definition(body);
        def.allowSleep = may;
        ASSERT_TRUE(world.redefine(body, def).ok());
        EXPECT_EQ(world.definition(body).allowSleep, may);
    };
    allow(stack.boxes[2], false);
    allow(hung, false);
    runFor(world, 8);
    EXPECT_EQ(stack.awake(), 5);
    EXPECT_TRUE(world.isAwake(hung));
    EXPECT_FALSE(world.isAwake(loner));
    const World copy = world;
    EXPECT_FALSE(copy.definition(hung).allowSleep);

    // What a call puts to sleep stays so until something wakes it.
    ASSERT_TRUE(world.setAwake(hung, false).ok());
    runFor(world, 1);
    EXPECT_FALSE(world.isAwake(hung));
    allow(stack.boxes[2], true);
    allow(hung, true);
    EXPECT_TRUE(world.isAwake(hung));
    runFor(world, 8);
    EXPECT_EQ(stack.awake(), 0);
    EXPECT_FALSE(world.isAwake(hung));
}

TEST(Sleep, WhoFellAsleepIsTold) {
    SleepingStack stack;
    World& world = stack.world;
    const BodyId first = addBody(world, dynamicAt({5, 0.5}), box(0.5, 0.5), material(0.6));
    std::vector<BodyId> told;
    for (int i = 0; i < 600; ++i) {
        std::vector<bool> wasAwake;
        world.visitBodies([&](BodyId id) { wasAwake.push_back(world.isAwake(id)); });
        run(world, 1);
        std::vector<BodyId> expected;
        std::size_t at = 0;
        world.visitBodies([&](BodyId id) {
            if (wasAwake[at++] && !world.isAwake(id)) { expected.push_back(id); }
        });
        const auto now = world.bodiesFellAsleep();
        ASSERT_TRUE(std::equal(now.begin(), now.end(), expected.begin(), expected.end())) << "step " << i;
        ASSERT_EQ(world.counters().fellAsleep, now.size()) << "step " << i;
        told.insert(told.end(), now.begin(), now.end());
        if (i == 300) {
            ASSERT_EQ(told.size(), 6U);
            ASSERT_TRUE(world.applyImpulse(first, vec(0, 1)).ok());
        }
    }
    EXPECT_EQ(told.size(), 7U);
    EXPECT_EQ(told.back(), first);
    // What a call puts to sleep fell asleep in no step.
    ASSERT_TRUE(world.setAwake(first, true).ok());
    ASSERT_TRUE(world.setAwake(first, false).ok());
    run(world, 1);
    EXPECT_TRUE(world.bodiesFellAsleep().empty());
}

}  // namespace
}  // namespace swept::test

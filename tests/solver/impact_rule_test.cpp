#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "impact_case.h"

namespace swept::test {
namespace {

TEST(Impact, RestsBelowTheThresholdUnlessPlasticIsAskedFor) {
    const ImpactFamily family{.form = Form::disk, .partner = Partner::still};
    int checked = 0;
    for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
        const ImpactCase before = randomImpact(family, seed);
        const Wide approach = approachOf(before, 0);
        if (approach < Wide(0.01)) { continue; }
        ++checked;
        ImpactCase slow = before;
        EXPECT_FALSE(resolveImpact(slow.contact, slow.bodies(), {.restitutionThreshold = real(double(2 * approach))}));
        EXPECT_EQ(slow.states[2].velocity, before.states[2].velocity) << "seed " << seed;
        ImpactCase fast = before;
        EXPECT_TRUE(resolveImpact(fast.contact, fast.bodies(), {.restitutionThreshold = real(double(approach / 2))}));
        const ImpactRule plastic{.restitutionThreshold = real(double(2 * approach)), .resolvePlastic = true};
        ImpactCase stopped = before;
        EXPECT_TRUE(resolveImpact(stopped.contact, stopped.bodies(), plastic));
        EXPECT_LE(apart(approachOf(stopped, 0), 0),
                  16 * Wide(kEpsilon) * std::max(speedScale(before, 0), speedScale(stopped, 0)))
            << "seed " << seed;
    }
    EXPECT_GT(checked, 300);
}

TEST(Impact, WaitsForPointsThatDoNotMeetWithinTheHorizon) {
    ImpactCase c;
    c.inertias[2] = {1, 0};
    c.states[2].velocity = {0, -2};
    c.contact.slotA = 1;
    c.contact.slotB = 2;
    c.contact.normal = {0, 1};
    c.contact.restitution = Real(0.5);
    c.contact.count = 1;
    c.contact.points[0].anchorB = {0, -1};
    c.contact.points[0].baseSeparation = 1;  // meets in half a second
    c.prepare();
    EXPECT_FALSE(resolveImpact(c.contact, c.bodies(), {.horizon = Real(0.25)}));
    EXPECT_EQ(c.states[2].velocity.y, Real(-2));
    EXPECT_TRUE(resolveImpact(c.contact, c.bodies(), {.horizon = Real(0.5)}));
    EXPECT_EQ(c.states[2].velocity.y, Real(1));
}

/// A rolling disk: moving and turning cancel at the contact, and what rounding leaves there is not an approach.
TEST(Impact, RollingIsNoImpact) {
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Random random(seed);
        ImpactCase c;
        const double direction = random.range(-3.14, 3.14);
        const double radius = std::exp2(random.range(-3, 3));
        const double speed = random.range(-10, 10);
        c.contact.normal = turned(direction, 1, 0);
        c.contact.slotA = 1;
        c.contact.slotB = 2;
        c.contact.restitution = 1;
        c.contact.friction = 1;
        c.contact.count = 1;
        c.contact.points[0].anchorB = real(-radius) * c.contact.normal;
        c.inertias[2] = {1, real(2 / (radius * radius))};
        c.states[2].angularVelocity = real(speed / radius);
        c.states[2].velocity = -cross(c.states[2].angularVelocity, c.contact.points[0].anchorB);
        c.prepare();
        ASSERT_FALSE(resolveImpact(c.contact, c.bodies(), {.resolvePlastic = true})) << "seed " << seed;
    }
}

/// Five equal disks in a row, the first one hits the rest: the last leaves with its whole speed.
TEST(Impact, TravelsThroughARowInEitherOrder) {
    constexpr int kDisks = 5;
    for (const bool forward : {true, false}) {
        std::array<BodyState, kDisks + 1> states{};
        std::array<BodyInertia, kDisks + 1> inertias{};
        for (std::size_t i = 1; i <= kDisks; ++i) { inertias[i] = {Real(0.5), 1}; }
        states[1].velocity = {3, 0};
        std::array<ContactConstraint, kDisks - 1> contacts{};
        std::vector<ContactConstraint*> order;
        for (std::uint32_t i = 0; i + 1 < kDisks; ++i) {
            ContactConstraint& contact = contacts[i];
            contact.slotA = i + 1;
            contact.slotB = i + 2;
            contact.normal = {1, 0};
            contact.restitution = 1;
            contact.friction = Real(0.5);
            contact.count = 1;
            contact.points[0].anchorA = {Real(0.25), 0};
            contact.points[0].anchorB = {Real(-0.25), 0};
            prepareContact(contact, inertias);
            order.push_back(&contact);
        }
        if (!forward) { std::reverse(order.begin(), order.end()); }
        const int rounds = resolveImpacts(order, {states, inertias}, {}, kMaxBounceRounds);
        EXPECT_EQ(rounds, forward ? 1 : kDisks - 1);
        for (std::size_t i = 1; i < kDisks; ++i) { EXPECT_EQ(states[i].velocity, Vec2{}) << "disk " << i; }
        EXPECT_EQ(states[kDisks].velocity, (Vec2{3, 0}));
    }
}

}  // namespace
}  // namespace swept::test

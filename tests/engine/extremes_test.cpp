#include <array>

#include "../support/random.h"
#include "extreme_scenes.h"

/// Loads, chains and sizes where iteration does not get there: what the direct solver reaches, each scene by the name
/// it has in `swept bench accuracy`. Limits are ten times what was measured, or more.

namespace swept::test {
namespace {

TEST(Extremes, HeavyTopOnLightBoxes) {
    for (const int below : {1, 10}) {
        for (const double ratio : {1e3, 1e4}) {
            Tower tower(below + 1, 1, ratio);
            runFor(tower.world, 10);
            const std::string name = "heavy-top-" + std::to_string(below) + "-R" + std::to_string(ratio) + " ";
            expectAtMost(name + "sag", tower.sag(1), 1e-5);
            expectAtMost(name + "drift", tower.drift(), 1e-4);
            const StepCounters& counters = tower.world.counters();
            EXPECT_GT(counters.directBodies + counters.settledBodies, 0U);
        }
    }
}

TEST(Extremes, StackOfFifty) {
    Tower tower(50, 1);
    runFor(tower.world, 2);
    expectAtMost("stack-50 sag", tower.sag(1), 1e-4);
    expectAtMost("stack-50 drift", tower.drift(), 1e-3);
    expectAtMost("stack-50 jitter", tower.fastest(), 0.01 * std::sqrt(kGravity));
}

TEST(Extremes, TinyBoxesStand) {
    for (const double side : {1e-2, 1e-3}) {
        Tower tower(10, side);
        runFor(tower.world, 2);
        const std::string name = "size-" + std::to_string(side) + " ";
        expectAtMost(name + "sag", tower.sag(side), 1e-3);
        expectAtMost(name + "drift", tower.drift() / side, 0.05);
        expectAtMost(name + "speed", tower.fastest() / std::sqrt(kGravity * side), 0.01);
    }
}

TEST(Extremes, SmallerBoxesGetMoreSubSteps) {
    std::uint64_t before = 0;
    for (const double side : {1.0, 0.0125}) {
        Tower tower(10, side);
        // Else it stands as it begins, and later it is settled, and held in one sub-step.
        must(tower.world.applyForce(tower.boxes[0], vec(1e-12, 0), tower.world.centerOfMass(tower.boxes[0])));
        run(tower.world, 1);
        const StepCounters& counters = tower.world.counters();
        EXPECT_EQ(counters.effortClasses, 1U) << side;
        EXPECT_EQ(counters.directBodies, 10U) << side;
        EXPECT_GT(counters.mostSubSteps, before) << side;
        before = counters.mostSubSteps;
        const double h = kStep / static_cast<double>(before);
        EXPECT_LE(h, 0.1 * std::sqrt(side / kGravity)) << side;
    }
}

TEST(Extremes, ChainsDoNotStretch) {
    for (const double ratio : {1e4, 1e6}) {
        expectAtMost("chain-R" + std::to_string(ratio), Chain(ratio, false).stretch(2), 1e-6);
    }
    expectAtMost("chain-swung-R10000", Chain(1e4, true).stretch(4), 1e-4);
    expectAtMost("chain-swung-R1000", Chain(1e3, true).stretch(10), 1e-4);  // tore in the fifth second or later
}

/// Twenty links of 1 kg swing a load that is let go level: no joint opens, and what is lost of the energy is what light
/// links take up that oscillate too fast to be followed. Limits are ten times what was measured, and more.
TEST(Extremes, ChainsSwingLoadsOfAnyMass) {
    for (const double ratio : {1e6, 1e9}) {
        const Swing swing(20, ratio, 0, ratio > 1e6 ? 4 : 10);
        const std::string name = "chain-swung-R" + std::to_string(ratio);
        expectAtMost(name + " gap", swing.gap, kIsDouble ? 5e-12 : 1e-6);
        expectAtMost(name + " stretch", swing.stretch, kIsDouble ? 5e-12 : 1e-6);
        expectAtMost(name + " energy lost", swing.lost, 2e-5);
        expectAtMost(name + " energy gained", swing.gained, kIsDouble ? 1e-9 : 1e-5);
    }
}

/// Let go from 40° above the level, the load falls through a slack chain and draws it tight at once. That costs energy
/// and never gives any; no joint opens.
TEST(Extremes, SlackChainsAreDrawnTight) {
    for (const double ratio : {1e2, 1e4, 1e6}) {
        const Swing swing(20, ratio, 0.7, 4);
        const std::string name = "slack chain " + std::to_string(ratio);
        expectAtMost(name + " gap", swing.gap, kIsDouble ? 5e-12 : 1e-6);
        expectAtMost(name + " energy gained", swing.gained, 1e-4);
    }
}

/// A chain that goes by sub-steps, as its ball does not turn, gets an eighth of them while it hangs still; one that is
/// let go, or pulled at, all of them at once.
TEST(Extremes, WhatHangsStillNeedsFewSubSteps) {
    Chain still(100, false, Chain::Ball::doesNotTurn);
    expectAtMost("chain-R100", still.stretch(2), 1e-6);
    EXPECT_EQ(still.world.counters().mostSubSteps, 2U);
    must(still.world.applyForce(still.ball, vec(100, 0), still.world.position(still.ball)));
    run(still.world, 1);
    EXPECT_GE(still.world.counters().mostSubSteps, 10U);
    Chain swung(100, true, Chain::Ball::doesNotTurn);
    for (int i = 0; i < 60; ++i) {
        run(swung.world, 1);
        ASSERT_GE(swung.world.counters().mostSubSteps, 10U) << "step " << i;
    }
}

/// Where all bodies turn and nothing is fast a step is a piece or two, whatever it is divided into elsewhere.
TEST(Extremes, LightChainsAreTakenThroughAStepAtOnce) {
    Chain still(100, false);
    expectAtMost("chain-R100", still.stretch(2), 1e-6);
    EXPECT_LE(still.world.counters().mostSubSteps, 2U);
    EXPECT_LE(still.world.counters().factorisations, 26U) << "of accelerations";
    Chain swung(100, true);
    for (int i = 0; i < 60; ++i) {
        run(swung.world, 1);
        ASSERT_EQ(swung.world.counters().directGivenUp, 0U) << "step " << i;
        ASSERT_LE(swung.world.counters().mostSubSteps, 8U) << "step " << i;
    }
}

/// Ten flat bars, each a thousand times as long as it is high.
TEST(Extremes, FlatBarsRest) {
    World world = makeWorld();
    addStatic(world, box(20, 0.5), material(0.6), {0, -0.5});
    std::vector<BodyId> bars;
    for (int i = 0; i < 10; ++i) {
        bars.push_back(addBody(world, dynamicAt({0, 0.01 * (i + 0.5)}), box(5, 0.005), material(0.6)));
    }
    runFor(world, 3);
    double worst = 0;
    for (int i = 0; i < 10; ++i) {
        worst = std::max(worst, length(world.position(bars[static_cast<std::size_t>(i)]) - DVec2{0, 0.01 * (i + 0.5)}));
    }
    expectAtMost("flat-bars move", worst / 0.01, 0.01);
}

/// What needs nothing extra is solved as before, whatever stands beside it.
TEST(Extremes, ATowerCostsItsNeighboursNothing) {
    const auto build = [](World& world, bool withTower) {
        addStatic(world, box(100, 0.5), material(0.6), {0, -0.5});
        const BodyId alone = addBody(world, dynamicAt({-20, 0.5}, vec(1, 0)), box(0.5, 0.5), material(0.6));
        for (int i = 0; withTower && i < 12; ++i) {  // with a speed, or it stands as it begins
            addBody(world, dynamicAt({20, i + 0.5}, vec(1e-4 * i, 0)), box(0.5, 0.5), material(0.6));
        }
        return alone;
    };
    World plain = makeWorld();
    World mixed = makeWorld();
    const BodyId a = build(plain, false);
    const BodyId b = build(mixed, true);
    std::uint64_t mostClasses = 0;
    for (int i = 0; i < 60; ++i) {
        run(plain, 1);
        run(mixed, 1);
        ASSERT_EQ(plain.position(a), mixed.position(b)) << "step " << i;
        ASSERT_EQ(plain.counters().directBodies, 0U);
        ASSERT_EQ(mixed.counters().directBodies + mixed.counters().settledBodies, 12U + plain.counters().settledBodies);
        mostClasses = std::max(mostClasses, mixed.counters().effortClasses);
    }
    EXPECT_EQ(mostClasses, 2U);
}

/// Twice the lengths, masses or times, and all numbers are what they were but for those factors.
TEST(Extremes, DirectSolvesScaleByPowersOfTwo) {
    const auto endOf = [](double l, double m, double t) {
        WorldSettings settings = awakeSettings(kGravity * l / (t * t));
        World world = makeWorld(settings);
        addStatic(world, box(20 * l, 0.5 * l), material(0.6), {0, -0.5 * l});
        BodyId last;
        for (int i = 0; i < 10; ++i) {
            last = addBody(world, dynamicAt({0.01 * l * (i % 2), (i + 0.5) * l}), box(0.5 * l, 0.5 * l),
                           material(0.6, 0, (i == 9 ? 100 : 1) * m / (l * l)));
        }
        BodyId before = addStatic(world, circle(0.05 * l), {}, {30 * l, 0});
        for (int i = 1; i <= 5; ++i) {
            ShapeDef shape = material(0.6, 0, (i == 5 ? 1000 : 1) * m / (l * l));
            shape.filter.mask = 0;
            const BodyId next = addBody(world, dynamicAt({(30 + i) * l, 0}), circle(0.25 * l), shape);
            RevoluteJointDef hinge;
            hinge.base.bodyA = before;
            hinge.base.bodyB = next;
            hinge.anchor = {(29.5 + i) * l, 0};
            must(world.createJoint(hinge));
            before = next;
        }
        run(world, 120, kStep * t);
        return std::array<DVec2, 2>{1 / l * world.position(last), 1 / l * world.position(before)};
    };
    const auto plain = endOf(1, 1, 1);
    for (const double factor : {1.0 / 64, 32.0}) {
        EXPECT_EQ(endOf(factor, 1, 1), plain) << "length";
        EXPECT_EQ(endOf(1, factor, 1), plain) << "mass";
        EXPECT_EQ(endOf(1, 1, factor), plain) << "time";
        EXPECT_EQ(endOf(factor, 4 * factor, 2 * factor), plain) << "all";
    }
}

/// The same of one box on a joint of each kind that is solved exactly. (In double sliders and welds ended on another
/// bit in every sixth case: impulses that turn were added to those that push, and so told when rounding was reached.)
TEST(Extremes, ExactJointsScaleByPowersOfTwo) {
    const auto endOf = [](std::uint64_t seed, int kind, double l) {
        Random random(seed);
        World world = makeWorld(awakeSettings(kGravity * l));
        const DVec2 place{random.range(-20, 20), random.range(-20, 20)};
        const DVec2 off{random.range(-2, 2), random.range(-2, 2)};
        const double angle = random.range(-kPi, kPi);
        JointDef base;
        base.bodyA = must(world.createBody(bodyAt(BodyType::fixed, l * place)));
        base.bodyB = addBody(world, dynamicAt(l * (place + off)), box(0.2 * l, 0.1 * l), material(0.6, 0, 1 / (l * l)));
        const DVec2 anchor = l * (place + 0.5 * off);
        switch (kind) {
            case 0:
                must(world.createJoint(RevoluteJointDef{base, anchor}));
                break;
            case 1:
                must(world.createJoint(DistanceJointDef{base, l * place, l * (place + off)}));
                break;
            case 2:
                must(world.createJoint(PrismaticJointDef{base, anchor, {std::cos(angle), std::sin(angle)}}));
                break;
            default:
                must(world.createJoint(WeldJointDef{base, anchor}));
                break;
        }
        run(world, 60);
        return 1 / l * world.position(base.bodyB);
    };
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        for (int kind = 0; kind < 4; ++kind) {
            const DVec2 plain = endOf(seed, kind, 1);
            for (const double factor : {1.0 / 64, 32.0}) {
                EXPECT_EQ(endOf(seed, kind, factor), plain) << "seed " << seed << ", kind " << kind;
            }
        }
    }
}

}  // namespace
}  // namespace swept::test

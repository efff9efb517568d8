#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Kinematic bodies, however fast, do not pass what rests, sleeps, is stacked or jointed.

namespace swept::test {
namespace {

enum class Target { ball, boxOnFloor, stack, jointedPair };

struct Swing {
    World world;
    std::vector<BodyId> targets;
    BodyId paddle;

    Swing(Target kind, bool asleep, double speed, double restitution, std::uint64_t seed) {
        const bool onFloor = kind == Target::boxOnFloor || kind == Target::stack;
        WorldSettings settings = awakeSettings(onFloor ? kGravity : 0);
        settings.sleep = true;
        world = makeWorld(settings);
        if (onFloor) { addStatic(world, segment(-10, 0, 10 + 2 * speed, 0), material(0.3)); }
        const ShapeDef surface = material(0.3, restitution);
        const Polygon polygon = kind == Target::ball ? circle(0.1) : box(0.1, 0.1);
        targets.push_back(addBody(world, dynamicAt({0, 0.1}), polygon, surface));
        if (kind == Target::stack) { targets.push_back(addBody(world, dynamicAt({0, 0.3}), polygon, surface)); }
        if (kind == Target::jointedPair) {
            targets.push_back(addBody(world, dynamicAt({0.1, 0.4}), polygon, surface));
            RevoluteJointDef hinge;
            hinge.base.bodyA = targets[0];
            hinge.base.bodyB = targets[1];
            hinge.anchor = {0.05, 0.25};
            must(world.createJoint(hinge));
        }
        run(world, onFloor ? 5 : 0);
        if (asleep) {
            for (const BodyId target : targets) { must(world.setAwake(target, false)); }
        }
        Random random(seed);
        BodyDef def = bodyAt(BodyType::kinematic, {-0.5 - random.uniform() * speed * kStep, 0.32});
        def.velocity = vec(speed, 0);
        paddle = addBody(world, def, box(0.02, 0.3), surface);
    }
    /// @return how many of them the paddle has left behind
    int leftBehind() {
        runFor(world, 0.4);
        const double x = world.position(paddle).x;
        return static_cast<int>(std::count_if(targets.begin(), targets.end(), [&](BodyId target) {
            return !(world.centerOfMass(target).x > x) && std::abs(world.centerOfMass(target).y - 0.3) < 2;
        }));
    }
};

TEST(MovingObstacles, APaddlePassesNothing) {
    for (const Target kind : {Target::ball, Target::boxOnFloor, Target::stack, Target::jointedPair}) {
        for (const bool asleep : {false, true}) {
            for (const double restitution : {0.0, 1.0}) {
                for (const double speed : {10.0, 30.0, 100.0, 300.0}) {
                    for (std::uint64_t seed = 0; seed < 5; ++seed) {
                        EXPECT_EQ(Swing(kind, asleep, speed, restitution, seed).leftBehind(), 0)
                            << "target " << static_cast<int>(kind) << (asleep ? " asleep, " : ", ") << speed
                            << " m/s, e " << restitution << ", seed " << seed;
                    }
                }
            }
        }
    }
}

TEST(MovingObstacles, APaddlePassesOnItsSpeed) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        for (const double speed : {10.0, 100.0, 300.0}) {
            Swing swing(Target::ball, true, speed, restitution, 1);
            EXPECT_EQ(swing.leftBehind(), 0);
            EXPECT_NEAR(velocityOf(swing.world, swing.targets[0]).x / ((1 + restitution) * speed), 1, 1e-5) << speed;
        }
    }
}

/// Its velocity was set after the last step: its box is that of the old one.
TEST(MovingObstacles, APaddleThatIsSentOffPassesNothing) {
    World world = makeWorld(0);
    const BodyId ball = addBody(world, dynamicAt({0, 0}), circle(0.1), material(0));
    const BodyId paddle = addBody(world, bodyAt(BodyType::kinematic, {-1, 0}), box(0.02, 0.3), material(0));
    run(world, 5);
    must(world.setVelocity(paddle, vec(200, 0), 0));
    run(world, 3);
    EXPECT_GT(world.position(ball).x, world.position(paddle).x);
}

/// Two plates that close on a ball, and go on when there is no room left for it.
TEST(MovingObstacles, PlatesCloseOnABall) {
    for (const double speed : {0.0, 10.0, 100.0, 1000.0}) {
        World world = makeWorld(0);
        std::array<BodyId, 2> plates{};
        for (const int side : {0, 1}) {
            BodyDef def = bodyAt(BodyType::kinematic, {side == 0 ? -5.0 : 5.0, 0});
            def.velocity = vec(side == 0 ? 5 : -5, 0);
            plates[static_cast<std::size_t>(side)] = addBody(world, def, segment(0, -50, 0, 50), material(0, 1));
        }
        const BodyId ball = addBody(world, dynamicAt({0.3, 0}, vec(speed, 0)), circle(0.2), material(0, 1));
        double lost = 0;
        double strikes = 0;
        int held = 0;
        bool crowded = false;  // from the first step on with more bounces than its budget is sure to hold
        for (int i = 0; i < 90; ++i) {
            must(world.step(kStep));
            ASSERT_TRUE(std::isfinite(world.position(ball).x) && std::isfinite(velocityOf(world, ball).x));
            ASSERT_LE(world.counters().impacts, 300U);
            strikes += static_cast<double>(world.counters().impacts);
            const double gap = world.position(plates[1]).x - world.position(plates[0]).x;
            for (const LostTimeEntry& entry : world.lostTime()) {
                lost += entry.seconds;
                EXPECT_EQ(entry.body, ball);
                EXPECT_TRUE(entry.reason == LostTimeReason::budget || entry.reason == LostTimeReason::clamp);
                held += entry.reason == LostTimeReason::clamp ? 1 : 0;
            }
            const double bounces = std::abs(velocityOf(world, ball).x) * kStep / (gap - 0.4);  // a step
            crowded = crowded || gap <= 1 || bounces >= 0.5 * world.settings().maxImpacts;
            if (!crowded) {
                ASSERT_LT(std::abs(world.position(ball).x), 0.5 * gap) << speed << " m/s, gap " << gap;
                ASSERT_EQ(lost, 0) << speed << " m/s, gap " << gap;
                ASSERT_NEAR(std::abs(velocityOf(world, ball).x), speed + 10 * strikes,
                            1e-4 * (1 + speed + 10 * strikes))
                    << "each strike of a plate gives twice its speed, gap " << gap;
            }
        }
        EXPECT_GT(lost, 0) << "there was no room left: it must say so";
        EXPECT_GT(held, 30) << "and is held between them from then on";
    }
}

/// It lies where neither end of the bar's turn is.
TEST(MovingObstacles, ABarThatTurnsFastStrikesWhatLiesInItsArc) {
    for (const double turn : {5, 20, 40, 60, 80, 100, 120, 150}) {
        for (const double away : {1.0, 3.0, 4.9}) {
            World world = makeWorld(0);
            BodyDef def = bodyAt(BodyType::kinematic, {}, -turn / 360 * kPi);
            def.angularVelocity = real(turn / 180 * kPi * kRate);
            addBody(world, def, box(5, 0.1));
            const BodyId ball = addBody(world, dynamicAt({away, 0}), circle(0.05));
            run(world, 1);
            EXPECT_GT(velocityOf(world, ball).y, 1) << turn << " degrees a step, at " << away << " m";
        }
    }
}

/// A row of boxes on ice that were put to sleep one by one wakes as one that fell asleep together.
TEST(MovingObstacles, WhatTheyStartleWakesItsNeighbours) {
    std::array<std::vector<DVec2>, 2> places;
    for (std::size_t i = 0; i < 2; ++i) {
        World world = makeWorld();
        addStatic(world, box(50, 0.5), material(0));
        std::vector<BodyId> row;
        for (int k = 0; k < 4; ++k) {
            row.push_back(addBody(world, dynamicAt({1.0 * k, 1}), box(0.5, 0.5), material(0)));
        }
        const BodyId wall = addBody(world, bodyAt(BodyType::kinematic, {-3, 1}), box(0.5, 0.4), material(0));
        run(world, 10);
        for (const BodyId body : row) { must(world.setAwake(body, i == 0)); }
        must(world.setVelocity(wall, vec(180, 0), 0));
        run(world, 1);
        for (const BodyId body : row) {
            EXPECT_TRUE(world.isAwake(body));
            places[i].push_back(world.position(body));
        }
    }
    for (std::size_t k = 0; k < 4; ++k) {  // what was put to sleep has lost the last of its speed
        EXPECT_NEAR(places[1][k].x, places[0][k].x, 1e-3) << "box " << k;
    }
}

/// A box between a wall and a plate that closes on it: impacts that hardly take it on are not worth their time, however
/// many are asked for.
TEST(MovingObstacles, WhatTheyCrushIsHeldWhateverImpactsItMayHave) {
    WorldSettings settings = awakeSettings();
    settings.maxImpacts = 1'000'000;
    World world = makeWorld(settings);
    addStatic(world, box(1, 20), {}, {-1, 0});
    addStatic(world, box(20, 1), {}, {0, -1});
    BodyDef plate = bodyAt(BodyType::kinematic, {3, 1});
    plate.velocity = vec(-60, 0);
    addBody(world, plate, box(0.2, 2));
    BodyDef def = dynamicAt({1, 1}, vec(0, -30), 50);
    def.angle = 0.3;
    const BodyId crushed = addBody(world, def, box(0.3, 0.2), material(0.6, 0.5));
    std::uint64_t impacts = 0;
    bool isStuck = false;
    for (int i = 0; i < 10; ++i) {
        run(world, 1);
        impacts = std::max(impacts, world.counters().impacts);
        for (const LostTimeEntry& entry : world.lostTime()) {
            isStuck = isStuck || (entry.body == crushed && entry.reason == LostTimeReason::stuck);
        }
    }
    EXPECT_TRUE(isStuck);
    EXPECT_GT(impacts, 64U) << "or the limit was never asked";
    EXPECT_LT(impacts, 5000U);
}

/// Pairs on rods that land, two of them on plates that rise.
struct Landing {
    World world = makeWorld(0);
    std::vector<BodyId> bodies;

    Landing() {
        addStatic(world, box(50, 1), material(0.3), {0, -1});
        for (int i = 0; i < 4; ++i) {
            DistanceJointDef rod;
            for (int k = 0; k < 2; ++k) {
                const DVec2 place{4.0 * i + k, 1.0 + 0.37 * i};
                bodies.push_back(addBody(world, dynamicAt(place, vec(0, -40)), box(0.2, 0.2), material(0.3, 0.3)));
            }
            rod.base.bodyA = bodies[bodies.size() - 2];
            rod.base.bodyB = bodies.back();
            rod.anchorA = world.position(rod.base.bodyA);
            rod.anchorB = world.position(rod.base.bodyB);
            must(world.createJoint(rod));
        }
        for (const double x : {0.5, 8.5}) {
            BodyDef plate = bodyAt(BodyType::kinematic, {x, -0.3});
            plate.velocity = vec(0, 20);
            bodies.push_back(addBody(world, plate, box(1, 0.1), material(0.3)));
        }
    }
};

/// Islands that advance from impact to impact take along what they come near.
TEST(MovingObstacles, ElsewhereChangeNothing) {
    Landing alone;
    Landing among;
    for (int i = 0; i < 40; ++i) {
        BodyDef other = bodyAt(BodyType::kinematic, {4.0 * i, 300});
        other.velocity = vec(i % 2, 0);
        other.angularVelocity = real(i % 3);
        addBody(among.world, other, box(1, 0.1));
    }
    std::uint64_t impacts = 0;
    for (int i = 0; i < 20; ++i) {
        run(alone.world, 1);
        run(among.world, 1);
        impacts += alone.world.counters().impacts;
        for (std::size_t k = 0; k < alone.bodies.size(); ++k) {
            ASSERT_EQ(alone.world.position(alone.bodies[k]), among.world.position(among.bodies[k])) << i << ' ' << k;
            ASSERT_EQ(alone.world.velocity(alone.bodies[k]), among.world.velocity(among.bodies[k])) << i << ' ' << k;
        }
    }
    EXPECT_GT(impacts, 4U) << "or nothing advanced";
}

}  // namespace
}  // namespace swept::test

#include <array>

#include "../support/random.h"
#include "world_support.h"

/// The modes that do not sweep: what they promise, what they cannot do, and how modes meet in a pair.

namespace swept::test {
namespace {

constexpr std::array kModes{ContinuousMode::off, ContinuousMode::speedLimit, ContinuousMode::speculative,
                            ContinuousMode::stop, ContinuousMode::subStep};
constexpr std::array kSpeeds{10.0, 100.0, 1000.0, 10000.0};
constexpr double kThinWall = 0.02;  ///< metres thick

WorldSettings modeSettings(ContinuousMode mode, double gravity = 0) {
    WorldSettings settings = awakeSettings(gravity);
    settings.continuous = mode;
    return settings;
}

struct Projectile {
    const char* name;
    Polygon polygon;
    double width;
};
std::vector<Projectile> projectiles() {
    return {{"circle", circle(0.1), 0.2},
            {"box", box(0.1, 0.1), 0.2},
            {"bar", box(0.25, 0.005), 0.01},
            {"capsule", capsule(0.5, 0.05), 0.1}};
}

/// Shots from the left at a wall around x = 0, within 30°, that do not see each other.
struct Range {
    World world;
    std::vector<BodyId> shots;

    Range(ContinuousMode mode, const Projectile& projectile, double speed, double spin, std::uint64_t seed,
          bool fixedRotation = false) {
        world = makeWorld(modeSettings(mode));
        addStatic(world, box(kThinWall / 2, 4000), material(0.3));
        ShapeDef surface = material(0.3);
        surface.filter.group = -1;
        Random random(seed);
        for (int i = 0; i < 40; ++i) {
            const double aim = random.range(-kPi / 6, kPi / 6);
            const double way = 0.7 + random.uniform() * speed * kStep;
            BodyDef def = dynamicAt({-way * std::cos(aim), -way * std::sin(aim)},
                                    vec(speed * std::cos(aim), speed * std::sin(aim)), random.range(-spin, spin));
            def.angle = random.range(0, 2 * kPi);
            def.fixedRotation = fixedRotation;
            shots.push_back(addBody(world, def, projectile.polygon, surface));
        }
    }
    int escaped() const {
        return static_cast<int>(
            std::count_if(shots.begin(), shots.end(), [this](BodyId shot) { return world.centerOfMass(shot).x > 0; }));
    }
};

/// Largest way that any point of the shots may have gone since `before`, metres.
double farthestWay(const World& world, const std::vector<BodyId>& shots, const std::vector<DVec2>& before,
                   const std::vector<double>& angles, double radius) {
    double farthest = 0;
    for (std::size_t i = 0; i < shots.size(); ++i) {
        farthest = std::max(farthest, length(world.centerOfMass(shots[i]) - before[i]) +
                                          radius * std::fabs(world.angle(shots[i]) - angles[i]));
    }
    return farthest;
}

TEST(SpeedLimit, HoldsEveryShotAndSaysWhatItTook) {
    for (const Projectile& projectile : projectiles()) {
        for (const double speed : kSpeeds) {
            Range range(ContinuousMode::speedLimit, projectile, speed, 200, 3);
            run(range.world, 1);
            EXPECT_EQ(range.world.counters().speedsCapped, range.shots.size()) << projectile.name << ' ' << speed;
            ASSERT_EQ(range.world.lostTime().size(), range.shots.size());
            for (const LostTimeEntry& entry : range.world.lostTime()) {
                EXPECT_EQ(entry.reason, LostTimeReason::speedLimit);
                EXPECT_GT(entry.seconds, 0);
                EXPECT_LE(entry.seconds, kStep);
            }
            run(range.world, 60);
            EXPECT_EQ(range.escaped(), 0) << projectile.name << " at " << speed;
            EXPECT_EQ(range.world.counters().toiCalls, 0U);
        }
    }
}

TEST(SpeedLimit, NoPointGoesFartherThanHalfOfBothWidths) {
    for (const Projectile& projectile : projectiles()) {
        Range range(ContinuousMode::speedLimit, projectile, 300, 100, 8);
        const double radius = static_cast<double>(radiusAbout(projectile.polygon, {}));
        const double most = (projectile.width + kThinWall) / 2;
        double farthest = 0;
        for (int step = 0; step < 60; ++step) {
            std::vector<DVec2> before;
            std::vector<double> angles;
            for (const BodyId shot : range.shots) {
                before.push_back(range.world.centerOfMass(shot));
                angles.push_back(range.world.angle(shot));
            }
            run(range.world, 1);
            farthest = std::max(farthest, farthestWay(range.world, range.shots, before, angles, radius));
        }
        EXPECT_LE(farthest, most * (1 + 1e-5)) << projectile.name;
        EXPECT_GE(farthest, most * 0.99) << projectile.name << ": slower than it need be";
    }
}

/// A heavy hammer flings a light ball: no push of the solver gets around the limit.
TEST(SpeedLimit, HoldsWhatOthersPush) {
    World world = makeWorld(modeSettings(ContinuousMode::off));
    addStatic(world, box(0.05, 10), {}, {1, 0});
    BodyDef hammer = dynamicAt({-1.4, 0}, vec(25, 0));
    addBody(world, hammer, box(0.3, 0.3), material(0, 1, 100));
    BodyDef def = dynamicAt({-0.5, 0});
    def.continuous = ContinuousMode::speedLimit;
    const BodyId ball = addBody(world, def, circle(0.1), material(0, 1));
    const double most = (0.2 + 0.1) / 2;
    std::uint64_t capped = 0;
    for (int step = 0; step < 30; ++step) {
        const DVec2 before = world.centerOfMass(ball);
        run(world, 1);
        EXPECT_LE(length(world.centerOfMass(ball) - before), most * (1 + 1e-5)) << step;
        capped += world.counters().speedsCapped;
    }
    EXPECT_GT(capped, 0U);
}

TEST(SpeedLimit, CutsOnce) {
    World world = makeWorld(modeSettings(ContinuousMode::speedLimit));
    addStatic(world, box(0.01, 10), {}, {1e6, 0});
    Random random(5);
    for (int i = 0; i < 100; ++i) {
        addBody(world,
                dynamicAt({3.0 * i, 0}, vec(random.range(100, 1000), random.range(-400, 400)), random.range(-99, 99)),
                box(0.3, 0.1));
    }
    run(world, 1);
    EXPECT_EQ(world.counters().speedsCapped, 100U);
    for (int step = 0; step < 20; ++step) {
        run(world, 1);
        ASSERT_EQ(world.counters().speedsCapped, 0U) << "for the rounding of the first cut";
    }
}

/// Before the step, and again when a heavy ball has pushed it: what is left of its way is a part of a part.
TEST(SpeedLimit, TellsOnceWhatItTookTwice) {
    World world = makeWorld(modeSettings(ContinuousMode::speedLimit));
    addStatic(world, box(0.1, 5), {}, {50, 0});
    const double limit = (0.5 + 0.2) / 2;
    const BodyId pushed = addBody(world, dynamicAt({0, 0}, vec(500, 0)), circle(0.25));
    const BodyId heavy = addBody(world, dynamicAt({0.5, 0}, vec(-4000, 0)), circle(0.25), material(0, 1, 500));
    const DVec2 start = world.position(pushed);
    run(world, 1);
    EXPECT_EQ(world.counters().speedsCapped, 2U);
    ASSERT_EQ(world.lostTime().size(), 2U);
    EXPECT_EQ(world.lostTime()[0].body, pushed);
    EXPECT_EQ(world.lostTime()[1].body, heavy);
    EXPECT_LE(length(world.position(pushed) - start), limit * (1 + 1e-5));
    EXPECT_GT(world.lostTime()[0].seconds, (1 - limit / (500 * kStep)) * kStep * (1 + 1e-6)) << "cut once";
    EXPECT_LT(world.lostTime()[0].seconds, kStep);
}

TEST(SpeedLimit, LeavesTheSlowAlone) {
    const auto drop = [](ContinuousMode mode) {
        World world = makeWorld(modeSettings(mode, kGravity));
        addStatic(world, box(10, 0.5));
        std::vector<BodyId> bodies;
        for (int i = 0; i < 5; ++i) {
            bodies.push_back(addBody(world, dynamicAt({1.2 * i, 1.2}, {}, 1), box(0.5, 0.5)));
        }
        std::uint64_t capped = 0;
        for (int step = 0; step < 90; ++step) {
            run(world, 1);
            capped += world.counters().speedsCapped + world.lostTime().size();
        }
        EXPECT_EQ(capped, 0U);
        return world.position(bodies[2]);
    };
    EXPECT_EQ(drop(ContinuousMode::speedLimit), drop(ContinuousMode::off));
}

/// Chains and segments have no width; a wall that comes or goes changes the limit at once.
TEST(SpeedLimit, FollowsTheThinnestWall) {
    World world = makeWorld(modeSettings(ContinuousMode::speedLimit));
    const BodyId ball = addBody(world, dynamicAt({0, 0}, vec(1000, 0)), circle(0.1));
    const auto limited = [&] {
        must(world.setVelocity(ball, vec(1000, 0), 0));
        run(world, 1);
        return velocityOf(world, ball).x * kStep;
    };
    EXPECT_NEAR(limited(), 1000 * kStep, 1e-3) << "no wall, no limit";
    addStatic(world, box(0.5, 1), {}, {0, 90});
    EXPECT_NEAR(limited(), (0.2 + 1) / 2, 1e-5);
    const BodyId thin = addStatic(world, box(0.05, 1), {}, {0, 95});
    EXPECT_NEAR(limited(), (0.2 + 0.1) / 2, 1e-6);
    addStatic(world, segment(0, 99, 1, 99));
    EXPECT_NEAR(limited(), 0.2 / 2, 1e-6);
    ShapeDef sensor;
    sensor.sensor = true;
    const BodyId watcher = addStatic(world, segment(0, 9, 1, 9), sensor);
    EXPECT_NEAR(limited(), 0.2 / 2, 1e-6) << "sensors are no walls";
    must(world.destroyBody(watcher));
    must(world.destroyBody(thin));
    EXPECT_NEAR(limited(), 0.2 / 2, 1e-6);
}

/// What turns shows other features than those it was looked at with: only a ball has none.
TEST(Speculative, HoldsWhatDoesNotTurn) {
    for (const Projectile& projectile : projectiles()) {
        for (const double speed : kSpeeds) {
            Range range(ContinuousMode::speculative, projectile, speed, 0, 4, projectile.polygon.count > 1);
            std::uint64_t ahead = 0;
            for (int step = 0; step < 40; ++step) {
                run(range.world, 1);
                ahead += range.world.counters().aheadContacts;
            }
            EXPECT_EQ(range.escaped(), 0) << projectile.name << " at " << speed;
            EXPECT_GT(ahead, 0U) << projectile.name << " at " << speed;
            EXPECT_EQ(range.world.counters().toiCalls, 0U);
        }
    }
}

/// A ball that would pass by the corner of a box, between it and nothing: the plane of its contact has no end.
TEST(Speculative, HasGhostCollisionsAndSweepsHaveNone) {
    const auto fly = [](ContinuousMode mode) {
        World world = makeWorld(modeSettings(mode));
        addStatic(world, box(0.5, 0.5), material(0));
        const BodyId ball = addBody(world, dynamicAt({-1.2, 1.1}, vec(120, 0)), circle(0.1), material(0));
        run(world, 1);
        return world.centerOfMass(ball) - DVec2{-1.2 + 120 * kStep, 1.1};
    };
    EXPECT_GT(length(fly(ContinuousMode::speculative)), 0.1);
    EXPECT_LT(length(fly(ContinuousMode::subStep)), 1e-5);
    EXPECT_LT(length(fly(ContinuousMode::stop)), 1e-5);
}

TEST(Speculative, SeesTheVelocityOfThisStep) {
    World world = makeWorld(modeSettings(ContinuousMode::speculative));
    addStatic(world, segment(5, -5, 5, 5), material(0));
    const BodyId ball = addBody(world, dynamicAt({0, 0}), circle(0.1), material(0));
    run(world, 3);
    must(world.setVelocity(ball, vec(900, 0), 0));
    run(world, 3);
    EXPECT_LT(world.centerOfMass(ball).x, 5);
}

TEST(Speculative, BouncesWithTheEnergyItCameWith) {
    World world = makeWorld(modeSettings(ContinuousMode::speculative));
    addStatic(world, segment(-5, -5, -5, 5), material(0, 1));
    addStatic(world, segment(5, -5, 5, 5), material(0, 1));
    const BodyId ball = addBody(world, dynamicAt({0.37, 0}, vec(60, 0)), circle(0.1), material(0, 1));
    for (int step = 0; step < 300; ++step) {
        run(world, 1);
        ASSERT_NEAR(std::fabs(velocityOf(world, ball).x), 60, 60 * (kIsDouble ? 1e-9 : 1e-4)) << step;
        ASSERT_LT(std::fabs(world.centerOfMass(ball).x), 5) << step;
    }
}

TEST(Speculative, FastPairsMeet) {
    for (const double speed : {60.0, 600.0}) {
        for (int offset = 0; offset < 20; ++offset) {
            World world = makeWorld(modeSettings(ContinuousMode::speculative));
            const double shift = offset * speed * kStep / 20;
            const BodyId left = addBody(world, dynamicAt({-2 * speed * kStep - shift, 0}, vec(speed, 0)), circle(0.1));
            const BodyId right = addBody(world, dynamicAt({2 * speed * kStep, 0}, vec(-speed, 0)), circle(0.1));
            run(world, 8);
            EXPECT_LT(world.centerOfMass(left).x, world.centerOfMass(right).x) << speed << ", offset " << offset;
        }
    }
}

/// One wall, five bodies, each with a mode of its own; the world's is another one.
/// What stopped at the top of a block, and is put beside it then, meets its side on a path that leads away from the
/// top. (It remembered what it had met, and flew through.)
TEST(Stop, MeetsAgainWhatItWasPutBeside) {
    WorldSettings settings = awakeSettings(0);
    settings.continuous = ContinuousMode::stop;
    World world = makeWorld(settings);
    addStatic(world, box(1, 1));
    const BodyId shot = addBody(world, dynamicAt({0, 3}, vec(0, -200)), circle(0.1));
    must(world.step(kStep));
    EXPECT_NEAR(world.position(shot).y, 1.1, 0.01);
    must(world.setPose(shot, {-3, -0.5}, 0));
    must(world.setVelocity(shot, vec(300, 30), 0));
    must(world.step(kStep));
    EXPECT_NEAR(world.position(shot).x, -1.1, 0.01);
}

TEST(Modes, OfABodyGoesBeforeThatOfTheWorld) {
    for (const ContinuousMode ofWorld : kModes) {
        World world = makeWorld(modeSettings(ofWorld));
        addStatic(world, box(0.01, 100), material(0, 1));
        std::vector<BodyId> balls;
        for (std::size_t i = 0; i < kModes.size(); ++i) {
            BodyDef def = dynamicAt({-1.5, 3.0 * static_cast<double>(i)}, vec(120, 0));
            def.continuous = kModes[i];
            balls.push_back(addBody(world, def, circle(0.1), material(0, 1)));
        }
        run(world, 1);
        EXPECT_GT(world.centerOfMass(balls[0]).x, 0.01) << "off: through";
        EXPECT_NEAR(world.centerOfMass(balls[1]).x, -1.5 + (0.2 + 0.02) / 2, 1e-5) << "speedLimit: slowed";
        EXPECT_LT(velocityOf(world, balls[2]).x, 0) << "speculative: bounced";
        EXPECT_NEAR(world.centerOfMass(balls[3]).x, -0.11, 1e-3) << "stop: held at the wall";
        EXPECT_NEAR(world.centerOfMass(balls[4]).x, -0.11 - (2 - (1.5 - 0.11)), 1e-3) << "subStep: bounced in time";
        EXPECT_EQ(world.counters().flyers, 2U);
        EXPECT_EQ(world.counters().sweeps, 2U);
        EXPECT_EQ(world.counters().speedsCapped, 1U);
        EXPECT_EQ(world.counters().aheadContacts, 1U);
        for (const BodyId ball : balls) { must(world.destroyBody(ball)); }
    }
}

/// What is not watched any more costs nothing: destroying the last such body turns the checks off.
TEST(Modes, OfDestroyedBodiesAreForgotten) {
    World world = makeWorld(modeSettings(ContinuousMode::off));
    addStatic(world, box(0.01, 100));
    BodyDef def = dynamicAt({-1.5, 0}, vec(120, 0));
    def.continuous = ContinuousMode::speedLimit;
    must(world.destroyBody(addBody(world, def, circle(0.1))));
    addBody(world, dynamicAt({-1.5, 0}, vec(120, 0)), circle(0.1));
    run(world, 1);
    EXPECT_EQ(world.counters().speedsCapped, 0U);
}

/// In a pair the more careful does its part for both: a ball without any mode is held by a speculative plank.
TEST(Modes, OfAPairTheMoreCarefulCounts) {
    const auto meets = [](ContinuousMode ofPlank) {
        World world = makeWorld(modeSettings(ContinuousMode::off));
        BodyDef def = dynamicAt({2, 0}, vec(-100, 0));
        def.continuous = ofPlank;
        const BodyId plank = addBody(world, def, box(0.05, 1));
        const BodyId ball = addBody(world, dynamicAt({-2, 0}, vec(100, 0)), circle(0.1));
        run(world, 5);
        return world.centerOfMass(ball).x < world.centerOfMass(plank).x;
    };
    EXPECT_FALSE(meets(ContinuousMode::off));
    EXPECT_TRUE(meets(ContinuousMode::speculative));
}

TEST(Modes, CostNothingWhereNothingIsFast) {
    for (const ContinuousMode mode : kModes) {
        World world = makeWorld(modeSettings(mode, kGravity));
        addStatic(world, box(20, 1));
        for (int i = 0; i < 10; ++i) { addBody(world, dynamicAt({1.5 * i - 7, 1.51}), box(0.5, 0.5)); }
        for (int step = 0; step < 60; ++step) {
            run(world, 1);
            const StepCounters& counters = world.counters();
            ASSERT_EQ(counters.sweeps + counters.toiCalls + counters.toiIterations + counters.impacts, 0U);
            ASSERT_EQ(counters.aheadContacts + counters.speedsCapped + counters.flyers, 0U);
            ASSERT_TRUE(world.lostTime().empty());
        }
    }
}

TEST(Modes, RefuseWhatIsNone) {
    World world = makeWorld();
    for (const int wrong : {5, 6, 200}) {
        WorldSettings settings;
        settings.continuous = static_cast<ContinuousMode>(wrong);
        EXPECT_EQ(world.configure(settings).code, StatusCode::outOfRange);
        BodyDef def;
        def.continuous = static_cast<ContinuousMode>(wrong);
        EXPECT_EQ(world.createBody(def).status().code, StatusCode::outOfRange);
    }
}

}  // namespace
}  // namespace swept::test

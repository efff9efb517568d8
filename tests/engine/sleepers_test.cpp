#include <array>

#include <vector>

#include "../support/random.h"
#include "joint_support.h"

/// What was put to sleep, or held, one by one or made something else meanwhile, and then is met.

namespace swept::test {
namespace {

WorldSettings weightless() {
    WorldSettings settings;
    settings.gravity = {};
    return settings;
}

class SleepersRow : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Gaps, SleepersRow, testing::Values(0.02, 0.04, 0.3));

/// Four boxes that touch, each put to sleep by itself, and a fifth that hits the first: no momentum goes to ground.
TEST_P(SleepersRow, TakeTheMomentumOfWhatHitsThem) {
    World world = makeWorld(weightless());
    std::vector<BodyId> bodies;
    for (int i = 0; i < 4; ++i) { bodies.push_back(addBody(world, dynamicAt({1.0 * i, 0}), box(0.5, 0.5))); }
    run(world, 3);
    for (const BodyId body : bodies) { must(world.setAwake(body, false)); }
    run(world, 1);
    bodies.push_back(addBody(world, dynamicAt({-1 - GetParam(), 0}, vec(3, 0)), box(0.5, 0.5)));
    run(world, 60);
    EXPECT_NEAR(momentumOf(world, bodies).x, 3, 1e-3);
}

/// Each end of a long row, put to sleep one by one in any order, wakes all of it within the step.
TEST(Sleepers, ALongRowWakesFromEitherEnd) {
    constexpr int kBoxes = 60;
    for (const int stepsAsleep : {0, 1, 3}) {
        for (const int kicked : {0, kBoxes / 3, kBoxes - 1}) {
            World world = makeWorld(weightless());
            std::vector<BodyId> bodies;
            for (int i = 0; i < kBoxes; ++i) {
                bodies.push_back(addBody(world, dynamicAt({1.0 * (i * 7 % kBoxes), 0}), box(0.5, 0.5)));
            }
            run(world, 3);
            for (const BodyId body : bodies) { must(world.setAwake(body, false)); }
            run(world, stepsAsleep);
            const std::uint64_t before = world.counters().wokeUp;
            must(world.setVelocity(bodies[static_cast<std::size_t>(kicked)], vec(0, 1), 0));
            run(world, 1);
            for (const BodyId body : bodies) { EXPECT_TRUE(world.isAwake(body)); }
            EXPECT_EQ(world.counters().wokeUp, before + kBoxes) << "each once";
        }
    }
}

/// The same of two that are welded: what hangs on what was hit wakes with it.
TEST_P(SleepersRow, WakeAcrossJoints) {
    World world = makeWorld(weightless());
    std::vector<BodyId> bodies{addBody(world, dynamicAt({0, 0}), box(0.5, 0.5)),
                               addBody(world, dynamicAt({1.5, 0}), box(0.5, 0.5))};
    WeldJointDef def;
    def.base = between(bodies[0], bodies[1]);
    def.anchor = {0.75, 0};
    must(world.createJoint(def));
    run(world, 3);
    for (const BodyId body : bodies) { must(world.setAwake(body, false)); }
    bodies.push_back(addBody(world, dynamicAt({-1 - GetParam(), 0}, vec(3, 0)), box(0.5, 0.5)));
    run(world, 60);
    EXPECT_NEAR(momentumOf(world, bodies).x, 3, 1e-3);
}

/// Boxes, disks and chains that fall, come to rest, are put to sleep, kicked, destroyed and made anew.
class Playground {
public:
    /// @param sleepers  crates asleep, far away, that were there before
    Playground(std::uint64_t seed, int sleepers) : world_(makeWorld(settingsOf(seed))), random_(seed) {
        BodyDef def = dynamicAt({});
        def.awake = false;
        for (int i = 0; i < sleepers; ++i) {
            def.position = {1e4 + 2.0 * i, 0.5};
            addBody(world_, def, box(0.5, 0.5));
        }
        addStatic(world_, box(1e5, 1), {}, {0, -1});
        for (int i = 0; i < 12; ++i) { bodies_.push_back(makeBody()); }
    }

    void step() {
        const auto chosen = static_cast<std::size_t>(random_.integer(0, static_cast<int>(bodies_.size()) - 1));
        const BodyId body = bodies_[chosen];
        const int what = random_.integer(0, 160);
        if (what == 0) { must(world_.setAwake(body, false)); }
        if (what == 1) { must(world_.setVelocity(body, vec(random_.range(-6, 6), 4), 0)); }
        if (what == 2) {
            must(world_.destroyBody(body));
            bodies_[chosen] = makeBody();
        }
        if (what == 3) { (void)world_.createJoint(hingeTo(body)); }  // or it is refused: with itself
        run(world_, 1);
    }

    std::vector<DVec2> state() const {
        std::vector<DVec2> state;
        for (const BodyId body : bodies_) {
            state.push_back(world_.position(body));
            state.push_back({world_.angle(body), world_.isAwake(body) ? 1.0 : 0.0});
        }
        return state;
    }
    std::uint64_t fellAsleep() const { return world_.counters().fellAsleep; }

private:
    static WorldSettings settingsOf(std::uint64_t seed) {
        WorldSettings settings;
        settings.profile = seed % 2 == 0 ? Profile::fast : Profile::accurate;
        return settings;
    }
    BodyId makeBody() {
        const double size = random_.range(0.2, 0.6);
        const BodyDef def = dynamicAt({random_.range(-5, 5), random_.range(1, 6)});
        return random_.chance(0.3) ? addBody(world_, def, circle(size)) : addBody(world_, def, box(size, 0.3));
    }
    RevoluteJointDef hingeTo(BodyId body) {
        const BodyId other = bodies_[static_cast<std::size_t>(random_.integer(0, 11))];
        RevoluteJointDef def;
        def.base = between(body, other);
        def.anchor = 0.5 * (world_.position(body) + world_.position(other));
        return def;
    }

    World world_;
    Random random_;
    std::vector<BodyId> bodies_;
};

/// Not a bit, whatever wakes and falls asleep itself.
TEST(Sleepers, ElsewhereChangeNothing) {
    std::uint64_t fellAsleep = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Playground alone(seed, 0);
        Playground among(seed, 200);
        for (int i = 0; i < 900; ++i) {
            alone.step();
            among.step();
            fellAsleep += alone.fellAsleep();
            ASSERT_EQ(alone.state(), among.state()) << "seed " << seed << " step " << i;
        }
    }
    EXPECT_GT(fellAsleep, 100U);
}

/// Steps after it fell asleep, with nothing else going on.
TEST(Sleepers, WakeWhenThePlatformTheyHangOnSetsOut) {
    World world = makeWorld(WorldSettings{});
    BodyDef def;
    def.type = BodyType::kinematic;
    def.position = {0, 5};
    const BodyId platform = must(world.createBody(def));
    const BodyId load = addBody(world, dynamicAt({0, 3}), box(0.5, 0.5));
    RevoluteJointDef hinge;
    hinge.base = between(platform, load);
    hinge.anchor = {0, 5};
    const JointId joint = must(world.createJoint(hinge));
    run(world, 300);
    ASSERT_FALSE(world.isAwake(load));
    must(world.setVelocity(platform, vec(1, 0), 0));
    run(world, 60);
    EXPECT_TRUE(world.isAwake(load));
    EXPECT_GT(world.position(load).x, 0.5);
    EXPECT_LT(world.jointError(joint), 1e-3);
}

/// Boxes that are held; the lower one is made ground and free again: the other one moves once in a step.
TEST(Sleepers, HeldOnesMayBeFrozenAndFreed) {
    for (const bool wait : {false, true}) {
        World world = makeWorld(WorldSettings{});
        addStatic(world, box(20, 0.5));
        const std::array boxes{addBody(world, dynamicAt({0, 1}), box(0.5, 0.5)),
                               addBody(world, dynamicAt({0, 2}), box(0.5, 0.5))};
        run(world, 20);
        ASSERT_EQ(world.counters().settledBodies, 2U);
        BodyDef def = world.definition(boxes[0]);
        def.type = BodyType::fixed;
        must(world.redefine(boxes[0], def));
        if (wait) { run(world, 200); }
        def.type = BodyType::dynamic;
        must(world.redefine(boxes[0], def));
        must(world.setPose(boxes[1], {10, 50}, 0));
        must(world.setVelocity(boxes[1], vec(1, 0), 0));
        run(world, 6);
        EXPECT_NEAR(world.position(boxes[1]).x, 10.1, 1e-5);
        EXPECT_EQ(world.counters().awakeBodies, 2U);
    }
}

TEST(Sleepers, HeldOnesThatWereFrozenMayLoseTheirNeighbour) {
    World world = makeWorld(WorldSettings{});
    addStatic(world, box(20, 0.5));
    const BodyId below = addBody(world, dynamicAt({0, 1}), box(0.5, 0.5));
    const BodyId above = addBody(world, dynamicAt({0, 2}), box(0.5, 0.5));
    run(world, 20);
    BodyDef def = world.definition(below);
    def.type = BodyType::fixed;
    must(world.redefine(below, def));
    must(world.destroyBody(above));
    def.type = BodyType::dynamic;
    must(world.redefine(below, def));
    run(world, 20);
    EXPECT_NEAR(world.position(below).y, 1, 1e-3);
}

/// Where it is, not where it was made.
TEST(Sleepers, SensorsOnGroundThatWasPutElsewhere) {
    World world = makeWorld(weightless());
    ShapeDef def;
    def.sensor = true;
    const BodyId gate = addStatic(world, box(0.1, 5), def, {0, 100});
    must(world.setPose(gate, {0, 0}, 0));
    addBody(world, dynamicAt({-3, 0}, vec(240, 0)), circle(0.1));
    run(world, 1);
    const std::span<const ContactEvent> events = world.contactEvents();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].type, ContactEventType::sensorBegin);
    EXPECT_NEAR(events[0].fraction, 0.7, 1e-3);
    EXPECT_EQ(events[1].type, ContactEventType::sensorEnd);
    EXPECT_NEAR(events[1].fraction, 0.8, 1e-3);
}

/// Its contact is looked at once, though that of others is set aside in the same step.
TEST(Sleepers, SensorsPutOverWhatJustFellAsleep) {
    World world = makeWorld(weightless());
    const BodyId body = addBody(world, dynamicAt({}), box(0.5, 0.5));
    run(world, 3);
    must(world.setAwake(body, false));
    ShapeDef def;
    def.sensor = true;
    addStatic(world, box(1, 1), def);
    run(world, 1);
    EXPECT_EQ(world.contactEvents().size(), 1U);
    EXPECT_FALSE(world.isAwake(body));
}

/// A ball in mode speedLimit between a fast heavy one of any mode and a wall of 2 cm does not pass that.
TEST(Sleepers, SpeedLimitHoldsWhateverPushes) {
    for (const double gap : {0.05, 2.0}) {
        for (const bool bullet : {false, true}) {
            World world = makeWorld(weightless());
            addStatic(world, box(0.01, 5), {}, {3, 0});
            BodyDef def = dynamicAt({});
            def.continuous = ContinuousMode::speedLimit;
            const BodyId ball = addBody(world, def, circle(0.1));
            def = dynamicAt({-0.2 - gap, 0}, vec(100, 0));
            def.mass = 100;
            def.bullet = bullet;
            addBody(world, def, circle(0.1));
            run(world, 60);
            EXPECT_LT(world.position(ball).x, 3) << gap << ' ' << bullet;
        }
    }
}

/// As a game does whose level is dug up: first the new ground, then the old one goes. What stands on it stands on,
/// asleep or held. (In `fast` eight boxes moved by 30 mm, and ten fell.)
TEST(Sleepers, StandOnGroundThatIsReplaced) {
    for (const Profile profile : kProfiles) {
        for (const int every : {1, 30}) {
            for (const bool isChain : {false, true}) {
                WorldSettings settings;
                settings.profile = profile;
                World world = makeWorld(settings);
                const BodyId level = must(world.createBody({}));
                const auto addGround = [&] {
                    const Vec2 points[] = {vec(10, 0), vec(0.3, 0), vec(-10, 0)};
                    return isChain
                               ? must(world.addChain(level, points, false, material(0.6)))
                               : must(world.addShape(level, must(makeBox(vec(10, 0.5), vec(0, -0.5))), material(0.6)));
                };
                ShapeId ground = addGround();
                std::vector<BodyId> tower;
                for (int i = 0; i < 10; ++i) {
                    tower.push_back(addBody(world, dynamicAt({0, 0.25 + 0.5 * i}), box(0.25, 0.25), material(0.6)));
                }
                run(world, 60);
                for (int i = 0; i < 240; ++i) {
                    if (i % every == 0) {
                        const ShapeId next = addGround();
                        must(world.destroyShape(ground));
                        ground = next;
                    }
                    run(world, 1);
                }
                for (int i = 0; i < 10; ++i) {
                    const DVec2 moved = world.position(tower[static_cast<std::size_t>(i)]) - DVec2{0, 0.25 + 0.5 * i};
                    EXPECT_LT(length(moved), 1e-4) << profileName(profile) << ", every " << every << ", box " << i;
                }
            }
        }
    }
}

/// What is built beside them wakes nobody, be it with a gap or a sensor. (What was held rested anew for each piece.)
TEST(Sleepers, SleepBesideWhatIsBuilt) {
    for (const bool isSensor : {false, true}) {
        for (const int every : {15, 60}) {
            World world = makeWorld(WorldSettings{});
            const BodyId level = must(world.createBody({}));
            must(world.addShape(level, box(10, 0.5)));
            const BodyId sleeper = addBody(world, dynamicAt({0, 1}), box(0.5, 0.5));
            const auto build = [&](int step) {
                if (step % every == 0) {
                    ShapeDef def = material(0.6);
                    def.sensor = isSensor;
                    addBody(world, {.position = {isSensor ? 0.51 : 0.55, 1.2}}, box(0.02, 0.02), def);
                }
            };
            int steps = 0;
            while (world.isAwake(sleeper) && steps < 600) {
                build(++steps);
                run(world, 1);
            }
            EXPECT_LT(steps, 100) << (isSensor ? "sensors" : "boxes") << " every " << every;
        }
    }
}

}  // namespace
}  // namespace swept::test

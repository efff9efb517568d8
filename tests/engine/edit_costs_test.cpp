#include <ctime>

#include "world_support.h"

/// What calls between steps cost, of bodies with many shapes and joints: what they change, not all that there is.

namespace swept::test {
namespace {

/// A level of so many tiles, one body, and crates that stand on it.
struct TiledLevel {
    World world = makeWorld(WorldSettings{.gravity = vec(0, -kGravity)});
    BodyId ground = must(world.createBody({}));
    std::vector<ShapeId> tiles;
    std::vector<BodyId> crates;

    explicit TiledLevel(int count) {
        for (int i = 0; i < count; ++i) {
            tiles.push_back(must(world.addShape(ground, must(makeBox(vec(0.5, 0.5), vec(i, -0.5))))));
        }
    }
    void addCrates(int count) {
        for (int i = 0; i < count; ++i) { crates.push_back(addBody(world, dynamicAt({1.0 * i, 0.4}), box(0.4, 0.4))); }
    }
    JointId hang(BodyId crate, bool collide, std::optional<Real> breakForce = std::nullopt) {
        RevoluteJointDef def{.base = {.bodyA = ground, .bodyB = crate, .collideConnected = collide},
                             .anchor = world.position(crate)};
        def.base.breakForce = breakForce;
        return must(world.createJoint(def));
    }
};

std::uint64_t boxesMoved(TiledLevel& level, const std::vector<JointId>& joints) {
    const std::uint64_t before = level.world.counters().proxiesMoved;
    for (const JointId joint : joints) { must(level.world.destroyJoint(joint)); }
    return level.world.counters().proxiesMoved - before;
}

TEST(EditCosts, AJointThatKeptNothingApartRenewsNoBoxes) {
    for (const bool collide : {false, true}) {
        TiledLevel level(200);
        level.addCrates(20);
        std::vector<JointId> joints;
        for (const BodyId crate : level.crates) { joints.push_back(level.hang(crate, collide)); }
        run(level.world, 3);
        // What was kept apart is found by the one box of the crate.
        EXPECT_EQ(boxesMoved(level, joints), collide ? 0U : 20U);
        runFor(level.world, 1);
        for (const BodyId crate : level.crates) { EXPECT_NEAR(level.world.position(crate).y, 0.4, 0.01); }
    }
}

TEST(EditCosts, JointsThatBreakRenewBoxesOfTheSmallerBodyAlone) {
    TiledLevel level(1000);
    level.addCrates(20);
    for (const BodyId crate : level.crates) { level.hang(crate, false, real(1e-3)); }
    must(level.world.step(kStep));
    EXPECT_EQ(level.world.jointBreaks().size(), 20U);
    expectAtMost("boxes", static_cast<double>(level.world.counters().proxiesMoved), 100);
    runFor(level.world, 1);
    for (const BodyId crate : level.crates) { EXPECT_NEAR(level.world.position(crate).y, 0.4, 0.01); }
}

TEST(EditCosts, ALevelThatGoesRenewsNoBoxes) {
    TiledLevel level(200);
    level.addCrates(20);
    for (const BodyId crate : level.crates) { level.hang(crate, false); }
    run(level.world, 3);
    const std::uint64_t before = level.world.counters().proxiesMoved;
    must(level.world.destroyBody(level.ground));
    EXPECT_EQ(level.world.counters().proxiesMoved, before);
    EXPECT_EQ(level.world.jointCount(), 0U);
}

/// Processor time of `act`, the least of five runs with things that `make` makes anew: what else the machine does
/// makes it longer, never shorter.
template <class Make, class Act>
double timeOf(const Make& make, const Act& act) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
        auto made = make();
        const std::clock_t begin = std::clock();
        act(made);
        least = std::min(least, static_cast<double>(std::clock() - begin));
    }
    return least;
}

/// How many times as long `act` takes of eight times as much.
template <class Make, class Act>
double growthOf(int count, const Make& make, const Act& act) {
    return timeOf([&] { return make(8 * count); }, act) / timeOf([&] { return make(count); }, act);
}

/// Shapes of a body that is not dynamic are measured as they come, and once a step as they go: quadratic, it would be
/// 64 times as long.
TEST(EditCosts, ShapesOfAKinematicBodyComeAndGoOneByOne) {
    const auto make = [](int count) {
        auto level = std::make_unique<TiledLevel>(0);
        must(level->world.redefine(level->ground, bodyAt(BodyType::kinematic, {})));
        return std::pair(std::move(level), count);
    };
    const double growth = growthOf(400, make, [](auto& made) {
        auto& [level, count] = made;
        std::vector<ShapeId> shapes;
        for (int i = 0; i < count; ++i) {
            shapes.push_back(must(level->world.addShape(level->ground, must(makeBox(vec(0.5, 0.5), vec(i, 0))))));
        }
        ShapeDef dense;
        dense.density = 2;
        for (const ShapeId shape : shapes) { must(level->world.redefine(shape, dense)); }
        for (const ShapeId shape : shapes) { must(level->world.destroyShape(shape)); }
    });
    expectAtMost("growth", growth, 28);
}

/// A kinematic body is as if it never had had the shapes that went, and as if all had been there from the start.
TEST(EditCosts, AKinematicBodyIsMeasuredAsIfMadeAtOnce) {
    const auto finalPlace = [](bool atOnce) {
        World world = makeWorld(awakeSettings());
        BodyDef def = bodyAt(BodyType::kinematic, {});
        def.velocity = vec(0.5, 0);
        def.angularVelocity = real(0.1);
        const BodyId lift = must(world.createBody(def));
        must(world.addShape(lift, box(4, 0.5), material(0.5)));
        const BodyId crate = addBody(world, dynamicAt({1, 1}), box(0.4, 0.4), material(0.5));
        const Polygon far = must(makeBox(vec(0.2, 0.2), vec(3, 0.6)));
        const Polygon gone = must(makeBox(vec(0.01, 5), vec(60, 0)));
        if (atOnce) { must(world.addShape(lift, far, material(0.5))); }
        const ShapeId more = must(world.addShape(lift, gone, material(0.5)));
        if (!atOnce) { must(world.addShape(lift, far, material(0.5))); }
        must(world.destroyShape(more));
        runFor(world, 2);
        return std::pair(world.position(crate), world.angle(crate));
    };
    EXPECT_EQ(finalPlace(false), finalPlace(true));
}

/// A crowd far from each other, awake.
auto crowdOf(int count) {
    auto level = std::make_unique<TiledLevel>(0);
    level->addCrates(count);
    must(level->world.step(kStep));
    return level;
}

TEST(EditCosts, AwakeBodiesGoWithoutALookAtTheOthers) {
    const double growth = growthOf(4000, crowdOf, [](auto& level) {
        for (std::size_t i = level->crates.size(); i > 0; --i) { must(level->world.destroyBody(level->crates[i - 1])); }
    });
    expectAtMost("growth", growth, 28);
}

TEST(EditCosts, AwakeBodiesArePutToSleepWithoutALookAtTheOthers) {
    const double growth = growthOf(4000, crowdOf, [](auto& level) {
        for (std::size_t i = level->crates.size(); i > 0; --i) {
            must(level->world.setAwake(level->crates[i - 1], false));
        }
    });
    expectAtMost("growth", growth, 28);
}

/// Bodies that leave and come back between two steps, some in the slots of others, are among the awake ones once.
TEST(EditCosts, WhoLeftAndCameBackIsAwakeOnce) {
    World world = makeWorld(WorldSettings{.gravity = vec(0, 0)});
    std::vector<BodyId> bodies;
    for (int i = 0; i < 12; ++i) { bodies.push_back(addBody(world, dynamicAt({2.0 * i, 0}), box(0.4, 0.3))); }
    for (int i = 0; i < 2; ++i) {
        must(world.setAwake(bodies[3], false));
        must(world.setAwake(bodies[3], true));
        must(world.destroyBody(bodies[5]));
        bodies[5] = addBody(world, dynamicAt({10, 1.0 * i}), box(0.4, 0.3));
    }
    must(world.setAwake(bodies[8], false));
    must(world.step(kStep));
    EXPECT_EQ(world.counters().awakeBodies, 11U);
    std::size_t awake = 0;
    for (const BodyId body : bodies) { awake += world.isAwake(body) ? 1 : 0; }
    EXPECT_EQ(awake, 11U);
}

/// Microseconds are of a look at one sensor, or one tile: sixteen times the level costs the same, but for memory.
TEST(EditCosts, ASensorOfALevelIsAskedWithoutALookAtTheLevel) {
    const auto make = [](int count) {
        auto level = std::make_unique<TiledLevel>(count);
        level->addCrates(count);
        ShapeDef zone;
        zone.sensor = true;
        level->tiles.push_back(must(level->world.addShape(level->ground, must(makeBox(vec(0.5, 2), vec(5, 1))), zone)));
        for (int i = 0; i < 400 && (i == 0 || level->world.counters().awakeBodies > 0); ++i) { run(level->world, 1); }
        EXPECT_EQ(level->world.counters().awakeBodies, 0U);
        return level;
    };
    const double growth = growthOf(250, make, [](auto& level) {
        std::size_t inside = 0;
        for (int i = 0; i < 2000; ++i) {
            level->world.visitOverlaps(level->tiles.back(), [&inside](ShapeId) { ++inside; });
        }
        EXPECT_EQ(inside, 2000U);
    });
    expectAtMost("growth", growth, 4);  // it was 10
}

}  // namespace
}  // namespace swept::test

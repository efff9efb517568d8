#include <algorithm>
#include <random>
#include <set>

#include "world_support.h"

/// What is destroyed or put elsewhere takes its contacts with it, whether one goes between two steps (its pairs are
/// looked for among all) or many do (they are listed by shape), and nothing of the others.

namespace swept::test {
namespace {

Polygon boxAt(double halfX, double halfY, Vec2 center) { return must(makeBox(vec(halfX, halfY), center)); }

/// A heap in a pit whose ground is one body of many tiles.
struct TiledPit {
    World world;
    BodyId ground;
    std::vector<ShapeId> tiles;
    std::vector<BodyId> bodies;

    TiledPit(unsigned seed, bool sleep) {
        WorldSettings settings = awakeSettings();
        settings.sleep = sleep;
        world = makeWorld(settings);
        ground = world.createBody({}).value();
        for (int i = -10; i < 10; ++i) { addTile(boxAt(0.5, 0.5, vec(i + 0.5, -0.5))); }
        for (int i = 0; i < 10; ++i) {
            addTile(boxAt(0.5, 0.5, vec(-10.5, i + 0.5)));
            addTile(boxAt(0.5, 0.5, vec(10.5, i + 0.5)));
        }
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> x(-9, 9);
        std::uniform_real_distribution<double> y(1, 9);
        for (int i = 0; i < 100; ++i) {
            const Polygon shape = i % 2 == 0 && !sleep ? circle(0.4) : box(0.4, 0.3);  // which does not roll
            bodies.push_back(addBody(world, dynamicAt({x(random), y(random)}), shape, material(0.5)));
        }
    }
    void addTile(const Polygon& tile) {
        const Result<ShapeId> id = world.addShape(ground, tile, material(0.5));
        ASSERT_TRUE(id.ok());
        tiles.push_back(id.value());
    }
};

using Touch = std::pair<std::uint32_t, std::uint32_t>;  // slots of shapes

Touch touchOf(ShapeId a, ShapeId b) { return std::minmax(a.index, b.index); }

std::set<Touch> touchesOf(const World& world) {
    std::set<Touch> touches;
    world.visitContacts([&](const ContactView& view) { touches.insert(touchOf(view.shapeA, view.shapeB)); });
    return touches;
}

/// Who touches as the events tell, which is less than who has contact points.
void followEvents(std::set<Touch>& touching, std::span<const ContactEvent> events) {
    for (const ContactEvent& event : events) {
        const Touch touch = touchOf(event.shapeA, event.shapeB);
        if (event.type == ContactEventType::begin) {
            EXPECT_TRUE(touching.insert(touch).second) << "begins twice";
        } else if (event.type == ContactEventType::end) {
            EXPECT_EQ(touching.erase(touch), 1U) << "ends without a begin, or twice";
        }
    }
}

std::set<Touch> without(std::set<Touch> touches, const std::set<Touch>& gone) {
    for (const Touch& touch : gone) { touches.erase(touch); }
    return touches;
}

class Removal : public testing::TestWithParam<int> {};

TEST_P(Removal, TakesItsContactsAndNoOthers) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const bool sleeps = seed % 2 == 0;  // then many of the contacts are parked
        TiledPit pit(seed, sleeps);
        std::set<Touch> touching;
        const auto sleeping = [&pit] {
            return std::count_if(pit.bodies.begin(), pit.bodies.end(),
                                 [&](BodyId body) { return !pit.world.isAwake(body); });
        };
        for (int step = 0; step < 90 || (sleeps && sleeping() < 20 && step < 2000); ++step) {
            run(pit.world, 1);
            followEvents(touching, pit.world.contactEvents());
        }
        EXPECT_EQ(sleeps, sleeping() > 0);
        std::mt19937 random(seed);
        std::shuffle(pit.bodies.begin(), pit.bodies.end(), random);
        std::shuffle(pit.tiles.begin(), pit.tiles.end(), random);
        pit.bodies.resize(static_cast<std::size_t>(GetParam()));
        pit.tiles.resize(std::min(pit.bodies.size(), pit.tiles.size()));
        std::set<std::uint32_t> bodies;
        std::set<std::uint32_t> tiles;
        for (const BodyId body : pit.bodies) { bodies.insert(body.index); }
        for (const ShapeId tile : pit.tiles) { tiles.insert(tile.index); }
        std::set<Touch> doomed;
        const std::set<Touch> before = touchesOf(pit.world);
        ASSERT_GT(before.size(), 50U);
        pit.world.visitContacts([&](const ContactView& view) {
            const auto parts = bodies.count(view.bodyA.index) + bodies.count(view.bodyB.index) +
                               tiles.count(view.shapeA.index) + tiles.count(view.shapeB.index);
            if (parts > 0) { doomed.insert(touchOf(view.shapeA, view.shapeB)); }
        });
        const std::span<const ContactEvent> told = pit.world.contactEvents();  // by which games find what to destroy
        for (std::size_t i = 0; i < pit.bodies.size(); ++i) {
            // Every third is put elsewhere: all its contacts end, too.
            must(i % 3 == 2 ? pit.world.setPose(pit.bodies[i], {40.0 + 2 * static_cast<double>(i), 5}, 0)
                            : pit.world.destroyBody(pit.bodies[i]));
        }
        for (const ShapeId tile : pit.tiles) { must(pit.world.destroyShape(tile)); }
        EXPECT_EQ(touchesOf(pit.world), without(before, doomed));
        EXPECT_EQ(pit.world.contactEvents().data(), told.data());
        EXPECT_EQ(pit.world.contactEvents().size(), told.size());
        run(pit.world, 1);
        followEvents(touching, pit.world.contactEvents());
        EXPECT_EQ(touching, without(touching, doomed));
        // The gaps are closed, and slots are used again.
        for (std::size_t n = 0; n < pit.bodies.size(); ++n) {
            addBody(pit.world, dynamicAt({0.1 * static_cast<double>(n) - 3, 12}), circle(0.3), material(0.5));
        }
        run(pit.world, 30);
        std::size_t left = 0;
        pit.world.visitContacts([&](const ContactView& view) {
            ++left;
            EXPECT_TRUE(pit.world.isValid(view.shapeA) && pit.world.isValid(view.shapeB));
            EXPECT_TRUE(pit.world.isValid(view.bodyA) && pit.world.isValid(view.bodyB));
        });
        EXPECT_GT(left, 0U);
    }
}
INSTANTIATE_TEST_SUITE_P(Counts, Removal, testing::Values(1, 2, 3, 60));

/// Whatever is fixed or moves by itself holds where it is put, however far that is from where it was made.
TEST(PutElsewhere, GroundHolds) {
    for (const BodyType type : {BodyType::fixed, BodyType::kinematic}) {
        for (const double distance : {0.5, 3.0, 20.0, 1000.0}) {
            for (const double angle : {0.0, kPi / 2}) {
                SCOPED_TRACE(testing::Message() << "distance " << distance << ", angle " << angle);
                World world = makeWorld(awakeSettings());
                const BodyId ground = addBody(world, bodyAt(type, {0, 0}), box(2, 2), material(0.5));
                run(world, 10);
                must(world.setPose(ground, {0, -distance}, angle));
                const BodyId falls = addBody(world, dynamicAt({0.5, 3 - distance}), box(0.4, 0.4), material(0.5));
                run(world, 120);
                expectAtMost("height", std::abs(world.position(falls).y - (2.4 - distance)), 0.01);
            }
        }
    }
}

TEST(RemovalOfShapes, LetsSleepWhoRestsElsewhere) {
    World world = makeWorld(WorldSettings{.gravity = vec(0, -kGravity)});
    const BodyId ground = world.createBody({}).value();
    const ShapeId left = world.addShape(ground, boxAt(1, 0.5, vec(-5, -0.5)), material(0.5)).value();
    ASSERT_TRUE(world.addShape(ground, boxAt(1, 0.5, vec(5, -0.5)), material(0.5)).ok());
    const BodyId falls = addBody(world, dynamicAt({-5, 0.5}), box(0.5, 0.5), material(0.5));
    const BodyId stays = addBody(world, dynamicAt({5, 0.5}), box(0.5, 0.5), material(0.5));
    runFor(world, 3);
    ASSERT_FALSE(world.isAwake(falls) || world.isAwake(stays));
    must(world.destroyShape(left));
    EXPECT_TRUE(world.isAwake(falls));
    EXPECT_FALSE(world.isAwake(stays));
    runFor(world, 1);
    EXPECT_LT(world.position(falls).y, -3);
    EXPECT_EQ(world.position(stays).x, 5);
}

/// Sizes of a fixed body are kept as shapes come and go: what moves there does so to the bit as on ground that never
/// had the others.
TEST(RemovalOfShapes, LeavesTheBodyAsIfTheyNeverWere) {
    const auto finalPose = [](bool hadMore) {
        World world = makeWorld(awakeSettings());
        const BodyId ground = world.createBody({}).value();
        EXPECT_TRUE(world.addShape(ground, boxAt(10, 0.5, vec(0, -0.5)), material(0.5)).ok());
        const BodyId ball = addBody(world, dynamicAt({-4, 3}, vec(3, 0)), circle(0.3), material(0.5));
        const BodyId plank = addBody(world, dynamicAt({2, 2}), box(1, 0.1), material(0.5));
        if (hadMore) {
            std::vector<ShapeId> more;
            for (int i = 0; i < 9; ++i) {
                more.push_back(
                    world.addShape(ground, boxAt(0.001 * (i + 1), 5 + i, vec(200 + i, 0)), material(0.5)).value());
            }
            for (const ShapeId id : more) { must(world.destroyShape(id)); }
        }
        runFor(world, 2);
        return std::array{world.position(ball), world.position(plank), DVec2{world.angle(ball), world.angle(plank)}};
    };
    EXPECT_EQ(finalPose(false), finalPose(true));
}

}  // namespace
}  // namespace swept::test

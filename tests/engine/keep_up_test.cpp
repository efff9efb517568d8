#include <limits>
#include <map>
#include <set>

#include "thrown_crowd.h"

/// What a game asks to keep up with a world: who moved, where shapes are, whether another machine has the same.

namespace swept::test {
namespace {

struct Pose {
    DVec2 position;
    double angle = 0;
    bool operator==(const Pose&) const = default;
};

/// A crowd that comes to rest on ground, a stack that stands in balance, what sleeps, a lift that goes and one that
/// does not.
struct Yard {
    World world;
    std::vector<BodyId> bodies;

    explicit Yard(Profile profile) {
        WorldSettings settings;
        settings.profile = profile;
        world = makeWorld(settings);
        bodies.push_back(addStatic(world, box(30, 0.5), material(0.5), {0, -0.5}));
        Random random(7);
        const auto calm = [](int i, BodyDef& def, ShapeDef&) {
            def.position = {def.position.x, 10 + def.position.y};
            def.velocity = Real(0.02) * def.velocity;
            def.awake = i % 4 != 0;
        };
        for (const BodyId body : throwCrowd(world, random, 40, calm)) { bodies.push_back(body); }
        for (int i = 0; i < 5; ++i) {
            bodies.push_back(addBody(world, dynamicAt({15, 0.5 + i}), box(0.5, 0.5), material(0.5)));
        }
        for (const double speed : {0.0, 0.5}) {
            BodyDef lift = bodyAt(BodyType::kinematic, {-15 - 10 * speed, 3});
            lift.velocity = vec(0, speed);
            bodies.push_back(addBody(world, lift, box(1, 0.1)));
        }
    }
    std::map<std::uint32_t, Pose> poses() const {
        std::map<std::uint32_t, Pose> all;
        world.visitBodies([&](BodyId id) { all[id.index] = {world.centerOfMass(id), world.angle(id)}; });
        return all;
    }
    std::set<std::uint32_t> moved() const {
        std::set<std::uint32_t> found;
        world.visitMoved([&](BodyId id) {
            EXPECT_TRUE(world.isValid(id));
            EXPECT_TRUE(found.insert(id.index).second) << "twice";
        });
        return found;
    }
};

class KeepUp : public testing::TestWithParam<Profile> {};

TEST_P(KeepUp, VisitsAllThatTheStepMovedAndNothingElse) {
    Yard yard(GetParam());
    std::size_t visits = 0;
    for (int step = 0; step < 600; ++step) {
        const auto before = yard.poses();
        must(yard.world.step(kStep));
        std::set<std::uint32_t> wanted;
        for (const auto& [slot, pose] : yard.poses()) {
            if (pose != before.at(slot)) { wanted.insert(slot); }
        }
        ASSERT_EQ(yard.moved(), wanted) << "step " << step;
        visits += wanted.size();
    }
    EXPECT_GT(visits, 2'000U);
    EXPECT_GT(yard.moved().size(), 0U) << "a lift goes on";
}

/// It slides on ice, so slowly that it falls asleep.
TEST(KeepUp, VisitsWhatMovesInTheStepThatPutsItToSleep) {
    int moved = 0;
    for (const double speed : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5}) {
        WorldSettings settings;
        settings.gravity = vec(0, -kGravity);
        World world = makeWorld(settings);
        addStatic(world, box(50, 0.5), material(0), {0, -0.5});
        const BodyId body = addBody(world, dynamicAt({0, 0.5}, vec(speed, 0)), box(0.5, 0.5), material(0));
        for (int step = 0; step < 600 && world.isAwake(body); ++step) {
            const DVec2 before = world.position(body);
            must(world.step(kStep));
            int visits = 0;
            world.visitMoved([&](BodyId id) { visits += id == body ? 1 : 0; });
            ASSERT_EQ(visits, world.position(body) != before ? 1 : 0) << speed << " m/s, step " << step;
            moved += visits > 0 && !world.isAwake(body) ? 1 : 0;
        }
        must(world.step(kStep));
        if (!world.isAwake(body)) {
            world.visitMoved([](BodyId) { ADD_FAILURE() << "it sleeps"; });
        }
    }
    EXPECT_GT(moved, 0);
}

TEST_P(KeepUp, VisitsNoneThatIsGone) {
    Yard yard(GetParam());
    run(yard.world, 30);
    const std::set<std::uint32_t> before = yard.moved();
    const World copy = yard.world;
    must(yard.world.destroyBody(yard.bodies[3]));
    must(yard.world.setAwake(yard.bodies[2], false));
    std::set<std::uint32_t> wanted = before;
    EXPECT_EQ(wanted.erase(yard.bodies[3].index), 1U);
    EXPECT_EQ(yard.moved(), wanted);
    const BodyId next = addBody(yard.world, dynamicAt({0, 50}), circle(0.5));
    EXPECT_EQ(next.index, yard.bodies[3].index) << "its slot is used again";
    EXPECT_EQ(yard.moved(), wanted);
    std::set<std::uint32_t> ofCopy;
    copy.visitMoved([&](BodyId id) { ofCopy.insert(id.index); });
    EXPECT_EQ(ofCopy, before);
}

TEST_P(KeepUp, HashesTellWorldsApartThatDifferInABit) {
    Yard yard(GetParam());
    run(yard.world, 40);
    std::set<std::uint64_t> hashes{yard.world.stateHash()};
    const auto expectAnother = [&hashes](const World& world, const char* what) {
        EXPECT_TRUE(hashes.insert(world.stateHash()).second) << what;
    };
    const World snapshot = yard.world;
    EXPECT_EQ(snapshot.stateHash(), yard.world.stateHash());
    const BodyId body = yard.bodies[5];
    const Vec2 velocity = snapshot.velocity(body);
    World world = snapshot;
    must(world.setVelocity(body, {std::nextafter(velocity.x, Real(1e3)), velocity.y}, snapshot.angularVelocity(body)));
    expectAnother(world, "velocity");
    world = snapshot;
    const DVec2 place = snapshot.position(body);
    must(world.setPose(body, {place.x, std::nextafter(place.y, 1e3)}, snapshot.angle(body)));
    expectAnother(world, "place");
    world = snapshot;
    must(world.setPose(body, place, std::nextafter(snapshot.angle(body), 1e3)));
    expectAnother(world, "angle");
    world = snapshot;
    must(world.destroyBody(body));
    expectAnother(world, "one is gone");
    (void)must(world.createBody(dynamicAt({0, 0})));
    expectAnother(world, "another in its slot");
    world = snapshot;
    must(world.setAwake(yard.bodies[43], false));  // of the stack
    expectAnother(world, "one sleeps");
    world = snapshot;
    EXPECT_EQ(world.stateHash(), *hashes.find(snapshot.stateHash()));
    run(world, 20);
    run(yard.world, 20);
    EXPECT_EQ(world.stateHash(), yard.world.stateHash()) << "from equal states on";
    EXPECT_NE(world.stateHash(), snapshot.stateHash());
}

INSTANTIATE_TEST_SUITE_P(OfBothProfiles, KeepUp, testing::Values(Profile::accurate, Profile::fast));

TEST(KeepUp, BoundsAreThoseOfTheShapeWhereItIs) {
    World world = makeWorld();
    const BodyId body = addBody(world, bodyAt(BodyType::dynamic, {3, 4}, 0.7), box(1, 0.25));
    ShapeId shape{};
    world.visitShapes(body, [&shape](ShapeId id) { shape = id; });
    const double x = std::cos(0.7) + 0.25 * std::sin(0.7);
    const double y = std::sin(0.7) + 0.25 * std::cos(0.7);
    const auto expectBox = [&world](ShapeId id, DVec2 lower, DVec2 upper) {
        const Aabb box = world.bounds(id);
        const double off = 100 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        EXPECT_NEAR(static_cast<double>(box.lower.x), lower.x, off);
        EXPECT_NEAR(static_cast<double>(box.lower.y), lower.y, off);
        EXPECT_NEAR(static_cast<double>(box.upper.x), upper.x, off);
        EXPECT_NEAR(static_cast<double>(box.upper.y), upper.y, off);
    };
    expectBox(shape, {3 - x, 4 - y}, {3 + x, 4 + y});
    must(world.setPose(body, {-3, 1}, 0));
    expectBox(shape, {-4, 0.75}, {-2, 1.25});
    const BodyId ground = must(world.createBody(bodyAt(BodyType::fixed, {10, 0})));
    const std::array points{vec(5, 0), vec(2, -1), vec(0, 3)};
    const ShapeId chain = must(world.addChain(ground, points, false, {}, real(0.5)));
    expectBox(chain, {9.5, -1.5}, {15.5, 3.5});
    must(world.destroyShape(chain));
    const Aabb none = world.bounds(chain);
    EXPECT_EQ(none.lower.x, Aabb{}.lower.x);
    EXPECT_EQ(none.upper.y, Aabb{}.upper.y);
}

TEST(KeepUp, NamesTheBodyWithoutMass) {
    World world = makeWorld();
    EXPECT_EQ(world.bodyWithoutMass(), BodyId{});
    (void)addBody(world, dynamicAt({0, 0}), circle(1));
    const BodyId second = must(world.createBody(dynamicAt({5, 0})));
    const BodyId third = must(world.createBody(dynamicAt({9, 0})));
    EXPECT_EQ(world.step(kStep).code, StatusCode::missingMass);
    EXPECT_EQ(world.bodyWithoutMass(), second);
    must(world.addShape(second, circle(1)));
    EXPECT_EQ(world.bodyWithoutMass(), third);
    must(world.destroyBody(third));
    EXPECT_EQ(world.bodyWithoutMass(), BodyId{});
    must(world.step(kStep));
}

TEST(KeepUp, CastShapesMeetAllOnTheirWay) {
    World world = makeWorld();
    Random random(3);
    for (int i = 0; i < 60; ++i) {
        addStatic(world, i % 2 == 0 ? circle(0.3) : box(0.4, 0.2), {}, {random.range(-8, 8), random.range(-8, 8)},
                  random.range(0, 3));
    }
    int met = 0;
    int free = 0;
    for (int i = 0; i < 200; ++i) {
        const Polygon carried = i % 2 == 0 ? capsule(0.4, 0.2) : box(0.3, 0.5);
        const WorldTransform from{{random.range(-9, 9), random.range(-9, 9)}, rotationFromAngle(random.range(0, 7))};
        const Vec2 way = vec(random.range(-9, 9), random.range(-9, 9));
        std::map<std::uint32_t, Real> fractions;
        world.castShapeAll(carried, from, way, {}, [&](const CastHit& hit) {
            EXPECT_TRUE(fractions.emplace(hit.shape.index, hit.fraction).second);
            return Real(1);
        });
        const CastHit first = world.castShape(carried, from, way);
        ASSERT_EQ(first.hit, !fractions.empty());
        for (const auto& [shape, fraction] : fractions) { EXPECT_GE(fraction, first.fraction); }
        if (first.hit) { EXPECT_EQ(fractions.at(first.shape.index), first.fraction); }
        // What it overlaps anywhere on the way it met; where it starts in contact with something, what it overlaps
        // deeper than contacts are (1/8 of 0.4 m), and than it was lifted off that.
        bool isInContact = false;
        world.overlapShape(carried, from, {}, [&](ShapeId) { return !(isInContact = true); });
        const Polygon deep = i % 2 == 0 ? capsule(0.4, 0.1) : box(0.2, 0.4);
        for (int k = 0; k <= 50; ++k) {
            const DVec2 at = from.position + k / 50.0 * toDouble(way);
            world.overlapShape(isInContact ? deep : carried, {at, from.rotation}, {}, [&](ShapeId shape) {
                EXPECT_EQ(fractions.count(shape.index), 1U);
                return true;
            });
        }
        free += isInContact ? 0 : 1;
        met += static_cast<int>(fractions.size());
        int visits = 0;
        world.castShapeAll(carried, from, way, {}, [&](const CastHit&) {
            ++visits;
            return Real(0);
        });
        EXPECT_EQ(visits, first.hit ? 1 : 0) << "a visitor that wants no more";
    }
    EXPECT_GT(met, 200);
    EXPECT_GT(free, 100);
}

}  // namespace
}  // namespace swept::test

#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "world_support.h"

/// A shape that gets another geometry is, from then on, one that was made so; it keeps its id.

namespace swept::test {
namespace {

ShapeId shapeOf(const World& world, BodyId body) {
    ShapeId found;
    world.visitShapes(body, [&](ShapeId id) { found = id; });
    return found;
}

TEST(Reshape, BeforeTheFirstStepItIsAsIfItHadBeenMadeSo) {
    for (const Profile profile : kProfiles) {
        World made = makeWorld(profile);
        World reshaped = makeWorld(profile);
        std::vector<std::pair<BodyId, BodyId>> pairs;
        for (World* const world : {&made, &reshaped}) { addStatic(*world, box(20, 0.5)); }
        for (int i = 0; i < 12; ++i) {
            const BodyDef def = dynamicAt({0.3 * (i % 4) - 0.5, 1.5 + 1.2 * i}, vec(0.1 * i, 0), 0.2 * i);
            const Polygon last = i % 2 == 0 ? box(0.6, 0.3) : capsule(0.3, 0.2);
            const BodyId other = addBody(reshaped, def, circle(0.1), material(0.5, 0.1, 2));
            must(reshaped.reshape(shapeOf(reshaped, other), last));
            pairs.emplace_back(addBody(made, def, last, material(0.5, 0.1, 2)), other);
        }
        for (int i = 0; i < 120; ++i) {
            must(made.step(kStep));
            must(reshaped.step(kStep));
        }
        for (const auto& [a, b] : pairs) {
            EXPECT_EQ(made.position(a), reshaped.position(b)) << profileName(profile);
            EXPECT_EQ(made.angle(a), reshaped.angle(b));
            EXPECT_EQ(made.velocity(a), reshaped.velocity(b));
            EXPECT_EQ(made.mass(a), reshaped.mass(b));
        }
    }
}

/// On a floor that it stands on, under a ceiling that would not let it stand up.
TEST(Reshape, WhoCrouchesStaysWhereHeIs) {
    World world = makeWorld();
    addStatic(world, box(10, 0.5), {}, {0, -0.5});
    BodyDef def = dynamicAt({0, 1});
    def.fixedRotation = true;
    const BodyId hero = addBody(world, def, box(0.4, 1));
    const ShapeId shape = shapeOf(world, hero);
    run(world, 30);
    const double feet = world.position(hero).y - 1;

    must(world.reshape(shape, must(makeBox(vec(0.4, 0.5), vec(0, -0.5)))));
    EXPECT_NEAR(world.mass(hero), 0.8, 1e-6);
    EXPECT_NEAR(world.centerOfMass(hero).y, feet + 0.5, 1e-6);
    EXPECT_FALSE(world.castRay({-5, feet + 1.5}, vec(10, 0)).hit);
    EXPECT_EQ(world.castRay({-5, feet + 0.5}, vec(10, 0)).shape, shape);
    must(world.step(kStep));
    ASSERT_EQ(world.contactEvents().size(), 2U) << "the old contact ends, another one begins";
    EXPECT_EQ(world.contactEvents()[0].type, ContactEventType::end);
    EXPECT_EQ(world.contactEvents()[1].type, ContactEventType::begin);
    run(world, 60);
    EXPECT_NEAR(world.position(hero).y - 1, feet, 1e-3);
    expectAtMost("m/s", length(velocityOf(world, hero)), 1e-3);
    EXPECT_TRUE(world.isValid(shape));
    EXPECT_EQ(world.bodyOf(shape), hero);
}

/// It spins about its centre, which moves over to where the new shape has it: the same point of the body is as fast.
TEST(Reshape, PointsGoOnAsTheyDid) {
    World world = makeWorld(0);
    const BodyId body = addBody(world, dynamicAt({0, 0}, vec(1, 0), 2), box(0.5, 0.5));
    run(world, 1);
    const DVec2 point = world.position(body) + DVec2{0.3, 0.4};
    const Vec2 before = world.velocityAt(body, point);
    must(world.reshape(shapeOf(world, body), must(makeBox(vec(0.5, 0.25), vec(1, 0)))));
    EXPECT_GT(length(world.centerOfMass(body) - world.position(body)), 0.9);
    const Vec2 after = world.velocityAt(body, point);
    EXPECT_NEAR(static_cast<double>(before.x), static_cast<double>(after.x), 1e-5);
    EXPECT_NEAR(static_cast<double>(before.y), static_cast<double>(after.y), 1e-5);
}

TEST(Reshape, WakesWhatLeansOnIt) {
    WorldSettings settings;
    World world = makeWorld(settings);
    addStatic(world, box(10, 0.5), {}, {0, -0.5});
    const BodyId lower = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5));
    const BodyId upper = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
    runFor(world, 3);
    ASSERT_FALSE(world.isAwake(upper));
    must(world.reshape(shapeOf(world, lower), must(makeBox(vec(0.5, 0.25), vec(0, -0.25)))));
    EXPECT_TRUE(world.isAwake(lower));
    EXPECT_TRUE(world.isAwake(upper));
    runFor(world, 2);
    EXPECT_NEAR(world.position(upper).y, 1, 0.01) << "it came down";
}

TEST(Reshape, OfWhatIsFixedDisabledOrASensor) {
    World world = makeWorld();
    const BodyId floor = addStatic(world, box(1, 0.5), {}, {0, -0.5});
    const BodyId crate = addBody(world, dynamicAt({3, 0.5}), box(0.5, 0.5));
    must(world.reshape(shapeOf(world, floor), box(5, 0.5)));  // now it is under the crate
    runFor(world, 1);
    EXPECT_NEAR(world.position(crate).y, 0.5, 0.01);

    must(world.setEnabled(crate, false));
    must(world.reshape(shapeOf(world, crate), box(0.5, 1)));
    must(world.setPose(crate, {3, 1}));
    must(world.setEnabled(crate, true));
    runFor(world, 1);
    EXPECT_NEAR(world.position(crate).y, 1, 0.01);

    ShapeDef sensor;
    sensor.sensor = true;
    const ShapeId trigger = must(world.addShape(floor, must(makeCircle(vec(-4, 1), real(0.5))), sensor));
    const auto countInside = [&] {
        int count = 0;
        world.visitOverlaps(trigger, [&](ShapeId) { ++count; });
        return count;
    };
    run(world, 2);
    EXPECT_EQ(countInside(), 0);
    must(world.reshape(trigger, must(makeCircle(vec(3, 1), real(0.5)))));
    run(world, 1);
    EXPECT_EQ(countInside(), 1);
}

TEST(Reshape, RefusesWhatAddShapeDoesAndChangesNothing) {
    World world = makeWorld();
    const BodyId ground = must(world.createBody({}));
    const std::array<Vec2, 3> points{{vec(5, 0), vec(0, 0), vec(-5, 0)}};
    const ShapeId chain = must(world.addChain(ground, points, false));
    const BodyId crate = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5));
    const ShapeId shape = shapeOf(world, crate);
    run(world, 30);
    const std::uint64_t before = world.stateHash();
    EXPECT_EQ(world.reshape({}, box(1, 1)).code, StatusCode::staleId);
    EXPECT_EQ(world.reshape(chain, box(1, 1)).code, StatusCode::notConvex);
    Polygon bad = box(1, 1);
    bad.vertices[2] = bad.vertices[0];
    EXPECT_FALSE(world.reshape(shape, bad).ok());
    bad = box(1, 1);
    bad.radius = -1;
    EXPECT_EQ(world.reshape(shape, bad).code, StatusCode::negative);
    EXPECT_EQ(world.stateHash(), before);
}

/// Fifty bodies, one of which gets another shape in each step: every contact that begins ends once, a copy and bytes go
/// on with the same bits, and nothing leaves the room.
TEST(Reshape, InAHeapThatNeverRests) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        World world = makeWorld(seed % 2 == 0 ? Profile::fast : Profile::accurate);
        for (const auto& [x, y, halfX, halfY] :
             {std::array{0.0, -1.0, 12.0, 1.0}, std::array{0.0, 21.0, 12.0, 1.0}, std::array{-11.0, 10.0, 1.0, 12.0},
              std::array{11.0, 10.0, 1.0, 12.0}}) {
            addStatic(world, box(halfX, halfY), {}, {x, y});
        }
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> part(0, 1);
        std::vector<BodyId> bodies;
        std::vector<ShapeId> shapes;
        for (int i = 0; i < 50; ++i) {
            bodies.push_back(addBody(world, dynamicAt({-9.0 + 2 * (i % 10), 1.0 + 2 * (i / 10)}), box(0.4, 0.4)));
            shapes.push_back(shapeOf(world, bodies.back()));
        }
        std::map<std::pair<std::uint64_t, std::uint64_t>, int> touching;
        const auto key = [](ShapeId a, ShapeId b) {
            const auto one = (std::uint64_t{a.index} << 32U) | a.generation;
            const auto two = (std::uint64_t{b.index} << 32U) | b.generation;
            return std::pair(std::min(one, two), std::max(one, two));
        };
        World copy;
        for (int i = 0; i < 240; ++i) {
            const double kind = part(random);
            const double a = 0.1 + 0.5 * part(random);
            const double b = 0.1 + 0.5 * part(random);
            const Polygon next = kind < 0.3 ? circle(a) : kind < 0.6 ? capsule(a, 0.5 * b) : box(a, b);
            const std::size_t which = random() % shapes.size();
            must(world.reshape(shapes[which], next));
            if (i == 120) { copy = world; }
            must(world.step(kStep));
            for (const ContactEvent& event : world.contactEvents()) {
                if (event.type == ContactEventType::hit) { continue; }
                int& count = touching[key(event.shapeA, event.shapeB)];
                count += event.type == ContactEventType::begin ? 1 : -1;
                EXPECT_TRUE(count == 0 || count == 1) << "seed " << seed << ", step " << i;
            }
            if (i < 120) { continue; }
            if (i > 120) { must(copy.reshape(shapes[which], next)); }
            must(copy.step(kStep));
            ASSERT_EQ(copy.stateHash(), world.stateHash()) << "seed " << seed << ", step " << i;
        }
        for (const BodyId body : bodies) {
            const DVec2 at = world.position(body);
            EXPECT_TRUE(std::abs(at.x) < 10 && at.y > 0 && at.y < 20) << "seed " << seed;
        }
    }
}

}  // namespace
}  // namespace swept::test

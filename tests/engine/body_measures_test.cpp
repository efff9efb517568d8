#include <swept/engine/bodies/body_measures.h>

#include "../support/random.h"
#include "state_of.h"
#include "world_support.h"

/// How large a body is, after any shapes of it came and went: what a look at all that are left says.

namespace swept::test {
namespace {

/// Few sizes, so that many shapes have the same, and places of which one is often the farthest.
Polygon randomShape(Random& random) {
    const double size = 0.5 * random.integer(1, 3);
    const double x = random.integer(-5, 5);
    const double y = random.integer(-5, 5);
    switch (random.integer(0, 2)) {
        case 0:
            return circle(size, vec(x, y));
        case 1:
            return segment(x, y, x + size, y);
        default:
            return must(makeBox(vec(size, 0.5), vec(x, y), 0));
    }
}

void expectMeasured(const World& world, BodyId id, const std::string& when) {
    World copy = world;
    WorldState& anew = stateOf(copy);
    measure(anew, id.index);
    const Body& expected = anew.bodies[id.index];
    const Body& body = stateOf(world).bodies[id.index];
    EXPECT_EQ(body.extent, expected.extent) << when;
    EXPECT_EQ(body.widest, expected.widest) << when;
    EXPECT_EQ(body.radius, expected.radius) << when;
    EXPECT_EQ(body.reach, expected.reach) << when;
    EXPECT_EQ(body.leastPassed, expected.leastPassed) << when;
    EXPECT_EQ(body.hasSensor, expected.hasSensor) << when;
    EXPECT_EQ(body.hasLine, expected.hasLine) << when;
    EXPECT_EQ(stateOf(world).leastPassedOfSensors, anew.leastPassedOfSensors) << when;
}

TEST(BodyMeasures, AreThoseOfTheShapesThatAreLeft) {
    for (const BodyType type : {BodyType::fixed, BodyType::kinematic}) {
        Random random(31);
        World world = makeWorld();
        const BodyId body = must(world.createBody(bodyAt(type, {1, 2})));
        std::vector<ShapeId> shapes;
        const auto takeOne = [&] {
            const auto place = static_cast<std::size_t>(random.integer(0, static_cast<int>(shapes.size()) - 1));
            std::swap(shapes[place], shapes.back());
            return shapes.back();
        };
        for (int step = 0; step < 600; ++step) {
            // It grows, and shrinks to nothing, again and again.
            const int most = step % 60 < 30 ? 3 : 1;
            for (int i = random.integer(0, most); i > 0; --i) {
                ShapeDef def = material(0.5);
                def.sensor = random.chance(0.1);
                shapes.push_back(must(world.addShape(body, randomShape(random), def)));
            }
            for (int i = random.integer(0, 4 - most); i > 0 && !shapes.empty(); --i) {
                must(world.destroyShape(takeOne()));
                shapes.pop_back();
            }
            if (!shapes.empty() && random.chance(0.1)) {
                const ShapeId changed = takeOne();
                ShapeDef def = world.definition(changed);
                def.sensor = !def.sensor;
                must(world.redefine(changed, def));
            }
            run(world, 1);
            expectMeasured(world, body, "step " + std::to_string(step));
        }
    }
}

}  // namespace
}  // namespace swept::test

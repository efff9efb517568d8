#include <cstddef>
#include <vector>

#include "world_support.h"

/// Where shapes come, go, or have another density, the centre of mass moves, and the points of the body go on as they
/// did.

namespace swept::test {
namespace {

TEST(MovedCenter, KeepsTheMotionOfAllPoints) {
    for (const int steps : {0, 1}) {
        World world = makeWorld(0);
        const BodyId body = must(world.createBody(dynamicAt({0, 0}, {}, 2)));
        must(world.addShape(body, must(makeBox(vec(0.5, 0.5), vec(-1, 0)))));
        const ShapeId right = must(world.addShape(body, must(makeBox(vec(0.5, 0.5), vec(1, 0)))));
        run(world, steps);
        must(world.setPose(body, {0, 0}, 0));
        EXPECT_NEAR(velocityOf(world, body).y, 0, 1e-6);
        ShapeDef light = world.definition(right);
        light.density = 0;
        must(world.redefine(right, light));
        EXPECT_NEAR(world.centerOfMass(body).x, -1, 1e-6);
        EXPECT_NEAR(velocityOf(world, body).y, -2, 1e-5);  // ω·x of the centre where it is now
        must(world.destroyShape(right));
        EXPECT_NEAR(velocityOf(world, body).y, -2, 1e-5);
        BodyDef def = world.definition(body);
        def.type = BodyType::kinematic;  // its velocity is that of the origin
        must(world.redefine(body, def));
        EXPECT_NEAR(velocityOf(world, body).y, 0, 1e-5);
        def = world.definition(body);
        def.type = BodyType::dynamic;
        must(world.redefine(body, def));
        EXPECT_NEAR(velocityOf(world, body).y, -2, 1e-5);
    }
}

/// A ship that turns loses block by block, each of which goes on as a body of its own.
TEST(MovedCenter, PiecesOfWhatTurnsKeepItsMomentum) {
    for (const int steps : {0, 1}) {
        World world = makeWorld(0);
        const BodyId ship = must(world.createBody(dynamicAt({0, 0})));
        std::vector<ShapeId> blocks;
        for (int i = 0; i < 10; ++i) {
            blocks.push_back(must(world.addShape(ship, must(makeBox(vec(0.5, 0.5), vec(i - 4.5, 0))))));
        }
        must(world.setVelocity(ship, {}, 2));
        run(world, steps);
        const double before = world.inertia(ship) * 2;
        for (int i = 9; i > 0; --i) {
            const DVec2 place = apply(world.transform(ship), vec(i - 4.5, 0));
            BodyDef def = dynamicAt(place, world.velocityAt(ship, place), world.angularVelocity(ship));
            def.angle = world.angle(ship);
            must(world.destroyShape(blocks[static_cast<std::size_t>(i)]));
            addBody(world, def, box(0.5, 0.5));
        }
        DVec2 momentum{};
        double angular = 0;
        world.visitBodies([&](BodyId body) {
            const DVec2 part = world.mass(body) * velocityOf(world, body);
            momentum = momentum + part;
            angular += cross(world.centerOfMass(body), part) +
                       world.inertia(body) * static_cast<double>(world.angularVelocity(body));
        });
        expectAtMost("momentum", length(momentum), 1e-3);
        EXPECT_NEAR(angular, before, 1e-3);
    }
}

}  // namespace
}  // namespace swept::test

#include <utility>

#include "world_digest.h"
#include "world_support.h"

/// Worlds change hands: what was a world stays one, bit for bit.

namespace swept::test {
namespace {

struct Dropped {
    World world = makeWorld();
    KnownIds known;
    Dropped() {
        known.bodies.push_back(addStatic(world, box(10, 1)));
        for (int i = 0; i < 6; ++i) {
            known.bodies.push_back(addBody(world, dynamicAt({0.1 * i, 2 + 1.2 * i}), box(0.5, 0.5)));
        }
        known.bodies.push_back(addBody(world, dynamicAt({3, 20}, vec(0, -80)), circle(0.1), material(0.5, 0.8)));
        run(world, 20);
    }
};

TEST(WorldMove, ConstructedFromAnother) {
    Dropped stays;
    Dropped goes;
    World moved(std::move(goes.world));
    run(stays.world, 60);
    run(moved, 60);
    EXPECT_EQ(digestOf(moved, goes.known), digestOf(stays.world, stays.known));
}

TEST(WorldMove, AssignedFromAnother) {
    Dropped stays;
    Dropped goes;
    World moved = makeWorld();
    addStatic(moved, box(1, 1));
    run(moved, 3);
    moved = std::move(goes.world);
    run(stays.world, 60);
    run(moved, 60);
    EXPECT_EQ(digestOf(moved, goes.known), digestOf(stays.world, stays.known));
    // The hollow one may be given a world again.
    goes.world = std::move(moved);
    run(stays.world, 10);
    run(goes.world, 10);
    EXPECT_EQ(digestOf(goes.world, goes.known), digestOf(stays.world, stays.known));
}

TEST(WorldMove, UserDataIsKept) {
    World world = makeWorld();
    BodyDef def = bodyAt(BodyType::dynamic, {});
    def.userData = 0xFEDCBA9876543210U;
    const BodyId body = must(world.createBody(def));
    ShapeDef shape;
    shape.userData = 42;
    const ShapeId id = must(world.addShape(body, circle(1), shape));
    const World moved(std::move(world));
    EXPECT_EQ(moved.userData(body), 0xFEDCBA9876543210U);
    EXPECT_EQ(moved.userData(id), 42u);
    EXPECT_EQ(moved.bodyOf(id), body);
}

}  // namespace
}  // namespace swept::test

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "../support/random.h"
#include "../support/some_of.h"
#include "world_support.h"

/// Bodies whose mass is all in a small head, with something light on a lever of many times their radius of gyration:
/// what pushes that turns the head in place. Thrown once, alone, into a closed static room.

namespace swept::test {
namespace {

constexpr double kRoomReach = 3;
constexpr double kLever = 1.5;

enum class RoomWalls : std::uint8_t { segments, boxes };

World makeStaticRoom(RoomWalls walls, Profile profile) {
    World world = makeWorld(awakeSettings(profile));
    const BodyId room = must(world.createBody({}));
    const std::array<Vec2, 4> corners{vec(-kRoomReach, -kRoomReach), vec(kRoomReach, -kRoomReach),
                                      vec(kRoomReach, kRoomReach), vec(-kRoomReach, kRoomReach)};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (walls == RoomWalls::segments) {
            must(world.addShape(room, must(makeSegment(corners[i], corners[(i + 1) % corners.size()]))));
            continue;
        }
        const bool isUpright = i % 2 == 1;
        const double side = i < 2 ? (isUpright ? 1 : -1) : (isUpright ? -1 : 1);
        const Vec2 half = isUpright ? vec(0.5, kRoomReach + 1) : vec(kRoomReach + 1, 0.5);
        const Vec2 center = isUpright ? vec(side * (kRoomReach + 0.5), 0) : vec(0, side * (kRoomReach + 0.5));
        must(world.addShape(room, must(makeBox(half, center))));
    }
    return world;
}

BodyId throwHammer(World& world, Random& random) {
    const double x = random.range(-1, 1);
    const double y = random.range(-1, 1);
    const double speed = std::pow(10, random.range(0.5, 2.5));
    const double along = speed * random.range(-1, 1);
    const double across = speed * random.range(-1, 1);
    BodyDef def = dynamicAt({x, y}, vec(along, across), random.range(-50, 50));
    def.angle = random.range(0, 2 * kPi);
    const BodyId hammer = addBody(world, def, circle(0.03));
    ShapeDef light;
    light.density = 0;
    light.restitution = real(0.3);
    must(world.addShape(hammer, circle(0.25, vec(kLever, 0)), light));
    return hammer;
}

bool isInside(const World& world, BodyId hammer) {
    for (const Vec2 place : {vec(0, 0), vec(kLever, 0)}) {
        const DVec2 there = apply(world.transform(hammer), place);
        if (std::max(std::fabs(there.x), std::fabs(there.y)) > kRoomReach + 0.01) { return false; }
    }
    return true;
}

void throwManyInto(RoomWalls walls) {
    Random random(41);
    for (int trial = 0; trial < someOf(600); ++trial) {
        World world = makeStaticRoom(walls, trial % 2 == 0 ? Profile::fast : Profile::accurate);
        const BodyId hammer = throwHammer(world, random);
        for (int step = 0; step < 400; ++step) {
            must(world.step(kStep));
            ASSERT_TRUE(isInside(world, hammer)) << "seed 41, trial " << trial << ", step " << step;
        }
    }
}

TEST(LeverRooms, OfSegmentsLetNoneOut) { throwManyInto(RoomWalls::segments); }
TEST(LeverRooms, OfBoxesLetNoneOut) { throwManyInto(RoomWalls::boxes); }

}  // namespace
}  // namespace swept::test

#include <cmath>
#include <vector>

#include "../support/random.h"
#include "world_support.h"

/// Bullets that are thrown about in a kinematic room that turns fast, pressed against its walls by each other.

namespace swept::test {
namespace {

constexpr double kRoomHalf = 2;

struct TurningRoom {
    World world;
    BodyId room;
    std::vector<BodyId> bullets;

    TurningRoom(Random& random, Profile profile, double spin) {
        WorldSettings settings = awakeSettings(profile);
        world = makeWorld(settings);
        BodyDef def;
        def.type = BodyType::kinematic;
        def.angularVelocity = real(spin);
        room = must(world.createBody(def));
        for (const double side : {-1.0, 1.0}) {
            must(world.addShape(room, must(makeBox(vec(kRoomHalf + 0.4, 0.2), vec(0, side * (kRoomHalf + 0.2))))));
            must(world.addShape(room, must(makeBox(vec(0.2, kRoomHalf), vec(side * (kRoomHalf + 0.2), 0)))));
        }
        const int count = random.integer(2, 14);
        for (int i = 0; i < count; ++i) { addBullet(random, i, 2 * kPi * i / count); }
    }

    void addBullet(Random& random, int i, double angle) {
        const double away = i % 2 == 0 ? 0.95 : 1.4;
        const double along = random.range(-20, 20);
        const double across = random.range(-20, 20);
        BodyDef def = dynamicAt(away * DVec2{std::cos(angle), std::sin(angle)}, vec(along, across));
        def.bullet = true;
        const double size = random.range(0.1, 0.2);
        bullets.push_back(addBody(world, def, random.chance(0.5) ? circle(size) : box(size, 0.6 * size)));
    }

    bool areInside() const {
        const Rotation rotation = rotationFromAngle(world.angle(room));
        for (const BodyId bullet : bullets) {
            const Vec2 place = unrotate(rotation, toReal(world.position(bullet)));
            if (std::fabs(place.x) > real(kRoomHalf + 0.05) || std::fabs(place.y) > real(kRoomHalf + 0.05)) {
                return false;
            }
        }
        return true;
    }
};

TEST(BulletRooms, LetNoneOut) {
    Random random(31);
    for (int trial = 0; trial < 24; ++trial) {
        const Profile profile = trial % 2 == 0 ? Profile::accurate : Profile::fast;
        TurningRoom room(random, profile, trial % 3 == 0 ? 40 : 20);
        for (int step = 0; step < 90; ++step) {
            run(room.world, 1);
            ASSERT_TRUE(room.areInside()) << "trial " << trial << ", step " << step;
        }
    }
}

}  // namespace
}  // namespace swept::test

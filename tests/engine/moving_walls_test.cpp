#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "world_support.h"

/// Kinematic walls pass nobody either, whatever they are made of, and whoever is held at his impact meanwhile.

namespace swept::test {
namespace {

double in(std::mt19937& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 65536) / 65536;
}

/// A place of the world in the frame of a body, in double.
DVec2 placeIn(const World& world, BodyId frame, DVec2 place) {
    return turned(place - world.position(frame), -world.angle(frame));
}

enum class Walls { chain, segments, thinBoxes };

constexpr double kHalfX = 4;
constexpr double kHalfY = 3;
constexpr double kWall = 0.02;  ///< thickness of boxes, metres

/// A closed kinematic room around the origin.
BodyId addRoom(World& world, Walls walls) {
    const BodyId room = must(world.createBody(bodyAt(BodyType::kinematic, {})));
    const std::array<Vec2, 4> corners{vec(-kHalfX, -kHalfY), vec(-kHalfX, kHalfY), vec(kHalfX, kHalfY),
                                      vec(kHalfX, -kHalfY)};
    if (walls == Walls::chain) {
        must(world.addChain(room, corners, true));
        return room;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 from = corners[i];
        const Vec2 to = corners[(i + 1) % corners.size()];
        if (walls == Walls::segments) {
            must(world.addShape(room, must(makeSegment(from, to))));
        } else {
            const Vec2 middle = real(0.5) * (from + to);
            const Vec2 out = (1 / length(middle)) * middle;
            const Vec2 half = real(0.5) * Vec2{std::fabs(to.x - from.x), std::fabs(to.y - from.y)};
            must(world.addShape(room, must(makeBox(half + vec(kWall / 2, kWall / 2), middle + real(kWall / 2) * out))));
        }
    }
    return room;
}

/// Whether all of a body is outside. @param reach  of any of its points from its origin, metres
bool isOut(const World& world, BodyId room, BodyId body, double reach) {
    const DVec2 place = placeIn(world, room, world.position(body));
    return std::fabs(place.x) > kHalfX + reach || std::fabs(place.y) > kHalfY + reach;
}

constexpr double kReach = 0.32;
Polygon shapeOf(std::uint32_t kind) {
    switch (kind) {
        case 0:
            return capsule(0.3, 0.006);
        case 1:
            return box(0.3, 0.02);
        case 2:
            return circle(0.3);
        default:
            return box(0.21, 0.21);
    }
}

/// A sinking lift that is one chain. A plank that struck it with one end, and swings down onto it with the other one in
/// the same step, was judged by where the chain had been as the step began, and so to be behind it.
TEST(MovingWalls, LiftsOfChainsHoldThinPlanks) {
    for (const double speed : {-0.5, -1.0, -2.0, -5.0, -10.0}) {
        for (std::uint32_t seed = 0; seed < 80; ++seed) {
            std::mt19937 random(seed);
            World world = makeWorld(9.81);
            const BodyId lift = must(world.createBody(bodyAt(BodyType::kinematic, {})));
            const std::array<Vec2, 2> floor{vec(50, 0), vec(-50, 0)};
            must(world.addChain(lift, floor, false));
            must(world.setVelocity(lift, vec(0, speed), 0));
            const double along = in(random, -2, 2);
            const double down = in(random, -4, 0);
            BodyDef def = dynamicAt({0, 1}, vec(along, speed + down), in(random, -6, 6));
            def.angle = in(random, -kPi, kPi);
            const BodyId plank = addBody(world, def, box(0.4, seed % 2 == 0 ? 0.006 : 0.02));
            run(world, 120);
            EXPECT_GT(world.position(plank).y - world.position(lift).y, -0.01) << "seed " << seed << ", " << speed;
        }
    }
}

/// A room that whirls drives a body from wall to wall, until its impacts are used up: held where it was, the walls went
/// on through it.
TEST(MovingWalls, RoomsThatTurnHoldALoneBody) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const Walls walls : {Walls::chain, Walls::segments, Walls::thinBoxes}) {
            for (std::uint32_t kind = 0; kind < 4; ++kind) {
                for (const double spin : {0.5, 4.0, 12.0, 20.0}) {
                    WorldSettings settings = awakeSettings(9.81);
                    settings.profile = profile;
                    World world = makeWorld(settings);
                    const BodyId room = addRoom(world, walls);
                    must(world.setVelocity(room, {}, real(spin)));
                    const BodyId body = addBody(world, dynamicAt({0.1, 0}), shapeOf(kind));
                    for (int step = 0; step < 240; ++step) {
                        run(world, 1);
                        ASSERT_FALSE(isOut(world, room, body, kReach + kWall))
                            << "walls " << static_cast<int>(walls) << " shape " << kind << " spin " << spin << " step "
                            << step;
                    }
                }
            }
        }
    }
}

/// Who is held at his impact goes along with the wall that struck him, or the bullet that he rides on, and turned with
/// them, too: 87 of 144, by up to 4 rad. Now only who has no
/// room to turn back, squeezed in a corner: 11.
TEST(MovingWalls, TurnNobodyWhoDoesNotTurn) {
    int turned = 0;
    for (const Profile profile : kProfiles) {
        for (const Walls walls : {Walls::chain, Walls::segments, Walls::thinBoxes}) {
            for (std::uint32_t seed = 0; seed < 6; ++seed) {
                std::mt19937 random(seed);
                World world = makeWorld(profile);
                const BodyId room = addRoom(world, walls);
                std::vector<BodyId> bodies;
                for (int i = 0; i < 8; ++i) {
                    BodyDef def = dynamicAt({in(random, -3.5, 3.5), 0});
                    def.position.y = in(random, -2.5, 2.5);
                    def.fixedRotation = i % 2 == 0;
                    def.velocity = vec(in(random, -30, 30), 0);
                    if (i % 2 != 0) { def.angularVelocity = real(in(random, -9, 9)); }
                    def.bullet = seed % 2 == 1;
                    bodies.push_back(addBody(world, def, shapeOf(static_cast<std::uint32_t>(random() % 4))));
                }
                for (int step = 0; step < 120; ++step) {
                    if (step % 20 == 0) { must(world.setVelocity(room, {}, real(in(random, -12, 12)))); }
                    run(world, 1);
                    for (const BodyId body : bodies) {
                        ASSERT_FALSE(isOut(world, room, body, kReach + kWall)) << "seed " << seed << " step " << step;
                    }
                }
                for (const BodyId body : bodies) {
                    if (!world.definition(body).fixedRotation || world.angle(body) == 0) { continue; }
                    ++turned;
                    EXPECT_LT(std::fabs(world.angle(body)), 0.15) << profileName(profile) << " seed " << seed;
                }
            }
        }
    }
    EXPECT_LE(turned, 15);
}

/// Bodies that press each other against walls that are shaken.
TEST(MovingWalls, RoomsThatAreShakenHoldACrowd) {
    constexpr std::size_t kBodies = 8;
    for (const Walls walls : {Walls::chain, Walls::segments, Walls::thinBoxes}) {
        for (const double speed : {2.0, 10.0, 50.0}) {
            for (std::uint32_t seed = 0; seed < 12; ++seed) {
                std::mt19937 random(seed);
                World world = makeWorld(9.81);
                const BodyId room = addRoom(world, walls);
                std::vector<BodyId> bodies;
                for (std::size_t i = 0; i < kBodies; ++i) {
                    BodyDef def = dynamicAt({in(random, -3.5, 3.5), 0});
                    def.position.y = in(random, -2.5, 2.5);
                    def.angle = in(random, -kPi, kPi);
                    const auto kind = static_cast<std::uint32_t>(random() % 4);
                    bodies.push_back(addBody(world, def, shapeOf(seed % 3 == 0 ? 0 : kind)));
                }
                for (int step = 0; step < 200; ++step) {
                    if (step % 10 == 0) {
                        const double along = in(random, -speed, speed);
                        const double up = in(random, -speed, speed);
                        must(world.setVelocity(room, vec(along, up), 0));
                    }
                    run(world, 1);
                    for (const BodyId body : bodies) {
                        ASSERT_FALSE(isOut(world, room, body, kReach + kWall))
                            << "walls " << static_cast<int>(walls) << " speed " << speed << " seed " << seed << " step "
                            << step;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test

#include <array>

#include "joint_support.h"
#include "thrown_crowd.h"

/// What is pressed or pulled into a wall, slowly and with any force, gets no farther than into it: what does not yield
/// comes first, then what kinematic bodies and joints ask. What that costs is reported.

namespace swept::test {
namespace {

struct Rest {
    World world;
    BodyId body;
    double lost = 0;  ///< s

    void go(int steps) {
        for (int i = 0; i < steps; ++i) {
            must(world.step(kStep));
            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
        }
    }
};

std::array<Polygon, 3> someShapes() { return {circle(0.4), box(0.4, 0.4), capsule(0.3, 0.2)}; }

/// The plate goes on through the ceiling, and leaves the body behind.
TEST(Pressed, AgainstACeilingByAPlate) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double speed : {0.1, 0.5, 1.5, 5.0, 20.0}) {
            for (const Polygon& polygon : someShapes()) {
                for (const bool isThin : {false, true}) {
                    WorldSettings settings = awakeSettings();
                    settings.profile = profile;
                    Rest rest{makeWorld(settings), {}};
                    addStatic(rest.world, isThin ? segment(-5, 3, 5, 3) : box(5, 0.2), {}, {0, isThin ? 0.0 : 3.2});
                    BodyDef plate = bodyAt(BodyType::kinematic, {0, 1.5});
                    plate.velocity = vec(0, speed);
                    addBody(rest.world, plate, box(2, 0.2));
                    rest.body = addBody(rest.world, dynamicAt({0, 2.2}), polygon);
                    double highest = 0;
                    for (int i = 0; i < static_cast<int>(4 / speed * kRate); ++i) {
                        rest.go(1);
                        highest = std::max(highest, rest.world.position(rest.body).y);
                    }
                    EXPECT_LT(highest, 3) << (profile == Profile::fast ? "fast, " : "accurate, ") << speed << " m/s, "
                                          << polygon.count << " vertices" << (isThin ? ", thin" : "");
                    EXPECT_GT(rest.lost, 0);
                }
            }
        }
    }
}

/// Its rod is made fast to something that goes away on the other side of the wall.
TEST(Pressed, AgainstAWallByARod) {
    for (const double speed : {0.2, 1.0, 5.0}) {
        for (const Polygon& polygon : someShapes()) {
            Rest rest{makeWorld(), {}};
            addStatic(rest.world, segment(-5, 0, 5, 0), material(0.5));
            addStatic(rest.world, segment(1, -5, 1, 5), material(0.5));
            BodyDef puller = bodyAt(BodyType::kinematic, {2, 1});
            puller.velocity = vec(speed, 0);
            rest.body = addBody(rest.world, dynamicAt({0.5, 0.45}), polygon, material(0.5));
            DistanceJointDef rod;
            rod.base = between(rest.body, must(rest.world.createBody(puller)));
            rod.anchorA = {0.5, 0.45};
            rod.anchorB = {2, 1};
            must(rest.world.createJoint(rod));
            rest.go(static_cast<int>(3 / speed * kRate));
            EXPECT_LT(rest.world.position(rest.body).x, 1) << speed << " m/s, " << polygon.count << " vertices";
            EXPECT_GT(rest.lost, 0);
        }
    }
}

/// What turns back and forth counts as fast, and is sunk into the wall by half of its radius. The box does not let go.
TEST(Pressed, WhileItShakes) {
    for (const bool isThin : {true, false}) {
        WorldSettings settings = awakeSettings(0);
        settings.profile = Profile::fast;
        Rest rest{makeWorld(settings), {}};
        addStatic(rest.world, isThin ? segment(0, -5, 0, 5) : box(0.2, 5), {}, {isThin ? 0.0 : -0.2, 0});
        BodyDef upright = dynamicAt({0.05, 0});
        upright.angle = 1.5707963267948966;
        rest.body = addBody(rest.world, upright, capsule(0.3, 0.1), material(0));
        BodyDef pressing = dynamicAt({0.4, 0});
        pressing.fixedRotation = true;
        const BodyId press = addBody(rest.world, pressing, box(0.3, 0.3), material(0));
        const double start = rest.world.position(rest.body).x;
        for (int i = 0; i < 200; ++i) {
            must(rest.world.setVelocity(rest.body, rest.world.velocity(rest.body), i % 2 == 0 ? -5 : 5));
            must(rest.world.applyForce(press, vec(-100, 0), rest.world.position(press)));
            must(rest.world.step(0.05));
        }
        EXPECT_GT(rest.world.position(rest.body).x, start - 1e-5) << (isThin ? "thin" : "thick");
    }
}

/// Rods that are put between bodies in flight, and jam between them and the walls.
TEST(Pressed, ByRodsInAClosedChamber) {
    constexpr double kHalf = 10;
    constexpr double kSlowStep = 1.0 / 30;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        WorldSettings settings = awakeSettings(seed % 2 == 0 ? 0 : kGravity);
        settings.profile = seed % 3 == 0 ? Profile::fast : Profile::accurate;
        World world = makeWorld(settings);
        for (const double side : {-kHalf, kHalf}) {
            addStatic(world, segment(side, -kHalf, side, kHalf));
            addStatic(world, segment(-kHalf, side, kHalf, side));
        }
        Random random(seed);
        const std::vector<BodyId> bodies = throwCrowd(world, random, 24, [](int, BodyDef&, ShapeDef&) {});
        for (int step = 0; step < 150; ++step) {
            if (step % 4 == 0) {
                const std::size_t first = static_cast<std::size_t>(random.range(0, 23.9));
                DistanceJointDef rod;
                rod.base = between(bodies[first], bodies[(first + 1) % bodies.size()]);
                rod.anchorA = world.position(rod.base.bodyA);
                rod.anchorB = world.position(rod.base.bodyB);
                must(world.createJoint(rod));
            }
            run(world, 1, kSlowStep);
            ASSERT_TRUE(areInside(world, bodies, kHalf)) << "seed " << seed << ", step " << step;
        }
    }
}

}  // namespace
}  // namespace swept::test

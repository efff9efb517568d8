#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Nothing passes through thin walls, at any speed, with any spin.

namespace swept::test {
namespace {

struct Projectile {
    const char* name;
    Polygon polygon;
};

std::vector<Projectile> projectiles() {
    return {
        {"circle", circle(0.1)}, {"box", box(0.1, 0.1)}, {"bar", box(0.25, 0.005)}, {"capsule", capsule(0.5, 0.05)}};
}

enum class Wall { segment, box };

constexpr int kShots = 200;
const std::array kSpeeds{10.0, 30.0, 100.0, 1000.0, 10000.0};

/// Shots at the wall x = 0 from the left: within 30°, spinning up to 200 rad/s, from 0.6 m plus up to one step away.
/// They do not see each other.
struct Range {
    World world;
    std::vector<BodyId> shots;

    Range(const Projectile& projectile, Wall wall, double speed, ContinuousMode mode, std::uint64_t seed) {
        WorldSettings settings = awakeSettings(0);
        settings.continuous = mode;
        world = makeWorld(settings);
        const Polygon face = wall == Wall::segment ? segment(0, -2000, 0, 2000) : box(0.005, 2000);
        addStatic(world, face, material(0.3));
        Random random(seed);
        ShapeDef surface = material(0.3);
        surface.filter.group = -1;
        for (int i = 0; i < kShots; ++i) {
            const double aim = random.range(-kPi / 6, kPi / 6);
            const double way = (0.6 + random.uniform() * speed * kStep);
            BodyDef def = dynamicAt({-way * std::cos(aim), -way * std::sin(aim)},
                                    vec(speed * std::cos(aim), speed * std::sin(aim)), random.range(-200, 200));
            def.angle = random.range(0, 2 * kPi);
            shots.push_back(addBody(world, def, projectile.polygon, surface));
        }
    }
    int escaped() const {
        int count = 0;
        for (const BodyId shot : shots) { count += world.centerOfMass(shot).x >= 0 ? 1 : 0; }
        return count;
    }
};

struct Volley {
    int shots = 0;
    int escaped = 0;
    std::string where;
    double lost = 0;   ///< time in the ledger, s
    double flown = 0;  ///< all time, s
};

Volley fireAll(ContinuousMode mode) {
    Volley volley;
    std::uint64_t seed = 0;
    for (const Projectile& projectile : projectiles()) {
        for (const Wall wall : {Wall::segment, Wall::box}) {
            for (const double speed : kSpeeds) {
                Range range(projectile, wall, speed, mode, ++seed);
                run(range.world, 20);
                const int escaped = range.escaped();
                volley.shots += kShots;
                volley.escaped += escaped;
                if (escaped == 0) { continue; }
                volley.where += std::string(projectile.name) + (wall == Wall::segment ? " segment " : " box ") +
                                std::to_string(speed) + " m/s: " + std::to_string(escaped) + "; ";
            }
        }
    }
    return volley;
}

TEST(Tunnelling, NoShotPassesInSubStep) {
    const Volley volley = fireAll(ContinuousMode::subStep);
    EXPECT_EQ(volley.escaped, 0) << volley.where;
    EXPECT_EQ(volley.shots, 8000);
}

TEST(Tunnelling, NoShotPassesInStop) {
    const Volley volley = fireAll(ContinuousMode::stop);
    EXPECT_EQ(volley.escaped, 0) << volley.where;
}

TEST(Tunnelling, MostShotsPassInOff) {
    const Volley volley = fireAll(ContinuousMode::off);
    EXPECT_GT(volley.escaped, volley.shots / 2) << "shots too easy to prove anything";
}

/// All shapes and speeds inside a closed box with thin walls, for a while.
Volley shakeInBox(Wall wall, ContinuousMode mode, double restitution, double gravity) {
    Volley volley;
    std::uint64_t seed = 100;
    for (const Projectile& projectile : projectiles()) {
        for (const double speed : kSpeeds) {
            WorldSettings settings = awakeSettings(gravity);
            settings.continuous = mode;
            World world = makeWorld(settings);
            const ShapeDef surface = material(0.3, restitution);
            for (int side = 0; side < 4; ++side) {
                const double turn = side * kPi / 2;
                addStatic(world, wall == Wall::segment ? segment(0, -5, 0, 5) : box(0.005, 5.01), surface,
                          turned({5, 0}, turn), turn);
            }
            Random random(++seed);
            ShapeDef own = surface;
            own.filter.group = -1;
            std::vector<BodyId> bodies;
            for (int i = 0; i < 10; ++i) {
                const double aim = random.range(0, 2 * kPi);
                BodyDef def = dynamicAt({random.range(-4, 4), random.range(-4, 4)},
                                        vec(speed * std::cos(aim), speed * std::sin(aim)), random.range(-200, 200));
                bodies.push_back(addBody(world, def, projectile.polygon, own));
            }
            for (int i = 0; i < 120; ++i) {
                must(world.step(kStep));
                for (const LostTimeEntry& entry : world.lostTime()) { volley.lost += entry.seconds; }
            }
            volley.flown += 10 * 120 * kStep;
            int escaped = 0;
            for (const BodyId body : bodies) {
                const DVec2 p = world.centerOfMass(body);
                escaped += std::max(std::abs(p.x), std::abs(p.y)) < 5 ? 0 : 1;
            }
            volley.shots += 10;
            volley.escaped += escaped;
            if (escaped > 0) {
                volley.where += std::string(projectile.name) + ' ' + std::to_string(speed) +
                                " m/s: " + std::to_string(escaped) + "; ";
            }
        }
    }
    return volley;
}

TEST(Tunnelling, NothingLeavesAClosedBox) {
    for (const Wall wall : {Wall::segment, Wall::box}) {
        for (const ContinuousMode mode : {ContinuousMode::subStep, ContinuousMode::stop}) {
            for (const double restitution : {0.0, 1.0}) {
                const Volley volley = shakeInBox(wall, mode, restitution, kGravity);
                EXPECT_EQ(volley.escaped, 0) << (wall == Wall::segment ? "segments, " : "boxes, ")
                                             << (mode == ContinuousMode::stop ? "stop" : "subStep") << ", e "
                                             << restitution << ": " << volley.where;
                if (mode == ContinuousMode::subStep) {
                    expectAtMost(std::string(wall == Wall::segment ? "segments" : "boxes") + ", e " +
                                     std::to_string(restitution) + ": lost time",
                                 volley.lost / volley.flown, 0.01);
                }
            }
        }
    }
}

TEST(Tunnelling, ManyLeaveAClosedBoxInOff) {
    const Volley volley = shakeInBox(Wall::segment, ContinuousMode::off, 0, kGravity);
    EXPECT_GT(volley.escaped, volley.shots / 2);
}

/// Shots into the corner of two walls with an angle between them; how many are outside after a second.
int outsideWedge(const Projectile& projectile, double angle, double speed, ContinuousMode mode) {
    WorldSettings settings = awakeSettings(0);
    settings.continuous = mode;
    World world = makeWorld(settings);
    const double half = angle / 2;
    const double far = 3 * speed + 100;
    for (const double side : {1.0, -1.0}) {
        addStatic(world, segment(0, 0, -far * std::cos(half), side * far * std::sin(half)), material(0.3));
    }
    Random random(17);
    ShapeDef surface = material(0.3);
    surface.filter.group = -1;
    std::vector<BodyId> shots;
    for (int i = 0; i < 20; ++i) {
        const double aim = random.range(-half / 2, half / 2);
        const double way = 0.6 / std::sin(half) + random.uniform() * speed * kStep;
        BodyDef def = dynamicAt({-way * std::cos(aim), -0.2 * way * std::sin(aim)},
                                vec(speed * std::cos(aim), speed * std::sin(aim)), random.range(-200, 200));
        def.angle = random.range(0, 2 * kPi);
        shots.push_back(addBody(world, def, projectile.polygon, surface));
    }
    run(world, 60);
    return static_cast<int>(std::count_if(shots.begin(), shots.end(), [&](BodyId shot) {
        const DVec2 p = world.centerOfMass(shot);
        return p.x >= 0 || std::abs(p.y) >= -p.x * std::tan(half);
    }));
}

TEST(Tunnelling, NothingIsSqueezedOutOfAWedge) {
    for (const Projectile& projectile : projectiles()) {
        for (const double degrees : {90.0, 30.0, 10.0, 3.0}) {
            for (const double speed : {10.0, 1000.0, 10000.0}) {
                for (const ContinuousMode mode : {ContinuousMode::subStep, ContinuousMode::stop}) {
                    EXPECT_EQ(outsideWedge(projectile, degrees * kPi / 180, speed, mode), 0)
                        << projectile.name << ' ' << degrees << " degrees, " << speed << " m/s, "
                        << (mode == ContinuousMode::stop ? "stop" : "subStep");
                }
            }
        }
    }
}

/// Shots from above at a chain with random heights; how many end below it.
int belowTerrain(const Projectile& projectile, double speed) {
    World world = makeWorld();
    Random random(7);
    std::vector<double> heights;
    for (int i = 0; i <= 200; ++i) { heights.push_back(0.5 * std::sin(0.7 * i) + random.range(0, 0.5)); }
    std::vector<Vec2> points;
    for (int i = 200; i >= 0; --i) { points.push_back(vec(i, heights[static_cast<std::size_t>(i)])); }
    const BodyId ground = must(world.createBody(bodyAt(BodyType::fixed, {})));
    must(world.addChain(ground, points, false, material(0.3)));
    ShapeDef surface = material(0.3);
    surface.filter.group = -1;
    std::vector<BodyId> shots;
    for (int i = 0; i < 50; ++i) {
        const double aim = random.range(-kPi / 6, kPi / 6);
        const double way = 2.5 + random.uniform() * speed * kStep;
        BodyDef def = dynamicAt({random.range(80, 120) - way * std::sin(aim), way * std::cos(aim)},
                                vec(speed * std::sin(aim), -speed * std::cos(aim)), random.range(-200, 200));
        def.angle = random.range(0, 2 * kPi);
        shots.push_back(addBody(world, def, projectile.polygon, surface));
    }
    run(world, 60);
    int below = 0;
    for (const BodyId shot : shots) {
        const DVec2 p = world.centerOfMass(shot);
        if (p.x < 0 || p.x >= 200) { continue; }  // it left at the side
        const double cell = std::floor(p.x);
        const auto i = static_cast<std::size_t>(cell);
        below += p.y < heights[i] + (p.x - cell) * (heights[i + 1] - heights[i]) ? 1 : 0;
    }
    return below;
}

TEST(Tunnelling, NothingFallsThroughTerrain) {
    for (const Projectile& projectile : projectiles()) {
        for (const double speed : kSpeeds) {
            EXPECT_EQ(belowTerrain(projectile, speed), 0) << projectile.name << ' ' << speed << " m/s";
        }
    }
}

/// A ball at rest in front of a thin wall is hit by a heavy one: fast within a step in which it was slow at the start.
bool isKnockedThrough(double speed, double restitution, std::uint64_t seed) {
    World world = makeWorld(0);
    Random random(seed);
    addStatic(world, segment(0, -5, 0, 5), material(0.3, restitution));
    const BodyId ball =
        addBody(world, dynamicAt({-0.1 - random.range(0.001, 0.3), 0}), circle(0.1), material(0.3, restitution));
    addBody(world, dynamicAt({-1 - random.uniform() * speed * kStep, random.range(-0.3, 0.3)}, vec(speed, 0)),
            circle(0.5), material(0.3, restitution, 10));
    run(world, 30);
    return world.position(ball).x > 0 && std::abs(world.position(ball).y) < 5;
}

TEST(Tunnelling, NothingIsKnockedThroughAWall) {
    for (const double speed : {5.0, 20.0, 50.0}) {
        for (const double restitution : {0.0, 1.0}) {
            for (std::uint64_t seed = 1; seed <= 50; ++seed) {
                EXPECT_FALSE(isKnockedThrough(speed, restitution, seed))
                    << speed << " m/s, e " << restitution << ", seed " << seed;
            }
        }
    }
}

TEST(Tunnelling, NothingLeavesAStorm) {
    World world = makeWorld();
    for (int side = 0; side < 4; ++side) {
        const double turn = side * kPi / 2;
        addStatic(world, segment(0, -10, 0, 10), material(0.3, 0.8), turned({10, 0}, turn), turn);
    }
    Random random(5);
    const std::vector<Projectile> kinds = projectiles();
    std::vector<BodyId> bodies;
    for (int i = 0; i < 150; ++i) {
        const double aim = random.range(0, 2 * kPi);
        const BodyDef def = dynamicAt({1.2 * (i % 15) - 8.4, 1.2 * (i / 15) - 8.4},
                                      vec(50 * std::cos(aim), 50 * std::sin(aim)), random.range(-20, 20));
        bodies.push_back(
            addBody(world, def, kinds[static_cast<std::size_t>(i) % kinds.size()].polygon, material(0.3, 0.8)));
    }
    double lost = 0;
    for (int i = 0; i < 120; ++i) {
        must(world.step(kStep));
        for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
    }
    for (const BodyId body : bodies) {
        const DVec2 p = world.centerOfMass(body);
        EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 10);
    }
    expectAtMost("lost time", lost / (150 * 120 * kStep), 0.01);
}

/// A bar that turns about its centre, from above a pin in its way: whether it is behind the pin in the end.
bool turnsThroughPin(double spin, double start) {
    World world = makeWorld(0);
    const BodyId pin = addStatic(world, circle(0.02), material(0.3), {0.9, 0});
    BodyDef def = dynamicAt({}, {}, spin);
    def.angle = -start;
    const BodyId bar = addBody(world, def, box(1, 0.005), material(0.3));
    RevoluteJointDef hinge;
    hinge.base.bodyA = pin;
    hinge.base.bodyB = bar;
    hinge.base.collideConnected = true;
    must(world.createJoint(hinge));
    run(world, 60);
    return world.angle(bar) > 0;
}

TEST(Tunnelling, HingedBarDoesNotTurnThroughAPin) {
    Random random(3);
    for (const double spin : {10.0, 30.0, 90.0, 200.0}) {
        for (int i = 0; i < 25; ++i) {
            const double start = random.range(0.5, 2.5);
            EXPECT_FALSE(turnsThroughPin(spin, start)) << spin << " rad/s from " << start;
        }
    }
}

}  // namespace
}  // namespace swept::test

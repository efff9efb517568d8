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
    return {{"circle", circle(0.1)},
            {"box", box(0.1, 0.1)},
            {"bar", box(0.25, 0.005)},
            {"capsule", capsule(0.5, 0.05)}};
}

enum class Wall { segment, box };

constexpr int kShots = 200;
const std::array kSpeeds{10.0, 30.0, 100.0, 1000.0, 10000.0};

/// Shots at the wall x = 0 from the left: within 30°, spinning up to 200 rad/s, from 0.6 m plus up to one step away. They
/// do not see each other.
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
    double lost = 0;    ///< time in the ledger, s
    double flown = 0;   ///< all time, s
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
                volley.where +=
                    std::string(projectile.name) + ' ' + std::to_string(speed) + " m/s: " + std::to_string(escaped) + "; ";
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

}  // namespace
}  // namespace swept::test

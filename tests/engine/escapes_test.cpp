#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Everything that is shot at walls, terrain, wedges and grooves, a thousand times each, at 10 … 10 000 m/s and up to
/// 500 rad/s.

namespace swept::test {
namespace {

constexpr int kShots = 1000;
constexpr std::array kSpeeds{10.0, 30.0, 100.0, 300.0, 1000.0, 10000.0};
constexpr double kMostSpin = 500;

struct Projectile {
    const char* name;
    Polygon polygon;
};

std::vector<Projectile> projectiles() {
    return {
        {"circle", circle(0.1)}, {"square", box(0.1, 0.1)}, {"bar", box(0.25, 0.005)}, {"capsule", capsule(0.5, 0.05)}};
}

struct Volley {
    World world;
    std::vector<BodyId> shots;
    double lost = 0;

    /// From `way` before the aim, or up to one step of flight farther.
    void shoot(const Projectile& projectile, DVec2 place, DVec2 velocity, Random& random) {
        ShapeDef surface = material(0.3);
        surface.filter.group = -1;  // they do not see each other
        BodyDef def = dynamicAt(place, toReal(velocity), random.range(-kMostSpin, kMostSpin));
        def.angle = random.range(0, 2 * kPi);
        shots.push_back(addBody(world, def, projectile.polygon, surface));
    }
    template <class Outside>
    int escapedAfter(int steps, const Outside& isOutside) {
        for (int i = 0; i < steps; ++i) {
            must(world.step(kStep));
            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
        }
        return static_cast<int>(std::count_if(shots.begin(), shots.end(),
                                              [&](BodyId shot) { return isOutside(world.centerOfMass(shot)); }));
    }
    void expectKept(const std::string& name, int escaped, int steps) const {
        EXPECT_EQ(escaped, 0) << name;
        expectAtMost(name + ": lost time", lost / (steps * kStep * static_cast<double>(shots.size())), 0.01);
    }
};

std::string nameOf(const char* place, const Projectile& projectile, double speed) {
    return std::string(place) + ", " + projectile.name + ", " + std::to_string(speed) + " m/s";
}

TEST(Escapes, Wall) {
    for (const Projectile& projectile : projectiles()) {
        for (const double speed : kSpeeds) {
            Volley volley{makeWorld(0), {}};
            const double half = 200 * std::max(1.0, speed / 100);
            addStatic(volley.world, segment(0, -half, 0, half), material(0.3));
            Random random(1);
            for (int i = 0; i < kShots; ++i) {
                const double aim = random.range(-kPi / 6, kPi / 6);
                const double way = 0.6 + random.uniform() * speed * kStep;
                const DVec2 direction{std::cos(aim), std::sin(aim)};
                volley.shoot(projectile, -way * direction, speed * direction, random);
            }
            const int escaped = volley.escapedAfter(60, [](DVec2 p) { return p.x >= 0; });
            volley.expectKept(nameOf("wall", projectile, speed), escaped, 60);
        }
    }
}

TEST(Escapes, Terrain) {
    for (const Projectile& projectile : projectiles()) {
        for (const double speed : kSpeeds) {
            Volley volley{makeWorld(), {}};
            Random random(7);
            std::vector<double> heights;
            for (int i = 0; i <= 200; ++i) { heights.push_back(0.5 * std::sin(0.7 * i) + random.range(0, 0.5)); }
            std::vector<Vec2> points;
            for (int i = 200; i >= 0; --i) { points.push_back(vec(i, heights[static_cast<std::size_t>(i)])); }
            const BodyId ground = must(volley.world.createBody(bodyAt(BodyType::fixed, {})));
            must(volley.world.addChain(ground, points, false, material(0.3)));
            for (int i = 0; i < kShots; ++i) {
                const double aim = random.range(-kPi / 6, kPi / 6);
                const double way = 2.5 + random.uniform() * speed * kStep;
                const DVec2 direction{std::sin(aim), -std::cos(aim)};
                volley.shoot(projectile, DVec2{random.range(80, 120), 0} - way * direction, speed * direction, random);
            }
            const auto isBelow = [&heights](DVec2 p) {
                if (p.x < 0 || p.x >= 200) { return false; }  // it left at the side
                const auto i = static_cast<std::size_t>(p.x);
                return p.y < heights[i] + (p.x - std::floor(p.x)) * (heights[i + 1] - heights[i]);
            };
            const int escaped = volley.escapedAfter(120, isBelow);
            volley.expectKept(nameOf("terrain", projectile, speed), escaped, 120);
        }
    }
}

TEST(Escapes, WedgesAndGrooves) {
    for (const double degrees : {90.0, 30.0, 10.0, 3.0}) {
        const double half = degrees * kPi / 360;
        for (const Projectile& projectile : projectiles()) {
            for (const double speed : kSpeeds) {
                Volley volley{makeWorld(0), {}};
                const double far = 3 * speed + 100;
                for (const double side : {1.0, -1.0}) {
                    addStatic(volley.world, segment(0, 0, -far * std::cos(half), side * far * std::sin(half)),
                              material(0.3));
                }
                Random random(17);
                for (int i = 0; i < kShots; ++i) {
                    const double aim = random.range(-half / 2, half / 2);
                    const double way = 0.6 / std::sin(half) + random.uniform() * speed * kStep;
                    const DVec2 direction{std::cos(aim), std::sin(aim)};
                    volley.shoot(projectile, {-way * direction.x, -0.2 * way * direction.y}, speed * direction, random);
                }
                const int escaped = volley.escapedAfter(
                    120, [half](DVec2 p) { return p.x >= 0 || std::abs(p.y) >= -p.x * std::tan(half); });
                volley.expectKept(nameOf((std::to_string(degrees) + " degrees").c_str(), projectile, speed), escaped,
                                  120);
            }
        }
    }
}

TEST(Escapes, StormOfAThousand) {
    World world = makeWorld(0);
    for (int side = 0; side < 4; ++side) {
        const double turn = side * kPi / 2;
        addStatic(world, segment(0, -20, 0, 20), material(0, 1), turned({20, 0}, turn), turn);
    }
    Random random(1);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 1000; ++i) {
        const double aim = random.range(0, 2 * kPi);
        const DVec2 place{-19 + 38.0 * (i % 32) / 31, -19 + 38.0 * (i / 32) / 31};
        bodies.push_back(addBody(world,
                                 dynamicAt(place, vec(50 * std::cos(aim), 50 * std::sin(aim)), random.range(-20, 20)),
                                 i % 2 == 0 ? box(0.1, 0.1) : circle(0.1), material(0, 1)));
    }
    const double before = energyOf(world, bodies, 0);
    double lost = 0;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
    }
    for (const BodyId body : bodies) {
        const DVec2 p = world.centerOfMass(body);
        EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 20);
    }
    expectAtMost("lost time", lost / (1000 * 600 * kStep), 1e-3);
    expectAtMost("energy", std::abs(energyOf(world, bodies, 0) / before - 1), 0.01);
}

}  // namespace
}  // namespace swept::test

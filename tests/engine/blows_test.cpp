#include <algorithm>
#include <string>

#include "world_support.h"

/// What is heavy falls on what is light, on the ground, without restitution: it stays there.

namespace swept::test {
namespace {

constexpr double kCrateHalf = 0.5;

struct Blow {
    double speed = 0;  ///< m/s
    double mass = 0;   ///< kg, of the one that falls; each that lies there has 1
    int layers = 1;
    double dt = kStep;
};

/// How fast it flies up again, of the speed of the blow.
double reboundOf(const Blow& blow, const WorldSettings& settings) {
    World world = makeWorld(settings);
    addStatic(world, box(20, 0.5), material(0.6), {0, -0.5});
    for (int i = 0; i < blow.layers; ++i) {
        addBody(world, dynamicAt({0, kCrateHalf + i}), box(kCrateHalf, kCrateHalf), material(0.6, 0, 1));
    }
    run(world, 60, blow.dt);
    BodyDef falling = dynamicAt({0, kCrateHalf + blow.layers + 0.1}, vec(0, -blow.speed));
    falling.mass = static_cast<Real>(blow.mass);
    const BodyId heavy = addBody(world, falling, box(kCrateHalf, kCrateHalf), material(0.6, 0, 1));
    double fastest = 0;
    for (double time = 0; time < 0.5; time += blow.dt) {
        run(world, 1, blow.dt);
        fastest = std::max(fastest, static_cast<double>(world.velocity(heavy).y));
    }
    return fastest / blow.speed;
}

std::string nameOf(const Blow& blow) {
    return std::to_string(blow.speed) + " m/s, " + std::to_string(blow.mass) + " kg on " + std::to_string(blow.layers) +
           ", steps of " + std::to_string(blow.dt) + " s";
}

/// It was thrown back with 0.2 to 0.3 of its speed at 3 : 1 to 7.9 : 1, from where on contacts are solved all at once.
TEST(Blows, OfTheHeavyOnTheLightDoNotThrowItBack) {
    for (const double speed : {2.0, 10.0, 40.0}) {
        for (const double mass : {2.0, 3.0, 5.0, 7.0, 7.9, 8.1, 12.0}) {
            for (const double dt : {1.0 / 60, 1.0 / 240, 1.0 / 1000}) {
                const Blow blow{.speed = speed, .mass = mass, .dt = dt};
                EXPECT_LT(reboundOf(blow, awakeSettings(Profile::accurate)), 0.05) << nameOf(blow);
            }
        }
    }
}

TEST(Blows, OnTowersDoNotThrowItBack) {
    for (const int layers : {3, 5, 10}) {
        for (const double mass : {3.0, 5.0, 7.0}) {
            const Blow blow{.speed = 5, .mass = mass, .layers = layers};
            EXPECT_LT(reboundOf(blow, awakeSettings(Profile::accurate)), 0.05) << nameOf(blow);
        }
    }
}

}  // namespace
}  // namespace swept::test

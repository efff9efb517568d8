#include "world_support.h"

/// Nothing catches on the inner vertices of a chain.

namespace swept::test {
namespace {

constexpr int kSeams = 200;
constexpr double kSpan = 0.5;

struct Ride {
    double lost = 0;  ///< part of the speed
    double hop = 0;   ///< largest distance from the level it rides at, m
    double turn = 0;  ///< largest angle, rad
};

Ride ride(const Polygon& polygon, double height, double speed) {
    World world = makeWorld();
    std::vector<Vec2> points;  // ground is listed from right to left
    for (int i = kSeams + 10; i >= -10; --i) {
        points.push_back(vec(i * kSpan, 0));
    }
    const BodyId ground = must(world.createBody(bodyAt(BodyType::fixed, {})));
    must(world.addChain(ground, points, false, material(0)));
    const BodyId body = addBody(world, dynamicAt({0, height}, vec(speed, 0)), polygon, material(0));
    Ride result;
    while (world.position(body).x < kSeams * kSpan) {
        must(world.step(kStep));
        result.hop = std::max(result.hop, std::abs(world.position(body).y - height));
        result.turn = std::max(result.turn, std::abs(world.angle(body)));
        result.lost = std::max(result.lost, 1 - velocityOf(world, body).x / speed);
        if (result.lost > 0.5) {
            break;
        }
    }
    return result;
}

void expectSmooth(const std::string& name, const Polygon& polygon, double height) {
    for (const double speed : {1.0, 5.0, 20.0, 100.0}) {
        const Ride result = ride(polygon, height, speed);
        const std::string at = name + " at " + std::to_string(speed) + " m/s: ";
        expectAtMost(at + "speed lost", result.lost, 1e-3);
        expectAtMost(at + "hop", result.hop, 0.002);
        expectAtMost(at + "turn", result.turn, 0.002);
    }
}

TEST(Seams, BoxSlidesOverThem) { expectSmooth("box", box(0.5, 0.5), 0.5); }
TEST(Seams, CircleSlidesOverThem) { expectSmooth("circle", circle(0.5), 0.5); }
TEST(Seams, CapsuleSlidesOverThem) { expectSmooth("capsule", capsule(0.5, 0.25), 0.25); }

}  // namespace
}  // namespace swept::test

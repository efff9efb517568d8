#include "world_support.h"

/// Nothing catches on seams: 1000 of them, of a chain, of separate segments, of flush tiles.

namespace swept::test {
namespace {

constexpr int kSeams = 1000;
constexpr double kSpan = 0.5;

enum class Ground { chain, segments, tiles };

void addGround(World& world, Ground ground, int seams) {
    if (ground == Ground::chain) {
        std::vector<Vec2> points;  // ground is listed from right to left
        for (int i = seams + 10; i >= -10; --i) { points.push_back(vec(i * kSpan, 0)); }
        const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, {})));
        must(world.addChain(body, points, false, material(0)));
        return;
    }
    for (int i = -10; i < seams + 10; ++i) {
        if (ground == Ground::segments) {
            addStatic(world, segment(i * kSpan, 0, (i + 1) * kSpan, 0), material(0));
        } else {
            addStatic(world, box(kSpan / 2, kSpan / 2), material(0), {(i + 0.5) * kSpan, -kSpan / 2});
        }
    }
}

struct Ride {
    double lost = 0;    ///< part of the speed
    double hop = 0;     ///< largest height above the start, m
    double sink = 0;    ///< largest depth below it, m
    double turn = 0;    ///< largest angle, rad
    double waited = 0;  ///< s in the ledger
};

Ride ride(Ground ground, const Polygon& polygon, double height, double speed) {
    // As many as it passes in 20 s.
    const int seams = static_cast<int>(std::min<double>(kSeams, 20 * speed / kSpan));
    World world = makeWorld();
    addGround(world, ground, seams);
    const BodyId body = addBody(world, dynamicAt({0, height}, vec(speed, 0)), polygon, material(0));
    Ride result;
    while (world.position(body).x < seams * kSpan && result.lost < 0.5) {
        must(world.step(kStep));
        result.hop = std::max(result.hop, world.position(body).y - height);
        result.sink = std::max(result.sink, height - world.position(body).y);
        result.turn = std::max(result.turn, std::abs(world.angle(body)));
        result.lost = std::max(result.lost, 1 - velocityOf(world, body).x / speed);
        for (const LostTimeEntry& entry : world.lostTime()) { result.waited += entry.seconds; }
    }
    return result;
}

/// In double precision what is round rides less smoothly over loose pieces, and a box waits on a chain for a moment.
bool isRough(Ground ground, const std::string& name) {
    return kIsDouble && ground != Ground::chain && name == "capsule";
}

void expectSmooth(const std::string& name, const Polygon& polygon, double height) {
    for (const Ground ground : {Ground::chain, Ground::segments, Ground::tiles}) {
        for (const double speed : {1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 50.0, 100.0}) {
            const Ride result = ride(ground, polygon, height, speed);
            const std::string at = name + " on ground " + std::to_string(static_cast<int>(ground)) + " at " +
                                   std::to_string(speed) + " m/s: ";
            const bool rough = isRough(ground, name);
            expectAtMost(at + "speed lost", result.lost, rough ? 1e-3 : 1e-4);
            expectAtMost(at + "hop", result.hop, rough ? 0.004 : 1e-4);
            expectAtMost(at + "sink", result.sink, rough ? 2e-4 : 1e-4);
            expectAtMost(at + "turn", result.turn, rough ? 2e-3 : 1e-3);
            expectAtMost(at + "waited", result.waited, kIsDouble ? kStep : 0);
        }
    }
}

TEST(Seams, BoxSlidesOverThem) { expectSmooth("box", box(0.5, 0.5), 0.5); }
TEST(Seams, CircleSlidesOverThem) { expectSmooth("circle", circle(0.5), 0.5); }
TEST(Seams, CapsuleSlidesOverThem) { expectSmooth("capsule", capsule(0.5, 0.25), 0.25); }

}  // namespace
}  // namespace swept::test

#include <array>

#include <swept/engine/contacts/ghosts.h>

#include "../support/random.h"
#include "world_support.h"

/// Ground of many flush pieces is one floor: what slides over it feels no seams. What is not flush is still in the way.

namespace swept::test {
namespace {

constexpr int kPieces = 200;
constexpr double kSpan = 0.5;  ///< of a piece, m

enum class Ground { boxes, segments, chain };
constexpr std::array<Ground, 3> kGrounds{Ground::boxes, Ground::segments, Ground::chain};
constexpr std::array<Ground, 2> kLoose{Ground::boxes, Ground::segments};  ///< pieces that know nothing of each other
constexpr std::array<const char*, 3> kGroundNames{"boxes", "segments", "chain"};
constexpr std::array<ContinuousMode, 2> kModes{ContinuousMode::subStep, ContinuousMode::stop};

std::string nameOf(Ground ground) { return kGroundNames[static_cast<std::size_t>(ground)]; }
std::string nameOf(ContinuousMode mode) { return mode == ContinuousMode::stop ? "stop" : "subStep"; }

/// One piece of ground: its upper side from p to q, q right of p; a box is 0.2 m thick.
void addPiece(World& world, Ground ground, DVec2 p, DVec2 q) {
    if (ground == Ground::segments) {
        addStatic(world, segment(p.x, p.y, q.x, q.y), material(0));
        return;
    }
    const DVec2 along = q - p;
    const DVec2 down = (0.1 / length(along)) * DVec2{along.y, -along.x};
    addStatic(world, box(0.5 * length(along), 0.1), material(0), 0.5 * (p + q) + down, std::atan2(along.y, along.x));
}

/// A level floor of pieces number `first` to `last` − 1; the piece of number 0 begins at x = 0.
void addFloor(World& world, Ground ground, int first, int last, double level = 0) {
    if (ground == Ground::chain) {
        std::vector<Vec2> points;  // ground is listed from right to left
        for (int i = last; i >= first; --i) { points.push_back(vec(i * kSpan, level)); }
        const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, {})));
        must(world.addChain(body, points, false, material(0)));
        return;
    }
    for (int i = first; i < last; ++i) { addPiece(world, ground, {i * kSpan, level}, {(i + 1) * kSpan, level}); }
}

World worldIn(ContinuousMode mode) {
    WorldSettings settings = awakeSettings();
    settings.continuous = mode;
    return makeWorld(settings);
}

struct Slider {
    const char* name;
    Polygon polygon;
    double height;  ///< of its centre above the ground
    double halfWidth;
};
std::vector<Slider> sliders() {
    return {{"box", box(0.5, 0.5), 0.5, 0.5},
            {"circle", circle(0.5), 0.5, 0.5},
            {"capsule", capsule(0.5, 0.25), 0.25, 0.75},
            {"rounded box", must(makeBox(vec(0.4, 0.4), {}, 0, real(0.1))), 0.5, 0.5}};
}

struct Ride {
    double change = 0;  ///< of the speed, largest, as a part of it
    double off = 0;     ///< largest distance from the level, m
    double turn = 0;    ///< largest angle, rad
    double waited = 0;  ///< part of the time that continuous collision took from it
    bool arrived = false;
};

Ride ride(const Slider& slider, Ground ground, ContinuousMode mode, double speed, double start = 0) {
    World world = worldIn(mode);
    addFloor(world, ground, -20, kPieces + 20);
    const BodyId body = addBody(world, dynamicAt({start, slider.height}, vec(speed, 0)), slider.polygon, material(0));
    const double end = kPieces * kSpan;
    const int most = static_cast<int>(1.1 * end / speed * kRate) + 2;
    Ride result;
    int steps = 0;
    for (; steps < most && world.position(body).x < end; ++steps) {
        must(world.step(kStep));
        result.change = std::max(result.change, std::abs(velocityOf(world, body).x / speed - 1));
        result.off = std::max(result.off, std::abs(world.position(body).y - slider.height));
        result.turn = std::max(result.turn, std::abs(world.angle(body)));
        for (const LostTimeEntry& lost : world.lostTime()) { result.waited += lost.seconds; }
    }
    result.waited /= steps * kStep;
    result.arrived = world.position(body).x >= end;
    return result;
}

void expectSmooth(ContinuousMode mode) {
    for (const Ground ground : kGrounds) {
        for (const Slider& slider : sliders()) {
            for (const double speed : {1.0, 5.0, 20.0, 100.0}) {
                const Ride result = ride(slider, ground, mode, speed);
                const std::string name = nameOf(ground) + ", " + nameOf(mode) + ", " + slider.name + " at " +
                                         std::to_string(speed) + " m/s: ";
                EXPECT_TRUE(result.arrived) << name;
                expectAtMost(name + "change of speed", result.change, 1e-4);
                expectAtMost(name + "off level", result.off, 1e-4);
                expectAtMost(name + "turn", result.turn, 1e-4);
                expectAtMost(name + "waited", result.waited, mode == ContinuousMode::stop ? 0.02 : 0);
            }
        }
    }
}

TEST(Ghosts, NothingCatchesOnSeamsWithSubSteps) { expectSmooth(ContinuousMode::subStep); }
TEST(Ghosts, NothingCatchesOnSeamsWithStops) { expectSmooth(ContinuousMode::stop); }

/// At any speed, and from any place of the first piece.
TEST(Ghosts, NothingCatchesOnSeamsAtRandomSpeeds) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        const double speed = std::pow(10.0, random.range(0.5, 2));
        const double start = random.range(0, kSpan);
        const Slider slider = sliders()[static_cast<std::size_t>(random.integer(0, 3))];
        for (const Ground ground : kGrounds) {
            for (const ContinuousMode mode : kModes) {
                const Ride result = ride(slider, ground, mode, speed, start);
                const std::string name = "seed " + std::to_string(seed) + ", " + nameOf(ground) + ", " + nameOf(mode) +
                                         ", " + slider.name + " at " + std::to_string(speed) + " m/s: ";
                EXPECT_TRUE(result.arrived) << name;
                expectAtMost(name + "change of speed", result.change, 1e-4);
                expectAtMost(name + "off level", result.off, 1e-4);
                expectAtMost(name + "turn", result.turn, 1e-4);
                expectAtMost(name + "waited", result.waited, mode == ContinuousMode::stop ? 0.02 : 0);
            }
        }
    }
}

/// In float each of sixteen sub-steps adds 3e-3 m/s to up to 14 m/s, rounded by up to 4.8e-7 m/s, always to the same
/// side for long: 1.6e-4 at most. (1e-4 was asked of both precisions; double has 2e-13.)
TEST(Ghosts, NothingCatchesOnASlopeOfPieces) {
    for (const Ground ground : kLoose) {
        for (const Slider& slider : sliders()) {
            World world = makeWorld();
            constexpr double kAngle = -0.3;
            for (int i = -4; i < kPieces; ++i) {
                addPiece(world, ground, turned({i * kSpan, 0}, kAngle), turned({(i + 1) * kSpan, 0}, kAngle));
            }
            BodyDef def = dynamicAt(turned({0, slider.height}, kAngle));
            def.angle = kAngle;
            const BodyId body = addBody(world, def, slider.polygon, material(0));
            constexpr double kSeconds = 5;
            runFor(world, kSeconds);
            const double expected = kGravity * std::sin(-kAngle) * kSeconds;
            const double speed = turned(velocityOf(world, body), -kAngle).x;
            const std::string name = nameOf(ground) + ", " + slider.name + ": ";
            expectAtMost(name + "error of speed", std::abs(speed / expected - 1), kIsDouble ? 1e-10 : 1.6e-4);
            const double above = turned(world.position(body), -kAngle).y - slider.height;
            expectAtMost(name + "off level", std::abs(above), 1e-4);
        }
    }
}

enum class GhostWall { standing, ofPieces, throughTheFloor };
constexpr std::array<GhostWall, 3> kWalls{GhostWall::standing, GhostWall::ofPieces, GhostWall::throughTheFloor};
constexpr int kWallPiece = 20;
constexpr double kWallX = kWallPiece * kSpan;

void addWall(World& world, Ground ground, GhostWall wall) {
    const bool through = wall == GhostWall::throughTheFloor;
    addFloor(world, ground, -400, through ? kWallPiece : kWallPiece + 20);
    const double piece = wall == GhostWall::standing ? 4 : kSpan;
    for (double y = through ? -2 : 0; y < 4; y += piece) {
        if (ground == Ground::segments) {
            addStatic(world, segment(kWallX, y, kWallX, y + piece), material(0));
        } else {
            addStatic(world, box(0.1, 0.5 * piece), material(0), {kWallX + 0.1, y + 0.5 * piece});
        }
    }
}

void expectStopped(Ground ground, GhostWall wall, ContinuousMode mode, const Slider& slider, double speed) {
    World world = worldIn(mode);
    addWall(world, ground, wall);
    const BodyId body = addBody(world, dynamicAt({0, slider.height}, vec(speed, 0)), slider.polygon, material(0));
    double front = 0;
    double slowest = speed;
    double rise = 0;
    for (int i = 0; i < static_cast<int>(1.5 * kWallX / speed * kRate) + 120; ++i) {
        must(world.step(kStep));
        rise = std::max(rise, world.position(body).y - slider.height);
        front = std::max(front, world.position(body).x + slider.halfWidth);
        slowest = std::min(slowest, static_cast<double>(velocityOf(world, body).x));
    }
    const std::string name = nameOf(ground) + " wall " + std::to_string(static_cast<int>(wall)) + ", " + nameOf(mode) +
                             ", " + slider.name + " at " + std::to_string(speed) + " m/s: ";
    expectAtMost(name + "past the wall", front - kWallX, 1e-4);
    expectAtMost(name + "short of the wall", kWallX - front, 1e-4);
    expectAtMost(name + "speed on", slowest, 0.01);
    expectAtMost(name + "thrown up", rise, 1e-3);
    expectAtMost(name + "below the floor", slider.height - world.position(body).y, 1e-4);
}

TEST(Ghosts, WallsAreStillWalls) {
    for (const Ground ground : kLoose) {
        for (const GhostWall wall : kWalls) {
            for (const ContinuousMode mode : kModes) {
                for (const Slider& slider : sliders()) {
                    for (const double speed : {1.0, 5.0, 20.0, 100.0}) {
                        expectStopped(ground, wall, mode, slider, speed);
                    }
                }
            }
        }
    }
}

/// A step as high as a part of the box. What is fast topples over it, but not before it took most of its speed.
TEST(Ghosts, StepsOfTwoPercentStopABox) {
    for (const Ground ground : kLoose) {
        for (const ContinuousMode mode : kModes) {
            for (const double height : {0.02, 0.05, 0.2}) {
                for (const double speed : {1.0, 5.0, 20.0, 100.0}) {
                    World world = worldIn(mode);
                    addFloor(world, ground, -20, kWallPiece);
                    addFloor(world, ground, kWallPiece, kWallPiece + 40, height);
                    if (ground == Ground::segments) {
                        addStatic(world, segment(kWallX, 0, kWallX, height), material(0));
                    }
                    const BodyId body = addBody(world, dynamicAt({0, 0.5}, vec(speed, 0)), box(0.5, 0.5), material(0));
                    double slowest = speed;
                    for (int i = 0; i < static_cast<int>(kWallX / speed * kRate) + 30; ++i) {
                        must(world.step(kStep));
                        slowest = std::min(slowest, velocityOf(world, body).x);
                    }
                    const std::string name = nameOf(ground) + ", " + nameOf(mode) + ", " + std::to_string(height) +
                                             " m at " + std::to_string(speed) + " m/s: ";
                    expectAtMost(name + "speed kept", slowest / speed, speed > 1 ? 0.5 : 0.01);
                }
            }
        }
    }
}

TEST(Ghosts, AGrooveHoldsWhatSlidesIntoIt) {
    for (const Ground ground : kLoose) {
        for (const ContinuousMode mode : kModes) {
            for (const Slider& slider : sliders()) {
                World world = worldIn(mode);
                for (int i = 0; i < 20; ++i) {
                    const double near = i * kSpan;
                    addPiece(world, ground, {-near - kSpan, near + kSpan}, {-near, near});
                    addPiece(world, ground, {near, near}, {near + kSpan, near + kSpan});
                }
                const BodyId body = addBody(world, dynamicAt({-4, 6}), slider.polygon, material(0));
                runFor(world, 10);
                double low = 10;
                for (int i = 0; i < 60; ++i) {
                    must(world.step(kStep));
                    low = std::min(low, world.position(body).y);
                }
                // Nothing of it may be below the groove: its centre is inside it, half its smallest width at least.
                const DVec2 place = world.position(body);
                const std::string name = nameOf(ground) + ", " + nameOf(mode) + ", " + slider.name + ": ";
                expectAtMost(name + "too deep", slider.height - low, 0);
                expectAtMost(name + "out of it", std::abs(place.x), place.y);
            }
        }
    }
}

/// How far the centre of what falls gets below the highest ground at its place, m: less than −0.2 while it stays above.
template <class Surface>
double sinkOf(World& world, BodyId body, double left, double right, const Surface& surface) {
    double sink = -10;
    for (int i = 0; i < 360; ++i) {
        must(world.step(kStep));
        const DVec2 p = world.position(body);
        if (p.x > left && p.x < right) { sink = std::max(sink, surface(p.x) - p.y); }
    }
    return sink;
}

void expectHeld(Ground ground, ContinuousMode mode, const Slider& slider, double drop) {
    const std::string name =
        nameOf(ground) + ", " + nameOf(mode) + ", " + slider.name + " from " + std::to_string(drop) + " m: ";
    const DVec2 above{0, slider.height + drop};

    World seam = worldIn(mode);
    addFloor(seam, ground, -1, 1);
    const BodyId onSeam = addBody(seam, dynamicAt(above), slider.polygon, material(0));
    const auto level = [&slider](double) { return slider.height; };
    expectAtMost(name + "below the seam", sinkOf(seam, onSeam, -1, 1, level), 0.001);

    World ridge = worldIn(mode);
    addPiece(ridge, ground, {-2, -1}, {0, 0});
    addPiece(ridge, ground, {0, 0}, {2, -1});
    const BodyId onRidge = addBody(ridge, dynamicAt(above), slider.polygon, material(1));
    const auto slopes = [](double x) { return -0.5 * std::abs(x); };
    expectAtMost(name + "through the ridge", sinkOf(ridge, onRidge, -2, 2, slopes), -0.2);

    World stairs = worldIn(mode);
    for (int i = 0; i < 40; ++i) {
        const double tread = -0.2 * i;
        addPiece(stairs, ground, {i * kSpan, tread}, {(i + 1) * kSpan, tread});
        addStatic(stairs, segment(i * kSpan, tread, i * kSpan, tread + 0.2), material(0.5));
    }
    const BodyId onStairs = addBody(stairs, dynamicAt(DVec2{1.25, 0} + above), slider.polygon, material(0.5));
    const auto treads = [](double x) { return -0.2 * std::floor(x / kSpan); };
    expectAtMost(name + "through the stairs", sinkOf(stairs, onStairs, 0, 20, treads), -0.2);
}

TEST(Ghosts, WhatIsDroppedOnASeamOrARidgeOrStairsStays) {
    for (const Ground ground : kLoose) {
        for (const ContinuousMode mode : kModes) {
            for (const Slider& slider : sliders()) {
                for (const double drop : {0.0, 1.0, 50.0}) { expectHeld(ground, mode, slider, drop); }
            }
        }
    }
}

TEST(Ghosts, SeparationAlongIsThatOfTheFarthestPoints) {
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Random random(seed);
        const auto shape = [&random] {
            const double radius = random.chance(0.5) ? 0 : random.range(0.01, 0.5);
            switch (random.integer(0, 3)) {
                case 0:
                    return circle(random.range(0.1, 1), vec(random.range(-1, 1), random.range(-1, 1)));
                case 1:
                    return capsule(random.range(0.1, 1), random.range(0.1, 1));
                case 2:
                    return segment(random.range(-1, 0), random.range(-1, 1), random.range(0.1, 1), 0);
                default:
                    return must(makeBox(vec(random.range(0.1, 1), random.range(0.1, 1)),
                                        vec(random.range(-1, 1), random.range(-1, 1)), random.range(-3, 3),
                                        real(radius)));
            }
        };
        const auto place = [&random] {
            return WorldTransform{{random.range(-3, 3), random.range(-3, 3)}, rotationFromAngle(random.range(-3, 3))};
        };
        const Polygon a = shape();
        const Polygon b = shape();
        const WorldTransform poseA = place();
        const WorldTransform poseB = place();
        const double angle = random.range(-kPi, kPi);
        const Vec2 direction = vec(std::cos(angle), std::sin(angle));
        const auto along = [direction](const WorldTransform& pose, Vec2 v) {
            const auto wide = [](auto x) { return static_cast<long double>(x); };
            const long double x = wide(pose.rotation.c) * wide(v.x) - wide(pose.rotation.s) * wide(v.y);
            const long double y = wide(pose.rotation.s) * wide(v.x) + wide(pose.rotation.c) * wide(v.y);
            return wide(direction.x) * (wide(pose.position.x) + x) + wide(direction.y) * (wide(pose.position.y) + y);
        };
        long double highest = -100;
        long double lowest = 100;
        for (const Vec2 v : a.points()) { highest = std::max(highest, along(poseA, v)); }
        for (const Vec2 v : b.points()) { lowest = std::min(lowest, along(poseB, v)); }
        const double radii = static_cast<double>(a.radius) + static_cast<double>(b.radius);
        ASSERT_NEAR(static_cast<double>(separationAlong(a, poseA, b, poseB, direction)),
                    static_cast<double>(lowest - highest) - radii, 64 * static_cast<double>(kEpsilon))
            << "seed " << seed;
    }
}

}  // namespace
}  // namespace swept::test

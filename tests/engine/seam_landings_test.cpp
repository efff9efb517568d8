#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Seams in walls that bodies fall along, and beside which they land: flush pieces without friction turn nothing back.

namespace swept::test {
namespace {

enum class Pieces { tiles, segments };

/// A row of flush pieces from the origin along x, solid below; or along y, solid to the right.
void addRow(World& world, Pieces pieces, int count, bool isWall) {
    for (int i = -5; i < count; ++i) {
        if (pieces == Pieces::segments) {
            addStatic(world, isWall ? segment(0, i, 0, i + 1) : segment(i, 0, i + 1, 0), material(0));
        } else {
            addStatic(world, box(0.5, 0.5), material(0), isWall ? DVec2{0.5, i + 0.5} : DVec2{i + 0.5, -0.5});
        }
    }
}

struct Rider {
    const char* name;
    Polygon polygon;
    double halfWidth;
    bool isUpright;
};
std::array<Rider, 4> riders() {
    return {Rider{"box that does not turn", box(0.4, 0.5), 0.4, true}, Rider{"box", box(0.4, 0.5), 0.4, false},
            Rider{"capsule that does not turn", capsule(0.2, 0.4), 0.6, true},
            Rider{"circle", circle(0.4), 0.4, false}};
}

BodyId addRider(World& world, const Rider& rider, DVec2 place, Vec2 velocity) {
    BodyDef def = dynamicAt(place, velocity);
    def.fixedRotation = rider.isUpright;
    return addBody(world, def, rider.polygon, material(0));
}

WorldSettings settingsFor(ContinuousMode mode, Profile profile) {
    WorldSettings settings = awakeSettings();
    settings.continuous = mode;
    settings.profile = profile;
    return settings;
}

/// Largest part of its speed along the floor that one of so many lost that came down on it at random places.
double worstLanding(const Rider& rider, Pieces pieces, Vec2 velocity, Profile profile, std::uint64_t seed) {
    constexpr int kStarts = 60;
    Random random(seed);
    double worst = 0;
    for (int i = 0; i < kStarts; ++i) {
        World world = makeWorld(settingsFor(ContinuousMode::subStep, profile));
        addRow(world, pieces, 40, false);
        const double x = random.range(0, 1);
        const double y = random.range(0.5, 2.5);
        const BodyId body = addRider(world, rider, {x, y}, velocity);
        for (int step = 0; step < 45 && world.position(body).x < 38; ++step) { must(world.step(kStep)); }
        worst = std::max(worst, 1 - velocityOf(world, body).x / static_cast<double>(velocity.x));
    }
    return worst;
}

TEST(SeamLandings, LoseNothing) {
    for (const Pieces pieces : {Pieces::tiles, Pieces::segments}) {
        for (const Rider& rider : riders()) {
            for (const Vec2 velocity : {vec(5, -3), vec(5, -10), vec(15, -10)}) {
                for (const Profile profile : {Profile::accurate, Profile::fast}) {
                    const std::string at =
                        std::string(rider.name) + " on pieces " + std::to_string(static_cast<int>(pieces)) + " at " +
                        testing::PrintToString(velocity.x) + ", " + testing::PrintToString(velocity.y) +
                        " m/s, profile " + std::to_string(static_cast<int>(profile));
                    expectAtMost(at + ": speed lost", worstLanding(rider, pieces, velocity, profile, 17), 1e-3);
                }
            }
        }
    }
}

/// How much slower than in free fall something falls along a wall that it is pushed against, at worst, m/s.
double worstFall(const Rider& rider, Pieces pieces, double speed, ContinuousMode mode, std::uint64_t seed) {
    constexpr int kStarts = 20;
    Random random(seed);
    double worst = 0;
    for (int i = 0; i < kStarts; ++i) {
        World world = makeWorld(settingsFor(mode, Profile::accurate));
        addRow(world, pieces, 60, true);
        const BodyId body = addRider(world, rider, {-0.02 - rider.halfWidth, random.range(50, 51)}, vec(0, -speed));
        double fallen = speed;
        for (int step = 0; step < 90 && world.position(body).y > 3; ++step) {
            must(world.setVelocity(body, {3, world.velocity(body).y}, 0));
            must(world.step(kStep));
            fallen += kGravity * kStep;
            worst = std::max(worst, fallen + velocityOf(world, body).y);
        }
    }
    return worst;
}

TEST(SeamLandings, NothingIsStoppedThatFallsAlongAWall) {
    for (const ContinuousMode mode : {ContinuousMode::subStep, ContinuousMode::stop, ContinuousMode::off}) {
        // What is stopped where it comes to the wall loses the rest of that step.
        const double most = mode == ContinuousMode::stop ? 0.05 + kGravity * kStep : 0.05;
        for (const Pieces pieces : {Pieces::tiles, Pieces::segments}) {
            for (const Rider& rider : riders()) {
                for (const double speed : {0.0, 10.0, 25.0}) {
                    const std::string at = std::string(rider.name) + " along pieces " +
                                           std::to_string(static_cast<int>(pieces)) + " from " + std::to_string(speed) +
                                           " m/s, mode " + std::to_string(static_cast<int>(mode));
                    expectAtMost(at + ": slower by", worstFall(rider, pieces, speed, mode, 23), most);
                }
            }
        }
    }
}

/// What stands out from the floor is no seam: a step.
TEST(SeamLandings, StepsAreStillInTheWay) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        World world = makeWorld(settingsFor(ContinuousMode::subStep, profile));
        addStatic(world, box(5, 0.5), material(0), {-4, -0.5});
        addStatic(world, box(5, 0.5), material(0), {6, -0.45});
        const BodyId body = addRider(world, riders()[0], {0.2, 0.7}, vec(5, -10));
        for (int step = 0; step < 60; ++step) { must(world.step(kStep)); }
        EXPECT_LT(velocityOf(world, body).x, 0.1) << static_cast<int>(profile);
        EXPECT_LT(world.position(body).x, 0.61) << static_cast<int>(profile);
    }
}

/// What is heavy, or pulled hard, sinks into the ground farther than flush ground may be uneven: the sides of the
/// pieces ahead are hidden all the same.
TEST(SeamLandings, WhatSinksInIsNotStoppedBySeams) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double gravity : {10.0, 20.0, 30.0}) {
            for (const double below : {0.25, 0.1}) {  // half the height of every second piece
                for (const bool isCrate : {false, true}) {
                    WorldSettings settings = awakeSettings(profile, gravity);
                    World world = makeWorld(settings);
                    for (int i = -2; i < 20; ++i) {
                        const double half = i % 2 == 0 ? 0.25 : below;
                        addStatic(world, box(0.5, half), material(0), {i + 0.5, -half});
                    }
                    BodyDef def = dynamicAt({0.3, isCrate ? 0.4 : 0.7}, vec(4, 0));
                    def.fixedRotation = !isCrate;
                    const Polygon player = must(makeCapsule(vec(0, -0.4), vec(0, 0.4), real(0.3)));
                    const BodyId body = addBody(world, def, isCrate ? box(0.4, 0.4) : player, material(0));
                    run(world, 240);
                    const std::string what = std::string(isCrate ? "crate" : "player") + " under " +
                                             std::to_string(gravity) + " m/s^2, profile " +
                                             std::to_string(static_cast<int>(profile)) + ": slower by";
                    expectAtMost(what, 4 - velocityOf(world, body).x, 0.01);
                }
            }
        }
    }
}

/// @return how deep a crate that does not turn gets into the corner of a step, however it comes down there, metres
double deepestInStep(Profile profile, std::uint64_t seed) {
    Random random(seed);
    const double rise = random.range(0.01, 0.2);
    World world = makeWorld(settingsFor(ContinuousMode::subStep, profile));
    addStatic(world, box(10, 0.5), material(0), {-10, -0.5});
    addStatic(world, box(10, 0.5), material(0), {10, rise - 0.5});
    const double forwards = random.range(5, 20);
    const double down = random.range(5, 20);
    const double part = random.range(0, 1);  // of its width, which is above the step when it would reach its top
    const double time = random.range(0, 4 * kStep);
    BodyDef def = dynamicAt({-0.42 + 0.04 * part - forwards * time, 0.4 + rise + down * time}, vec(forwards, -down));
    def.fixedRotation = true;
    const BodyId body = addBody(world, def, box(0.4, 0.4), material(0));
    double deepest = 0;
    for (int i = 0; i < 10; ++i) {
        run(world, 1);
        const DVec2 place = world.position(body);
        deepest = std::max(deepest, std::min(place.x + 0.4, rise + 0.4 - place.y));
    }
    return deepest;
}

/// Nor is it gone into by what has yet to land before it. (The floor hid its corner, and crates were in it by as much
/// as 11 cm.)
TEST(SeamLandings, NothingGoesIntoAStep) {
    for (const Profile profile : kProfiles) {
        double deepest = 0;
        for (std::uint64_t seed = 0; seed < 200; ++seed) { deepest = std::max(deepest, deepestInStep(profile, seed)); }
        expectAtMost(profileName(profile) + ", metres in the step", deepest, 2e-3);
    }
}

}  // namespace
}  // namespace swept::test

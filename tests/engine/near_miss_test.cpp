#include <cmath>

#include "world_support.h"

/// What flies past something, and never meets it, is not turned away by it, however near and whatever both are:
/// contacts are made ahead of time, with a normal that is soon out of date.

namespace swept::test {
namespace {

struct Passer {
    const char* name;
    Polygon polygon;
    double half;  ///< height, metres
};

std::vector<Passer> passers() {
    return {{"ball", circle(0.3), 0.3},
            {"capsule", capsule(0.4, 0.3), 0.3},
            {"box", box(0.3, 0.3), 0.3},
            {"rounded box", must(makeBox(vec(0.2, 0.2), {}, 0, real(0.1))), 0.3}};
}

/// Past the upper corners of a box, at many phases of the step.
void expectUntouched(BodyType type, Profile profile, const Passer& passer, double speed, double clearance) {
    constexpr int kPhases = 24;
    for (int phase = 0; phase < kPhases; ++phase) {
        WorldSettings settings = awakeSettings(profile, 0);
        World world = makeWorld(settings);
        addBody(world, bodyAt(type, {4, 0}), box(0.5, 0.5), material(0.5, 0, 1000));
        const double start = 2 + speed * kStep * phase / kPhases;
        const Vec2 velocity = vec(speed, 0);
        const BodyId body = addBody(world, dynamicAt({start, 0.5 + passer.half + clearance}, velocity), passer.polygon);
        for (int i = 0; i < static_cast<int>(4 / speed * kRate); ++i) {
            must(world.step(kStep));
            ASSERT_TRUE(world.velocity(body) == velocity && world.angularVelocity(body) == 0)
                << passer.name << ", " << (type == BodyType::fixed ? "fixed" : "dynamic") << ", " << speed << " m/s, "
                << clearance << " m away, phase " << phase << ": " << world.velocity(body).x << ", "
                << world.velocity(body).y;
        }
    }
}

TEST(NearMisses, TurnNobodyAway) {
    for (const BodyType type : {BodyType::fixed, BodyType::dynamic}) {
        for (const Profile profile : {Profile::accurate, Profile::fast}) {
            for (const Passer& passer : passers()) {
                for (const double speed : {1.0, 4.0, 8.0, 16.0}) {
                    for (const double clearance : {0.002, 0.01, 0.03}) {
                        expectUntouched(type, profile, passer, speed, clearance);
                    }
                }
            }
        }
    }
}

/// Falling past a ledge, as characters do.
TEST(NearMisses, NobodyIsKickedByALedge) {
    for (const double height : {1.0, 2.0, 3.5}) {
        for (const double clearance : {0.002, 0.01}) {
            World world = makeWorld();
            addStatic(world, box(1, 0.2), material(0.5));
            const BodyId body = addBody(world, dynamicAt({1.3 + clearance, height}),
                                        must(makeCapsule(vec(0, -0.4), vec(0, 0.4), real(0.3))));
            run(world, 60);
            EXPECT_EQ(world.velocity(body).x, 0) << height << " m, " << clearance;
            EXPECT_NEAR(world.velocity(body).y, -kGravity, 1e-4) << height << " m, " << clearance;
        }
    }
}

/// Over crates that stand side by side, on to them and off: their edges are flush with what it stands on. (A sharp box
/// that a step leaves within two thousandths before the next side touches that, and trips: at 2 m/s it does.)
TEST(NearMisses, OfFlushBodiesHoldNobodyUp) {
    std::vector<Passer> sliders = passers();
    sliders.push_back({"player", must(makeCapsule(vec(0, -0.4), vec(0, 0.4), real(0.3))), 0.7});
    for (const Passer& slider : sliders) {
        for (const double speed : {2.0, 4.0, 8.0}) {
            if (slider.polygon.radius == 0 && speed < 4) { continue; }
            World world = makeWorld();
            addStatic(world, box(20, 0.5), material(0.6), {5, -1.5});
            addStatic(world, box(5, 0.5), material(0.6), {-5, -0.5});
            addStatic(world, box(5, 0.5), material(0.6), {15, -0.5});
            for (int i = 0; i < 10; ++i) { addBody(world, dynamicAt({i + 0.5, -0.5}), box(0.5, 0.5), material(0.6)); }
            run(world, 60);
            BodyDef def = dynamicAt({-2, slider.half}, vec(speed, 0));
            def.fixedRotation = slider.half > 0.5;
            const BodyId body = addBody(world, def, slider.polygon, material(0));
            double highest = 0;
            for (int i = 0; i < static_cast<int>(15 / speed * kRate); ++i) {
                run(world, 1);
                highest = std::max(highest, world.position(body).y - slider.half);
            }
            EXPECT_NEAR(world.velocity(body).x, speed, 0.02) << slider.name;
            EXPECT_LT(highest, 1e-3) << slider.name << ", " << speed << " m/s";
        }
    }
}

/// What does meet something is stopped as before, and leaves no later than a rounding.
TEST(NearMisses, HitsAreStillHits) {
    for (const double offset : {0.0, 0.2, 0.5, 0.7}) {
        for (const double speed : {1.0, 4.0, 8.0}) {
            World world = makeWorld(0);
            addStatic(world, box(0.5, 0.5), {}, {4, 0});
            const BodyId body = addBody(world, dynamicAt({2, offset}, vec(speed, 0)), circle(0.3), material(0));
            double deepest = 0;
            for (int i = 0; i < static_cast<int>(4 / speed * kRate); ++i) {
                must(world.step(kStep));
                const NearestShape nearest = world.nearest(world.position(body), 9, {.ignore = body});
                deepest = std::max(deepest, 0.3 - static_cast<double>(nearest.distance));
            }
            EXPECT_LT(deepest, 2e-3) << offset << " beside, " << speed << " m/s";
            EXPECT_LT(velocityOf(world, body).x, 0.95 * speed) << offset << " beside, " << speed << " m/s";
        }
    }
}

}  // namespace
}  // namespace swept::test

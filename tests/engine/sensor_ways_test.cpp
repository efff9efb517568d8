#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Sensors see what passes them within a step, whatever turns, and however small or thin the sensor or the other is: as
/// often as geometry says, and when.

namespace swept::test {
namespace {

ShapeDef seeing() {
    ShapeDef def;
    def.sensor = true;
    def.density = 0;
    return def;
}

struct SeenEvents {
    int begins = 0;
    int ends = 0;
    double firstBegin = -1;  ///< in steps
};

SeenEvents seenIn(World& world, int steps) {
    SeenEvents seen;
    for (int i = 0; i < steps; ++i) {
        run(world, 1);
        for (const ContactEvent& event : world.contactEvents()) {
            seen.begins += event.type == ContactEventType::sensorBegin ? 1 : 0;
            seen.ends += event.type == ContactEventType::sensorEnd ? 1 : 0;
            if (event.type == ContactEventType::sensorBegin && seen.firstBegin < 0) {
                seen.firstBegin = i + event.fraction;
            }
        }
    }
    return seen;
}

BodyDef turningAt(BodyType type, double spin) {
    BodyDef def = bodyAt(type, {});
    def.angularVelocity = real(spin);
    def.mass = type == BodyType::dynamic ? 1 : 0;
    def.inertia = type == BodyType::dynamic ? 1 : 0;
    return def;
}

/// A beam from the hub outwards, over balls that rest about it: each begins and ends once a turn. A hub that is solid
/// and larger than all else, one that is not, one that may be moved.
TEST(SensorWays, TurningBeamsSeeEachBallOnceATurn) {
    constexpr int kBalls = 16;
    constexpr int kTurns = 3;
    constexpr double kOut = 18;
    const std::array beams{segment(0.5, 0, 20, 0), must(makeSegment(vec(0.5, 0), vec(20, 0), real(0.01))),
                           must(makeBox(vec(10, 0.01), vec(10.5, 0)))};
    for (const double spin : {0.5, 2.0, 6.0, 10.0, 40.0}) {
        for (std::size_t k = 0; k < 3 * beams.size(); ++k) {
            const std::size_t hub = k % 3;
            World world = makeWorld(0);
            const BodyId tower =
                must(world.createBody(turningAt(hub == 1 ? BodyType::dynamic : BodyType::kinematic, spin)));
            if (hub == 2) { must(world.addShape(tower, circle(0.5))); }
            must(world.addShape(tower, beams[k / 3], seeing()));
            for (int i = 0; i < kBalls; ++i) {
                addBody(world, dynamicAt(turned({kOut, 0}, 2 * kPi * (i + 0.37) / kBalls)), circle(0.2));
            }
            // Not to the end of a turn: a ball is 0.37 of a gap away from there.
            const SeenEvents seen = seenIn(world, static_cast<int>(std::lround(kTurns * 2 * kPi / spin * kRate)));
            EXPECT_EQ(seen.begins, kTurns * kBalls) << "beam " << k / 3 << ", hub " << hub << ", " << spin << " rad/s";
            EXPECT_EQ(seen.ends, kTurns * kBalls) << "beam " << k / 3 << ", hub " << hub << ", " << spin << " rad/s";
            if (spin <= 10) {
                const double at = 2 * kPi * 0.37 / kBalls - std::asin(0.2 / kOut) - (k / 3 > 0 ? 0.01 / kOut : 0);
                EXPECT_NEAR(seen.firstBegin, at / spin * kRate, 0.02) << "beam " << k / 3 << ", " << spin << " rad/s";
            }
        }
    }
}

/// A sword of a sensor alone over a small target, from wherever it begins.
TEST(SensorWays, SwordsSeeSmallTargets) {
    for (const double spin : {5.0, 10.0, 20.0, 40.0}) {
        for (int i = 0; i < 50; ++i) {
            World world = makeWorld(0);
            addBody(world, dynamicAt(turned({1.1, 0}, 0.6 + 0.01 * i)), circle(0.05));
            const BodyId sword = must(world.createBody(turningAt(BodyType::kinematic, spin)));
            must(world.addShape(sword, must(makeBox(vec(0.6, 0.02), vec(0.6, 0))), seeing()));
            const SeenEvents seen = seenIn(world, static_cast<int>(2 / spin * kRate) + 2);
            EXPECT_EQ(seen.begins, 1) << spin << " rad/s, target " << i;
            EXPECT_EQ(seen.ends, 1) << spin << " rad/s, target " << i;
        }
    }
}

/// Who moves: a crate with a small sensor past a small ball, a ball past it, or a line past either.
TEST(SensorWays, SmallSensorsOfLargeBodiesSeeSmallThings) {
    for (const double speed : {1.0, 3.0, 6.0, 9.0, 14.0, 30.0}) {
        for (int i = 0; i < 40; ++i) {
            for (const int kind : {0, 1, 2, 3}) {
                World world = makeWorld(0);
                const double start = -2 - 0.013 * i;
                if (kind == 0) {  // a crate with a sensor
                    addStatic(world, circle(0.03));
                    const BodyId crate = addBody(world, dynamicAt({start, -1}, vec(speed, 0)), box(0.5, 0.5));
                    must(world.addShape(crate, circle(0.03, vec(0, 1)), seeing()));
                } else if (kind == 1) {  // a crate past a sensor, by its nose
                    addStatic(world, circle(0.03), seeing());
                    const BodyId crate = addBody(world, dynamicAt({start, -1}, vec(speed, 0)), box(0.5, 0.5));
                    must(world.addShape(crate, segment(0, 0.5, 0, 1.01)));
                } else if (kind == 2) {  // a line, sideways
                    addStatic(world, circle(0.01), seeing());
                    BodyDef def = dynamicAt({start, 0.3}, vec(speed, 0));
                    def.mass = 1;
                    def.inertia = real(0.1);
                    addBody(world, def, segment(0, -0.5, 0, 0.5));
                } else {  // a crate over a wire
                    addStatic(world, segment(0, -3, 0, 3), seeing());
                    addBody(world, dynamicAt({start, 0}, vec(speed, 0)), box(0.02, 0.5));
                }
                const SeenEvents seen = seenIn(world, static_cast<int>(3.2 / speed * kRate));
                EXPECT_EQ(seen.begins, 1) << "kind " << kind << ", " << speed << " m/s, start " << start;
                EXPECT_EQ(seen.ends, 1) << "kind " << kind << ", " << speed << " m/s, start " << start;
            }
        }
    }
}

/// An arm far beyond the solid shapes of its body, which turned a little and stands again.
TEST(SensorWays, ArmsThatTurnedALittleSeeWhatTheyOverlap) {
    Random random(41);
    int overlapping = 0;
    for (int i = 0; i < 100; ++i) {
        const double turn = random.range(0.0005, 0.006);
        World world = makeWorld(0);
        const BodyId crate = addBody(world, bodyAt(BodyType::dynamic, {}), box(0.5, 0.5));
        const Polygon shape = must(makeBox(vec(10, 0.01), vec(10, 0)));
        const ShapeId arm = must(world.addShape(crate, shape, seeing()));
        addBody(world, bodyAt(BodyType::kinematic, {19, 19 * std::tan(turn)}), circle(0.005));
        run(world, 10);
        constexpr double kSpin = 0.02;
        must(world.setVelocity(crate, {}, real(kSpin)));
        run(world, static_cast<int>(std::lround(turn / kSpin * kRate)));
        must(world.setVelocity(crate, {}, 0));
        run(world, 60);
        int told = 0;
        world.visitOverlaps(arm, [&](ShapeId) { ++told; });
        int there = 0;
        QueryFilter filter;
        filter.ignore = crate;
        world.overlapShape(shape, world.transform(crate), filter, [&](ShapeId) {
            ++there;
            return true;
        });
        EXPECT_EQ(told, there) << "case " << i << ", turned " << turn;
        overlapping += there;
    }
    EXPECT_GT(overlapping, 20);
}

/// Of what is damped: a wall in the place of the sensor is met at the same time.
TEST(SensorWays, OfWhatIsDampedHaveTheTimesOfItsHits) {
    for (const double damping : {0.0, 0.5, 2.0, 10.0, 40.0}) {
        std::array<double, 2> times{-1, -1};
        for (const bool isSensor : {false, true}) {
            World world = makeWorld(0);
            addStatic(world, box(0.5, 0.5), isSensor ? seeing() : ShapeDef{}, {2, 0});
            BodyDef def = dynamicAt({}, vec(300, 0));
            def.linearDamping = real(damping);
            addBody(world, def, circle(0.1));
            for (int i = 0; i < 2 && times[isSensor ? 1 : 0] < 0; ++i) {
                run(world, 1);
                for (const ContactEvent& event : world.contactEvents()) {
                    const bool isMeant =
                        event.type == ContactEventType::sensorBegin || event.type == ContactEventType::hit;
                    if (isMeant && times[isSensor ? 1 : 0] < 0) { times[isSensor ? 1 : 0] = i + event.fraction; }
                }
            }
        }
        EXPECT_GT(times[0], 0);
        EXPECT_NEAR(times[0], times[1], 1e-4) << "damping " << damping;
    }
}

/// Fast for its size or not: thrown up from under a sensor, over its lower edge, and back within the step.
TEST(SensorWays, SeeTheTopOfAThrow) {
    for (const double radius : {0.2, 4.0}) {
        World world = makeWorld(10);
        constexpr double kLong = 0.2;
        constexpr double kTop = 0.05;  // of 1 m/s
        addStatic(world, box(10, 0.05), seeing(), {0, radius + 0.05 + 0.5 * kTop});
        addBody(world, dynamicAt({}, vec(0, 1)), circle(radius));
        must(world.step(kLong));
        std::vector<double> fractions;
        for (const ContactEvent& event : world.contactEvents()) { fractions.push_back(event.fraction); }
        ASSERT_EQ(fractions.size(), 2U) << "radius " << radius;
        // Half as high as the top at (1 ∓ 1/√2)/2 of the time.
        EXPECT_NEAR(fractions[0], 0.5 - std::sqrt(0.125), 5e-3);
        EXPECT_NEAR(fractions[1], 0.5 + std::sqrt(0.125), 5e-3);
    }
}

/// A crate that slides along the edge of a sensor, as near as times of impact are found: it is not in and out in every
/// step.
TEST(SensorWays, SkimmedAreSilent) {
    World world = makeWorld(0);
    addStatic(world, box(5, 0.01), seeing());
    addBody(world, dynamicAt({-4, 0.26 + 1e-6}, vec(4, 0)), box(0.25, 0.25));
    EXPECT_LE(seenIn(world, 60).begins, 1);
}

/// A ball past a round sensor, at a time between two steps: 3 µm deep it is in, and out again. As deep as roundings go,
/// which is 2⁻¹⁷ of its radius, it is no more in than one that passes outside, as near as times of impact are found.
/// (All that overlapped by as little as that were told.)
TEST(SensorWays, GrazedAreSilent) {
    for (int i = -100; i <= 100; ++i) {
        const double depth = 1e-7 * i;
        if ((depth > -2e-7 && depth < 2e-7) || (depth > 1.5e-6 && depth < 3e-6)) { continue; }  // may be either
        World world = makeWorld(0);
        addStatic(world, circle(0.25), seeing());
        addBody(world, dynamicAt({-0.8, 0.5 - depth}, vec(100, 0)), circle(0.25));
        const SeenEvents seen = seenIn(world, 1);
        EXPECT_EQ(seen.begins, depth > 2e-6 ? 1 : 0) << depth << " m deep";
        EXPECT_EQ(seen.ends, seen.begins) << depth << " m deep";
    }
}

/// What moves no farther than a part of its width, and of that of the sensor, costs no sweep.
TEST(SensorWays, OfWhatIsSlowForItsSizeAreNotFollowed) {
    World world = makeWorld(0);
    addStatic(world, box(1, 1), seeing(), {9, 0});
    addStatic(world, box(0.01, 0.01), seeing(), {30, 0});
    addBody(world, dynamicAt({7.5, 0}, vec(4, 0)), box(0.5, 0.5));
    EXPECT_EQ(seenIn(world, 4).begins, 1);
    EXPECT_EQ(world.counters().sensorSweeps, 0U);
}

}  // namespace
}  // namespace swept::test

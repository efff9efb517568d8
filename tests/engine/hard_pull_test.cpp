#include <array>

#include "../support/some_of.h"
#include "world_support.h"

/// What gravity or a force pulls so hard that it would be fast from rest within a step, and that lies on something on
/// its own. It flew from impact to impact, fell along the slope before each, and crept for ever, awake; rolling
/// resistance was lost on it.

namespace swept::test {
namespace {

std::string caseOf(Profile profile) { return profile == Profile::fast ? "fast, " : "accurate, "; }

/// Pulled by so many of its extents in a step: between 0.25 and 0.31.
struct ThinBody {
    double extent;  ///< metres
    double rate;    ///< Hz
};
const ThinBody kThinBodies[] = {{0.01, 60}, {0.04, 30}, {0.08, 20}};

std::string caseOf(Profile profile, const ThinBody& thin) {
    return caseOf(profile) + std::to_string(thin.extent) + " m at " + std::to_string(thin.rate) + " Hz, ";
}

ShapeDef rollingOn(double friction, double resistance) {
    ShapeDef def = material(friction);
    def.rollingResistance = real(resistance);
    return def;
}

/// A body on a slope through the origin that falls to the left.
struct ThinOnSlope {
    World world;
    BodyId body;
    double angle;

    /// @param slope  its tangent
    ThinOnSlope(Profile profile, double slope, const Polygon& polygon, double height, const ShapeDef& surface,
                double gravity = kGravity)
        : angle(std::atan(slope)) {
        WorldSettings settings;
        settings.profile = profile;
        settings.gravity = vec(0, -gravity);
        world = makeWorld(settings);
        addStatic(world, box(50, 1), surface, turned({0, -1}, angle), angle);
        BodyDef def = dynamicAt(turned({0, height}, angle));
        def.angle = angle;
        body = addBody(world, def, polygon, surface);
    }
    DVec2 place() const { return turned(world.centerOfMass(body), -angle); }
    double downhillSpeed() const { return -turned(velocityOf(world, body), -angle).x; }
};

TEST(HardPull, ThinBoxesStayOnSlopes) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const ThinBody& thin : kThinBodies) {
            for (const double slope : {0.1, 0.2, 0.3, 0.5}) {
                const double half = thin.extent / 2;
                for (const double halfWidth : {half, 10 * half}) {
                    ThinOnSlope on(profile, slope, box(halfWidth, half), half, material(0.6));
                    runFor(on.world, 10, 1 / thin.rate);
                    const std::string name = caseOf(profile, thin) + "slope " + std::to_string(slope);
                    expectAtMost(name, length(on.place() - DVec2{0, half}), 1e-3);
                    EXPECT_FALSE(on.world.isAwake(on.body)) << name;
                }
            }
        }
    }
}

TEST(HardPull, ThinBoxesSlideDownSteepSlopes) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const ThinBody& thin : kThinBodies) {
            for (const double friction : {0.0, 0.2, 0.4}) {
                ThinOnSlope on(profile, 0.5, box(thin.extent, thin.extent / 2), thin.extent / 2, material(friction));
                runFor(on.world, 2, 1 / thin.rate);
                const double wanted = 2 * kGravity * (std::sin(on.angle) - friction * std::cos(on.angle));
                const std::string name = caseOf(profile, thin) + "friction " + std::to_string(friction);
                expectAtMost(name, std::abs(on.downhillSpeed() / wanted - 1), 5e-3);
                expectAtMost(name + ": depth", thin.extent / 2 - on.place().y, thin.extent / 8);
            }
        }
    }
}

TEST(HardPull, SmallBallsThatResistRollingStay) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const ThinBody& thin : kThinBodies) {
            ThinOnSlope on(profile, 0.1, circle(thin.extent / 2), thin.extent / 2, rollingOn(0.6, 0.3));
            runFor(on.world, 10, 1 / thin.rate);
            expectAtMost(caseOf(profile, thin) + "way", std::abs(on.place().x), 1e-3);
            EXPECT_FALSE(on.world.isAwake(on.body)) << caseOf(profile, thin);
        }
    }
}

/// A disk that rolls has 3/2 of its mass. In `fast` it sinks in by a fiftieth, and rolls on a radius as much smaller.
TEST(HardPull, SmallBallsRollByTheClosedForm) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const ThinBody& thin : kThinBodies) {
            for (const double resistance : {0.0, 0.05}) {
                ThinOnSlope on(profile, 0.1, circle(thin.extent / 2), thin.extent / 2, rollingOn(0.6, resistance));
                runFor(on.world, 0.5, 1 / thin.rate);  // contacts give way to their load at first
                const double start = on.downhillSpeed();
                runFor(on.world, 1, 1 / thin.rate);
                const double gain = on.downhillSpeed() - start;
                const double wanted = kGravity * (std::sin(on.angle) - resistance * std::cos(on.angle)) * 2 / 3;
                const std::string name = caseOf(profile, thin) + "resistance " + std::to_string(resistance);
                expectAtMost(name, std::abs(gain / wanted - 1), profile == Profile::fast ? 0.06 : 5e-3);
            }
        }
    }
}

/// Of 10 to 100 times its weight: friction holds from 1.7 times on.
TEST(HardPull, AMagnetHoldsABoxAtAWall) {
    constexpr double kHalf = 0.2;
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const double rate : {30.0, 60.0}) {
            for (const double strength : {10.0, 38.0, 60.0, 100.0}) {
                // Beyond that, springs of four sub-steps would give way too far (hard_pull.h).
                if (profile == Profile::fast && rate < 60 && strength > 36) { continue; }
                WorldSettings settings = awakeSettings(profile);
                World world = makeWorld(settings);
                addStatic(world, box(1, 50), {}, {1, 0});
                const BodyId body = addBody(world, dynamicAt({-kHalf, 0}), box(kHalf, kHalf));
                const auto hold = [&](double seconds) {
                    for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
                        must(world.applyForce(body, vec(strength * kGravity * world.mass(body), 0),
                                              world.position(body)));
                        must(world.step(1 / rate));
                    }
                };
                hold(1);
                const double start = world.position(body).y;
                hold(5);
                const std::string name = caseOf(profile) + std::to_string(strength) + " g, " + std::to_string(rate);
                expectAtMost(name, std::abs(world.position(body).y - start), 1e-4);
                expectAtMost(name + ": depth", world.position(body).x + kHalf, 0.13 * 2 * kHalf);
            }
        }
    }
}

TEST(HardPull, BoxesStayUnderTenTimesTheGravity) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const double half : {0.025, 0.05}) {
            ThinOnSlope on(profile, 0.3, box(half, half), half, material(0.6), 10 * kGravity);
            runFor(on.world, 10);
            expectAtMost(caseOf(profile) + std::to_string(half), length(on.place() - DVec2{0, half}), 1e-3);
            EXPECT_FALSE(on.world.isAwake(on.body)) << caseOf(profile) << half;
        }
    }
}

/// From a sixteenth of its extent in a step to 512 of them: what carries it changes on the way.
TEST(HardPull, NothingIsPulledThroughASegment) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const int subSteps : {0, 1, 8}) {
            for (int power = -8; power <= 18; power += 4 - someOf(3)) {
                const double extent = kGravity * kStep * kStep / std::exp2(power / 2.0);
                const double half = extent / 2;
                const std::array<Polygon, 3> shapes{box(2 * half, half), circle(half), capsule(4 * half, half)};
                for (const Polygon& polygon : shapes) {
                    WorldSettings settings = awakeSettings(profile);
                    if (subSteps > 0) { settings.subSteps = subSteps; }
                    World world = makeWorld(settings);
                    const double slope = 0.5;
                    addStatic(world, must(makeSegment(vec(-50, 0), vec(50, 0))), material(0.3), {}, slope);
                    BodyDef def = dynamicAt(turned({0, 1.1 * half}, slope));
                    def.angle = slope;
                    const BodyId body = addBody(world, def, polygon, rollingOn(0.3, 0.2));
                    double lowest = 1;
                    for (int i = 0; i < 120; ++i) {
                        run(world, 1);
                        lowest = std::min(lowest, turned(world.centerOfMass(body), -slope).y / extent);
                    }
                    EXPECT_GT(lowest, 0) << caseOf(profile) << subSteps << " sub-steps, 2^" << power / 2.0 << ", "
                                         << polygon.count << " vertices";
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "world_support.h"

/// A chain as a platform that one jumps onto from below: it is there for what comes from above alone, and does not lift
/// who does not get over it.

namespace swept::test {
namespace {

constexpr double kTall = 0.8;    ///< half height of all jumpers
constexpr double kStart = -1.5;  ///< of their middle

/// A thin platform at y = 0, and one who jumps through it from below.
struct Jump {
    World world = makeWorld();
    BodyId ground;
    ShapeId platform;
    BodyId jumper;

    Jump(const Polygon& shape, double speed, std::span<const Vec2> points, double drift = 0.2) {
        ground = must(world.createBody({}));
        platform = must(world.addChain(ground, points, false, material(0.5)));
        BodyDef def = dynamicAt({0, kStart}, vec(drift, speed));
        def.fixedRotation = true;
        jumper = addBody(world, def, shape, material(0.5));
    }
    Jump(const Polygon& shape, double speed) : Jump(shape, speed, std::array{vec(5, 0), vec(-5, 0)}) {}
    double height() const { return world.position(jumper).y; }
};

struct Flight {
    double top = kStart;
    std::size_t begins = 0;  ///< of touching
};

Flight fly(Jump& jump, double seconds, double rate = kRate) {
    Flight flight;
    for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
        must(jump.world.step(1 / rate));
        flight.top = std::max(flight.top, jump.height());
        for (const ContactEvent& event : jump.world.contactEvents()) {
            flight.begins += event.type == ContactEventType::begin ? 1 : 0;
        }
    }
    return flight;
}

/// Where the jumper's middle would get to if nothing was there.
double freeTop(double speed) { return kStart + speed * speed / (2 * kGravity); }

/// Goes up as if nothing was there, and stands on the platform in the end, or falls through it.
void expectFreeJump(Jump& jump, double speed, double rate) {
    const bool getsOver = freeTop(speed) > kTall;
    const Flight flight = fly(jump, getsOver ? 4 : 1.5, rate);
    EXPECT_LT(flight.top, freeTop(speed) + 1e-3) << speed << " m/s, " << rate << " Hz";
    if (getsOver) {
        EXPECT_NEAR(jump.height(), kTall, 0.01) << speed << " m/s, " << rate << " Hz";
    } else {
        EXPECT_EQ(flight.begins, 0U) << speed << " m/s, " << rate << " Hz";
        EXPECT_NEAR(jump.height(), kStart + 1.5 * speed - 0.5 * kGravity * 1.5 * 1.5, 0.01) << speed;
    }
}

class Platform : public testing::TestWithParam<Polygon> {};
INSTANTIATE_TEST_SUITE_P(Jumpers, Platform,
                         testing::Values(must(makeBox(vec(0.4, kTall))),
                                         must(makeCapsule(vec(0, -0.5), vec(0, 0.5), real(0.3))),
                                         must(makeCircle({0, 0}, real(kTall)))));

TEST_P(Platform, LetsThroughFromBelowAndCarriesFromAbove) {
    for (const double speed : {6.9, 8.0, 12.0, 60.0}) {
        Jump jump(GetParam(), speed);
        const Flight flight = fly(jump, 20);
        EXPECT_GT(flight.top, freeTop(speed) - 0.01) << speed;
        EXPECT_LT(flight.top, freeTop(speed) + 0.01) << speed;
        EXPECT_NEAR(jump.height(), kTall, 0.01) << speed;
    }
}

TEST_P(Platform, IsNotThereForWhoDoesNotGetOverIt) {
    for (const double speed : {3.0, 4.0, 5.0}) {
        Jump jump(GetParam(), speed);
        runFor(jump.world, 1);
        EXPECT_NEAR(jump.height(), -1.5 + speed - kGravity / 2, 0.01) << speed;
    }
}

/// A chain is solid in front of the middle of a shape: before, who turned with the middle above it was lifted by half a
/// height, and stood on it.
TEST_P(Platform, DoesNotLiftWhoHardlyGetsThere) {
    for (const double rate : {60.0, 120.0, 240.0}) {
        for (int tenths = 50; tenths <= 75; ++tenths) {
            Jump jump(GetParam(), 0.1 * tenths);
            expectFreeJump(jump, 0.1 * tenths, rate);
        }
    }
}

TEST_P(Platform, OfManyPiecesIsNoOther) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 50; ++i) { points.push_back(vec(5 - 0.2 * i, 0)); }
    for (const double drift : {-1.7, 0.0, 0.9}) {
        for (int tenths = 50; tenths <= 75; ++tenths) {
            Jump jump(GetParam(), 0.1 * tenths, points, drift);
            expectFreeJump(jump, 0.1 * tenths, kRate);
        }
    }
}

TEST_P(Platform, ThatMovesLetsThroughAsWell) {
    for (const double rise : {-1.0, 1.0}) {
        for (int tenths = 40; tenths <= 75; ++tenths) {
            Jump jump(GetParam(), 0.1 * tenths);
            must(jump.world.redefine(jump.ground, bodyAt(BodyType::kinematic, {})));
            must(jump.world.setVelocity(jump.ground, vec(0, rise), 0));
            const Flight flight = fly(jump, 1.5);
            const double line = 1.5 * rise;
            if (flight.begins > 0) {
                EXPECT_NEAR(jump.height(), line + kTall, 0.01) << tenths << ", rise " << rise;
            } else {
                EXPECT_LT(jump.height(), line) << tenths << ", rise " << rise;
                EXPECT_NEAR(flight.top, freeTop(0.1 * tenths), 0.01) << tenths << ", rise " << rise;
            }
        }
    }
}

/// What came from no back is held, or comes out, however deep it is.
TEST_P(Platform, IsSolidForWhatWasPutThere) {
    Jump made(GetParam(), 0);
    const BodyId body = addBody(made.world, dynamicAt({2, 0.3}), GetParam(), material(0.5));
    runFor(made.world, 3);
    EXPECT_NEAR(made.world.position(body).y, kTall, 0.01);
    Jump moved(GetParam(), 5);
    runFor(moved.world, 0.2);
    must(moved.world.setPose(moved.jumper, {0, 0.3}, 0));
    must(moved.world.setVelocity(moved.jumper, {}, 0));
    runFor(moved.world, 3);
    EXPECT_NEAR(moved.height(), kTall, 0.01);
}

/// Half way through a slope, beside a vertex of it, the shortest way out of the next piece leads along the ground: who
/// was held off along that one hung there for ever.
TEST_P(Platform, LetsNobodyHangBesideAnInnerVertex) {
    for (const Profile profile : kProfiles) {
        for (const double slope : {0.2, -0.3}) {
            for (int tenths = -5; tenths <= 5; ++tenths) {
                for (const double height : {0.7, 0.5, 0.2}) {
                    World world = makeWorld(profile);
                    const BodyId ground = must(world.createBody(bodyAt(BodyType::kinematic, {}, slope)));
                    must(world.addChain(ground, std::array{vec(5, 0), vec(0, 0), vec(-5, 0)}, false, material(0.5)));
                    BodyDef def = dynamicAt(turned({0.1 * tenths, 0}, slope) + DVec2{0, height});
                    def.fixedRotation = true;
                    addBody(world, def, GetParam(), material(0.5));
                    runFor(world, 1);
                    const std::string where = profileName(profile) + ", slope " + std::to_string(slope) + ", at " +
                                              std::to_string(0.1 * tenths) + ", " + std::to_string(height);
                    EXPECT_LT(deepestOverlap(world), 0.01) << where;
                    EXPECT_TRUE(world.lostTime().empty()) << where;
                }
            }
        }
    }
}

TEST_P(Platform, HoldsWhatFallsOntoItInEveryMode) {
    for (const ContinuousMode mode : {ContinuousMode::off, ContinuousMode::stop, ContinuousMode::subStep}) {
        Jump jump(GetParam(), 0);
        WorldSettings settings = awakeSettings();
        settings.continuous = mode;
        must(jump.world.configure(settings));
        BodyDef def = dynamicAt({2, 3}, vec(0.3, -12));
        def.fixedRotation = true;
        const BodyId body = addBody(jump.world, def, GetParam(), material(0.5));
        runFor(jump.world, 3);
        EXPECT_NEAR(jump.world.position(body).y, kTall, 0.01) << static_cast<int>(mode);
    }
}

TEST_P(Platform, IsLeftDownwardsByAFilter) {
    Jump jump(GetParam(), 8);
    runFor(jump.world, 3);
    ASSERT_NEAR(jump.height(), kTall, 0.01);
    ShapeDef def = jump.world.definition(jump.platform);
    def.filter.mask = 0;
    must(jump.world.redefine(jump.platform, def));
    runFor(jump.world, 1);
    EXPECT_NEAR(jump.height(), kTall - kGravity / 2, 0.1);
}

}  // namespace
}  // namespace swept::test

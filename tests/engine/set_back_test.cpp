#include <swept/engine/flight/set_back.h>

#include "../support/random.h"
#include "world_support.h"

/// What a flyer fell through between two impacts of a step, and how that is paid back.

namespace swept::test {
namespace {

double armTo(const LowPoint& point) { return static_cast<double>(point.arm); }
double depthOf(const LowPoint& point) { return static_cast<double>(point.depth); }

/// How far a point is above where it is to be afterwards, metres.
double leftOf(const LowPoint& point, const SetBack& back) {
    return static_cast<double>(back.along) + armTo(point) * static_cast<double>(back.turn) - depthOf(point);
}

/// A rod of 2 m and 3 kg on one end: the centre rises by a quarter of what the end does, since a push at the end moves
/// the end by 1/m + 1²/(m/3) = 4/m.
TEST(SetBack, OneEndOfARod) {
    const LowPoint end{.arm = 1, .depth = real(0.004)};
    const SetBack back = setBackOf({end, end}, {.inverseMass = real(1.0 / 3), .inverseInertia = 1}, 1);
    EXPECT_NEAR(static_cast<double>(back.along), 0.001, 1e-8);
    EXPECT_NEAR(static_cast<double>(back.turn), 0.003, 1e-8);
}

/// Whatever lies flush rises as it is, and what cannot turn does.
TEST(SetBack, WithoutATurn) {
    const LowPoint left{.arm = -1, .depth = real(0.25)};
    const LowPoint right{.arm = 1, .depth = real(0.25)};
    const SetBack flush = setBackOf({left, right}, {.inverseMass = 2, .inverseInertia = 5}, 1);
    EXPECT_NEAR(static_cast<double>(flush.along), 0.25, 1e-7);
    EXPECT_NEAR(static_cast<double>(flush.turn), 0, 1e-7);
    const SetBack stiff = setBackOf({left, LowPoint{.arm = 1, .depth = real(0.5)}}, {.inverseMass = 2}, 1);
    EXPECT_EQ(stiff.along, real(0.5));
    EXPECT_EQ(stiff.turn, 0);
}

/// Of all displacements that raise both points the one of least m·along² + I·turn²: it is a sum of pushes (not pulls)
/// at those points that are not above where they are to be, and these conditions hold for no other one.
TEST(SetBack, IsTheLeastThatRaisesBothPoints) {
    constexpr double kRounding = kIsDouble ? 1e-12 : 2e-4;
    Random random(31);
    for (int i = 0; i < 20'000; ++i) {
        const double mass = std::exp(random.range(-5, 5));
        const double radius = std::exp(random.range(-3, 1));  // of gyration
        std::array<LowPoint, 2> points{};
        for (LowPoint& point : points) {
            point.arm = real(random.range(-1, 1));
            point.depth = real(random.range(-0.5, 1));
        }
        if (std::abs(armTo(points[0]) - armTo(points[1])) < 0.1) { continue; }  // as good as one
        const SetBack back =
            setBackOf(points, {.inverseMass = real(1 / mass), .inverseInertia = real(1 / (mass * radius * radius))}, 0);
        const double along = static_cast<double>(back.along);
        const double push = radius * radius * static_cast<double>(back.turn);
        const double second = (push - armTo(points[0]) * along) / (armTo(points[1]) - armTo(points[0]));
        const std::array<double, 2> pushes{along - second, second};
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double limit = kRounding * (1 + 1 / (radius * radius));
            EXPECT_GE(leftOf(points[k], back), -limit) << "seed 31, case " << i;
            EXPECT_GE(pushes[k], -limit) << "seed 31, case " << i;
            EXPECT_LE(std::min(pushes[k], leftOf(points[k], back)), limit) << "seed 31, case " << i;
        }
    }
}

/// A heavy head with a light ball on a lever of fifty times its radius of gyration, on that ball: to raise it by a push
/// would turn the lever as far as the ball is deep, and a lever that is nearly upright by many times that.
TEST(SetBack, WithoutATurnThatReachesFar) {
    const BodyInertia inertia{.inverseMass = 1, .inverseInertia = 2500};
    const auto backOf = [&](double arm) {
        const LowPoint ball{.arm = real(arm), .depth = real(0.01)};
        return setBackOf({ball, ball}, inertia, real(1.25));
    };
    const SetBack level = backOf(1);
    EXPECT_EQ(level.arm, 0);
    EXPECT_NEAR(static_cast<double>(level.turn), 0.01, 1e-5);
    const SetBack upright = backOf(0.02);
    EXPECT_EQ(upright.arm, real(0.02));
    EXPECT_EQ(upright.turn, 0);
    EXPECT_EQ(upright.along, real(0.01));
}

/// An elastic bounce loses as much energy as raising the body by the displacement takes, or all of the approach.
TEST(SetBack, IsPaidByTheBounce) {
    Random random(5);
    int stopped = 0;
    int raised = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double mass = std::exp(random.range(-5, 5));
        const double inertia = mass * std::exp(random.range(-4, 2));
        const double arm = random.range(-1, 1);
        const double depth = random.range(0.01, 1);
        const double pull = random.range(0.1, 20);
        const double velocity = random.range(-10, 5);
        const double spin = random.range(-10, 10);
        const double approach = -(velocity + arm * spin);
        if (approach < 0.01) { continue; }
        const LowPoint point{.arm = real(arm), .depth = real(depth)};
        const BodyInertia inverse{.inverseMass = real(1 / mass), .inverseInertia = real(1 / inertia)};
        const SetBack back = setBackOf({point, point}, inverse, real(random.range(0, 3)));
        raised += back.arm != 0 ? 1 : 0;
        const double left = static_cast<double>(
            speedLeft(back, {.pull = real(pull), .velocity = real(velocity), .spin = real(spin)}, inverse));
        const double ofPoint = 1 / (1 / mass + arm * arm / inertia);
        const double paid = 0.5 * ofPoint * approach * approach * (1 - left * left);
        const double cost = mass * pull * static_cast<double>(back.along);
        EXPECT_GE(left, 0) << "seed 5, case " << i;
        EXPECT_LE(left, 1) << "seed 5, case " << i;
        const double rounding = (kIsDouble ? 1e-9 : 1e-3) * (cost + 0.5 * ofPoint * approach * approach);
        if (left > 0) {
            EXPECT_NEAR(paid, cost, rounding) << "seed 5, case " << i;
        } else {
            EXPECT_LE(paid, cost + rounding) << "seed 5, case " << i;
            ++stopped;
        }
    }
    EXPECT_GT(raised, 100);
    EXPECT_GT(stopped, 1000);
    EXPECT_LT(stopped, 15'000);
}

/// What leaves, or is pulled away, has nothing to pay.
TEST(SetBack, IsFreeForWhatLeaves) {
    const SetBack back{.along = real(0.5)};
    const BodyInertia inertia{.inverseMass = 1, .inverseInertia = 1};
    EXPECT_EQ(speedLeft(back, {.pull = 10, .velocity = 1}, inertia), 1);
    EXPECT_EQ(speedLeft(back, {.pull = -10, .velocity = -1}, inertia), 1);
    EXPECT_EQ(speedLeft(back, {.pull = 0, .velocity = -1}, inertia), 1);
    EXPECT_EQ(speedLeft({}, {.pull = 10, .velocity = -1}, inertia), 1);
    EXPECT_NEAR(static_cast<double>(speedLeft(back, {.pull = 9, .velocity = -5}, inertia)), 0.8, 1e-6) << "25 − 9";
}

/// A box that bounces down on a slope that it does not slide on comes to rest, however short the steps are. Raised
/// without a turn it hopped on from corner to corner for ever in tiny bounces (at 240 Hz, 16 to 40 of 40).
TEST(SetBack, BoxesWithRestitutionComeToRestOnASlope) {
    for (const double rate : {60.0, 240.0, 960.0}) {
        for (const double slope : {0.183, 0.3}) {
            for (const double restitution : {0.3, 0.5}) {
                Random random(7);
                for (int i = 0; i < 4; ++i) {
                    World world = makeWorld();
                    addStatic(world, segment(-100, 0, 100, 0), material(0.6), {}, slope);
                    BodyDef def = dynamicAt({0, random.range(0.3, 1)});
                    def.angle = random.range(-3, 3);
                    def.velocity = vec(random.range(-3, 3), 0);
                    def.angularVelocity = real(random.range(-5, 5));
                    const BodyId body = addBody(world, def, box(0.111, 0.111), material(0.6, restitution));
                    runFor(world, 15, 1 / rate);
                    const DVec2 before = world.position(body);
                    runFor(world, 1, 1 / rate);
                    const double way = length(world.position(body) - before);
                    EXPECT_LT(way, kIsDouble ? 1e-6 : 1e-5)
                        << rate << " Hz, slope " << slope << ", restitution " << restitution << ", seed 7, case " << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <swept/toi/toi_method.h>

#include "query_parts.h"

/// Each method on cases small enough to see: where it is right, and where it must be wrong.

namespace swept::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTarget = 0.01;
constexpr double kMethodTolerance = 0.0001;

ToiPolygon box(double halfWidth, double halfHeight) {
    return {{DVec2{-halfWidth, -halfHeight}, DVec2{halfWidth, -halfHeight}, DVec2{halfWidth, halfHeight},
             DVec2{-halfWidth, halfHeight}},
            4,
            0};
}

Sweep resting(DVec2 center) {
    Sweep sweep;
    sweep.c0 = sweep.c1 = center;
    return sweep;
}

Sweep moving(DVec2 from, DVec2 to) {
    Sweep sweep;
    sweep.c0 = from;
    sweep.c1 = to;
    return sweep;
}

Sweep turning(Sweep sweep, double from, double to) {
    sweep.a0 = from;
    sweep.a1 = to;
    return sweep;
}

ToiSettings settings() { return {kTarget, kMethodTolerance, 1}; }

/// A wall 0.2 thick at the origin; a ball of radius ¼ flies through it from x = −2.
Query ballThroughWall(double to) {
    return {box(0.1, 1), resting({0, 0}), circle(0.25), moving({-2, 0}, {to, 0}), settings()};
}

/// A bar of length 2 turns by half a turn, 0.3 above the ground: level at both ends, upright and 0.7 deep in the
/// middle.
Query dippingBar() {
    return {box(5, 1), resting({0, -1}), box(1, 0.05), turning(resting({0, 0.3}), 0, kPi), settings()};
}

void expectImpact(const Query& q, ToiMethod method, double fraction, double within) {
    const Toi toi = by(method, q);
    EXPECT_EQ(toi.state, ToiState::hit) << nameOf(method);
    EXPECT_NEAR(toi.fraction, fraction, within) << nameOf(method);
    EXPECT_NEAR(toi.separation, static_cast<double>(trueSeparation(q, toi.fraction)), 1e-12) << nameOf(method);
}

void expectSeparated(const Query& q, ToiMethod method) {
    const Toi toi = by(method, q);
    EXPECT_EQ(toi.state, ToiState::separated) << nameOf(method);
    EXPECT_EQ(toi.fraction, q.settings.tMax) << nameOf(method);
}

TEST(ToiMethods, HaveNamesBothWays) {
    for (const ToiMethodInfo& info : kToiMethods) {
        EXPECT_EQ(nameOf(info.method), info.name);
        EXPECT_EQ(toiMethodFrom(info.name), info.method);
        EXPECT_EQ(describe(info.method), info.description);
        EXPECT_FALSE(info.description.empty());
        EXPECT_EQ(info.description.find('\n'), std::string_view::npos);
    }
    EXPECT_EQ(toiMethodFrom("magic"), std::nullopt);
    EXPECT_EQ(toiMethodFrom(""), std::nullopt);
}

TEST(ToiMethods, AgreeOnABallThatMeetsAWall) {
    // The gap of 2 − 0.1 − 0.25 shrinks to the target on a way of 4.
    const double expected = (1.65 - kTarget) / 4;
    for (const ToiMethodInfo& info : kToiMethods) {
        if (info.method == ToiMethod::discrete) { continue; }
        expectImpact(ballThroughWall(2), info.method, expected, kMethodTolerance / 4);
    }
}

TEST(ToiMethods, AgreeOnAThrownBall) {
    // Height above the target: 0.39 at the start, 0.09 at the end, and a sag of 4·t·(t − 1) between.
    Query q{box(5, 1), resting({0, -1}), circle(0.1), moving({0, 0.5}, {1, 0.2}), settings()};
    q.sweepB.k = {0, 4};
    const double expected = (4.3 - std::sqrt(4.3 * 4.3 - 16 * 0.39)) / 8;
    for (const ToiMethod method :
         {ToiMethod::shapeCast, ToiMethod::conservativeAdvancement, ToiMethod::bruteForce, ToiMethod::certified}) {
        expectImpact(q, method, expected, kMethodTolerance / 2);
    }
    // It comes up again: the end is above the ground, and so is the chord that a ray takes.
    for (const ToiMethod method : {ToiMethod::discrete, ToiMethod::rayCast, ToiMethod::separatingAxisRoot}) {
        expectSeparated(q, method);
    }
}

TEST(ToiMethods, AgreeOnABarThatTurnsDown) {
    // The lower corner of the bar's end, (1, −0.05) from the centre, comes down to the target on a quarter turn.
    Query q = dippingBar();
    q.sweepB.a1 = -kPi / 2;
    const double reach = std::hypot(1, 0.05);
    const double expected = (std::asin((0.3 - kTarget) / reach) - std::asin(0.05 / reach)) / (kPi / 2);
    for (const ToiMethod method : {ToiMethod::conservativeAdvancement, ToiMethod::bruteForce,
                                   ToiMethod::separatingAxisRoot, ToiMethod::certified}) {
        expectImpact(q, method, expected, 1.1 * kMethodTolerance / (0.9 * kPi / 2));
    }
    EXPECT_NEAR(by(ToiMethod::bruteForce, q).fraction, expected, 1e-14);
}

TEST(ToiMethods, DiscreteTunnelsAndSinksIn) {
    expectSeparated(ballThroughWall(2), ToiMethod::discrete);
    const Toi sunk = by(ToiMethod::discrete, ballThroughWall(-0.1));
    EXPECT_EQ(sunk.state, ToiState::hit);
    EXPECT_EQ(sunk.fraction, 1);
    EXPECT_NEAR(sunk.separation, -0.25, 1e-12);  // the centre stands on the wall's face
}

TEST(ToiMethods, RayCastMissesWideShapesAndComesLate) {
    // Two bars whose ends overlap, while neither's middle meets the other.
    const Query ends{box(1, 0.1), resting({0, 0}), box(1, 0.1), moving({1.5, 2}, {1.5, -2}), settings()};
    expectSeparated(ends, ToiMethod::rayCast);
    expectImpact(ends, ToiMethod::certified, (1.8 - kTarget) / 4, kMethodTolerance);

    const Query boxes{box(0.5, 0.5), resting({0, 0}), box(0.5, 0.5), moving({-2, 0}, {2, 0}), settings()};
    const Toi late = by(ToiMethod::rayCast, boxes);
    EXPECT_EQ(late.state, ToiState::hit);
    EXPECT_NEAR(late.separation, kTarget - 0.5, 1e-12);  // by half the width
}

TEST(ToiMethods, RayCastLooksFromBothMiddles) {
    // A bar comes down with its end on a ball: its own middle misses, but the ball's middle meets the bar; and swapped.
    const Query q{circle(0.2), resting({0.8, 0}), box(1, 0.1), moving({0, 2}, {0, -2}), settings()};
    const double expected = (2 - 0.3 - kTarget) / 4;
    expectImpact(q, ToiMethod::rayCast, expected, 1e-12);
    expectImpact({q.b, q.sweepB, q.a, q.sweepA, q.settings}, ToiMethod::rayCast, expected, 1e-12);
}

TEST(ToiMethods, RayCastOfABodyThatRests) {
    expectSeparated({box(1, 1), resting({0, 0}), circle(0.5), resting({2, 0}), settings()}, ToiMethod::rayCast);
    expectImpact({box(1, 1), resting({0, 0}), circle(0.5), resting({1.4, 0}), settings()}, ToiMethod::rayCast, 0, 0);
}

TEST(ToiMethods, ShapeCastIgnoresRotation) {
    expectSeparated(dippingBar(), ToiMethod::shapeCast);
    // An upright bar falls down flat while it passes by: the cast hits what has turned away.
    const Query away{circle(0.1), resting({0.5, 0}), box(0.1, 1), turning(moving({-2, 1.05}, {2, 1.05}), 0, kPi / 2),
                     settings()};
    EXPECT_EQ(by(ToiMethod::shapeCast, away).state, ToiState::hit);
    expectSeparated(away, ToiMethod::certified);
}

TEST(ToiMethods, SeparatingAxisRootMissesTheDippingVertex) {
    const Query q = dippingBar();
    EXPECT_LT(trueSeparation(q, 0.5), -0.6L);
    expectSeparated(q, ToiMethod::separatingAxisRoot);
    for (const ToiMethod method : {ToiMethod::conservativeAdvancement, ToiMethod::bruteForce, ToiMethod::certified}) {
        const Toi toi = by(method, q);
        EXPECT_EQ(toi.state, ToiState::hit) << nameOf(method);
        EXPECT_LT(toi.fraction, 0.1) << nameOf(method);
    }
}

TEST(ToiMethods, SeparatingAxisRootHoldsTheAxisInTheBodyWhoseEdgeIsClosest) {
    // In the bar's own frame its face stands still, whichever of the two the bar is.
    const Query barIsB{circle(0.2), resting({0.7, -0.5}), box(1, 0.05), turning(resting({0, 0.3}), 0, -1.5),
                       settings()};
    const Query barIsA{barIsB.b, barIsB.sweepB, barIsB.a, barIsB.sweepA, barIsB.settings};
    const Toi b = by(ToiMethod::separatingAxisRoot, barIsB);
    const Toi a = by(ToiMethod::separatingAxisRoot, barIsA);
    EXPECT_EQ(b.state, ToiState::hit);
    EXPECT_NEAR(b.fraction, a.fraction, 1e-12);
    EXPECT_EQ(b.iterations, a.iterations);
}

TEST(ToiMethods, SpeculativeStopsAtGhosts) {
    // A ball flies along above a platform that begins at x = 0. From where it starts, the platform's corner is nearly
    // straight ahead, and the constraint takes the corner for a wall.
    const Query q{box(5, 1), resting({5, -1}), circle(0.25), moving({-2, 0.5}, {2, 0.5}), settings()};
    expectSeparated(q, ToiMethod::certified);
    const Toi ghost = by(ToiMethod::speculative, q);
    EXPECT_EQ(ghost.state, ToiState::hit);
    EXPECT_GT(ghost.separation, 0.2);  // it leaves the ball in mid-air
    // |(2, 0.5)| − ¼ − target, used up at a speed of 4·cos of the slope
    const double distance = std::hypot(2, 0.5);
    EXPECT_NEAR(ghost.fraction, (distance - 0.25 - kTarget) / (4 * 2 / distance), 1e-12);
}

TEST(ToiMethods, SpeculativeSeesTheTurningOfTheClosestPoint) {
    // The corner next to the ground moves down at once, at its distance from the centre times the spin.
    Query q{box(5, 1), resting({0, -1}), box(1, 0.05), turning(resting({0, 0.3}), -0.1, -1.1), settings()};
    const double height = 0.3 - std::sin(0.1) - 0.05 * std::cos(0.1);
    const double speed = std::cos(0.1) - 0.05 * std::sin(0.1);
    expectImpact(q, ToiMethod::speculative, (height - kTarget) / speed, 1e-12);
}

TEST(ToiMethods, SpeculativeMissesWhatTurnsIn) { expectSeparated(dippingBar(), ToiMethod::speculative); }

TEST(ToiMethods, StartTheSameWay) {
    const Query touching{box(1, 1), resting({0, 0}), box(1, 1), moving({2.005, 0}, {3, 0}), settings()};
    const Query overlapping{box(1, 1), resting({0, 0}), box(1, 1), moving({1.5, 0}, {3, 0}), settings()};
    const Query radiiOnly{circle(1), resting({0, 0}), circle(1), moving({1.5, 0}, {3, 0}), settings()};
    for (const ToiMethodInfo& info : kToiMethods) {
        if (info.method == ToiMethod::discrete || info.method == ToiMethod::rayCast) { continue; }
        expectImpact(touching, info.method, 0, 0);
        expectImpact(radiiOnly, info.method, 0, 0);
        const Toi toi = by(info.method, overlapping);
        EXPECT_EQ(toi.state, ToiState::overlapped) << info.name;
        EXPECT_EQ(toi.fraction, 0) << info.name;
        EXPECT_NEAR(toi.separation, -0.5, 1e-12) << info.name;
    }
}

/// The target is that of the settings; a bracket holds the hit, and is said to be none where a method has none.
TEST(ToiMethods, TellTheirTargetAndBracket) {
    const Query overlapping{box(1, 1), resting({0, 0}), box(1, 1), moving({1.5, 0}, {3, 0}), settings()};
    const Query touching{box(1, 1), resting({0, 0}), box(1, 1), moving({2.005, 0}, {3, 0}), settings()};
    Query turningDown = dippingBar();
    turningDown.sweepB.a1 = -kPi / 2;
    for (const Query& q : {ballThroughWall(2), ballThroughWall(-1), turningDown, overlapping, touching}) {
        for (const ToiMethodInfo& info : kToiMethods) {
            const Toi toi = by(info.method, q);
            const bool hasBracket = info.method != ToiMethod::discrete && info.method != ToiMethod::rayCast &&
                                    info.method != ToiMethod::speculative;
            EXPECT_EQ(toi.target, kTarget) << info.name;
            if (hasBracket && toi.state == ToiState::hit && toi.fraction > 0) {
                EXPECT_LT(toi.fractionLower, toi.fraction) << info.name;
                EXPECT_GT(toi.separationLower, kTarget) << info.name;
                const bool isOfWholeMotion = info.method != ToiMethod::shapeCast || q.sweepB.a1 == q.sweepB.a0;
                const double there = static_cast<double>(trueSeparation(q, toi.fractionLower));
                if (isOfWholeMotion) { EXPECT_GE(there, toi.separationLower - 1e-12) << info.name; }
            } else {
                EXPECT_EQ(toi.fractionLower, toi.fraction) << info.name;
                EXPECT_EQ(toi.separationLower, toi.separation) << info.name;
            }
        }
    }
}

TEST(ToiMethods, StopAtTMax) {
    for (const ToiMethodInfo& info : kToiMethods) {
        Query q = ballThroughWall(2);
        q.settings.tMax = 0.375;
        expectSeparated(q, info.method);
        EXPECT_NEAR(by(info.method, q).separation, 0.15, 1e-12) << info.name;
    }
}

}  // namespace
}  // namespace swept::test

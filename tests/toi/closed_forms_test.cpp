#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../support/random.h"
#include "query_parts.h"

/// Impacts whose time can be written down. With a tolerance of a few roundings the answer must agree to many digits.

namespace swept::test {
namespace {

constexpr double kTolerance = 1e-12;

/// A box whose upper face is the x axis, wide enough to stand for a half-plane.
ToiPolygon ground() { return {{DVec2{-50, -1}, DVec2{50, -1}, DVec2{50, 0}, DVec2{-50, 0}}, 4, 0}; }

ToiSettings settings(double target) {
    ToiSettings result;
    result.target = target;
    result.tolerance = kTolerance;
    return result;
}

TEST(ToiClosedForm, CircleMeetsCircle) {
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        Query q{circle(random.range(0, 0.5)), {}, circle(random.range(0.1, 0.5)), {}, settings(0.01)};
        q.sweepA.c0 = {random.range(-3, 3), random.range(-3, 3)};
        q.sweepA.c1 = {random.range(-3, 3), random.range(-3, 3)};
        q.sweepB.c0 = {random.range(-3, 3), random.range(-3, 3)};
        q.sweepB.c1 = {random.range(-3, 3), random.range(-3, 3)};
        q.sweepA.a1 = random.range(-9, 9);  // circles turn about their centres: no matter
        // |d + t v| = level
        const DVec2 d = q.sweepB.c0 - q.sweepA.c0;
        const DVec2 v = (q.sweepB.c1 - q.sweepA.c1) - d;
        const double level = q.a.radius + q.b.radius + 0.01;
        if (length(d) < level + 0.01) { continue; }
        const double discriminant = dot(d, v) * dot(d, v) - dot(v, v) * (dot(d, d) - level * level);
        if (std::fabs(discriminant) < 1e-3) { continue; }  // grazing: the time is ill-conditioned
        const double t = discriminant > 0 ? (-dot(d, v) - std::sqrt(discriminant)) / dot(v, v) : 2;
        if (std::fabs(t - 1) < 1e-9) { continue; }
        const bool meets = t > 0 && t < 1;
        const Toi toi = ask(q);
        ASSERT_EQ(toi.state, meets ? ToiState::hit : ToiState::separated) << "seed " << seed << q;
        ASSERT_NEAR(toi.fraction, meets ? t : 1, 1e-10) << "seed " << seed << q;
        hits += meets ? 1 : 0;
    }
    EXPECT_GT(hits, 200);
}

TEST(ToiClosedForm, ThrownBallLandsOnItsParabola) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const double radius = random.range(0.1, 0.5);
        const double height = random.range(0.02, 0.5);  // above the level at which it counts as touching
        const double rise = random.range(-1, 1);
        const double k = -random.range(3, 9);  // gravity: the centre stands at y0 + t·rise + t(t − 1)·k
        const double target = 0.001;
        Query q{ground(), {}, circle(radius), {}, settings(target)};
        q.sweepB.c0 = {random.range(-5, 5), radius + target + height};
        q.sweepB.c1 = q.sweepB.c0 + DVec2{random.range(-5, 5), rise};
        q.sweepB.k = {0, k};
        // height + t (rise − k) + t² k = 0
        const double b = rise - k;
        const double t = (b + std::sqrt(b * b - 4 * height * k)) / (-2 * k);
        if (t > 1) { continue; }
        for (const Toi& toi : {ask(q), askCast(q)}) {
            ASSERT_EQ(toi.state, ToiState::hit) << "seed " << seed << q;
            ASSERT_NEAR(toi.fraction, t, 1e-10) << "seed " << seed << q;
            ASSERT_LE(toi.iterations, 4) << "the bound is the motion itself";
            ASSERT_NEAR(toi.normal.y, 1, 1e-12);
            ASSERT_NEAR(toi.pointA.y, 0, 1e-9);
            ASSERT_NEAR(toi.pointB.y, target, 1e-9);
        }
    }
}

TEST(ToiClosedForm, DippingBallTurnsBackInTime) {
    // The bound bends upward here: the centre comes nearest half-way, by a quarter of k, and returns.
    for (const double gap : {0.26, 0.2501, 0.2499, 0.24, 0.1}) {
        Query q{ground(), {}, circle(0.1), {}, settings(0)};
        q.sweepB.c0 = {0, 0.1 + gap};
        q.sweepB.c1 = q.sweepB.c0;
        q.sweepB.k = {0, 1};  // dips by t (1 − t), at most 1/4
        const Toi toi = ask(q);
        if (gap > 0.25) {
            EXPECT_EQ(toi.state, ToiState::separated) << gap;
        } else {
            EXPECT_EQ(toi.state, ToiState::hit) << gap;
            EXPECT_NEAR(toi.fraction, 0.5 - std::sqrt(0.25 - gap), 1e-9) << gap;
        }
        EXPECT_LE(toi.iterations, 5);
    }
}

TEST(ToiClosedForm, SpinningBarReachesThePin) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const double pinRadius = random.range(0, 0.05);
        const double target = 0.002;
        const double distance = random.range(0.3, 0.95);
        const double pinAngle = random.range(0.3, 3.0);  // where the pin stands, seen from the bar's centre
        const double turns = random.range(1, 30) * random.sign();
        Query q;
        q.a = {{DVec2{-1, 0}, DVec2{1, 0}}, 2, 0};
        q.b = circle(pinRadius);
        q.settings = settings(target);
        q.sweepA.c0 = q.sweepA.c1 = {random.range(-1e3, 1e3), random.range(-1e3, 1e3)};
        q.sweepA.a1 = turns;
        q.sweepB.c0 = q.sweepB.c1 = q.sweepA.c0 + DVec2{distance * std::cos(pinAngle), distance * std::sin(pinAngle)};
        // As rounded: the pin's place relative to the centre.
        const DVec2 pin = q.sweepB.c0 - q.sweepA.c0;
        const double touching = std::asin((pinRadius + target) / length(pin));  // angle between bar and pin's direction
        const double direction = std::atan2(pin.y, pin.x);
        const double turn = turns > 0 ? direction - touching : std::numbers::pi - direction - touching;
        const double t = turn / std::fabs(turns);
        const Toi toi = ask(q);
        if (turn < 1e-3 || std::fabs(t - 1) < 1e-6) { continue; }
        ASSERT_EQ(toi.state, t < 1 ? ToiState::hit : ToiState::separated) << "seed " << seed << q;
        if (t < 1) { ASSERT_NEAR(toi.fraction, t, 1e-10) << "seed " << seed << q; }
    }
}

TEST(ToiClosedForm, BulletStopsAtTheWall) {
    // A bullet of a centimetre crosses a wall of a millimetre at a kilometre a step.
    Query q;
    q.a = {{DVec2{-0.0005, -5}, DVec2{0.0005, -5}, DVec2{0.0005, 5}, DVec2{-0.0005, 5}}, 4, 0};
    q.b = circle(0.005);
    q.sweepB.c0 = {-500, 0.25};
    q.sweepB.c1 = {500, 0.25};
    q.sweepB.a1 = 30;
    q.settings = defaultToiSettings(q.a, q.b);
    const double gap = 500 - 0.0005 - 0.005 - q.settings.target;
    for (const Toi& toi : {ask(q), askCast(q)}) {
        ASSERT_EQ(toi.state, ToiState::hit);
        EXPECT_NEAR(toi.fraction, gap / 1000, q.settings.tolerance / 1000);
        EXPECT_NEAR(toi.normal.x, -1, 1e-9);
    }
}

}  // namespace
}  // namespace swept::test

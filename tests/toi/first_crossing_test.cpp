#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "../oracle/first_crossing.h"
#include "../support/random.h"
#include "measured_cases.h"
#include "query_parts.h"

/// The interval oracle itself, against times that can be written down and against the measured cases.

namespace swept::test {
namespace {

using oracle::Crossing;
using oracle::CrossingState;
using oracle::MovingPair;
using Long = long double;

constexpr oracle::CrossingSettings kFine{1e-12, 20'000};

Crossing cross(const Query& q, double level) {
    return firstCrossing(MovingPair(q.a, q.sweepA, q.b, q.sweepB), level, 0, 1, kFine);
}

/// Checks a crossing against the known time of the first one, above 1 for none.
void expectAt(const Crossing& crossing, Long time, const Query& q) {
    if (time > 1) {
        ASSERT_EQ(crossing.state, CrossingState::none) << static_cast<double>(time) << q;
        return;
    }
    ASSERT_EQ(crossing.state, CrossingState::found) << static_cast<double>(time) << q;
    ASSERT_LE(crossing.hi - crossing.lo, kFine.resolution) << q;
    ASSERT_LE(crossing.lo, time + 1e-14L) << q;
    ASSERT_GE(crossing.hi, time - 1e-14L) << q;
}

TEST(FirstCrossing, OfTwoCircles) {
    int found = 0;
    int none = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        Query q{circle(random.range(0, 0.5)), {}, circle(random.range(0.1, 0.5)), {}, {}};
        for (Sweep* sweep : {&q.sweepA, &q.sweepB}) {
            sweep->c0 = {random.range(-3, 3), random.range(-3, 3)};
            sweep->c1 = {random.range(-3, 3), random.range(-3, 3)};
            sweep->a1 = random.range(-9, 9);
        }
        const double level = random.range(-0.1, 0.1);
        // |d + t v| = reach
        const Long dx = static_cast<Long>(q.sweepB.c0.x) - q.sweepA.c0.x;
        const Long dy = static_cast<Long>(q.sweepB.c0.y) - q.sweepA.c0.y;
        const Long vx = static_cast<Long>(q.sweepB.c1.x) - q.sweepA.c1.x - dx;
        const Long vy = static_cast<Long>(q.sweepB.c1.y) - q.sweepA.c1.y - dy;
        const Long reach = static_cast<Long>(q.a.radius) + q.b.radius + level;
        const Long approach = dx * vx + dy * vy;
        const Long speed = vx * vx + vy * vy;
        const Long apart = dx * dx + dy * dy - reach * reach;
        const Long discriminant = approach * approach - speed * apart;
        if (reach <= 0 || std::fabs(discriminant) < 1e-4L || std::fabs(apart) < 1e-6L) { continue; }
        Long time = discriminant > 0 ? (-approach - std::sqrt(discriminant)) / speed : 2;
        if (apart <= 0) { time = 0; }
        if (time < 0) { time = 2; }
        if (std::fabs(time - 1) < 1e-9L) { continue; }
        expectAt(cross(q, level), time, q);
        if (HasFatalFailure()) { return; }
        (time > 1 ? none : found) += 1;
    }
    EXPECT_GT(found, 400);
    EXPECT_GT(none, 400);
}

TEST(FirstCrossing, OfACircleOnAParabolaWithAHalfPlane) {
    int found = 0;
    int none = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const double tilt = random.range(0, 6);
        Query q;
        q.a = {{DVec2{-90, -1}, DVec2{90, -1}, DVec2{90, 0}, DVec2{-90, 0}}, 4, 0};  // its upper face is the plane
        q.b = circle(random.range(0.1, 0.5));
        q.sweepB.c0 = {random.range(-5, 5), q.b.radius + random.range(0.05, 1)};
        q.sweepB.c1 = {random.range(-5, 5), q.b.radius + random.range(-1, 1)};
        q.sweepB.k = {random.range(-2, 2), random.range(-6, 6)};
        q.sweepB.a1 = tilt;
        const double level = random.range(-0.02, 0.02);
        // y0 + t (y1 − y0 − k) + t² k = radius + level
        const Long k = q.sweepB.k.y;
        const Long constant = static_cast<Long>(q.sweepB.c0.y) - q.b.radius - level;
        const Long slope = static_cast<Long>(q.sweepB.c1.y) - q.sweepB.c0.y - k;
        const Long discriminant = slope * slope - 4 * k * constant;
        if (std::fabs(discriminant) < 1e-4L || std::fabs(k) < 1e-3L) { continue; }
        Long time = 2;
        if (discriminant > 0) {
            const Long root = std::sqrt(discriminant);
            for (const Long t : {(-slope - root) / (2 * k), (-slope + root) / (2 * k)}) {
                if (t > 0 && t < time) { time = t; }
            }
        }
        if (std::fabs(time - 1) < 1e-9L) { continue; }
        expectAt(cross(q, level), time, q);
        if (HasFatalFailure()) { return; }
        (time > 1 ? none : found) += 1;
    }
    EXPECT_GT(found, 400);
    EXPECT_GT(none, 400);
}

TEST(FirstCrossing, OfATurningBarWithAPin) {
    int found = 0;
    int none = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const double turns = random.range(0.5, random.chance(0.2) ? 60 : 4) * random.sign();
        const double pinAngle = random.range(0.3, 2.8);
        const double distance = random.range(0.3, 0.95);
        Query q;
        q.a = {{DVec2{-1, 0}, DVec2{1, 0}}, 2, 0};
        q.b = circle(random.range(0, 0.05));
        q.sweepA.c0 = q.sweepA.c1 = {random.range(-1e3, 1e3), random.range(-1e3, 1e3)};
        q.sweepA.a1 = turns;
        q.sweepB.c0 = q.sweepB.c1 = q.sweepA.c0 + DVec2{distance * std::cos(pinAngle), distance * std::sin(pinAngle)};
        const double level = random.range(0, 0.01);
        const Long x = static_cast<Long>(q.sweepB.c0.x) - q.sweepA.c0.x;
        const Long y = static_cast<Long>(q.sweepB.c0.y) - q.sweepA.c0.y;
        const Long touching = std::asin((static_cast<Long>(q.b.radius) + level) / std::sqrt(x * x + y * y));
        const Long pin = std::atan2(y, x);
        const Long turn = turns > 0 ? pin - touching : std::numbers::pi_v<Long> - pin - touching;
        const Long time = turn / std::fabs(turns);
        if (std::fabs(time - 1) < 1e-9L) { continue; }
        if (random.chance(0.5)) {
            std::swap(q.a, q.b);
            std::swap(q.sweepA, q.sweepB);
        }
        expectAt(cross(q, level), time, q);
        if (HasFatalFailure()) { return; }
        (time > 1 ? none : found) += 1;
    }
    EXPECT_GT(found, 400);
    EXPECT_GT(none, 100);
}

/// A bar mixes its rotation from 0 to `turn` and meets a pin on the way, seen from a frame that is turned by `tilt`.
/// The mixed vector runs along a chord: half of it lies tan(turn/2) from the middle, so the bar is at the angle φ when
/// tan(φ − turn/2) = (2t − 1) tan(turn/2).
TEST(FirstCrossing, OfABarThatMixesItsRotationsWithAPin) {
    int found = 0;
    int none = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const double turn = random.range(0.3, 3.1) * random.sign();
        const double tilt = random.range(-3, 3);
        const double pin = turn * random.range(-0.2, 1.2) + tilt;
        const double distance = random.range(0.3, 0.95);
        Query q;
        q.a = {{DVec2{0, 0}, DVec2{1, 0}}, 2, 0};
        q.b = circle(random.range(0.001, 0.05));
        q.sweepB.c0 = q.sweepB.c1 = {distance * std::cos(pin), distance * std::sin(pin)};
        const oracle::PlainVec from{std::cos(tilt), std::sin(tilt)};
        const oracle::PlainVec to{std::cos(tilt + turn), std::sin(tilt + turn)};
        const Long x = q.sweepB.c0.x;
        const Long y = q.sweepB.c0.y;
        const Long touching = std::asin(static_cast<Long>(q.b.radius) / std::sqrt(x * x + y * y));
        // From `from` to the pin, the way the bar turns.
        const Long start = std::atan2(static_cast<Long>(from.x) * y - from.y * x, from.x * x + from.y * y);
        const Long whole = std::atan2(static_cast<Long>(from.x) * to.y - from.y * to.x,
                                      static_cast<Long>(from.x) * to.x + static_cast<Long>(from.y) * to.y);
        const Long angle = (turn > 0 ? start : -start) - touching;
        const Long half = std::fabs(whole) / 2;
        if (std::fabs(angle) < 1e-6L || std::fabs(angle - 2 * half) < 1e-6L || angle < -2) { continue; }
        Long time = (1 + std::tan(angle - half) / std::tan(half)) / 2;
        if (angle > 2 * half || angle < 0) { time = 2; }
        if (angle < 0 && angle > -2 * touching) { time = 0; }  // the pin is in the bar
        const auto mixed = oracle::Turning::mixed(from, to);
        const auto still = oracle::Turning::steady(0, 0);
        const bool swapped = random.chance(0.5);
        const MovingPair pair = swapped ? MovingPair(q.b, q.sweepB, still, q.a, q.sweepA, mixed)
                                        : MovingPair(q.a, q.sweepA, mixed, q.b, q.sweepB, still);
        expectAt(firstCrossing(pair, 0, 0, 1, kFine), time, q);
        if (HasFatalFailure()) { return; }
        (time > 1 ? none : found) += 1;
    }
    EXPECT_GT(found, 400);
    EXPECT_GT(none, 50);
}

/// Both bodies mix: where the oracle says free, dense samples of the normalised mixture stay above; where it says
/// crossed, the sample there is below.
TEST(FirstCrossing, OfMixedRotationsAgreesWithSamples) {
    int found = 0;
    int none = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const auto direction = [&random] {
            const double angle = random.range(0, 7);
            return oracle::PlainVec{std::cos(angle), std::sin(angle)};
        };
        Query q;
        q.a = {{DVec2{-1, -0.1}, DVec2{1, -0.1}, DVec2{1, 0.1}, DVec2{-1, 0.1}}, 4, 0};
        q.b = {{DVec2{-0.5, 0}, DVec2{0.5, 0}, DVec2{0, 0.7}}, 3, 0.05};
        q.sweepA.localCenter = {random.range(-0.5, 0.5), 0};
        q.sweepB.c0 = {random.range(-1.5, 1.5), random.range(0.6, 1.6)};
        q.sweepB.c1 = {random.range(-1.5, 1.5), random.range(0.6, 1.6)};
        const auto turningA = oracle::Turning::mixed(direction(), direction());
        const auto turningB = oracle::Turning::mixed(direction(), direction());
        const MovingPair pair(q.a, q.sweepA, turningA, q.b, q.sweepB, turningB);
        const Crossing crossing = firstCrossing(pair, 0.01, 0, 1, kFine);
        ASSERT_NE(crossing.state, CrossingState::undecided) << seed;
        const bool isFound = crossing.state == CrossingState::found;
        const double end = isFound ? crossing.lo : 1;
        for (int i = 0; end > 0 && i < 500; ++i) {
            ASSERT_GT(pair.guessSeparation(end * i / 500), 0.01 - 1e-12) << seed << " at " << end * i / 500;
        }
        if (isFound) { ASSERT_LE(pair.guessSeparation(crossing.hi), 0.01 + 1e-12) << seed; }
        (isFound ? found : none) += 1;
    }
    EXPECT_GT(found, 80);
    EXPECT_GT(none, 20);
}

TEST(FirstCrossing, BelowContactIsThePenetrationDepth) {
    // A small box sinks into a large one: the smallest way out is up, until the middle is passed.
    Query q;
    q.a = {{DVec2{-4, -2}, DVec2{4, -2}, DVec2{4, 0}, DVec2{-4, 0}}, 4, 0};
    q.b = {{DVec2{-0.25, -0.25}, DVec2{0.25, -0.25}, DVec2{0.25, 0.25}, DVec2{-0.25, 0.25}}, 4, 0};
    q.sweepB.c0 = {0, 1.25};
    q.sweepB.c1 = {0, -0.75};
    for (const double level : {0.5, 0.125, 0.0, -0.125, -0.5, -0.75}) {
        expectAt(cross(q, level), (1 - level) / 2.0L, q);
    }
    expectAt(cross(q, -1.125), 2, q);
}

TEST(FirstCrossing, ExactGrazingIsUndecided) {
    // Two circles pass with exactly the level between them: at no finite precision is it decided whether they reach it.
    Query q{circle(0.5), {}, circle(0.25), {}, {}};
    q.sweepB.c0 = {-2, 1};
    q.sweepB.c1 = {2, 1};
    const Crossing crossing = cross(q, 0.25);
    ASSERT_EQ(crossing.state, CrossingState::undecided);
    EXPECT_GT(crossing.lo, 0.4999);
    EXPECT_LT(crossing.lo, 0.5001);
    EXPECT_EQ(cross(q, 0.25 + 1e-9).state, CrossingState::found);
    EXPECT_EQ(cross(q, 0.25 - 1e-9).state, CrossingState::none);
}

TEST(FirstCrossing, TheBudgetIsKept) {
    // The tip of a bar passes a pin forty times, a thousandth away.
    Query q;
    q.a = {{DVec2{-1, 0}, DVec2{1, 0}}, 2, 0};
    q.a.radius = 0.01;
    q.b = circle(0.01);
    q.sweepA.a1 = 120;
    q.sweepB.c0 = q.sweepB.c1 = {1.021, 0};
    const MovingPair pair(q.a, q.sweepA, q.b, q.sweepB);
    const Crossing whole = firstCrossing(pair, 0, 0, 1, kFine);
    ASSERT_EQ(whole.state, CrossingState::none);
    ASSERT_GT(whole.pieces, 20);
    const Crossing poor = firstCrossing(pair, 0, 0, 1, {kFine.resolution, 10});
    EXPECT_EQ(poor.state, CrossingState::undecided);
    EXPECT_EQ(poor.pieces, 10);
    EXPECT_LT(poor.lo, 1);
}

/// Compares with one row of the truth.
void expectSame(const MeasuredCase& measured, const nlohmann::json& first, const Crossing& crossing) {
    const std::string status = first.at("status").get<std::string>();
    if (status == "miss") { ASSERT_EQ(crossing.state, CrossingState::none) << measured.id; }
    if (status == "overlap") {
        ASSERT_EQ(crossing.state, CrossingState::found) << measured.id;
        ASSERT_EQ(crossing.hi, 0) << measured.id;
    }
    if (status == "hit") {
        ASSERT_EQ(crossing.state, CrossingState::found) << measured.id;
        ASSERT_LE(crossing.lo, first.at("tHi").get<double>()) << measured.id;
        ASSERT_GE(crossing.hi, first.at("tLo").get<double>()) << measured.id;
    }
}

TEST(FirstCrossing, OfTheMeasuredCases) {
    const std::vector<MeasuredCase> cases = readMeasuredCases();
    ASSERT_EQ(cases.size(), 300U);
    std::map<std::string, int> scored;
    for (const MeasuredCase& measured : cases) {
        for (const char* level : {"contact", "atTarget"}) {
            const auto& first = measured.truth.at(level);
            const double height = std::string(level) == "contact" ? 0 : measured.truth.at("target").get<double>();
            const std::string status = first.at("status").get<std::string>();
            if (status == "graze") { continue; }
            expectSame(measured, first, cross(measured.query, height));
            if (HasFatalFailure()) { return; }
            ++scored[status];
        }
    }
    EXPECT_GT(scored["hit"], 200);
    EXPECT_GT(scored["miss"], 50);
    EXPECT_GT(scored["overlap"], 25);
}

TEST(FirstCrossing, OfTheSmallestMeasuredSeparations) {
    for (const MeasuredCase& measured : readMeasuredCases()) {
        const double size = measured.truth.at("size").get<double>();
        const auto& smallest = measured.truth.at("minSep");
        const double margin = 1e-6 * size;
        const Crossing below = cross(measured.query, smallest.at(0).get<double>() - margin);
        const Crossing above = cross(measured.query, smallest.at(1).get<double>() + margin);
        ASSERT_EQ(below.state, CrossingState::none) << measured.id;
        ASSERT_EQ(above.state, CrossingState::found) << measured.id;
        ASSERT_LE(above.hi, 1) << measured.id;
    }
}

}  // namespace
}  // namespace swept::test

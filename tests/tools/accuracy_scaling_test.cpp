#include <gtest/gtest.h>

#include <swept/samples/scene_units.h>
#include <swept/tools/accuracy/accuracy_case.h>

#include "../samples/trace_compare.h"

/// Power-of-two invariance over every scene whose outcome is known, in both precisions: other units of length, mass and
/// time give the same run to the bit.

namespace swept::test {
namespace {

constexpr std::int64_t kSteps = 60;

void compareAll(Precision precision, const Units& units) {
    int conclusive = 0;
    int underflown = 0;
    for (const accuracy::Case& c : accuracy::allCases()) {
        if (c.isLong) { continue; }
        const SceneRun plain = runOf(c.scene, precision, kSteps);
        const SceneRun other = runOf(scaled(c.scene, units.length, units.mass, units.time), precision, kSteps);
        if (plain.underflow || other.underflow) {
            ++underflown;
            continue;
        }
        ++conclusive;
        EXPECT_EQ(firstDifference(plain.trace, other.trace, units), "") << c.name << ", " << text(units);
    }
    testing::Test::RecordProperty("conclusive", conclusive);
    testing::Test::RecordProperty("underflown", underflown);
    EXPECT_GT(conclusive, 4 * underflown) << "too many runs underflowed to prove anything: " << underflown;
}

TEST(AccuracyScaling, SinglePrecisionHasNoUnits) { compareAll(Precision::f32, {7, -5, 3}); }
TEST(AccuracyScaling, DoublePrecisionHasNoUnits) { compareAll(Precision::f64, {57, -33, 15}); }

}  // namespace
}  // namespace swept::test

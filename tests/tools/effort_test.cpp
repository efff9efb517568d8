#include <gtest/gtest.h>

#include <swept/tools/bench/effort_bench.h>

/// The claim of the page: an error budget keeps the error of the fixed worst case at a fraction of its cost.

namespace swept::bench {
namespace {

class EffortBudgets : public testing::TestWithParam<double> {};

TEST_P(EffortBudgets, AreKeptAtAFractionOfTheCostOfTheSmallestFixedNumber) {
    for (const EffortRow& row : benchEffort({.repeats = 0, .budget = GetParam()}, [](const EffortRow&) {})) {
        SCOPED_TRACE(row.scene + (row.precision == Precision::f32 ? " f32" : " f64"));
        EXPECT_LE(row.chosen.error, 1);
        EXPECT_EQ(row.chosen.missed, 0);
        EXPECT_GE(row.fixedSubSteps, 16) << "not demanding";
        EXPECT_GT(row.fixed.bodySubSteps, 0);
        EXPECT_LE(row.chosen.bodySubSteps, 0.5 * row.fixed.bodySubSteps);
    }
}

INSTANTIATE_TEST_SUITE_P(TimesThoseOfTheScenes, EffortBudgets, testing::Values(1.0, 1.5));

}  // namespace
}  // namespace swept::bench

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <swept/toi/toi_method.h>
#include <swept/toi/toi_observer.h>

#include "families.h"

/// Watching a search changes nothing, and shows what it did.

namespace swept::test {
namespace {

constexpr std::uint64_t kObserved = 100;

class Diary final : public ToiObserver {
public:
    std::vector<ToiStep> steps;
    void onStep(const ToiStep& step) override { steps.push_back(step); }
};

class ToiObserved : public ::testing::TestWithParam<ToiMethod> {};

TEST_P(ToiObserved, StepsLeadToTheSameAnswer) {
    int watched = 0;
    for (const Family family : kFamilies) {
        for (std::uint64_t seed = 0; seed < kObserved; ++seed) {
            Query q = randomQuery(family, seed);
            SCOPED_TRACE(::testing::Message() << nameOf(family) << " seed " << seed << q);
            const auto by = [&q] { return timeOfImpactBy(GetParam(), q.a, q.sweepA, q.b, q.sweepB, q.settings); };
            const Toi alone = by();
            Diary diary;
            q.settings.observer = &diary;
            const Toi toi = by();
            ASSERT_EQ(toi.state, alone.state);
            ASSERT_EQ(toi.fraction, alone.fraction);
            ASSERT_EQ(toi.separation, alone.separation);
            ASSERT_EQ(toi.normal, alone.normal);
            ASSERT_EQ(toi.iterations, alone.iterations);
            double reached = 0;
            for (const ToiStep& step : diary.steps) {
                ASSERT_GE(step.fraction, reached);
                ASSERT_GT(step.next, step.fraction);
                ASSERT_GT(step.separation, q.settings.target);
                reached = step.fraction;
            }
            if (!diary.steps.empty()) {
                ASSERT_EQ(diary.steps.back().next, toi.fraction) << "it ends where it went last";
            }
            ASSERT_LE(static_cast<int>(diary.steps.size()), toi.iterations + toi.rootIterations);
            watched += static_cast<int>(diary.steps.size());
        }
    }
    EXPECT_GT(watched, 1500);
}

INSTANTIATE_TEST_SUITE_P(Methods, ToiObserved,
                         ::testing::Values(ToiMethod::certified, ToiMethod::conservativeAdvancement),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

/// The bound that is drawn lies below the true separation.
TEST(ToiBound, LiesBelowTheSeparation) {
    int bounded = 0;
    for (const Family family : kFamilies) {
        for (std::uint64_t seed = 0; seed < kObserved / 2; ++seed) {
            const Query q = randomQuery(family, seed);
            SCOPED_TRACE(::testing::Message() << nameOf(family) << " seed " << seed << q);
            const double start = separationAt(q.a, q.sweepA, q.b, q.sweepB, 0).separation;
            if (!(start > q.settings.target)) { continue; }
            for (int i = 1; i <= 8; ++i) {
                const double level = start + (q.settings.target - start) * i / 8;
                const double until = certainUntil(q.a, q.sweepA, q.b, q.sweepB, q.settings, 0, level);
                for (int j = 0; j <= 5; ++j) {
                    ASSERT_GT(static_cast<double>(trueSeparation(q, until * j / 5)), level - q.settings.tolerance / 4);
                }
                bounded += until < q.settings.tMax ? 1 : 0;
            }
        }
    }
    EXPECT_GT(bounded, 1500);
}

}  // namespace
}  // namespace swept::test

#include <gtest/gtest.h>

#include <thread>

#include "model.h"

namespace swept::test {
namespace {

/// Everything that the three kinds of queries see, as one number.
std::uint64_t askEverything(const Broadphase& broadphase, const std::vector<Aabb>& boxes) {
    std::uint64_t seen = 0;
    const auto alongTheWay = [&](ProxyId id, Real limit) {
        seen += static_cast<std::uint64_t>(id);
        return limit;
    };
    for (const Aabb& box : boxes) {
        broadphase.query(box, [&](ProxyId id) {
            seen += 1000 + static_cast<std::uint64_t>(id);
            return true;
        });
        broadphase.ray(toDouble(box.lower), {30, 10}, 1, alongTheWay);
        broadphase.sweep(box, {-20, 15}, 1, alongTheWay);
    }
    return seen;
}

TEST(ConcurrentQueries, SeeTheSameAsOneThread) {
    for (const BroadphaseKind kind : kEveryKind) {
        Random random(21);
        const auto broadphase = makeBroadphase(kind);
        std::vector<Aabb> boxes;
        for (int i = 0; i < 200; ++i) {
            boxes.push_back(randomBox(Family::scattered, random));
            ASSERT_TRUE(broadphase->insert(boxes.back(), randomKind(random)).ok());
        }
        const std::uint64_t expected = askEverything(*broadphase, boxes);
        const std::uint64_t testsOfOne = broadphase->counters().boxTests;
        std::vector<std::uint64_t> seen(4);
        std::vector<std::thread> threads;
        for (std::uint64_t& mine : seen) {
            threads.emplace_back([&] { mine = askEverything(*broadphase, boxes); });
        }
        for (std::thread& thread : threads) { thread.join(); }
        EXPECT_GT(expected, 1000U);
        for (const std::uint64_t each : seen) { EXPECT_EQ(each, expected); }
        EXPECT_EQ(broadphase->counters().boxTests, 5 * testsOfOne) << "no test is lost from the count";
    }
}

}  // namespace
}  // namespace swept::test

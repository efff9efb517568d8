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

/// Before pairs are asked for the first time, and after so much has come and gone since that a structure may be made
/// anew for the queries, by whichever comes first.
TEST(ConcurrentQueries, FindWhatHasJustCome) {
    for (const BroadphaseKind kind : kEveryKind) {
        Random random(22);
        const auto broadphase = makeBroadphase(kind);
        const auto plain = makeBroadphase(BroadphaseKind::allPairs);  // looks at each box
        std::vector<Aabb> boxes;
        std::vector<ProxyId> ids;
        std::vector<ProxyPair> pairs;
        std::vector<ProxyPair> expectedPairs;
        for (int round = 0; round < 12; ++round) {
            for (int i = 0; i < 700; ++i) {
                boxes.push_back(randomBox(Family::scattered, random));
                const ProxyKind proxyKind = randomKind(random);
                ids.push_back(plain->insert(boxes.back(), proxyKind).value());
                ASSERT_EQ(broadphase->insert(boxes.back(), proxyKind).value(), ids.back());
            }
            for (int i = 0; i < 300; ++i) {
                const std::size_t one = below(random, static_cast<std::uint32_t>(ids.size()));
                ASSERT_TRUE(plain->remove(ids[one]).ok() && broadphase->remove(ids[one]).ok());
                ids[one] = ids.back();
                ids.pop_back();
                const ProxyId moved = ids[below(random, static_cast<std::uint32_t>(ids.size()))];
                const Aabb box = randomBox(Family::scattered, random);
                ASSERT_TRUE(plain->move(moved, box).ok() && broadphase->move(moved, box).ok());
            }
            const std::span<const Aabb> some = std::span(boxes).last(20);
            const std::uint64_t expected = askEverything(*plain, {some.begin(), some.end()});
            const std::uint64_t testsBefore = broadphase->counters().boxTests;
            std::vector<std::uint64_t> seen(4);
            std::vector<std::thread> threads;
            for (std::uint64_t& mine : seen) {
                threads.emplace_back([&] { mine = askEverything(*broadphase, {some.begin(), some.end()}); });
            }
            for (std::thread& thread : threads) { thread.join(); }
            for (const std::uint64_t each : seen) { ASSERT_EQ(each, expected) << nameOf(kind) << " round " << round; }
            const std::uint64_t tests = broadphase->counters().boxTests - testsBefore;
            ASSERT_EQ(askEverything(*broadphase, {some.begin(), some.end()}), expected);
            EXPECT_EQ(4 * (broadphase->counters().boxTests - testsBefore), 5 * tests) << "all search the same";
            ASSERT_EQ(askEverything(*broadphase->clone(), {some.begin(), some.end()}), expected);
            if (round % 3 != 2) { continue; }
            plain->pairs(expectedPairs);
            broadphase->pairs(pairs);
            ASSERT_EQ(pairs, expectedPairs) << nameOf(kind) << " round " << round;
        }
    }
}

}  // namespace
}  // namespace swept::test

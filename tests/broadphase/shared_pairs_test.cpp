#include <gtest/gtest.h>

#include "../support/thread_tasks.h"
#include "model.h"

namespace swept::test {
namespace {

/// A crowd in which each round moves another share of the boxes, told to two broadphases alike.
class Crowd {
public:
    explicit Crowd(std::uint64_t seed) : random_(seed) {
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const auto x = random_.range(-45, 45);
            const auto y = random_.range(-45, 45);
            boxes_.push_back({{static_cast<Real>(x), static_cast<Real>(y)},
                              {static_cast<Real>(x + 0.9), static_cast<Real>(y + 0.9)}});
        }
    }
    void insertInto(Broadphase& broadphase) {
        for (std::uint32_t i = 0; i < kCount; ++i) {
            ASSERT_TRUE(broadphase.insert(boxes_[i], i % 3 == 0 ? ProxyKind::kinematic : ProxyKind::dynamic).ok());
        }
    }
    /// Those whose number is a multiple of `stride`.
    void drift(std::uint32_t stride) {
        moved_.clear();
        for (std::uint32_t i = 0; i < kCount; i += stride) {
            const Vec2 way{static_cast<Real>(random_.range(-1, 1)), static_cast<Real>(random_.range(-1, 1))};
            boxes_[i] = {boxes_[i].lower + way, boxes_[i].upper + way};
            moved_.push_back(i);
        }
    }
    void tell(Broadphase& broadphase) {
        for (const std::uint32_t i : moved_) { ASSERT_TRUE(broadphase.move(static_cast<ProxyId>(i), boxes_[i]).ok()); }
    }
    /// All at once, by several threads.
    void tellBeside(Broadphase& broadphase, TaskSystem& tasks) {
        broadphase.beginMoves();
        tasks.run(moved_.size(), 16, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                EXPECT_TRUE(broadphase.moveInParallel(static_cast<ProxyId>(moved_[i]), boxes_[moved_[i]]).ok());
            }
        });
        EXPECT_EQ(broadphase.endMoves(tasks), moved_.size());
    }
    std::size_t findWith(const Broadphase& broadphase) const {
        std::size_t found = 0;
        for (std::size_t i = 0; i < boxes_.size(); i += 7) {
            broadphase.query(boxes_[i], [&found](ProxyId) { return ++found > 0; });
        }
        return found;
    }

private:
    static constexpr std::uint32_t kCount = 4000;
    Random random_;
    std::vector<Aabb> boxes_;
    std::vector<std::uint32_t> moved_;
};

TEST(SharedPairs, AreThoseOfOneThread) {
    for (const int workers : {1, 2, 3, 8}) {
        ThreadTasks tasks(workers);
        Crowd crowd(11);
        const auto alone = makeBroadphase(BroadphaseKind::automatic);
        const auto shared = makeBroadphase(BroadphaseKind::automatic);
        crowd.insertInto(*alone);
        crowd.insertInto(*shared);
        std::vector<ProxyPair> expected;
        std::vector<ProxyPair> pairs;
        std::size_t found = 0;
        for (std::uint32_t round = 0; round < 12; ++round) {
            alone->pairs(expected);
            shared->pairs(pairs, tasks);
            ASSERT_EQ(pairs, expected) << workers << " workers, round " << round;
            EXPECT_EQ(shared->counters().boxTests, alone->counters().boxTests) << "nor does the search differ";
            found += expected.size();
            crowd.drift(1 + round);
            crowd.tell(*alone);
            crowd.tell(*shared);
        }
        EXPECT_GT(found, 4000U) << "too few pairs to prove anything";
    }
}

/// The same pairs, and the same answers between the searches, as of boxes that are moved one after the other.
TEST(SharedPairs, OfBoxesThatAreMovedBesideEachOther) {
    for (int kind = 0; kind < kBroadphaseKindCount; ++kind) {
        ThreadTasks tasks(3);
        Crowd crowd(23);
        const auto alone = makeBroadphase(BroadphaseKind::automatic);
        const auto shared = makeBroadphase(static_cast<BroadphaseKind>(kind));
        crowd.insertInto(*alone);
        crowd.insertInto(*shared);
        std::vector<ProxyPair> expected;
        std::vector<ProxyPair> pairs;
        std::size_t found = 0;
        for (std::uint32_t round = 0; round < 6; ++round) {
            alone->pairs(expected);
            shared->pairs(pairs, tasks);
            ASSERT_EQ(pairs, expected) << "kind " << kind << ", round " << round;
            found += expected.size();
            crowd.drift(1 + round);
            crowd.tell(*alone);
            crowd.tellBeside(*shared, tasks);
            ASSERT_EQ(crowd.findWith(*shared), crowd.findWith(*alone)) << "kind " << kind << ", round " << round;
            crowd.drift(9);  // and some more one after the other
            crowd.tell(*alone);
            crowd.tell(*shared);
        }
        EXPECT_GT(found, 4000U) << "too few pairs to prove anything";
        shared->beginMoves();
        EXPECT_FALSE(shared->moveInParallel(static_cast<ProxyId>(1'000'000), {}).ok());
        EXPECT_EQ(shared->endMoves(tasks), 0U);
    }
}

/// Counts the loops that it is handed with more than one range in them.
class CountingTasks final : public TaskSystem {
public:
    int workerCount() const override { return 2; }
    void run(std::size_t count, std::size_t grain, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        shared += count > grain ? 1 : 0;
        if (count > 0) { body(0, count, 1); }
    }
    int shared = 0;
};

TEST(SharedPairs, OfAFewBoxesAreFoundInOnePiece) {
    CountingTasks tasks;
    const auto broadphase = makeBroadphase(BroadphaseKind::automatic);
    for (int i = 0; i < 500; ++i) {
        const auto x = static_cast<Real>(i);
        ASSERT_TRUE(broadphase->insert({{x, 0}, {x + Real(1.5), 1}}, ProxyKind::dynamic).ok());
    }
    std::vector<ProxyPair> pairs;
    broadphase->pairs(pairs, tasks);
    EXPECT_EQ(pairs.size(), 499U);
    EXPECT_EQ(tasks.shared, 0) << "handing it over costs more than the search";
}

}  // namespace
}  // namespace swept::test

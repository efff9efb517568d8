#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include <swept/tools/bench/broadphase_bench.h>
#include <swept/tools/bench/broadphase_bench_table.h>
#include <swept/tools/bench/broadphase_peer_scenes.h>
#include <swept/tools/bench/overlap_bench.h>

namespace swept::bench {
namespace {

/// Knows of no pairs but one that there is not.
class Liar final : public BroadphaseContestant {
public:
    std::string name() const override { return "liar"; }
    void begin(std::span<const ProxyTraits>) override {}
    void follow(const TraceStep&) override {}
    void findPairs(std::vector<TracePair>& found) override { found.assign(1, {0, 0}); }
    void forget(std::span<const TracePair>) override {}
    std::uint64_t countBoxHits(std::span<const Aabb>) const override { return 0; }
    std::uint64_t countRayHits(std::span<const RayQuery>) const override { return 0; }
    std::size_t memoryBytes() const override { return 0; }
};

void expectAgreement(const std::vector<BroadphaseRow>& rows) {
    ASSERT_FALSE(rows.empty());
    for (const BroadphaseRow& row : rows) {
        EXPECT_TRUE(row.agrees) << row.method << " finds other pairs in " << row.scene;
        EXPECT_NEAR(row.boxHits, rows.front().boxHits, 1e-9) << row.method << ' ' << row.scene;
        EXPECT_NEAR(row.rayHits, rows.front().rayHits, 0.02 * rows.front().rayHits) << row.method << ' ' << row.scene;
        EXPECT_GT(row.movedPerStep, 0) << row.scene;
    }
}

TEST(BroadphaseBench, EverybodyFindsTheSamePairs) {
    for (const BoxScene scene : kBoxScenes) {
        const Motion motion = makeBoxScene(scene, 200, 8, 3);
        BoxTrace trace = enlarged(motion, {});
        trace.warmSteps = 2;
        const auto rows = benchTrace(allBroadphases(), motion, trace, 0);
        EXPECT_GE(rows.size(), static_cast<std::size_t>(kBroadphaseKindCount) + 1);
        expectAgreement(rows);
        EXPECT_GT(rows.front().alivePairs, 5) << nameOf(scene);
    }
}

TEST(BroadphaseBench, ALiarIsFoundOut) {
    const Motion motion = makeBoxScene(BoxScene::uniform, 50, 4, 1);
    BroadphaseContestants contestants;
    contestants.push_back(std::make_unique<Liar>());
    EXPECT_FALSE(benchTrace(contestants, motion, enlarged(motion, {}), 0).front().agrees);
}

TEST(BroadphaseBench, EnlargedBoxesHoldTheBoundsAtEveryStep) {
    const Motion motion = makeBoxScene(BoxScene::raining, 100, 20, 5);
    for (const MarginRule& rule : {MarginRule{0, 0}, MarginRule{0.125F, 4}, MarginRule{.asBox2d3 = true}}) {
        const BoxTrace trace = enlarged(motion, rule);
        std::vector<Aabb> boxes(motion.proxies.size());
        for (std::size_t i = 0; i < motion.steps.size(); ++i) {
            for (const ProxyBox& box : trace.steps[i].inserted) { boxes[box.proxy] = box.box; }
            for (const ProxyBox& box : trace.steps[i].moved) { boxes[box.proxy] = box.box; }
            for (const TightBox& tight : motion.steps[i].moved) {
                ASSERT_TRUE(contains(boxes[tight.proxy], tight.box)) << "step " << i << ", proxy " << tight.proxy;
            }
        }
    }
}

TEST(BroadphaseBench, MarginsSpareRenewals) {
    const Motion motion = makeBoxScene(BoxScene::uniform, 200, 20, 5);
    const std::uint64_t none = enlarged(motion, {0, 0}).timedMoves();
    const std::uint64_t some = enlarged(motion, {0.25F, 0}).timedMoves();
    EXPECT_EQ(none, 200U * 20U);
    EXPECT_LT(some, none / 2);
}

TEST(BroadphaseBench, ASceneOfThePeerIsRecorded) {
    const RecordedScene scene = recordPeerScene(PeerScene::tumbler, 0.02);
    EXPECT_EQ(scene.motion.proxies.size(), 4U + 45U * 45U);
    BoxTrace trace = enlarged(scene.motion, {.asBox2d3 = true});
    trace.warmSteps = 1;
    const std::string names[] = {"automatic", "bvh", "Box2D 2.4.1"};
    expectAgreement(benchTrace(allBroadphases(names), scene.motion, trace, 0));
}

TEST(BroadphaseBench, RatiosAreOfCasesThatBothWereIn) {
    std::vector<BroadphaseRow> rows(3);
    rows[0].scene = rows[1].scene = "one";
    rows[2].scene = "two";
    rows[0].method = rows[2].method = "ours";
    rows[1].method = "Box2D";
    rows[0].pairTime = 2;
    rows[1].pairTime = 10;
    rows[2].pairTime = 1;
    const auto rivals = rivalry(rows);
    ASSERT_EQ(rivals.size(), 1U);
    EXPECT_EQ(rivals.front().cases, 1);
    EXPECT_DOUBLE_EQ(rivals.front().geometricMean, 5);
}

TEST(OverlapBench, NoRungMissesATouchingPair) {
    const auto rows = benchOverlap({.count = 300, .seed = 2, .passes = 1});
    double falsest = 0;
    for (const OverlapRow& row : rows) {
        EXPECT_TRUE(row.missesNone) << row.family << ' ' << row.rung;
        EXPECT_GT(row.passing, 0.05) << row.family << ' ' << row.rung;
        if (row.rung == "GJK") { EXPECT_EQ(row.falseShare, 0); }
        falsest = std::max(falsest, row.falseShare);
    }
    EXPECT_GT(falsest, 0.3) << "the boxes of bars are loose";
    std::ostringstream table;
    writeOverlapTable(table, rows);
    EXPECT_EQ(table.str().find("misses"), std::string::npos);
}

}  // namespace
}  // namespace swept::bench

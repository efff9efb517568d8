#include <gtest/gtest.h>

#include <limits>

#include "model.h"

namespace swept::test {
namespace {

constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

class Refusal : public testing::TestWithParam<BroadphaseKind> {
protected:
    std::unique_ptr<Broadphase> broadphase_ = makeBroadphase(GetParam());
};

TEST_P(Refusal, OfBadBoxesChangesNothing) {
    const Aabb good = {{0, 0}, {1, 1}};
    const ProxyId id = broadphase_->insert(good, ProxyKind::dynamic).value();
    std::vector<ProxyPair> pairs;
    broadphase_->pairs(pairs);
    const std::pair<Aabb, StatusCode> bad[] = {
        {{{kNaN, 0}, {1, 1}}, StatusCode::notFinite},       {{{0, kNaN}, {1, 1}}, StatusCode::notFinite},
        {{{0, 0}, {kNaN, 1}}, StatusCode::notFinite},       {{{0, 0}, {1, kNaN}}, StatusCode::notFinite},
        {{{-kInfinity, 0}, {1, 1}}, StatusCode::notFinite}, {{{0, 0}, {1, kInfinity}}, StatusCode::notFinite},
        {{{2, 0}, {1, 1}}, StatusCode::outOfRange},         {{{0, 2}, {1, 1}}, StatusCode::outOfRange}};
    for (const auto& [box, code] : bad) {
        EXPECT_EQ(broadphase_->insert(box, ProxyKind::dynamic).status().code, code);
        const Status moved = broadphase_->move(id, box);
        EXPECT_EQ(moved.code, code);
        EXPECT_STREQ(moved.field, "box");
        EXPECT_EQ(broadphase_->box(id), good);
    }
    EXPECT_EQ(broadphase_->insert(good, ProxyKind::dynamic).value(), ProxyId{1}) << "a refused box takes no slot";
    ASSERT_TRUE(broadphase_->remove(ProxyId{1}).ok());
    broadphase_->pairs(pairs);
    EXPECT_TRUE(pairs.empty());
    EXPECT_EQ(broadphase_->counters().reinserted, 0U);
}

TEST_P(Refusal, OfStaleIds) {
    const ProxyId id = broadphase_->insert({{0, 0}, {1, 1}}, ProxyKind::fixed).value();
    ASSERT_TRUE(broadphase_->remove(id).ok());
    const ProxyId stale[] = {id, ProxyId{1}, ProxyId{std::numeric_limits<std::uint32_t>::max()}};
    for (const ProxyId each : stale) {
        EXPECT_EQ(broadphase_->move(each, {{0, 0}, {1, 1}}).code, StatusCode::staleId);
        EXPECT_EQ(broadphase_->remove(each).code, StatusCode::staleId);
        EXPECT_EQ(broadphase_->renewPairs(each).code, StatusCode::staleId);
    }
}

TEST_P(Refusal, OfNaNInQueriesIsAnEmptyAnswer) {
    ASSERT_TRUE(broadphase_->insert({{-1, -1}, {1, 1}}, ProxyKind::fixed).ok());
    int visits = 0;
    const auto countBox = [&](ProxyId) {
        ++visits;
        return true;
    };
    const auto countRay = [&](ProxyId, Real limit) {
        ++visits;
        return limit;
    };
    broadphase_->query({{kNaN, 0}, {1, 1}}, countBox);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    broadphase_->ray({nan, 0}, {1, 0}, 1, countRay);
    broadphase_->ray({0, 0}, {1, nan}, 1, countRay);
    broadphase_->ray({0, 0}, {1, 0}, kNaN, countRay);
    broadphase_->ray({0, 0}, {1, 0}, -1, countRay);
    broadphase_->sweep({{0, 0}, {kNaN, 1}}, {1, 0}, 1, countRay);
    EXPECT_EQ(visits, 0);
    const Aabb several[] = {{{kNaN, 0}, {1, 1}}, {{0, 0}, {1, kNaN}}, {{5, 5}, {6, 6}}, {{5, 5}, {6, 6}}};
    ASSERT_TRUE(broadphase_->insert({{5, 5}, {6, 6}}, ProxyKind::dynamic).ok());
    broadphase_->queryDynamic(several, [&](std::size_t index, ProxyId) {
        ++visits;
        EXPECT_GE(index, 2U) << "the others know nothing of it";
    });
    EXPECT_EQ(visits, 2);
}

TEST_P(Refusal, IsNotNeededForTheLargestFiniteBoxes) {
    const Real most = std::numeric_limits<Real>::max();
    Random random(5);
    Model model;
    for (int i = 0; i < 60; ++i) {
        Aabb box = randomBox(Family::mixedSizes, random);
        if (i % 5 == 0) { box = {{-most, -most}, {most, most}}; }
        if (i % 5 == 1) { box = {{most, -most}, {most, most}}; }
        model.insert(box, ProxyKind::dynamic);
        ASSERT_TRUE(broadphase_->insert(box, ProxyKind::dynamic).ok());
    }
    std::vector<ProxyPair> pairs;
    broadphase_->pairs(pairs);
    EXPECT_EQ(pairs, model.pairs());
}

INSTANTIATE_TEST_SUITE_P(EveryImplementation, Refusal, testing::ValuesIn(kEveryKind),
                         [](const testing::TestParamInfo<BroadphaseKind>& kind) { return nameOf(kind.param); });

}  // namespace
}  // namespace swept::test

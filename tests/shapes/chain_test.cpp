#include <limits>

#include <gtest/gtest.h>

#include <swept/shapes/chain.h>

#include "shape_families.h"

namespace swept::test {
namespace {

const std::array<Vec2, 4> kSquare = {Vec2{0, 0}, Vec2{4, 0}, Vec2{4, 4}, Vec2{0, 4}};

TEST(Chain, LoopSegmentsKnowTheirNeighboursAllAround) {
    ASSERT_TRUE(validateChain(kSquare, true, 0).ok());
    ASSERT_EQ(chainSegmentCount(4, true), 4);
    for (int i = 0; i < 4; ++i) {
        const ChainSegment segment = chainSegment(kSquare, true, real(0.5), i);
        const auto at = [&](int k) { return kSquare[static_cast<std::size_t>((i + k + 4) % 4)]; };
        EXPECT_EQ(segment.before, at(-1));
        EXPECT_EQ(segment.p, at(0));
        EXPECT_EQ(segment.q, at(1));
        EXPECT_EQ(segment.after, at(2));
        EXPECT_TRUE(segment.hasBefore && segment.hasAfter);
        EXPECT_EQ(segment.radius, real(0.5));
    }
}

TEST(Chain, OpenChainEndsWithoutNeighbours) {
    ASSERT_EQ(chainSegmentCount(4, false), 3);
    const ChainSegment first = chainSegment(kSquare, false, 0, 0);
    EXPECT_FALSE(first.hasBefore);
    EXPECT_TRUE(first.hasAfter);
    EXPECT_EQ(first.after, kSquare[2]);
    const ChainSegment last = chainSegment(kSquare, false, 0, 2);
    EXPECT_TRUE(last.hasBefore);
    EXPECT_FALSE(last.hasAfter);
    EXPECT_EQ(last.q, kSquare[3]);
    const ChainSegment only = chainSegment(std::span(kSquare).first(2), false, 0, 0);
    EXPECT_FALSE(only.hasBefore || only.hasAfter);
}

TEST(Chain, ThatGoesOnAsAnotherKnowsItsNeighbours) {
    for (int i = 0; i < 2; ++i) {  // the first two segments of one chain, and each by itself
        const auto begin = static_cast<std::size_t>(i);
        const ChainSegment whole = chainSegment(kSquare, false, 0, i);
        ChainNeighbours beyond{.after = kSquare[begin + 2]};
        if (i > 0) { beyond.before = kSquare[begin - 1]; }
        const ChainSegment piece = chainSegment(std::span(kSquare).subspan(begin, 2), false, 0, 0, beyond);
        EXPECT_EQ(piece.hasBefore, whole.hasBefore) << i;
        EXPECT_EQ(piece.hasAfter, whole.hasAfter) << i;
        EXPECT_EQ(piece.before, whole.before) << i;
        EXPECT_EQ(piece.after, whole.after) << i;
    }
}

TEST(Chain, CollidesOnTheRight) {
    EXPECT_EQ(normalOf(chainSegment(kSquare, true, 0, 0)), (Vec2{0, -1})) << "outside of a counter-clockwise loop";
    const std::array<Vec2, 2> ground = {Vec2{5, 0}, Vec2{-5, 0}};
    EXPECT_EQ(normalOf(chainSegment(ground, false, 0, 0)), (Vec2{0, 1})) << "ground is listed from right to left";
}

TEST(Chain, SegmentIsAValidPolygon) {
    for (int i = 0; i < 4; ++i) {
        const Polygon polygon = polygonOf(chainSegment(kSquare, true, real(0.25), i));
        EXPECT_TRUE(validate(polygon).ok());
        EXPECT_EQ(polygon.count, 2);
        EXPECT_EQ(polygon.radius, real(0.25));
        EXPECT_EQ(polygon.normals[0], -polygon.normals[1]);
    }
}

TEST(Chain, RefusesWhatIsNone) {
    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    const auto codeOf = [](std::vector<Vec2> points, bool loop, Real radius) {
        return validateChain(points, loop, radius).code;
    };
    EXPECT_EQ(codeOf({}, false, 0), StatusCode::tooFewVertices);
    EXPECT_EQ(codeOf({{0, 0}}, false, 0), StatusCode::tooFewVertices);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}}, true, 0), StatusCode::tooFewVertices);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}}, false, 0), StatusCode::ok);
    EXPECT_EQ(codeOf({{0, 0}, {nan, 0}}, false, 0), StatusCode::notFinite);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {1, 0}}, false, 0), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {0, 0}}, false, 0), StatusCode::ok) << "a chain may come back";
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {0, 0}}, true, 0), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}}, false, -1), StatusCode::negative);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}}, false, nan), StatusCode::notFinite);
}

}  // namespace
}  // namespace swept::test

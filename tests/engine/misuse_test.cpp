#include "vandal.h"

/// Random calls of everything that a world offers, most of them nonsense: the world says no, stays as it was, and goes
/// on.

namespace swept::test {
namespace {

/// What is left can be cleared away, and then a ball falls as in a new world.
void expectUsable(Vandal& vandal) {
    World& world = vandal.world();
    ASSERT_EQ(world.bodyCount(), vandal.livingBodies());
    for (const BodyId id : vandal.known().bodies) {
        if (world.isValid(id)) { must(world.destroyBody(id)); }
    }
    EXPECT_EQ(world.bodyCount(), 0u);
    EXPECT_EQ(world.jointCount(), 0u);
    must(world.step(kStep));
    EXPECT_EQ(world.counters().contacts, 0u);
    EXPECT_EQ(world.counters().awakeBodies, 0u);
    for (const ShapeId id : vandal.known().shapes) { EXPECT_FALSE(world.isValid(id)); }
    must(world.configure(awakeSettings()));
    runFor(world, 9);  // for eight seconds springs are those of the longest step that there was
    addStatic(world, box(20, 1));
    const BodyId ball = addBody(world, dynamicAt({0, 4}), circle(0.5));
    run(world, 10);
    EXPECT_NEAR(velocityOf(world, ball).y, -kGravity * 10 * kStep, 1e-5);
    run(world, 200);
    EXPECT_NEAR(world.position(ball).y, 1.5, 0.005);
    EXPECT_NEAR(velocityOf(world, ball).y, 0, 0.005);
}

void vandalise(Sizes sizes, int seeds, int actions) {
    int refusals = 0;
    int calls = 0;
    int broken = 0;
    std::array<int, kStatusCodeCount> codes{};
    JointTally joined{};
    for (int seed = 0; seed < seeds; ++seed) {
        Vandal vandal(static_cast<std::uint64_t>(seed), sizes);
        for (int i = 0; i < actions; ++i) {
            vandal.act();
            ASSERT_TRUE(vandal.allFinite()) << "seed " << seed << " action " << i;
            if (testing::Test::HasFatalFailure()) { FAIL() << "seed " << seed << " action " << i; }
        }
        expectUsable(vandal);
        if (testing::Test::HasFailure()) { FAIL() << "seed " << seed; }
        refusals += vandal.refusals();
        calls += vandal.calls();
        broken += vandal.broken();
        for (std::size_t type = 0; type < joined.size(); ++type) { joined[type] += vandal.joined()[type]; }
        for (std::size_t c = 0; c < codes.size(); ++c) { codes[c] += vandal.codes()[c]; }
    }
    EXPECT_GT(refusals, calls / 5);
    EXPECT_GT(codes[0], calls / 5);
    EXPECT_GT(broken, 0);
    for (std::size_t type = 0; type < joined.size(); ++type) { EXPECT_GT(joined[type], 0) << "joint type " << type; }
    for (const StatusCode code :
         {StatusCode::notFinite, StatusCode::negative, StatusCode::notPositive, StatusCode::outOfRange,
          StatusCode::staleId, StatusCode::degenerate, StatusCode::notConvex, StatusCode::tooFewVertices,
          StatusCode::tooManyVertices, StatusCode::wrongBodyType, StatusCode::missingMass, StatusCode::notDistinct,
          StatusCode::disabled}) {
        EXPECT_GT(codes[static_cast<std::size_t>(code)], 0) << describe(code) << " was never the answer";
    }
}

TEST(Misuse, LeavesAUsableWorld) { vandalise(Sizes::usual, SWEPT_MISUSE_PROGRAMS, 1'250); }

/// Finite, but so large that sums and products of them are not. More worlds of shorter lives: a few grow old full of
/// bodies that turn a million times in a step, and every step of those takes as long as all the rest.
TEST(Misuse, ExtremeNumbersToo) { vandalise(Sizes::extreme, 5 * SWEPT_MISUSE_PROGRAMS, 625); }

}  // namespace
}  // namespace swept::test

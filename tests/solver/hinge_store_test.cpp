#include <gtest/gtest.h>
#include <swept/solver/joint_blocks/hinge_lanes.h>
#include <swept/solver/joint_blocks/hinge_store.h>

#include <algorithm>

#include "../support/some_of.h"
#include "batch_fields.h"
#include "random_solve.h"

/// Hinges may be kept by someone else: the same bits as of constraints in the batch, with kernels and without.

namespace swept::test {
namespace {

HingeParts partsOf(const RevoluteConstraint& joint) { return {joint.hasSpring, joint.hasMotor, joint.hasLimits}; }

class KeptHinges final : public HingeStore {
public:
    explicit KeptHinges(SolverBatch& batch) : batch_(batch), hinges_(std::move(batch.revolutes)) {
        batch.revolutes.clear();
        for (std::uint32_t i = 0; i < hinges_.size(); ++i) {
            RevoluteConstraint& joint = hinges_[i];
            joint.source = i;
            joint.total = {};
            prepare(joint, batch.inertias);
            batch.hingeLinks.push_back(
                {.slotA = joint.slotA, .slotB = joint.slotB, .source = i, .parts = partsOf(joint)});
        }
        batch.hingeStore = this;
    }

    void fill(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& to) override {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const RevoluteConstraint& joint = hinges_[first + i];
            if (!places[i].isInBlock) {
                to.rest[places[i].index] = joint;
                ++alone;
                continue;
            }
            WideRevolute& block = to.blocks[places[i].index];
            fillHead(block, places[i].lane,
                     {joint.slotA, joint.slotB, joint.anchorA, joint.anchorB, joint.centerOffset, joint.softness,
                      joint.linearImpulse},
                     batch_.inertias[joint.slotA], batch_.inertias[joint.slotB]);
            if (block.parts.any()) { fillParts(block, places[i].lane, joint, joint.baseAngle); }
            ++inBlocks;
        }
    }
    void take(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& from) override {
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i].isInBlock) {
                takeLane(from.blocks[places[i].index], places[i].lane, hinges_[first + i]);
            } else {
                hinges_[first + i] = from.rest[places[i].index];
            }
        }
    }
    /// In the order of the other batch, which was sorted by colour.
    void giveBackLike(const SolverBatch& other) {
        for (const RevoluteConstraint& joint : other.revolutes) { batch_.revolutes.push_back(hinges_[joint.source]); }
    }

    int alone = 0;
    int inBlocks = 0;

private:
    SolverBatch& batch_;
    std::vector<RevoluteConstraint> hinges_;
};

TEST(HingeStore, IsSolvedToTheBitLikeConstraintsOfTheBatch) {
    int alone = 0;
    int inBlocks = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const int times = seed % 3 == 0 ? 16 : 1;
        RandomSolve plain(seed, times);
        RandomSolve kept(seed, times);
        for (std::uint32_t i = 0; i < plain.batch.revolutes.size(); ++i) { plain.batch.revolutes[i].source = i; }
        kept.settings.wide = seed % 4 != 0;
        KeptHinges store(kept.batch);
        const SolveReport ofPlain = Solver().solve(plain.batch, plain.settings);
        const SolveReport ofKept = Solver().solve(kept.batch, kept.settings);
        ASSERT_TRUE(kept.batch.revolutes.empty()) << "they belong to the store";
        store.giveBackLike(plain.batch);
        ASSERT_EQ(bitsOf(plain.batch), bitsOf(kept.batch)) << "seed " << seed;
        ASSERT_EQ(ofPlain.colours, ofKept.colours) << "seed " << seed;
        alone += store.alone;
        inBlocks += store.inBlocks;
    }
    EXPECT_GT(alone, 100);
    EXPECT_EQ(inBlocks > 100, revoluteKernels() != nullptr);
}

TEST(HingeStore, IsSolvedToTheSameBitsAgain) {
    for (std::uint64_t seed = 0; seed < someOf(100U); ++seed) {
        Solver used;
        for (int round = 0; round < 6; ++round) {
            const auto make = [seed, round] {
                RandomSolve solve(seed, seed % 3 == 0 ? 16 : 1);
                // Hinges between such bodies are but points.
                if (round > 3) { solve.batch.inertias[1].inverseInertia = 0; }
                if (round % 2 == 1) { solve.settings.wide = seed % 4 != 0; }
                return solve;
            };
            RandomSolve first = make();
            RandomSolve second = make();
            KeptHinges ofFirst(first.batch);
            KeptHinges ofSecond(second.batch);
            (void)used.solve(first.batch, first.settings);
            (void)Solver().solve(second.batch, second.settings);
            ofFirst.giveBackLike(second.batch);
            ofSecond.giveBackLike(second.batch);
            ASSERT_EQ(bitsOf(first.batch), bitsOf(second.batch)) << "seed " << seed << ", round " << round;
            ASSERT_EQ(ofFirst.inBlocks, ofSecond.inBlocks);
        }
    }
}

}  // namespace
}  // namespace swept::test

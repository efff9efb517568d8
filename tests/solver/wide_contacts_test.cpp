#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include <swept/solver/contacts/contact_lanes.h>
#include <swept/solver/contacts/contact_store.h>
#include <swept/solver/wide/wide_contacts.h>

#ifdef SWEPT_SIMD
#include <swept/solver/wide/wide_targets.h>
// after it
#include <hwy/targets.h>
#endif

#include "batch_fields.h"
#include "random_solve.h"

/// Blocks of contacts and of hinges, and contacts that someone else keeps, against the same one by one: the same bits
/// with every instruction set of this machine.

namespace swept::test {
namespace {

/// Contacts without restitution, and what is prepared in blocks alone.
void forgetBounces(RandomSolve& solve) {
    solve.settings.bounces = false;
    for (ContactConstraint& contact : solve.batch.contacts) { contact.restitution = 0; }
}
/// All at once: contacts are iterated in between.
void solveOneJointDirectly(RandomSolve& solve) {
    RevoluteConstraint joint = solve.batch.revolutes.empty() ? RevoluteConstraint{} : solve.batch.revolutes[0];
    joint.slotA = 1;
    joint.slotB = 2;
    solve.batch.clearJoints();
    solve.batch.revolutes.push_back(joint);
    solve.settings.direct = DirectScope::joints;
}
void forgetPrepared(SolverBatch& batch) {
    for (ContactConstraint& contact : batch.contacts) {
        contact.sharedResponse = 0;
        for (ContactConstraintPoint& point : contact.points) {
            point.baseSeparation = point.normalMass = point.tangentMass = 0;
        }
    }
}

struct BlockCounts {
    int contacts = 0;
    int hinges = 0;
    int rods = 0;
    int slides = 0;
    int wheels = 0;
    int welds = 0;
    int drives = 0;
};

BlockCounts expectSameBits(int times, std::uint64_t seeds) {
    BlockCounts blocks;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        RandomSolve narrow(seed, times);
        RandomSolve wide(seed, times);
        const bool bounces = seed % 2 == 0;
        if (!bounces) {
            forgetBounces(narrow);
            forgetBounces(wide);
        }
        narrow.settings.wide = false;
        if (seed % 5 == 0) {
            solveOneJointDirectly(narrow);
            solveOneJointDirectly(wide);
        }
        const SolveReport ofNarrow = Solver().solve(narrow.batch, narrow.settings);
        const SolveReport ofWide = Solver().solve(wide.batch, wide.settings);
        if (!bounces) {
            forgetPrepared(narrow.batch);
            forgetPrepared(wide.batch);
        }
        EXPECT_EQ(ofNarrow.contactBlocks + ofNarrow.hingeBlocks + ofNarrow.rodBlocks, 0);
        EXPECT_EQ(ofNarrow.slideBlocks + ofNarrow.wheelBlocks + ofNarrow.weldBlocks + ofNarrow.driveBlocks, 0);
        EXPECT_EQ(ofNarrow.bounceRounds, ofWide.bounceRounds) << "seed " << seed;
        EXPECT_EQ(bitsOf(narrow.batch), bitsOf(wide.batch)) << "seed " << seed;
        if (testing::Test::HasFailure()) { break; }
        blocks.contacts += ofWide.contactBlocks;
        blocks.hinges += ofWide.hingeBlocks;
        blocks.rods += ofWide.rodBlocks;
        blocks.slides += ofWide.slideBlocks;
        blocks.wheels += ofWide.wheelBlocks;
        blocks.welds += ofWide.weldBlocks;
        blocks.drives += ofWide.driveBlocks;
    }
    return blocks;
}

/// Contacts of a batch, kept outside of it.
class KeptContacts final : public ContactStore {
public:
    /// @param areAlone  what has restitution is a constraint on its own
    explicit KeptContacts(SolverBatch& batch, bool areAlone = false)
        : batch_(batch), contacts_(std::move(batch.contacts)) {
        batch.contacts.clear();
        for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
            const ContactConstraint& contact = contacts_[i];
            batch.links.push_back({.slotA = contact.slotA,
                                   .slotB = contact.slotB,
                                   .source = i,
                                   .points = static_cast<std::uint8_t>(contact.count),
                                   .isAlone = areAlone && contact.restitution > 0});
        }
        batch.store = this;
    }

    void fill(std::span<WideContact<1>> blocks, Links links) override { fillBlocks(blocks, links); }
    void fill(std::span<WideContact<2>> blocks, Links links) override { fillBlocks(blocks, links); }
    void fill(std::span<ContactConstraint> constraints, Links links) override {
        for (std::size_t i = 0; i < links.size(); ++i) { constraints[i] = contacts_[links[i].source]; }
        alone += static_cast<int>(links.size());
    }
    void take(std::span<const WideContact<1>> blocks, Links links) override { takeBlocks(blocks, links); }
    void take(std::span<const WideContact<2>> blocks, Links links) override { takeBlocks(blocks, links); }
    void take(std::span<const ContactConstraint> constraints, Links links) override {
        for (std::size_t i = 0; i < links.size(); ++i) { contacts_[links[i].source] = constraints[i]; }
    }
    void giveBack() { batch_.contacts = std::move(contacts_); }

    int alone = 0;

private:
    template <std::size_t kPoints>
    void fillBlocks(std::span<WideContact<kPoints>> blocks, Links links) {
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            fillBlock(blocks[i], std::span(batch_.inertias), [&](std::size_t lane) -> const ContactConstraint& {
                return contacts_[links[i * kBlockLanes + lane].source];
            });
            if constexpr (kPoints == 2) {
                contactKernels()->prepareTwo(blocks.subspan(i, 1));
            } else {
                contactKernels()->prepareOne(blocks.subspan(i, 1));
            }
        }
    }
    template <std::size_t kPoints>
    void takeBlocks(std::span<const WideContact<kPoints>> blocks, Links links) {
        for (std::size_t i = 0; i < blocks.size() * kBlockLanes; ++i) {
            const WideContact<kPoints>& block = blocks[i / kBlockLanes];
            const std::size_t lane = i % kBlockLanes;
            for (std::size_t k = 0; lane < block.lanes && k < kPoints; ++k) {
                ContactConstraintPoint& point = contacts_[links[i].source].points[k];
                point.normalImpulse = block.points[k].normalImpulse[lane];
                point.tangentImpulse = block.points[k].tangentImpulse[lane];
                point.totalNormalImpulse = block.points[k].totalNormalImpulse[lane];
            }
        }
    }

    SolverBatch& batch_;
    std::vector<ContactConstraint> contacts_;
};

/// Contacts may be kept by someone else: the same bits, with kernels and without, also of what bounces together.
TEST(ContactStore, IsSolvedToTheBitLikeConstraintsOfTheBatch) {
    int alone = 0;
    int rounds = 0;
    int blocks = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const int times = seed % 3 == 0 ? 16 : 1;
        RandomSolve plain(seed, times);
        RandomSolve kept(seed, times);
        const bool bounces = seed % 2 == 0;
        if (!bounces) {
            forgetBounces(plain);
            forgetBounces(kept);
        }
        kept.settings.wide = seed % 4 != 0;
        KeptContacts store(kept.batch, bounces);
        const SolveReport ofPlain = Solver().solve(plain.batch, plain.settings);
        const SolveReport ofKept = Solver().solve(kept.batch, kept.settings);
        store.giveBack();
        forgetPrepared(plain.batch);
        forgetPrepared(kept.batch);
        ASSERT_EQ(bitsOf(plain.batch), bitsOf(kept.batch)) << "seed " << seed;
        ASSERT_EQ(ofPlain.colours, ofKept.colours) << "seed " << seed;
        ASSERT_EQ(ofPlain.bounceRounds, ofKept.bounceRounds) << "seed " << seed;
        rounds += ofKept.bounceRounds;
        alone += store.alone;
        blocks += ofKept.contactBlocks;
    }
    EXPECT_GT(alone, 100);
    EXPECT_GT(rounds, 100);
    EXPECT_EQ(blocks > 100, contactKernels() != nullptr);
}

/// Of contacts alone between bodies that can be moved, colours may be found before.
TEST(ContactStore, IsColouredAheadToTheSameBits) {
    Solver ahead;  // one for all: what was found ahead is for one solve
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        std::vector<RandomSolve> both(2, RandomSolve(seed, 8));
        std::vector<int> colours;
        for (RandomSolve& solve : both) {
            forgetBounces(solve);
            solve.batch.clearJoints();
            solve.settings.joints = false;
            solve.settings.direct = DirectScope::none;
            for (std::size_t slot = 1; slot < solve.batch.inertias.size(); ++slot) {
                BodyInertia& inertia = solve.batch.inertias[slot];
                if (!isMovable(inertia)) { inertia = {1, 1}; }
            }
            KeptContacts store(solve.batch);
            Solver fresh;
            const bool isSecond = &solve == &both[1];
            if (isSecond && seed % 4 != 3) { ahead.colourAhead(solve.batch, true); }
            colours.push_back((isSecond ? ahead : fresh).solve(solve.batch, solve.settings).colours);
            store.giveBack();
            forgetPrepared(solve.batch);
        }
        ASSERT_EQ(bitsOf(both[0].batch), bitsOf(both[1].batch)) << "seed " << seed;
        ASSERT_EQ(colours[0], colours[1]) << "seed " << seed;
    }
}

/// As the engine hands over a large pile in profile `fast`.
void bounceInTurn(RandomSolve& solve) {
    solve.settings.bounces = false;
    solve.settings.bouncesInTurn = true;
    for (ContactConstraint& contact : solve.batch.contacts) {
        if (contact.restitution > kLivelyRestitution) { contact.bounceSpeed = solve.settings.restitutionThreshold; }
    }
}

/// @return how many blocks there were
int expectSameBouncesInTurn(int times, std::uint64_t seeds) {
    int blocks = 0;
    int bounced = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        RandomSolve narrow(seed, times);
        RandomSolve wide(seed, times);
        RandomSolve plastic(seed, times);
        bounceInTurn(narrow);
        bounceInTurn(wide);
        forgetBounces(plastic);
        narrow.settings.wide = false;
        const auto solve = [](RandomSolve& one) {
            KeptContacts store(one.batch);
            const SolveReport report = Solver().solve(one.batch, one.settings);
            store.giveBack();
            forgetPrepared(one.batch);
            return report;
        };
        solve(narrow);
        blocks += solve(wide).contactBlocks;
        solve(plastic);
        EXPECT_EQ(bitsOf(narrow.batch), bitsOf(wide.batch)) << "seed " << seed;
        bounced += bitsOf(plastic.batch) != bitsOf(wide.batch) ? 1 : 0;
        if (testing::Test::HasFailure()) { break; }
    }
    EXPECT_GT(bounced, static_cast<int>(seeds / 2)) << "too few bounces to prove anything";
    return blocks;
}

#ifdef SWEPT_SIMD

/// Makes Highway choose one instruction set.
class WideContacts : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(WideContacts, GiveTheBitsOfContactsOneByOne) {
    if (contactKernels() == nullptr) {  // of the plain processor
        EXPECT_EQ(expectSameBits(1, 10).contacts, 0);
        return;
    }
    ASSERT_STREQ(contactKernels()->name, hwy::TargetName(GetParam()));
    EXPECT_GT(expectSameBits(1, 300).contacts, 300) << "too few blocks to prove anything";
    const BlockCounts blocks = expectSameBits(16, 60);
    EXPECT_GT(blocks.contacts, 600);  // of sixteen lanes in float: fewer than when there were eight
    EXPECT_GT(blocks.hinges, 150);
    // Where there are no doubles side by side, rods and motor joints have no kernel.
    EXPECT_EQ(blocks.rods > 100, rodKernels() != nullptr);
    EXPECT_EQ(blocks.drives > 50, driveKernels() != nullptr);
    EXPECT_GT(blocks.slides, 50);
    EXPECT_GT(blocks.wheels, 50);
    EXPECT_GT(blocks.welds, 50);
}

TEST_P(WideContacts, BounceInTurnToTheBitAsOneByOne) {
    EXPECT_EQ(expectSameBouncesInTurn(1, 50) + expectSameBouncesInTurn(16, 20) > 100, contactKernels() != nullptr);
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, WideContacts, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

#endif

TEST(WideContact, BlocksAreLaidOutAlikeEverywhere) {
    EXPECT_EQ(sizeof(LaneArray), 64U);
    EXPECT_EQ(sizeof(WideContact<2>) - sizeof(WideContact<1>), sizeof(WideContactPoint));
    EXPECT_EQ(expectSameBits(4, 20).contacts > 0, contactKernels() != nullptr);
}

}  // namespace
}  // namespace swept::test

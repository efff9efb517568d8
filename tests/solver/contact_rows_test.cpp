#include <gtest/gtest.h>
#include <swept/solver/contacts/contact_lanes.h>
#include <swept/solver/contacts/contact_rows.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#ifdef SWEPT_SIMD
#include <swept/solver/wide/wide_targets.h>
// after it
#include <hwy/targets.h>
#endif

#include "../support/random.h"

/// Contacts that are laid into blocks side by side, and impulses that are taken back so, against the same one by one:
/// the same bits with every instruction set of this machine.

namespace swept::test {
namespace {

#ifdef SWEPT_SIMD

constexpr std::size_t kBodies = 20;

/// Random rows for one block, and all that it is filled from.
template <std::size_t kPoints>
struct FilledBlock {
    explicit FilledBlock(std::uint64_t seed) : random(seed) {
        for (std::size_t i = 0; i < kBodies; ++i) {
            const bool moves = i > 0 && i % 5 != 0;
            inertias.push_back(moves ? BodyInertia{number(0.1, 9), i % 7 == 0 ? Real(0) : number(0.1, 9)}
                                     : BodyInertia{});
        }
        terms = {.scale = seed % 3 == 0 ? Real(0.75) : Real(1),
                 .pushRatio = Real(1) / 16,
                 .closingTime = number(0.01, 0.02),
                 .bounceSpeed = number(0.1, 1),
                 .softness = softnessOfSubStep(kContactCycles, kContactDampingRatio, Real(0.004)),
                 .groundSoftness = softnessOfSubStep(2 * kContactCycles, kContactDampingRatio, Real(0.004)),
                 .settled = seed % 4 == 0};
        const auto lanes = static_cast<std::uint32_t>(seed % 2 == 0 ? kBlockLanes : 2 + seed % (kBlockLanes - 2));
        std::memset(static_cast<void*>(&block), 0xff, sizeof(block));  // of another solve
        emptyBlock(block, lanes);
        from.rows.fill(&nothing);
        for (std::size_t lane = 0; lane < lanes; ++lane) { setLane(lane); }
    }

    Real number(double low, double high) { return static_cast<Real>(random.range(low, high)); }
    Vec2 vector(double size) { return {number(-size, size), number(-size, size)}; }

    void setLane(std::size_t lane) {
        ContactRow& row = rows[lane];
        row.manifold.count = static_cast<int>(kPoints);
        row.manifold.normal = rotate(rotationFromAngle(random.range(-3, 3)), Vec2{1, 0});
        for (std::size_t k = 0; k < kPoints; ++k) {
            row.manifold.points[k] = {vector(2), number(-0.1, 0.1), static_cast<FeatureId>(random.integer(0, 60'000))};
            row.normalImpulse[k] = random.chance(0.4) ? Real(0) : number(0, 2);
            row.tangentImpulse[k] = number(-1, 1);
        }
        row.friction = number(0, 1);
        row.restitution = random.chance(0.5) ? Real(0) : number(0, 1);
        row.radiusA = random.chance(0.5) ? Real(0) : number(0, 1);
        row.radiusB = random.chance(0.5) ? Real(0) : number(0, 1);
        row.extent = number(0.1, 2);
        from.rows[lane] = &row;
        const Rotation rotation = rotationFromAngle(random.range(-3, 3));
        from.rotationC[lane] = rotation.c;
        from.rotationS[lane] = rotation.s;
        from.localCenterX[lane] = number(-1, 1);
        from.localCenterY[lane] = number(-1, 1);
        from.fromAToBX[lane] = number(-2, 2);
        from.fromAToBY[lane] = number(-2, 2);
        from.extent[lane] = row.extent;
        const auto a = static_cast<BodySlot>(random.integer(0, kBodies - 1));
        const auto b = static_cast<BodySlot>(random.integer(0, kBodies - 1));
        block.stateA[lane] = offsetOf(a);
        block.stateB[lane] = offsetOf(b);
        block.inverseMassA[lane] = inertias[a].inverseMass;
        block.inverseMassB[lane] = inertias[b].inverseMass;
        block.inverseInertiaA[lane] = inertias[a].inverseInertia;
        block.inverseInertiaB[lane] = inertias[b].inverseInertia;
    }

    /// One by one, as constraints are made.
    ContactConstraint constraintOf(std::size_t lane) const {
        const ContactRow& row = rows[lane];
        const Rotation rotation{from.rotationC[lane], from.rotationS[lane]};
        ContactConstraint contact;
        contact.slotA = slotAt(block.stateA[lane]);
        contact.slotB = slotAt(block.stateB[lane]);
        contact.normal = rotate(rotation, row.manifold.normal);
        contact.friction = row.friction;
        contact.restitution = row.restitution;
        contact.maxPushSpeed = terms.pushRatio * row.extent / terms.closingTime;
        contact.radiusA = row.radiusA;
        contact.radiusB = row.radiusB;
        if (row.restitution > kLivelyRestitution) { contact.bounceSpeed = terms.bounceSpeed; }
        const bool isOnGround = inertias[contact.slotA].inverseMass == 0 || inertias[contact.slotB].inverseMass == 0;
        contact.softness = isOnGround ? terms.groundSoftness : terms.softness;
        contact.count = static_cast<std::int32_t>(kPoints);
        for (std::size_t k = 0; k < kPoints; ++k) {
            ContactConstraintPoint& point = contact.points[k];
            const Vec2 localCenter{from.localCenterX[lane], from.localCenterY[lane]};
            point.anchorA = rotate(rotation, row.manifold.points[k].point - localCenter);
            point.anchorB = point.anchorA - Vec2{from.fromAToBX[lane], from.fromAToBY[lane]};
            point.baseSeparation = row.manifold.points[k].separation;
            point.normalImpulse = terms.scale * row.normalImpulse[k];
            point.tangentImpulse = terms.scale * row.tangentImpulse[k];
            point.separation = point.normalImpulse > 0 ? Real(0) : point.baseSeparation;
        }
        return contact;
    }

    Random random;
    std::vector<BodyInertia> inertias;
    std::array<ContactRow, kBlockLanes> rows{};
    ContactRow nothing;
    ContactSources from{};
    ContactTerms terms;
    WideContact<kPoints> block;
};

/// Of the lanes in use.
template <std::size_t kPoints>
std::vector<Real> numbersOf(const WideContact<kPoints>& block, bool settled) {
    std::vector<Real> numbers{block.mostRestitution};
    const auto note = [&](const LaneArray& lanes) {
        numbers.insert(numbers.end(), lanes.begin(), lanes.begin() + block.lanes);
    };
    for (const LaneArray* lanes :
         {&block.normalX, &block.normalY, &block.friction, &block.maxPushSpeed, &block.radiusA, &block.radiusB,
          &block.bounceSpeed, &block.biasRate, &block.massScale, &block.impulseScale, &block.restitution}) {
        note(*lanes);
    }
    if constexpr (kPoints == 2) {
        for (const LaneArray* lanes : {&block.sharedResponse, &block.pairGain, &block.begins}) { note(*lanes); }
    }
    for (const WideContactPoint& point : block.points) {
        for (const LaneArray* lanes : {&point.normalArmA, &point.tangentArmA, &point.normalArmB, &point.tangentArmB,
                                       &point.baseSeparation, &point.normalMass, &point.tangentMass,
                                       &point.normalImpulse, &point.tangentImpulse, &point.totalNormalImpulse}) {
            note(*lanes);
        }
        if (settled) { note(point.separation); }
    }
    return numbers;
}

template <std::size_t kPoints>
void fill(FilledBlock<kPoints>& filled) {
    if constexpr (kPoints == 2) {
        contactRowKernels()->fillTwo(filled.block, filled.from, filled.terms);
    } else {
        contactRowKernels()->fillOne(filled.block, filled.from, filled.terms);
    }
}

template <std::size_t kPoints>
WideContact<kPoints> filledOneByOne(const FilledBlock<kPoints>& filled) {
    WideContact<kPoints> block;
    emptyBlock(block, filled.block.lanes);
    fillBlock(block, std::span(filled.inertias), [&](std::size_t lane) { return filled.constraintOf(lane); });
    if constexpr (kPoints == 2) {
        contactKernels()->prepareTwo(std::span(&block, 1));
    } else {
        contactKernels()->prepareOne(std::span(&block, 1));
    }
    return block;
}

template <std::size_t kPoints>
void expectSameFilling() {
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        FilledBlock<kPoints> filled(seed);
        const WideContact<kPoints> wanted = filledOneByOne(filled);
        fill(filled);
        const std::vector<Real> got = numbersOf(filled.block, filled.terms.settled);
        const std::vector<Real> numbers = numbersOf(wanted, filled.terms.settled);
        ASSERT_EQ(got.size(), numbers.size());
        ASSERT_EQ(std::memcmp(got.data(), numbers.data(), got.size() * sizeof(Real)), 0) << "seed " << seed;
        ASSERT_EQ(filled.block.movableA, wanted.movableA) << "seed " << seed;
        ASSERT_EQ(filled.block.movableB, wanted.movableB) << "seed " << seed;
        for (std::size_t lane = 0; lane < wanted.lanes; ++lane) {
            for (std::size_t k = 0; k < kPoints; ++k) {
                const bool isUnloaded = (filled.block.unloaded[k] >> lane & 1U) != 0;
                ASSERT_EQ(isUnloaded, filled.rows[lane].normalImpulse[k] == 0) << "seed " << seed;
            }
        }
    }
}

template <std::size_t kPoints>
void expectSameTaking() {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        FilledBlock<kPoints> filled(seed);
        fill(filled);
        std::array<ContactRow, kBlockLanes> wanted = filled.rows;
        std::vector<ContactRow*> rows;
        LanesByPoint pressing{};
        for (std::size_t lane = 0; lane < filled.block.lanes; ++lane) {
            rows.push_back(&filled.rows[lane]);
            for (std::size_t k = 0; k < kPoints; ++k) {
                filled.block.points[k].normalImpulse[lane] = filled.number(0, 2);
                filled.block.points[k].tangentImpulse[lane] = filled.number(-2, 2);
                const bool presses = filled.random.chance(0.5);
                filled.block.points[k].totalNormalImpulse[lane] = presses ? filled.number(0.1, 2) : Real(0);
                pressing[k] |= (presses ? 1U : 0U) << lane;
                wanted[lane].normalImpulse[k] = filled.block.points[k].normalImpulse[lane] / filled.terms.scale;
                wanted[lane].tangentImpulse[k] = filled.block.points[k].tangentImpulse[lane] / filled.terms.scale;
            }
        }
        if constexpr (kPoints == 2) {
            ASSERT_EQ(contactRowKernels()->takeTwo(filled.block, rows, filled.terms.scale), pressing);
        } else {
            ASSERT_EQ(contactRowKernels()->takeOne(filled.block, rows, filled.terms.scale), pressing);
        }
        for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {  // and those that are not in use stay as they are
            ASSERT_EQ(filled.rows[lane].normalImpulse, wanted[lane].normalImpulse) << "seed " << seed;
            ASSERT_EQ(filled.rows[lane].tangentImpulse, wanted[lane].tangentImpulse) << "seed " << seed;
            ASSERT_EQ(filled.rows[lane].friction, wanted[lane].friction) << "seed " << seed;
        }
    }
}

/// Makes Highway choose one instruction set.
class ContactRows : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override {
        hwy::SetSupportedTargetsForTest(GetParam());
        ASSERT_EQ(contactRowKernels() == nullptr, contactKernels() == nullptr);
    }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(ContactRows, FillBlocksToTheBitAsOneByOne) {
    if (contactRowKernels() == nullptr) { GTEST_SKIP() << "a plain processor: no blocks are filled"; }
    expectSameFilling<1>();
    expectSameFilling<2>();
}

TEST_P(ContactRows, TakeImpulsesToTheBitAsOneByOne) {
    if (contactRowKernels() == nullptr) { GTEST_SKIP() << "a plain processor: no blocks are filled"; }
    expectSameTaking<1>();
    expectSameTaking<2>();
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, ContactRows, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

#endif

/// Kernels load four numbers of it at a time.
TEST(ContactRow, HoldsItsNumbersSideBySide) {
    EXPECT_EQ(offsetof(ContactRow, radiusB) - offsetof(ContactRow, friction), 3 * sizeof(Real));
    EXPECT_EQ(contactRowKernels() == nullptr, contactKernels() == nullptr);
}

}  // namespace
}  // namespace swept::test

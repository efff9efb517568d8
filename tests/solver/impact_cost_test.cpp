#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "newton_reference.h"

/// How many contacts are visited where many bounce together.

namespace swept::test {
namespace {

/// A square of touching disks that all fall towards its lowest row, which stands: each contact must pass the blow on to
/// all.
struct Block {
    std::vector<BodyState> states;
    std::vector<BodyInertia> inertias;
    std::vector<ContactConstraint> contacts;

    explicit Block(std::uint32_t side) {
        states.resize(side * side + 1);
        inertias.resize(side * side + 1);
        for (std::uint32_t i = side + 1; i <= side * side; ++i) {
            states[i].velocity = {0, -1 - Real(0.01) * static_cast<Real>(i % 11)};
            inertias[i] = {1, 2};
        }
        for (std::uint32_t row = 0; row < side; ++row) {
            for (std::uint32_t column = 0; column < side; ++column) {
                const std::uint32_t own = 1 + row * side + column;
                if (column + 1 < side) { connect(own, own + 1, {1, 0}); }
                if (row + 1 < side) { connect(own, own + side, {0, 1}); }
            }
        }
        for (ContactConstraint& contact : contacts) { prepareContact(contact, inertias); }
    }

    void connect(std::uint32_t a, std::uint32_t b, Vec2 normal) {
        ContactConstraint contact;
        contact.slotA = a;
        contact.slotB = b;
        contact.normal = normal;
        contact.restitution = Real(0.9);
        contact.count = 1;
        contact.points[0].anchorA = Real(0.5) * normal;
        contact.points[0].anchorB = Real(-0.5) * normal;
        contacts.push_back(contact);
    }
    Wide energy() const {
        Wide sum = 0;
        for (std::size_t i = 1; i < states.size(); ++i) {
            if (!(inertias[i].inverseMass > 0)) { continue; }
            const Vec2 v = states[i].velocity;
            sum += Wide(0.5) * (Wide(v.x) * v.x + Wide(v.y) * v.y);
        }
        return sum;
    }
};

/// @return contacts visited
std::size_t visitsOf(std::uint32_t side, bool isCoarse) {
    Block block(side);
    std::vector<ContactConstraint*> all;
    for (ContactConstraint& contact : block.contacts) { all.push_back(&contact); }
    const Wide before = block.energy();
    ImpactScratch scratch;
    reflectImpacts(all, {block.states, block.inertias}, {.isCoarse = isCoarse}, kMaxBounceRounds, scratch);
    EXPECT_LE(block.energy(), before * (1 + 1e-4L)) << side;
    EXPECT_GT(scratch.visits, 0U);
    // The last round may exceed the budget by its least number of sweeps.
    const std::size_t always = isCoarse ? 1024 : 16384;
    EXPECT_LE(scratch.visits, std::max<std::size_t>(always, 2 * all.size()) + 3 * all.size()) << side;
    return scratch.visits;
}

TEST(Impact, OfThousandsCostsAFewVisitsOfEach) {
    for (const std::uint32_t side : {10U, 30U, 70U}) { EXPECT_LE(visitsOf(side, true), visitsOf(side, false)) << side; }
}

/// What a later round leaves out is what nobody moved: at the end nothing approaches that is in the call's reach.
TEST(Impact, RoundsLookAtWhatMovedAlone) {
    constexpr std::uint32_t kLength = 200;
    std::vector<BodyState> states(kLength + 1);
    std::vector<BodyInertia> inertias(kLength + 1, BodyInertia{1, 2});
    std::vector<ContactConstraint> contacts(kLength - 1);
    states[1].velocity = {1, 0};
    std::vector<ContactConstraint*> all;
    for (std::uint32_t i = 0; i + 1 < kLength; ++i) {
        ContactConstraint& contact = contacts[i];
        contact.slotA = i + 1;
        contact.slotB = i + 2;
        contact.normal = {1, 0};
        contact.restitution = 1;
        contact.count = 1;
        contact.points[0].anchorA = {Real(0.5), 0};
        contact.points[0].anchorB = {Real(-0.5), 0};
        prepareContact(contact, inertias);
        all.push_back(&contact);
    }
    ImpactScratch scratch;
    EXPECT_LT(reflectImpacts(all, {states, inertias}, {}, 2 * static_cast<int>(kLength), scratch),
              2 * static_cast<int>(kLength));
    EXPECT_EQ(states[kLength].velocity, (Vec2{1, 0})) << "the blow went through the row, from ball to ball";
    for (std::uint32_t i = 1; i < kLength; ++i) { EXPECT_EQ(states[i].velocity, (Vec2{0, 0})) << i; }
    // All of them once, and then three at a time: two neighbours of what moved, and the one between.
    EXPECT_LE(scratch.visits, all.size() + 4 * kLength);
}

/// Three balls side by side that a fourth and a fifth fall between, all of it at this speed. @return contacts visited
std::size_t visitsOfPyramid(Real speed, Real slope) {
    std::vector<BodyState> states(6);
    std::vector<BodyInertia> inertias(6, BodyInertia{1, 0});
    inertias[kFixedSlot] = {};
    for (BodyState& state : states) { state.velocity = {speed, 0}; }
    states[4].velocity.y = states[5].velocity.y = -1;
    std::vector<ContactConstraint> contacts;
    for (const auto& [below, above, side] :
         {std::array{1, 4, 1}, std::array{2, 4, -1}, std::array{2, 5, 1}, std::array{3, 5, -1}}) {
        ContactConstraint contact;
        contact.slotA = static_cast<BodySlot>(below);
        contact.slotB = static_cast<BodySlot>(above);
        contact.normal = normalized(Vec2{static_cast<Real>(side) * slope, 1}).unit;
        contact.restitution = 1;
        contact.count = 1;
        contacts.push_back(contact);
    }
    std::vector<ContactConstraint*> all;
    for (ContactConstraint& contact : contacts) {
        prepareContact(contact, inertias);
        all.push_back(&contact);
    }
    ImpactScratch scratch;
    reflectImpacts(all, {states, inertias}, {}, kMaxBounceRounds, scratch);
    EXPECT_LT(states[2].velocity.y, 0) << "nothing was hit";
    return scratch.visits;
}

/// What bounces together on the move is found in no more sweeps than at rest: the search ends where rounding begins,
/// which goes by the speeds of the bodies.
TEST(Impact, TogetherEndsWhereRoundingBegins) {
    for (const Real slope : {Real(0.3), Real(0.7), Real(1), Real(1.7), Real(3)}) {
        for (const Real speed : {Real(30), Real(1000), Real(30000)}) {
            EXPECT_LE(visitsOfPyramid(speed, slope), visitsOfPyramid(0, slope) + 8) << speed << ", " << slope;
        }
    }
}

/// A disc between a wall on its left, which stands, and a face on its right, which comes at a speed of 1.
struct Squeeze {
    std::array<BodyState, 3> states{};
    std::array<BodyInertia, 3> inertias{};
    std::array<ContactConstraint, 2> contacts{};
    std::size_t visits = 0;

    /// @param tilt  of the face: where it is above 0, the way up is free
    Squeeze(Real tilt, Real friction, Real restitution) {
        states[2].velocity = {-1, 0};
        inertias[1] = {1, 2};
        const Vec2 away = normalized(Vec2{-1, tilt}).unit;
        for (std::size_t i = 0; i < 2; ++i) {
            ContactConstraint& contact = contacts[i];
            contact.slotA = static_cast<BodySlot>(2 * i);
            contact.slotB = 1;
            contact.normal = i == 0 ? Vec2{1, 0} : away;
            contact.friction = friction;
            contact.restitution = restitution;
            contact.count = 1;
            contact.points[0].anchorB = Real(-1) * contact.normal;
            prepareContact(contact, inertias);
        }
        states[1].velocity = {Real(-0.5), 0};  // so that both are met
        std::vector<ContactConstraint*> all{&contacts[0], &contacts[1]};
        ImpactScratch scratch;
        reflectImpacts(all, {states, inertias}, {.resolvePlastic = true}, 64, scratch);
        visits = scratch.visits;
    }
};

/// Nothing keeps a body out of both: a call takes no more than a few sweeps to tell, and gives it no more speed than
/// what squeezes it has.
TEST(Impact, OfWhatIsSqueezedEndsSoon) {
    for (const Real restitution : {Real(0), Real(0.5)}) {
        const Squeeze press(0, Real(0.6), restitution);
        EXPECT_LE(press.visits, 64U) << restitution;
        EXPECT_LE(length(press.states[1].velocity), Real(1.001)) << restitution;
        for (const ContactConstraint& contact : press.contacts) {
            EXPECT_LE(contact.points[0].totalNormalImpulse, 32) << restitution;
        }
    }
}

/// Nor where there is a way out, and friction holds it there; what it lets go does get out.
TEST(Impact, OfWhatFrictionHoldsEndsSoon) {
    const Squeeze held(Real(0.3), Real(0.6), 0);
    EXPECT_LE(held.visits, 4096U);
    const Squeeze free(Real(0.3), 0, 0);
    for (const ContactConstraint& contact : free.contacts) {
        const Vec2 moving = free.states[1].velocity - free.states[contact.slotA].velocity;
        EXPECT_GE(dot(moving, contact.normal), Real(-1e-3));
    }
    EXPECT_GT(free.states[1].velocity.y, 1);
}

}  // namespace
}  // namespace swept::test

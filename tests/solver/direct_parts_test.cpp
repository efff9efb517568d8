#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "numbers.h"
#include "random_solve.h"

/// What is solved all at once is searched island by island: none pays for what goes to and fro in another one.

namespace swept::test {
namespace {

/// Bodies and contacts that do not bounce.
RandomSolve contactsAlone(std::uint64_t seed) {
    RandomSolve solve(seed);
    solve.batch.clearJoints();
    for (ContactConstraint& contact : solve.batch.contacts) { contact.restitution = 0; }
    solve.settings.subSteps = 2;
    solve.settings.joints = false;
    solve.settings.direct = DirectScope::all;
    return solve;
}

/// Both in one batch, their contacts in turns.
RandomSolve together(const RandomSolve& first, const RandomSolve& second) {
    RandomSolve both = first;
    const auto after = static_cast<BodySlot>(first.batch.states.size() - 1);
    for (std::size_t i = 1; i < second.batch.states.size(); ++i) {
        both.batch.addBody(second.batch.states[i], second.batch.inertias[i], second.batch.drives[i]);
    }
    both.batch.contacts.clear();
    const auto moved = [after](BodySlot slot) {
        return slot == kFixedSlot ? slot : static_cast<BodySlot>(slot + after);
    };
    for (std::size_t i = 0; i < std::max(first.batch.contacts.size(), second.batch.contacts.size()); ++i) {
        if (i < second.batch.contacts.size()) {
            ContactConstraint contact = second.batch.contacts[i];
            contact.slotA = moved(contact.slotA);
            contact.slotB = moved(contact.slotB);
            both.batch.contacts.push_back(contact);
        }
        if (i < first.batch.contacts.size()) { both.batch.contacts.push_back(first.batch.contacts[i]); }
    }
    return both;
}

/// @param after  slots before those of the part
void expectSame(const SolverBatch& batch, std::size_t after, const SolverBatch& alone, std::uint64_t seed) {
    for (std::size_t i = 1; i < alone.states.size(); ++i) {
        const BodyState& a = batch.states[after + i];
        const BodyState& b = alone.states[i];
        EXPECT_EQ(a.velocity, b.velocity) << "seed " << seed << ", body " << i;
        EXPECT_EQ(a.angularVelocity, b.angularVelocity) << "seed " << seed << ", body " << i;
        EXPECT_EQ(a.deltaPosition, b.deltaPosition) << "seed " << seed << ", body " << i;
    }
}

TEST(DirectParts, AreSolvedAsIfTheyWereAlone) {
    int searched = 0;
    for (std::uint64_t seed = 0; seed < 400; seed += 2) {
        RandomSolve first = contactsAlone(seed);
        RandomSolve second = contactsAlone(seed + 1);
        second.settings = first.settings;
        RandomSolve both = together(first, second);
        Solver solver;
        const SolveReport ofFirst = solver.solve(first.batch, first.settings);
        const SolveReport ofSecond = solver.solve(second.batch, second.settings);
        const SolveReport ofBoth = solver.solve(both.batch, both.settings);
        EXPECT_EQ(ofBoth.direct.givenUp > 0, ofFirst.direct.givenUp + ofSecond.direct.givenUp > 0) << "seed " << seed;
        if (!ofBoth.isDirect || ofBoth.direct.givenUp > 0) { continue; }
        searched += ofFirst.direct.rounds > 8 && ofSecond.direct.rounds > 8 ? 1 : 0;
        expectSame(both.batch, 0, first.batch, seed);
        expectSame(both.batch, first.batch.states.size() - 1, second.batch, seed);
    }
    EXPECT_GT(searched, 20);
}

}  // namespace
}  // namespace swept::test

#include <gtest/gtest.h>
#include <swept/solver/graph/constraint_graph.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "../support/random.h"
#include "../support/some_of.h"

namespace swept::test {
namespace {

bool isMovable(const SolverBatch& batch, BodySlot slot) {
    return batch.inertias[slot].inverseMass > 0 || batch.inertias[slot].inverseInertia > 0;
}

template <class Item>
std::vector<Item> listOf(std::span<const Item> items) {
    return {items.begin(), items.end()};
}

/// Bodies of all kinds and random constraints between them; the source names the place in the array.
SolverBatch randomBatch(std::uint64_t seed) {
    Random random(seed);
    SolverBatch batch;
    batch.clear();
    const int bodies = random.integer(1, 60);
    for (int i = 0; i < bodies; ++i) {
        const double kind = random.uniform();
        BodyInertia inertia{1, 1};
        if (kind < 0.1) { inertia = {}; }
        if (kind > 0.95) { inertia = {0, 1}; }  // turns in place
        batch.addBody({}, inertia, {});
    }
    // A hub takes part in many constraints, so that some families overflow.
    const double hubShare = random.chance(0.5) ? random.uniform() : 0;
    const auto fill = [&](auto& constraints) {
        const int count = random.integer(0, 120);
        for (int i = 0; i < count; ++i) {
            auto& constraint = constraints.emplace_back();
            const int a = random.chance(hubShare) ? 1 : random.integer(0, bodies);
            const int b = (a + random.integer(1, bodies)) % (bodies + 1);
            constraint.slotA = static_cast<BodySlot>(random.chance(0.5) ? a : b);
            constraint.slotB = static_cast<BodySlot>(a + b) - constraint.slotA;
            constraint.source = static_cast<std::uint32_t>(i);
        }
    };
    fill(batch.contacts);
    fill(batch.revolutes);
    fill(batch.distances);
    return batch;
}

/// Checks one kind: ranges cover the array in order, sources are a permutation, ascending within a colour.
template <class Constraint, class RangeOf>
void checkKind(const std::vector<Constraint>& before, const std::vector<Constraint>& after, RangeOf&& rangeOf,
               std::uint64_t seed) {
    ASSERT_EQ(before.size(), after.size()) << "seed " << seed;
    std::uint32_t expected = 0;
    std::set<std::uint32_t> sources;
    for (int colour = 0; colour < kColourCount; ++colour) {
        const ColourRange range = rangeOf(colour);
        ASSERT_EQ(range.begin, expected) << "seed " << seed;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const Constraint& constraint = after[i];
            sources.insert(constraint.source);
            ASSERT_EQ(constraint.slotA, before[constraint.source].slotA) << "seed " << seed;
            ASSERT_EQ(constraint.slotB, before[constraint.source].slotB) << "seed " << seed;
            if (i > range.begin) {
                ASSERT_LT(after[i - 1].source, constraint.source) << "seed " << seed << ": not stable";
            }
        }
        expected = range.end;
    }
    ASSERT_EQ(expected, after.size()) << "seed " << seed;
    ASSERT_EQ(sources.size(), after.size()) << "seed " << seed;
}

class ColourUse {
public:
    explicit ColourUse(const SolverBatch& batch) : batch_(batch) {}

    template <class Constraint>
    void take(const std::vector<Constraint>& constraints, ColourRange range, int colour, std::uint64_t seed) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const bool bothMove = isMovable(batch_, constraints[i].slotA) && isMovable(batch_, constraints[i].slotB);
            ASSERT_EQ(bothMove, colour < kFirstFixedColour) << "seed " << seed << ": wrong half of the colours";
            for (const BodySlot slot : {constraints[i].slotA, constraints[i].slotB}) {
                if (!isMovable(batch_, slot)) { continue; }
                ASSERT_TRUE(taken_.insert(slot).second)
                    << "seed " << seed << ": body " << slot << " twice in " << colour;
            }
        }
    }

private:
    const SolverBatch& batch_;
    std::set<BodySlot> taken_;
};

TEST(ConstraintGraph, NoColourHasAMovableBodyTwiceAndNothingIsLost) {
    int overflows = 0;
    int colours = 0;
    ConstraintGraph graph;  // one for all, as a world keeps it
    for (std::uint64_t seed = 0; seed < someOf(3'000U); ++seed) {
        const SolverBatch before = randomBatch(seed);
        SolverBatch after = before;
        graph.colour(after);
        const std::vector<std::uint32_t> places(graph.contacts().begin(), graph.contacts().end());
        graph.sortContacts(after);
        for (std::size_t i = 0; i < places.size(); ++i) {
            ASSERT_EQ(after.contacts[i].source, before.contacts[places[i]].source) << "seed " << seed;
            ASSERT_EQ(graph.contacts()[i], i) << "seed " << seed;
        }
        checkKind(
            before.contacts, after.contacts, [&](int c) { return graph.range<ContactConstraint>(c); }, seed);
        checkKind(
            before.revolutes, after.revolutes, [&](int c) { return graph.range<RevoluteConstraint>(c); }, seed);
        checkKind(
            before.distances, after.distances, [&](int c) { return graph.range<DistanceConstraint>(c); }, seed);
        for (const int colour : graph.activeColours()) {
            ++colours;
            if (colour == kOverflowColour) {
                ++overflows;
                continue;
            }
            ColourUse use(after);
            use.take(after.contacts, graph.range<ContactConstraint>(colour), colour, seed);
            use.take(after.revolutes, graph.range<RevoluteConstraint>(colour), colour, seed);
            use.take(after.distances, graph.range<DistanceConstraint>(colour), colour, seed);
        }
        ASSERT_TRUE(std::is_sorted(graph.activeColours().begin(), graph.activeColours().end()));
        if (HasFatalFailure()) { return; }
    }
    EXPECT_GT(overflows, someOf(300));
    EXPECT_GT(colours, someOf(30'000));
}

TEST(ConstraintGraph, IsTheSameWhateverItColouredBefore) {
    ConstraintGraph used;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SolverBatch first = randomBatch(seed);
        SolverBatch second = first;
        ConstraintGraph fresh;
        used.colour(first);
        fresh.colour(second);
        used.sortContacts(first);
        fresh.sortContacts(second);
        ASSERT_EQ(used.activeColours(), fresh.activeColours()) << "seed " << seed;
        const auto sourcesOf = [](const auto& constraints) {
            std::vector<std::uint32_t> sources;
            for (const auto& constraint : constraints) { sources.push_back(constraint.source); }
            return sources;
        };
        ASSERT_EQ(sourcesOf(first.contacts), sourcesOf(second.contacts)) << "seed " << seed;
        ASSERT_EQ(sourcesOf(first.revolutes), sourcesOf(second.revolutes)) << "seed " << seed;
        ASSERT_EQ(sourcesOf(first.distances), sourcesOf(second.distances)) << "seed " << seed;
    }
}

TEST(ConstraintGraph, AheadItIsTheSame) {
    ConstraintGraph ahead;
    ConstraintGraph after;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SolverBatch batch = randomBatch(seed);
        const bool doAllMove = seed % 2 == 0;
        std::vector<BodySlot> standing;
        for (std::size_t slot = 1; slot < batch.inertias.size(); ++slot) {
            if (doAllMove) { batch.inertias[slot] = {1, 1}; }
            if (!isMovable(batch.inertias[slot])) { standing.push_back(static_cast<BodySlot>(slot)); }
        }
        const bool hasJoints = seed % 3 != 0;
        SolverBatch notSet = batch;
        std::fill(notSet.inertias.begin(), notSet.inertias.end(), BodyInertia{});
        hasJoints ? after.colour(batch) : after.colourContacts(batch);
        ahead.colourAhead(notSet, !hasJoints, standing);
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        ASSERT_EQ(listOf(ahead.contactColours()), listOf(after.contactColours()));
        ASSERT_EQ(ahead.pointCounts(), after.pointCounts());
        ASSERT_EQ(listOf(ahead.contactRanks()), listOf(after.contactRanks()));
        ASSERT_EQ(ahead.activeColours(), after.activeColours());
        const auto sourcesOf = [](const std::vector<DistanceConstraint>& joints) {
            std::vector<std::uint32_t> sources;
            for (const DistanceConstraint& joint : joints) { sources.push_back(joint.source); }
            return sources;
        };
        ASSERT_EQ(sourcesOf(notSet.distances), sourcesOf(batch.distances));
    }
}

/// Stores that are there, and not asked for anything.
class SilentContacts final : public ContactStore {
public:
    void fill(std::span<WideContact<1>>, Links) override { ADD_FAILURE(); }
    void fill(std::span<WideContact<2>>, Links) override { ADD_FAILURE(); }
    void fill(std::span<ContactConstraint>, Links) override { ADD_FAILURE(); }
    void take(std::span<const WideContact<1>>, Links) override { ADD_FAILURE(); }
    void take(std::span<const WideContact<2>>, Links) override { ADD_FAILURE(); }
    void take(std::span<const ContactConstraint>, Links) override { ADD_FAILURE(); }
};
class SilentHinges final : public HingeStore {
public:
    void fill(std::size_t, std::span<const BlockPlace>, const HingeArrays&) override { ADD_FAILURE(); }
    void take(std::size_t, std::span<const BlockPlace>, const HingeArrays&) override { ADD_FAILURE(); }
};

/// The same constraints as links, one after the other.
void linkAll(SolverBatch& batch, Random& random) {
    static SilentContacts contacts;
    static SilentHinges hinges;
    for (const ContactConstraint& contact : batch.contacts) {
        const auto points = static_cast<std::uint8_t>(random.integer(1, 2));
        batch.links.push_back({contact.slotA, contact.slotB, contact.source, points, random.chance(0.1)});
    }
    for (const RevoluteConstraint& joint : batch.revolutes) {
        batch.hingeLinks.push_back({joint.slotA, joint.slotB, joint.source, {}});
    }
    batch.contacts.clear();
    batch.revolutes.clear();
    batch.store = &contacts;
    if (!batch.hingeLinks.empty()) { batch.hingeStore = &hinges; }
}

/// Changes something that colours may depend on, or nothing.
void changeLinks(SolverBatch& batch, Random& random) {
    const auto any = [&random](const auto& items) {
        return static_cast<std::size_t>(random.integer(0, static_cast<int>(items.size()) - 1));
    };
    const auto anyBody = [&] { return static_cast<BodySlot>(any(batch.inertias)); };
    switch (random.integer(0, 9)) {
        case 0:
            if (!batch.links.empty()) { batch.links.pop_back(); }
            break;
        case 1:
            if (!batch.links.empty()) { batch.links[any(batch.links)].points ^= 3U; }
            break;
        case 2:
            if (!batch.links.empty()) { batch.links[any(batch.links)].slotA = anyBody(); }
            break;
        case 3:
            if (!batch.hingeLinks.empty()) { batch.hingeLinks[any(batch.hingeLinks)].slotB = anyBody(); }
            break;
        case 4:
            batch.inertias[1] = isMovable(batch, 1) ? BodyInertia{} : BodyInertia{1, 1};
            break;
        case 5:
            batch.distances.resize(batch.distances.empty() ? 1 : 0);
            break;
        case 6:
            batch.links.push_back({anyBody(), anyBody(), 0, 1, false});
            break;
        default:
            break;
    }
    // As links of a solve are: of something that moves, and no body to itself.
    std::erase_if(batch.links, [&batch](const ContactLink& link) {
        return link.slotA == link.slotB || !(isMovable(batch, link.slotA) || isMovable(batch, link.slotB));
    });
}

TEST(ConstraintGraph, CountsContactsOfAColourFromBothEnds) {
    std::size_t fromTheBack = 0;
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        Random random(seed);
        SolverBatch batch = randomBatch(seed);
        linkAll(batch, random);
        ConstraintGraph graph;
        graph.colour(batch);
        std::map<std::pair<std::size_t, std::size_t>, std::array<std::uint32_t, 2>> seen;  // by colour and points
        for (std::size_t i = 0; i < batch.links.size(); ++i) {
            const ContactLink& link = batch.links[i];
            const std::size_t colour = graph.contactColours()[i];
            const std::size_t points = colour == kOverflowColour ? 0 : pointsInBlock(link);
            const bool isBack = points > 0 && 2 * std::max(link.slotA, link.slotB) >= batch.inertias.size();
            const ContactRank rank = graph.contactRanks()[i];
            ASSERT_EQ(rank.isBack(), isBack) << "seed " << seed << ", link " << i;
            ASSERT_EQ(rank.number(), (seen[{colour, points}][isBack ? 1 : 0]++)) << "seed " << seed << ", link " << i;
            fromTheBack += isBack ? 1 : 0;
        }
        for (const auto& [place, counts] : seen) {
            ASSERT_EQ(graph.pointCounts()[place.first][place.second].ofSide, counts) << "seed " << seed;
        }
    }
    EXPECT_GT(fromTheBack, 1000U);
}

TEST(ConstraintGraph, KeepsTheColoursThatLinksWouldBeGivenAnew) {
    int keptHinges = 0;
    int changedHinges = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        SolverBatch batch = randomBatch(seed);
        if (random.chance(0.5)) { batch.distances.clear(); }
        const SolverBatch constraints = batch;
        linkAll(batch, random);
        ConstraintGraph used;
        for (int round = 0; round < 30; ++round) {
            if (random.chance(0.05)) {  // something else in between
                SolverBatch other = constraints;
                used.colour(other);
            }
            ConstraintGraph fresh;
            SolverBatch again = batch;
            used.colour(batch);
            fresh.colour(again);
            keptHinges += used.areHingesKept() && batch.hingeStore != nullptr ? 1 : 0;
            changedHinges += used.areHingesKept() ? 0 : 1;
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", round " << round);
            ASSERT_EQ(listOf(used.contactColours()), listOf(fresh.contactColours()));
            ASSERT_EQ(listOf(used.hingeColours()), listOf(fresh.hingeColours()));
            ASSERT_EQ(used.pointCounts(), fresh.pointCounts());
            ASSERT_EQ(listOf(used.contactRanks()), listOf(fresh.contactRanks()));
            ASSERT_EQ(used.activeColours(), fresh.activeColours());
            changeLinks(batch, random);
        }
    }
    EXPECT_GT(keptHinges, someOf(3'000));
    EXPECT_GT(changedHinges, someOf(1'000));
}

/// A star: `count` contacts of one movable body with others that may move or not.
ColourRange overflowOfStar(int count, BodyInertia others) {
    SolverBatch batch;
    batch.clear();
    const BodySlot hub = batch.addBody({}, {1, 1}, {});
    for (int i = 0; i < count; ++i) {
        ContactConstraint contact;
        contact.slotA = batch.addBody({}, others, {});
        contact.slotB = hub;
        batch.contacts.push_back(contact);
    }
    ConstraintGraph graph;
    graph.colour(batch);
    return graph.range<ContactConstraint>(kOverflowColour);
}

TEST(ConstraintGraph, OverflowsWhenABodyHasMoreConstraintsThanThereAreColours) {
    const auto countOf = [](ColourRange range) { return range.end - range.begin; };
    EXPECT_EQ(countOf(overflowOfStar(48, {1, 1})), 0U);
    EXPECT_EQ(countOf(overflowOfStar(49, {1, 1})), 1U);
    EXPECT_EQ(countOf(overflowOfStar(100, {1, 1})), 52U);
    EXPECT_EQ(countOf(overflowOfStar(15, {})), 0U);
    EXPECT_EQ(countOf(overflowOfStar(16, {})), 1U);
}

}  // namespace
}  // namespace swept::test

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/task_system.h"
#include "../graph/constraint_graph.h"
#include "../graph/range_cut.h"
#include "../halves.h"
#include "../wide/wide_contacts.h"
#include "contact_store.h"

namespace swept::inline SWEPT_PRECISION {

/// Blocks of contacts that have as many points there, colour by colour.
struct BlockRow {
    RawVector<std::uint8_t> lanes;    ///< in use, by block
    std::vector<ColourRange> halves;  ///< for each colour its blocks of the first half of the bodies, then for each the
                                      ///< others
    std::size_t middle = 0;           ///< how many blocks are of the first half

    std::size_t count() const { return lanes.size(); }
    /// Goes through all on several workers, each of which meets the same bodies as in the solve, if it can.
    /// @param take  called with ranges of blocks that cover them exactly once
    template <class Take>
    void share(TaskSystem& loops, const Take& take) const;
};

/// Where the contacts of a solve stand: of each colour what fills blocks, by number of points, and the rest one by one.
/// What is halved are the bodies of the batch, by their places; a contact is of the first half if both its bodies are.
/// In the blocks of a colour, contacts of the first half come first, and those of the second half last:
///
///     of two points   1st half → | ← 2nd half     where the bar is, `middle`, a block may hold contacts of both;
///     of one point    1st half → | ← 2nd half     each half is counted from its own end
///     the rest        as listed, cut in the middle of their number
///
/// So two workers that keep to their ends of the colours mostly meet bodies that they had before. (What another one
/// wrote takes longer to fetch than to solve.)
class ContactLayout {
public:
    /// What kind of place a contact gets within its colour: where there are blocks, by its points there.
    enum Kind : std::uint8_t { kAlone, kOnePoint, kTwoPoints, kKindCount };
    struct Colour {
        ColourRange one;
        ColourRange two;
        ColourRange rest;
        // Where, roughly, the blocks begin that hold contacts of the second half of the bodies:
        std::uint32_t middleOfOne = 0;
        std::uint32_t middleOfTwo = 0;

        bool hasBlocks() const { return two.begin < two.end || one.begin < one.end; }
        /// Blocks, and contacts on their own.
        std::size_t count() const { return (two.end - two.begin) + (one.end - one.begin) + (rest.end - rest.begin); }
        /// Of these those of the first half of the bodies.
        std::size_t middle() const {
            return (middleOfTwo - two.begin) + (middleOfOne - one.begin) + (rest.end - rest.begin) / 2;
        }
    };

    /// @param wide  false: everything is on its own
    void layOut(const ConstraintGraph& graph, bool wide);

    const Colour& operator[](int colour) const { return colours_[static_cast<std::size_t>(colour)]; }
    const BlockRow& one() const { return one_; }
    const BlockRow& two() const { return two_; }
    /// Contacts on their own.
    std::size_t restCount() const { return restCount_; }
    /// Lets a colour go on with what another one holds. @return false, and nothing is done, unless both hold only
    /// contacts on their own, which stand side by side. Then their order matters.
    bool join(int colour, int next);
    /// @pre laid out
    /// @param contacts  of the batch, or links
    /// @param list  called with the kind of place, the place, and which contact it is of; by several workers
    template <class Contacts, class List>
    void listPlaces(const ConstraintGraph& graph, const Contacts& contacts, TaskSystem& loops, const List& list) const;

private:
    using KindCounts = std::array<std::uint32_t, kKindCount>;
    /// Contacts that are worth handing over to be listed.
    static constexpr std::size_t kListGrain = 512;
    /// Blocks per part of a parallel loop.
    static constexpr std::size_t kBlockGrain = 8;
    friend BlockRow;
    /// Places for the contacts of a colour that have as many points in blocks.
    struct Places {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        ContactRank leftOver{};   ///< who gets none of these, if anybody
        bool isOneLeft = false;   ///< there is somebody
        std::uint32_t alone = 0;  ///< the place that he gets among those on their own
    };

    bool mayHaveBlocks(int colour) const { return isWide_ && colour != kOverflowColour; }
    void countBlocks(const ConstraintGraph& graph);
    static Places placesFor(ColourRange blocks, std::uint32_t contacts, std::uint32_t inFront, std::uint32_t& alone);
    void listHalves(const ConstraintGraph& graph);

    bool isWide_ = false;
    std::size_t restCount_ = 0;
    std::array<Colour, kColourCount> colours_{};
    BlockRow one_;
    BlockRow two_;
    std::array<std::array<Places, kKindCount>, kColourCount> places_{};
};

template <class Take>
void BlockRow::share(TaskSystem& loops, const Take& take) const {
    runInHalves(loops, middle, count(), ContactLayout::kBlockGrain, [&](std::size_t begin, std::size_t end) {
        RangeCut cut(begin, end);
        if (cut.isWhole(count())) { return take(std::size_t{0}, count()); }
        for (const ColourRange& half : halves) {
            const ColourRange some = cut.next(half);
            if (some.begin < some.end) { take(std::size_t{some.begin}, std::size_t{some.end}); }
        }
    });
}

template <class Contacts, class List>
void ContactLayout::listPlaces(const ConstraintGraph& graph, const Contacts& contacts, TaskSystem& loops,
                               const List& list) const {
    const std::span<const std::uint8_t> colours = graph.contactColours();
    if (!isWide_) {  // all on their own, in their order
        std::array<std::uint32_t, kColourCount> next{};
        for (const int active : graph.activeColours()) {
            const auto c = static_cast<std::size_t>(active);
            next[c] = colours_[c].rest.begin;
        }
        for (std::uint32_t i = 0; i < colours.size(); ++i) { list(kAlone, next[colours[i]]++, i); }
        return;
    }
    const std::span<const ContactRank> ranks = graph.contactRanks();
    loops.run(colours.size(), kListGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t c = colours[i];
            const std::size_t kind = c == kOverflowColour ? std::size_t{kAlone} : pointsInBlock(contacts[i]);
            const Places& places = places_[c][kind];
            const ContactRank rank = ranks[i];
            const auto contact = static_cast<std::uint32_t>(i);
            if (places.isOneLeft && rank == places.leftOver) {
                list(kAlone, places.alone, contact);
            } else {
                list(kind, rank.isBack() ? places.end - 1 - rank.number() : places.begin + rank.number(), contact);
            }
        }
    });
}

}  // namespace swept::inline SWEPT_PRECISION

#include "contact_layout.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

namespace {

/// A block with fewer contacts costs more than they do one by one.
constexpr std::uint32_t kFewestLanes = 2;
constexpr auto kLanes = static_cast<std::uint32_t>(kBlockLanes);

std::size_t lengthOf(std::span<const ColourRange> ranges) {
    std::size_t sum = 0;
    for (const ColourRange& range : ranges) { sum += range.end - range.begin; }
    return sum;
}

/// Of contacts of a colour, with as many points: those that make no block.
std::uint32_t leftOver(std::uint32_t contacts) { return contacts % kLanes < kFewestLanes ? contacts % kLanes : 0; }
static_assert(kFewestLanes == 2, "one at most");

/// Of contacts of a colour, with as many points: the blocks that they make.
std::uint32_t blocksFor(std::uint32_t contacts) {
    return contacts / kLanes + (contacts % kLanes < kFewestLanes ? 0 : 1);
}

/// Blocks for contacts of one colour, all but the one that may be left over.
/// @param next  block that is free, of as many as are needed
ColourRange reserve(std::uint32_t contacts, RawVector<std::uint8_t>& lanesOf, std::uint32_t& next) {
    const std::uint32_t begin = next;
    while (contacts >= kFewestLanes) {
        const std::uint32_t lanes = std::min(contacts, kLanes);
        lanesOf[next++] = static_cast<std::uint8_t>(lanes);
        contacts -= lanes;
    }
    return {begin, next};
}

}  // namespace

/// @param blocks  of the colour, with as many points
/// @param inFront  contacts that are counted from the front
/// @param alone  next place for who is left over
ContactLayout::Places ContactLayout::placesFor(ColourRange blocks, std::uint32_t contacts, std::uint32_t inFront,
                                               std::uint32_t& alone) {
    const std::uint32_t begin = blocks.begin * kLanes;
    const std::uint32_t inBlocks = contacts - leftOver(contacts);
    Places places{.begin = begin, .end = begin + inBlocks};
    if (inBlocks == contacts) { return places; }
    places.isOneLeft = true;
    places.alone = alone++;
    places.leftOver =
        inFront < contacts ? ContactRank{ContactRank::kIsBack | (contacts - inFront - 1)} : ContactRank{inFront - 1};
    return places;
}

void ContactLayout::countBlocks(const ConstraintGraph& graph) {
    KindCounts blocks{};
    for (const int active : graph.activeColours()) {
        if (!mayHaveBlocks(active)) { continue; }
        const auto& contacts = graph.pointCounts()[static_cast<std::size_t>(active)];
        for (const Kind kind : {kOnePoint, kTwoPoints}) { blocks[kind] += blocksFor(contacts[kind].all()); }
    }
    one_.lanes.resize(blocks[kOnePoint]);
    two_.lanes.resize(blocks[kTwoPoints]);
}

void ContactLayout::layOut(const ConstraintGraph& graph, bool wide) {
    isWide_ = wide;
    countBlocks(graph);
    std::uint32_t one = 0;
    std::uint32_t two = 0;
    std::uint32_t rest = 0;
    for (const int active : graph.activeColours()) {
        const auto c = static_cast<std::size_t>(active);
        KindCounts counts{};
        for (std::size_t points = 0; points < kKindCount; ++points) {
            counts[mayHaveBlocks(active) ? points : std::size_t{kAlone}] += graph.pointCounts()[c][points].all();
        }
        colours_[c].two = reserve(counts[kTwoPoints], two_.lanes, two);
        colours_[c].one = reserve(counts[kOnePoint], one_.lanes, one);
        colours_[c].rest.begin = rest;
        rest += counts[kAlone];
        const auto placesOf = [&](ColourRange range, Kind kind) {
            return placesFor(range, counts[kind], graph.pointCounts()[c][kind].front(), rest);
        };
        places_[c] = {Places{.begin = colours_[c].rest.begin}, placesOf(colours_[c].one, kOnePoint),
                      placesOf(colours_[c].two, kTwoPoints)};
        colours_[c].rest.end = rest;
    }
    restCount_ = rest;
    listHalves(graph);
}

void ContactLayout::listHalves(const ConstraintGraph& graph) {
    one_.halves.clear();
    two_.halves.clear();
    for (const int active : graph.activeColours()) {
        const auto c = static_cast<std::size_t>(active);
        Colour& colour = colours_[c];
        const auto middleOf = [&](Kind kind) {  // where the places of the first half end
            const Places& places = places_[c][kind];
            return std::min(places.begin + graph.pointCounts()[c][kind].front(), places.end) / kLanes;
        };
        colour.middleOfOne = middleOf(kOnePoint);
        colour.middleOfTwo = middleOf(kTwoPoints);
        one_.halves.push_back({colour.one.begin, colour.middleOfOne});
        two_.halves.push_back({colour.two.begin, colour.middleOfTwo});
    }
    one_.middle = lengthOf(one_.halves);
    two_.middle = lengthOf(two_.halves);
    for (const int active : graph.activeColours()) {
        const Colour& colour = colours_[static_cast<std::size_t>(active)];
        one_.halves.push_back({colour.middleOfOne, colour.one.end});
        two_.halves.push_back({colour.middleOfTwo, colour.two.end});
    }
}

bool ContactLayout::join(int colour, int next) {
    if ((*this)[colour].hasBlocks() || (*this)[next].hasBlocks()) { return false; }
    ColourRange& rest = colours_[static_cast<std::size_t>(colour)].rest;
    const ColourRange& more = colours_[static_cast<std::size_t>(next)].rest;
    if (rest.end != more.begin) { return false; }
    rest.end = more.end;
    return true;
}

}  // namespace swept::inline SWEPT_PRECISION

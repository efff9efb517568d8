#include "contact_blocks.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "contact_lanes.h"
#include "contact_rows.h"
#include "halves.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const ContactKernels* contactKernels() { return nullptr; }
const ContactRowKernels* contactRowKernels() { return nullptr; }
#endif

namespace {

/// A block with fewer contacts costs more than they do one by one.
constexpr std::uint32_t kFewestLanes = 2;
constexpr auto kLanes = static_cast<std::uint32_t>(kBlockLanes);
/// Blocks per part of a parallel loop.
constexpr std::size_t kBlockGrain = 8;

std::size_t lengthOf(std::span<const ColourRange> ranges) {
    std::size_t sum = 0;
    for (const ColourRange& range : ranges) { sum += range.end - range.begin; }
    return sum;
}

/// Contacts on their own that are worth handing over to be filled.
constexpr std::size_t kRestGrain = 16;
/// Links, or contacts, that are worth handing over to be listed.
constexpr std::size_t kListGrain = 512;

/// Of contacts of a colour, with as many points: those that make no block.
std::uint32_t leftOver(std::uint32_t contacts) { return contacts % kLanes < kFewestLanes ? contacts % kLanes : 0; }
static_assert(kFewestLanes == 2, "one at most");

/// Of contacts of a colour, with as many points: the blocks that they make.
std::uint32_t blocksFor(std::uint32_t contacts) {
    return contacts / kLanes + (contacts % kLanes < kFewestLanes ? 0 : 1);
}

/// Where there are not enough blocks, room is made for this many times as many. What is not used takes addresses alone.
constexpr std::size_t kRoomRatio = 4;

/// Nothing in the blocks is needed any more: they do not grow one by one, which would carry it along each time.
template <class Block>
void makeRoom(std::vector<Block>& blocks, std::size_t needed) {
    if (needed <= blocks.size()) { return; }
    if (needed > blocks.capacity()) {
        blocks.clear();
        blocks.reserve(kRoomRatio * needed);
    }
    blocks.resize(needed);
}

/// Visits each contact of blocks in the batch with its block and lane.
/// @param places  of the lanes of the blocks
template <class Block, class Contacts, class Visit>
void forEachLane(std::span<Block> blocks, std::span<const std::uint32_t> places, Contacts& contacts, Visit&& visit) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        for (std::size_t lane = 0; lane < blocks[i].lanes; ++lane) {
            visit(contacts[places[i * kBlockLanes + lane]], blocks[i], lane);
        }
    }
}

}  // namespace

/// Blocks for contacts of one colour, all but the one that may be left over. @pre there are as many
template <std::size_t kPoints>
ColourRange ContactBlocks::reserve(std::uint32_t contacts, Blocks<kPoints>& blocks) {
    const std::uint32_t begin = blocks.count;
    while (contacts >= kFewestLanes) {
        const std::uint32_t lanes = std::min(contacts, kLanes);
        blocks.lanes[blocks.count++] = static_cast<std::uint8_t>(lanes);
        contacts -= lanes;
    }
    return {begin, blocks.count};
}

/// In each colour contacts among the first half of the bodies come first, and those of the second half last: so two
/// workers that keep to their ends of the colours mostly meet bodies that they had before. (What another one wrote
/// takes longer to fetch than to solve.)
/// @param blocks  of the colour, with as many points
/// @param inFront  contacts that are counted from the front
/// @param alone  next place for who is left over
ContactBlocks::Places ContactBlocks::placesFor(ColourRange blocks, std::uint32_t contacts, std::uint32_t inFront,
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

void ContactBlocks::layOut(const ConstraintGraph& graph) {
    KindCounts blocks{};
    for (const int active : graph.activeColours()) {
        if (!mayHaveBlocks(active)) { continue; }
        const auto& contacts = graph.pointCounts()[static_cast<std::size_t>(active)];
        for (const Kind kind : {kOnePoint, kTwoPoints}) { blocks[kind] += blocksFor(contacts[kind].all()); }
    }
    makeRoom(one_.blocks, blocks[kOnePoint]);
    makeRoom(two_.blocks, blocks[kTwoPoints]);
    one_.lanes.resize(blocks[kOnePoint]);
    two_.lanes.resize(blocks[kTwoPoints]);
    one_.count = two_.count = 0;
    std::uint32_t rest = 0;
    for (const int active : graph.activeColours()) {
        const auto c = static_cast<std::size_t>(active);
        KindCounts counts{};
        for (std::size_t points = 0; points < kKindCount; ++points) {
            counts[mayHaveBlocks(active) ? points : std::size_t{kAlone}] += graph.pointCounts()[c][points].all();
        }
        colours_[c].two = reserve(counts[kTwoPoints], two_);
        colours_[c].one = reserve(counts[kOnePoint], one_);
        colours_[c].rest.begin = rest;
        rest += counts[kAlone];
        const auto placesOf = [&](ColourRange range, Kind kind) {
            return placesFor(range, counts[kind], graph.pointCounts()[c][kind].front(), rest);
        };
        places_[c] = {Places{.begin = colours_[c].rest.begin}, placesOf(colours_[c].one, kOnePoint),
                      placesOf(colours_[c].two, kTwoPoints)};
        colours_[c].rest.end = rest;
    }
    rest_.resize(rest);
}

/// @param list  called with the kind of place, the place, and which contact it is of; by several workers
template <class Contacts, class List>
void ContactBlocks::listPlaces(const ConstraintGraph& graph, const Contacts& contacts, TaskSystem& loops,
                               const List& list) const {
    const std::span<const std::uint8_t> colours = graph.contactColours();
    if (kernels_ == nullptr) {  // all on their own, in their order
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

void ContactBlocks::listContacts(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops) {
    one_.places.resize(one_.count * kBlockLanes);
    two_.places.resize(two_.count * kBlockLanes);
    const std::array<std::uint32_t*, kKindCount> lists{rest_.data(), one_.places.data(), two_.places.data()};
    listPlaces(graph, batch.contacts, loops,
               [&](std::size_t kind, std::uint32_t place, std::uint32_t i) { lists[kind][place] = i; });
}

/// Constraints of those on their own will stand in the batch in the order of their places.
void ContactBlocks::listLinks(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops) {
    const ContactLink any = batch.links.empty() ? ContactLink{} : batch.links.front();
    one_.makeRoomForLinks(any);
    two_.makeRoomForLinks(any);
    restLinks_.resize(rest_.size());
    const std::array<ContactLink*, kKindCount> lists{restLinks_.data(), one_.links.data(), two_.links.data()};
    listPlaces(graph, batch.links, loops,
               [&](std::size_t kind, std::uint32_t place, std::uint32_t i) { lists[kind][place] = batch.links[i]; });
    std::iota(rest_.begin(), rest_.end(), 0U);
}

/// Masses of all lanes at once.
template <std::size_t kPoints>
void ContactBlocks::prepare(std::span<WideContact<kPoints>> blocks) const {
    if constexpr (kPoints == 2) {
        kernels_->prepareTwo(blocks);
    } else {
        kernels_->prepareOne(blocks);
    }
}

/// @pre listed
void ContactBlocks::listHalves(const ConstraintGraph& graph) {
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

template <std::size_t kPoints>
void ContactBlocks::Blocks<kPoints>::makeRoomForLinks(const ContactLink& unused) {
    links.resize(count * kBlockLanes);
    for (std::size_t i = 0; i < count; ++i) {
        std::fill(&links[i * kBlockLanes] + lanes[i], &links[i * kBlockLanes] + kBlockLanes, unused);
    }
}

template <std::size_t kPoints>
void ContactBlocks::Blocks<kPoints>::empty(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) { emptyBlock(blocks[i], lanes[i]); }
}

template <std::size_t kPoints>
template <class Take>
void ContactBlocks::Blocks<kPoints>::share(TaskSystem& loops, const Take& take) const {
    if (count == 0) { return; }
    runInHalves(loops, middle, count, kBlockGrain, [&](std::size_t begin, std::size_t end) {
        RangeCut cut(begin, end);
        if (cut.isWhole(count)) { return take(std::size_t{0}, std::size_t{count}); }
        for (const ColourRange& half : halves) {
            const ColourRange some = cut.next(half);
            if (some.begin < some.end) { take(std::size_t{some.begin}, std::size_t{some.end}); }
        }
    });
}

template <std::size_t kPoints>
void ContactBlocks::fillFromStore(SolverBatch& batch, Blocks<kPoints>& blocks, TaskSystem& loops) {
    blocks.share(loops, [&](std::size_t begin, std::size_t end) {
        blocks.empty(begin, end);
        batch.store->fill(blocks.all().subspan(begin, end - begin), blocks.linksOf(begin, end));
    });
}

/// Blocks from constraints; what is left over stays where it is.
template <std::size_t kPoints>
void ContactBlocks::fillFromBatch(const SolverBatch& batch, Blocks<kPoints>& blocks, TaskSystem& loops) {
    blocks.share(loops, [&](std::size_t begin, std::size_t end) {
        blocks.empty(begin, end);
        const std::span<WideContact<kPoints>> some = blocks.all().subspan(begin, end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const std::span<const std::uint32_t> places = blocks.placesOf(i, i + 1);
            fillBlock(some[i - begin], std::span(batch.inertias),
                      [&](std::size_t lane) -> const ContactConstraint& { return batch.contacts[places[lane]]; });
        }
        prepare(some);
    });
}

void ContactBlocks::build(SolverBatch& batch, const ConstraintGraph& graph, const BuildSettings& settings,
                          TaskSystem& loops) {
    kernels_ = settings.wide ? contactKernels() : nullptr;
    layOut(graph);
    if (batch.store != nullptr) {
        listLinks(batch, graph, loops);
        listHalves(graph);
        batch.contacts.resize(rest_.size());
        fillFromStore(batch, two_, loops);
        fillFromStore(batch, one_, loops);
        loops.run(rest_.size(), kRestGrain, [&](std::size_t begin, std::size_t end, int) {
            const std::span<ContactConstraint> some = std::span(batch.contacts).subspan(begin, end - begin);
            batch.store->fill(some, std::span<const ContactLink>(restLinks_).subspan(begin, end - begin));
        });
    } else {
        listContacts(batch, graph, loops);
        listHalves(graph);
        fillFromBatch(batch, two_, loops);
        fillFromBatch(batch, one_, loops);
    }
    anyBounces_ = batch.store == nullptr && mostRestitution(batch) > 0;
    if (settings.prepared) { return; }
    for (const std::uint32_t place : rest_) { prepareContact(batch.contacts[place], batch.inertias); }
}

bool ContactBlocks::hasBlocks(int colour) const {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    return ranges.two.begin < ranges.two.end || ranges.one.begin < ranges.one.end;
}

bool ContactBlocks::join(int colour, int next) {
    if (hasBlocks(colour) || hasBlocks(next)) { return false; }
    ColourRange& rest = colours_[static_cast<std::size_t>(colour)].rest;
    const ColourRange& more = colours_[static_cast<std::size_t>(next)].rest;
    if (rest.end != more.begin) { return false; }
    rest.end = more.end;
    return true;
}

std::size_t ContactBlocks::countOf(int colour) const {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    return (ranges.two.end - ranges.two.begin) + (ranges.one.end - ranges.one.begin) +
           (ranges.rest.end - ranges.rest.begin);
}

std::size_t ContactBlocks::middleOf(int colour) const {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    return (ranges.middleOfTwo - ranges.two.begin) + (ranges.middleOfOne - ranges.one.begin) +
           (ranges.rest.end - ranges.rest.begin) / 2;
}

/// Of each list first what meets the first half of the bodies, and then the others, the other way round: whoever begins
/// at one end of the colour keeps to the same half whichever list he is in. Nothing is cut in two where one worker does
/// it all.
template <class TakeOne, class TakeTwo, class TakeRest>
void ContactBlocks::forEachList(int colour, RangeCut cut, const TakeOne& takeOne, const TakeTwo& takeTwo,
                                const TakeRest& takeRest) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const auto one = [&](ColourRange range) {
        if (const auto blocks = cut.next(one_.blocks, range); !blocks.empty()) { takeOne(blocks); }
    };
    const auto two = [&](ColourRange range) {
        if (const auto blocks = cut.next(two_.blocks, range); !blocks.empty()) { takeTwo(blocks); }
    };
    if (cut.isWhole(countOf(colour))) {
        two(ranges.two);
        one(ranges.one);
        takeRest(cut.next(rest_, ranges.rest));
        return;
    }
    two({ranges.two.begin, ranges.middleOfTwo});
    one({ranges.one.begin, ranges.middleOfOne});
    takeRest(cut.next(rest_, ranges.rest));
    one({ranges.middleOfOne, ranges.one.end});
    two({ranges.middleOfTwo, ranges.two.end});
}

void ContactBlocks::warmStart(SolverBatch& batch, int colour, RangeCut cut) {
    const SolverBodies bodies{batch.states, batch.inertias};
    forEachList(
        colour, cut, [&](auto blocks) { kernels_->warmStartOne(blocks, bodies); },
        [&](auto blocks) { kernels_->warmStartTwo(blocks, bodies); },
        [&](auto rest) { warmStartContacts(batch.contacts, rest, bodies); });
}

void ContactBlocks::bounce(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass) {
    const SolverBodies bodies{batch.states, batch.inertias};
    forEachList(
        colour, cut, [&](auto blocks) { kernels_->bounceOne(blocks, bodies, pass); },
        [&](auto blocks) { kernels_->bounceTwo(blocks, bodies, pass); },
        [&](auto rest) { bounceContacts(batch.contacts, rest, bodies, pass); });
}

void ContactBlocks::solve(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass) {
    const SolverBodies bodies{batch.states, batch.inertias};
    forEachList(
        colour, cut, [&](auto blocks) { kernels_->solveOne(blocks, bodies, pass); },
        [&](auto blocks) { kernels_->solveTwo(blocks, bodies, pass); },
        [&](auto rest) { solveContacts(batch.contacts, rest, bodies, pass); });
}

Real ContactBlocks::mostRestitution(const SolverBatch& batch) const {
    Real most = 0;
    for (std::size_t i = 0; i < two_.count; ++i) { most = std::max(most, two_.blocks[i].mostRestitution); }
    for (std::size_t i = 0; i < one_.count; ++i) { most = std::max(most, one_.blocks[i].mostRestitution); }
    for (const std::uint32_t place : rest_) { most = std::max(most, batch.contacts[place].restitution); }
    return most;
}

void ContactBlocks::addUpBouncing(SolverBatch& batch) const {
    if (!anyBounces_) { return; }
    const auto addUp = [](ContactConstraint& contact, const auto& block, std::size_t lane) {
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            contact.points[i].totalNormalImpulse += block.points[i].normalImpulse[lane];
        }
    };
    const auto addUpAll = [&](const auto& blocks) {
        for (std::size_t i = 0; i < blocks.count; ++i) {
            if (blocks.blocks[i].mostRestitution > 0) {
                forEachLane(blocks.all().subspan(i, 1), blocks.placesOf(i, i + 1), batch.contacts, addUp);
            }
        }
    };
    addUpAll(two_);
    addUpAll(one_);
}

void ContactBlocks::readBack(SolverBatch& batch, TaskSystem& loops) {
    if (batch.store != nullptr) {
        const auto take = [&](const auto& blocks) {
            blocks.share(loops, [&](std::size_t begin, std::size_t end) {
                batch.store->take(blocks.all().subspan(begin, end - begin), blocks.linksOf(begin, end));
            });
        };
        take(std::as_const(two_));
        take(std::as_const(one_));
        batch.store->take(std::span<const ContactConstraint>(batch.contacts), restLinks_);
        return;
    }
    const auto read = [](ContactConstraint& contact, const auto& block, std::size_t lane) {
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            ContactConstraintPoint& point = contact.points[i];
            point.normalImpulse = block.points[i].normalImpulse[lane];
            point.tangentImpulse = block.points[i].tangentImpulse[lane];
            if (!(block.mostRestitution > 0)) { point.totalNormalImpulse = block.points[i].totalNormalImpulse[lane]; }
        }
    };
    forEachLane(two_.all(), two_.places, batch.contacts, read);
    forEachLane(one_.all(), one_.places, batch.contacts, read);
}

}  // namespace swept::inline SWEPT_PRECISION

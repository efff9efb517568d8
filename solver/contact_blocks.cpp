#include "contact_blocks.h"

#include <algorithm>
#include <numeric>

#include "contact_lanes.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const ContactKernels* contactKernels() { return nullptr; }
#endif

namespace {

/// A block with fewer contacts costs more than they do one by one.
constexpr std::uint32_t kFewestLanes = 2;
constexpr auto kLanes = static_cast<std::uint32_t>(kBlockLanes);
/// Contacts, and blocks, per part of a parallel loop.
constexpr std::size_t kPlaceGrain = 64;
constexpr std::size_t kBlockGrain = 8;

/// Visits each contact of blocks in the batch with its block and lane.
template <class Block, class Visit>
void forEachLane(std::span<Block> blocks, std::vector<ContactConstraint>& contacts, Visit&& visit) {
    for (Block& block : blocks) {
        for (std::size_t lane = 0; lane < block.lanes; ++lane) { visit(contacts[block.place[lane]], block, lane); }
    }
}

}  // namespace

ContactBlocks::Kind ContactBlocks::kindOf(std::size_t points, int colour) const {
    if (kernels_ == nullptr || colour == kOverflowColour || points == 0) { return kAlone; }
    return points == 1 ? kOnePoint : kTwoPoints;
}

/// Empty blocks for contacts of one colour, all but the one that may be left over.
template <std::size_t kPoints>
ColourRange ContactBlocks::reserve(std::uint32_t contacts, Blocks<kPoints>& blocks) {
    const std::uint32_t begin = blocks.count;
    while (contacts >= kFewestLanes) {
        const std::uint32_t lanes = std::min(contacts, kLanes);
        if (blocks.count == blocks.blocks.size()) { blocks.blocks.emplace_back(); }
        emptyBlock(blocks.blocks[blocks.count++], lanes);
        contacts -= lanes;
    }
    return {begin, blocks.count};
}

void ContactBlocks::layOut(const ConstraintGraph& graph) {
    one_.count = two_.count = 0;
    std::uint32_t rest = 0;
    for (const int active : graph.activeColours()) {
        const auto c = static_cast<std::size_t>(active);
        KindCounts counts{};
        for (std::size_t points = 0; points <= 2; ++points) {
            counts[kindOf(points, active)] += graph.pointCounts()[c][points];
        }
        colours_[c].two = reserve(counts[kTwoPoints], two_);
        colours_[c].one = reserve(counts[kOnePoint], one_);
        const auto leftOver = [](std::uint32_t contacts) {
            return contacts % kLanes < kFewestLanes ? contacts % kLanes : 0;
        };
        next_[c] = {rest, colours_[c].one.begin * kLanes, colours_[c].two.begin * kLanes};
        colours_[c].rest.begin = rest;
        rest += counts[kAlone] + leftOver(counts[kTwoPoints]) + leftOver(counts[kOnePoint]);
        colours_[c].rest.end = rest;
    }
    rest_.resize(rest);
}

ContactPlace ContactBlocks::placeFor(Kind kind, std::size_t colour) {
    KindCounts& next = next_[colour];
    if (kind != kAlone) {
        const std::uint32_t end = (kind == kOnePoint ? colours_[colour].one : colours_[colour].two).end;
        const std::uint32_t place = next[kind];
        if (place < end * kLanes) {
            ++next[kind];
            return {place / kLanes, static_cast<std::uint8_t>(place % kLanes), static_cast<std::uint8_t>(kind)};
        }
    }
    return {next[kAlone]++, 0, 0};
}

/// In the order of the contacts: so they stand in each colour.
template <class PointsOf>
void ContactBlocks::listPlaces(std::span<const std::uint8_t> colours, const PointsOf& pointsOf) {
    places_.resize(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        places_[i] = placeFor(kindOf(pointsOf(i), colours[i]), colours[i]);
        if (places_[i].points == 0) { rest_[places_[i].index] = static_cast<std::uint32_t>(i); }
    }
}

ContactArrays ContactBlocks::arrays(SolverBatch& batch) {
    return {std::span(one_.blocks).first(one_.count), std::span(two_.blocks).first(two_.count), batch.contacts};
}

/// Blocks from constraints; what is left over stays where it is.
void ContactBlocks::fillFrom(const SolverBatch& batch) {
    anyBounces_ = false;
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
        const ContactPlace& place = places_[i];
        const ContactConstraint& contact = batch.contacts[i];
        const auto fill = [&](auto& block) {
            block.place[place.lane] = i;
            fillLane(block, place.lane, contact, batch.inertias[contact.slotA], batch.inertias[contact.slotB]);
        };
        if (place.points == 1) {
            fill(one_.blocks[place.index]);
        } else if (place.points == 2) {
            fill(two_.blocks[place.index]);
        }
        anyBounces_ = anyBounces_ || (place.points > 0 && contact.restitution > 0);
    }
}

/// Ends what the lanes began, and finds masses, in ranges that any worker may take.
template <std::size_t kPoints>
void ContactBlocks::finishBlocks(Blocks<kPoints>& blocks, TaskSystem& loops) {
    if (blocks.count == 0) { return; }
    loops.run(blocks.count, kBlockGrain, [&](std::size_t begin, std::size_t end, int) {
        const std::span<WideContact<kPoints>> some = std::span(blocks.blocks).subspan(begin, end - begin);
        for (WideContact<kPoints>& block : some) { closeBlock(block); }
        if constexpr (kPoints == 2) {
            kernels_->prepareTwo(some);
        } else {
            kernels_->prepareOne(some);
        }
    });
}

void ContactBlocks::build(SolverBatch& batch, const ConstraintGraph& graph, const BuildSettings& settings,
                          TaskSystem& loops) {
    kernels_ = settings.wide ? contactKernels() : nullptr;
    layOut(graph);
    if (batch.store != nullptr) {
        listPlaces(graph.contactColours(), [&](std::size_t i) { return batch.links[i].pointsInBlock(); });
        std::iota(rest_.begin(), rest_.end(), 0U);  // the store puts them there in this order
        batch.contacts.resize(rest_.size());
        anyBounces_ = false;
        const ContactArrays to = arrays(batch);
        loops.run(places_.size(), kPlaceGrain, [&](std::size_t begin, std::size_t end, int) {
            batch.store->fill(begin, std::span(places_).subspan(begin, end - begin), to);
        });
    } else {
        listPlaces(graph.contactColours(),
                   [&](std::size_t i) { return static_cast<std::size_t>(batch.contacts[i].count); });
        fillFrom(batch);
    }
    finishBlocks(two_, loops);
    finishBlocks(one_, loops);
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

void ContactBlocks::warmStart(SolverBatch& batch, int colour, RangeCut cut) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(two_.blocks, ranges.two); !blocks.empty()) {
        kernels_->warmStartTwo(blocks, bodies);
    }
    if (const auto blocks = cut.next(one_.blocks, ranges.one); !blocks.empty()) {
        kernels_->warmStartOne(blocks, bodies);
    }
    warmStartContacts(batch.contacts, cut.next(rest_, ranges.rest), bodies);
}

void ContactBlocks::bounce(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(two_.blocks, ranges.two); !blocks.empty()) {
        kernels_->bounceTwo(blocks, bodies, pass);
    }
    if (const auto blocks = cut.next(one_.blocks, ranges.one); !blocks.empty()) {
        kernels_->bounceOne(blocks, bodies, pass);
    }
    bounceContacts(batch.contacts, cut.next(rest_, ranges.rest), bodies, pass);
}

void ContactBlocks::solve(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(two_.blocks, ranges.two); !blocks.empty()) {
        kernels_->solveTwo(blocks, bodies, pass);
    }
    if (const auto blocks = cut.next(one_.blocks, ranges.one); !blocks.empty()) {
        kernels_->solveOne(blocks, bodies, pass);
    }
    solveContacts(batch.contacts, cut.next(rest_, ranges.rest), bodies, pass);
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
                forEachLane(std::span(&blocks.blocks[i], 1), batch.contacts, addUp);
            }
        }
    };
    addUpAll(two_);
    addUpAll(one_);
}

void ContactBlocks::readBack(SolverBatch& batch, TaskSystem& loops) {
    if (batch.store != nullptr) {
        const ContactArrays from = arrays(batch);
        loops.run(places_.size(), kPlaceGrain, [&](std::size_t begin, std::size_t end, int) {
            batch.store->take(begin, std::span(places_).subspan(begin, end - begin), from);
        });
        batch.store->end();
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
    forEachLane(std::span(two_.blocks).first(two_.count), batch.contacts, read);
    forEachLane(std::span(one_.blocks).first(one_.count), batch.contacts, read);
}

}  // namespace swept::inline SWEPT_PRECISION

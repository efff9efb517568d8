#include "contact_blocks.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "contact_lanes.h"
#include "contact_rows.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const ContactKernels* contactKernels() { return nullptr; }
const ContactRowKernels* contactRowKernels() { return nullptr; }
#endif

namespace {

/// Contacts on their own that are worth handing over to be filled.
constexpr std::size_t kRestGrain = 16;
/// Where there are not enough blocks, room is made for this many times as many. What is not used takes addresses alone.
constexpr std::size_t kRoomRatio = 4;

/// Visits each contact of a block in the batch with its lane.
template <class Block, class Contacts, class Visit>
void forEachLane(Block& block, std::span<const std::uint32_t> places, Contacts& contacts, const Visit& visit) {
    for (std::size_t lane = 0; lane < block.lanes; ++lane) { visit(contacts[places[lane]], block, lane); }
}

}  // namespace

/// @param visit  called with the blocks of two points and where they stand, then with those of one
template <class Visit>
void ContactBlocks::forBothKinds(const Visit& visit) {
    visit(two_, layout_.two());
    visit(one_, layout_.one());
}
template <class Visit>
void ContactBlocks::forBothKinds(const Visit& visit) const {
    visit(two_, layout_.two());
    visit(one_, layout_.one());
}

/// Nothing in the blocks is needed any more: they do not grow one by one, which would carry it along each time.
template <std::size_t kPoints>
void ContactBlocks::Blocks<kPoints>::makeRoom(std::size_t count) {
    if (count <= blocks.size()) { return; }
    if (count > blocks.capacity()) {
        blocks.clear();
        blocks.reserve(kRoomRatio * count);
    }
    blocks.resize(count);
}

template <std::size_t kPoints>
void ContactBlocks::Blocks<kPoints>::makeRoomForLinks(const BlockRow& row, const ContactLink& unused) {
    links.resize(row.count() * kBlockLanes);
    for (std::size_t i = 0; i < row.count(); ++i) {
        std::fill(&links[i * kBlockLanes] + row.lanes[i], &links[i * kBlockLanes] + kBlockLanes, unused);
    }
}

template <std::size_t kPoints>
std::span<WideContact<kPoints>> ContactBlocks::Blocks<kPoints>::emptied(const BlockRow& row, std::size_t begin,
                                                                        std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) { emptyBlock(blocks[i], row.lanes[i]); }
    return std::span(blocks).subspan(begin, end - begin);
}

void ContactBlocks::listContacts(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops) {
    forBothKinds([](auto& blocks, const BlockRow& row) { blocks.places.resize(row.count() * kBlockLanes); });
    const std::array<std::uint32_t*, ContactLayout::kKindCount> lists{rest_.data(), one_.places.data(),
                                                                      two_.places.data()};
    layout_.listPlaces(graph, batch.contacts, loops,
                       [&](std::size_t kind, std::uint32_t place, std::uint32_t i) { lists[kind][place] = i; });
}

/// Constraints of those on their own will stand in the batch in the order of their places.
void ContactBlocks::listLinks(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops) {
    const ContactLink any = batch.links.empty() ? ContactLink{} : batch.links.front();
    forBothKinds([&](auto& blocks, const BlockRow& row) { blocks.makeRoomForLinks(row, any); });
    restLinks_.resize(rest_.size());
    const std::array<ContactLink*, ContactLayout::kKindCount> lists{restLinks_.data(), one_.links.data(),
                                                                    two_.links.data()};
    layout_.listPlaces(graph, batch.links, loops, [&](std::size_t kind, std::uint32_t place, std::uint32_t i) {
        lists[kind][place] = batch.links[i];
    });
    std::iota(rest_.begin(), rest_.end(), 0U);
}

void ContactBlocks::fillFromStore(SolverBatch& batch, TaskSystem& loops) {
    batch.contacts.resize(rest_.size());
    forBothKinds([&](auto& blocks, const BlockRow& row) {
        row.share(loops, [&](std::size_t begin, std::size_t end) {
            batch.store->fill(blocks.emptied(row, begin, end), blocks.linksOf(begin, end));
        });
    });
    loops.run(rest_.size(), kRestGrain, [&](std::size_t begin, std::size_t end, int) {
        const std::span<ContactConstraint> some = std::span(batch.contacts).subspan(begin, end - begin);
        batch.store->fill(some, std::span<const ContactLink>(restLinks_).subspan(begin, end - begin));
    });
}

/// Blocks from constraints; what is left over stays where it is.
void ContactBlocks::fillFromBatch(const SolverBatch& batch, TaskSystem& loops) {
    forBothKinds([&](auto& blocks, const BlockRow& row) {
        row.share(loops, [&](std::size_t begin, std::size_t end) {
            const auto some = blocks.emptied(row, begin, end);
            for (std::size_t i = begin; i < end; ++i) {
                const std::span<const std::uint32_t> places = blocks.placesOf(i, i + 1);
                fillBlock(some[i - begin], std::span(batch.inertias),
                          [&](std::size_t lane) -> const ContactConstraint& { return batch.contacts[places[lane]]; });
            }
            prepare(some);  // masses of all lanes at once
        });
    });
}

void ContactBlocks::build(SolverBatch& batch, const ConstraintGraph& graph, const BuildSettings& settings,
                          TaskSystem& loops) {
    kernels_ = settings.wide ? contactKernels() : nullptr;
    layout_.layOut(graph, kernels_ != nullptr);
    forBothKinds([](auto& blocks, const BlockRow& row) { blocks.makeRoom(row.count()); });
    rest_.resize(layout_.restCount());
    if (batch.store != nullptr) {
        listLinks(batch, graph, loops);
        fillFromStore(batch, loops);
    } else {
        listContacts(batch, graph, loops);
        fillFromBatch(batch, loops);
    }
    anyBounces_ = batch.store == nullptr && mostRestitution(batch) > 0;
    if (settings.prepared) { return; }
    for (const std::uint32_t place : rest_) { prepareContact(batch.contacts[place], batch.inertias); }
}

/// Of each list first what meets the first half of the bodies, and then the others, the other way round: whoever begins
/// at one end of the colour keeps to the same half whichever list he is in. Nothing is cut in two where one worker does
/// it all.
template <class TakeOne, class TakeTwo, class TakeRest>
void ContactBlocks::forEachList(int colour, RangeCut cut, const TakeOne& takeOne, const TakeTwo& takeTwo,
                                const TakeRest& takeRest) {
    const ContactLayout::Colour& ranges = layout_[colour];
    if (cut.isWhole(ranges.count())) {  // as mostly: small solves go through little else than such lists
        const auto take = [](auto& all, ColourRange range, const auto& takeSome) {
            if (range.begin < range.end) { takeSome(std::span(&all[range.begin], range.end - range.begin)); }
        };
        take(two_.blocks, ranges.two, takeTwo);
        take(one_.blocks, ranges.one, takeOne);
        return take(rest_, ranges.rest, takeRest);
    }
    const auto one = [&](ColourRange range) {
        if (const auto blocks = cut.next(one_.blocks, range); !blocks.empty()) { takeOne(blocks); }
    };
    const auto two = [&](ColourRange range) {
        if (const auto blocks = cut.next(two_.blocks, range); !blocks.empty()) { takeTwo(blocks); }
    };
    const auto rest = [&](ColourRange range) {
        if (const auto some = cut.next(rest_, range); !some.empty()) { takeRest(some); }
    };
    two({ranges.two.begin, ranges.middleOfTwo});
    one({ranges.one.begin, ranges.middleOfOne});
    rest(ranges.rest);
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

void ContactBlocks::list(int colour) {
    const ContactLayout::Colour& ranges = layout_[colour];
    for (const Listed& some :
         {Listed{ContactLayout::kTwoPoints, ranges.two}, Listed{ContactLayout::kOnePoint, ranges.one},
          Listed{ContactLayout::kAlone, ranges.rest}}) {
        if (some.range.begin < some.range.end) { listed_.push_back(some); }
    }
}

void ContactBlocks::solveListed(SolverBatch& batch, const ContactPass& pass) {
    const SolverBodies bodies{batch.states, batch.inertias};
    for (const Listed& some : listed_) {
        const std::size_t begin = some.range.begin;
        const std::size_t count = some.range.end - begin;
        if (some.kind == ContactLayout::kTwoPoints) {
            kernels_->solveTwo(std::span(&two_.blocks[begin], count), bodies, pass);
        } else if (some.kind == ContactLayout::kOnePoint) {
            kernels_->solveOne(std::span(&one_.blocks[begin], count), bodies, pass);
        } else {
            solveContacts(batch.contacts, std::span<const std::uint32_t>(&rest_[begin], count), bodies, pass);
        }
    }
}

Real ContactBlocks::mostRestitution(const SolverBatch& batch) const {
    Real most = 0;
    forBothKinds([&](const auto& blocks, const BlockRow& row) {
        for (std::size_t i = 0; i < row.count(); ++i) { most = std::max(most, blocks.blocks[i].mostRestitution); }
    });
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
    forBothKinds([&](const auto& blocks, const BlockRow& row) {
        for (std::size_t i = 0; i < row.count(); ++i) {
            if (blocks.blocks[i].mostRestitution > 0) {
                forEachLane(blocks.blocks[i], blocks.placesOf(i, i + 1), batch.contacts, addUp);
            }
        }
    });
}

void ContactBlocks::readBack(SolverBatch& batch, TaskSystem& loops) {
    if (batch.store != nullptr) {
        forBothKinds([&](const auto& blocks, const BlockRow& row) {
            row.share(loops, [&](std::size_t begin, std::size_t end) {
                batch.store->take(std::span(blocks.blocks).subspan(begin, end - begin), blocks.linksOf(begin, end));
            });
        });
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
    forBothKinds([&](const auto& blocks, const BlockRow& row) {
        for (std::size_t i = 0; i < row.count(); ++i) {
            forEachLane(blocks.blocks[i], blocks.placesOf(i, i + 1), batch.contacts, read);
        }
    });
}

}  // namespace swept::inline SWEPT_PRECISION

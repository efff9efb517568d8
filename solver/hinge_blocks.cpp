#include "hinge_blocks.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "hinge_lanes.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const RevoluteKernels* revoluteKernels() { return nullptr; }
#endif

namespace {

/// A block with fewer joints costs more than they do one by one.
constexpr std::uint32_t kFewestLanes = 2;
/// Hinges of a block of a parallel loop.
constexpr std::size_t kPlaceGrain = 128;
constexpr auto kLanes = static_cast<std::uint32_t>(kBlockLanes);

HingeParts partsOf(const RevoluteConstraint& joint) { return {joint.hasSpring, joint.hasMotor, joint.hasLimits}; }

std::uint8_t numberOf(const HingeParts& parts) {
    return static_cast<std::uint8_t>((parts.hasSpring ? 4U : 0U) + (parts.hasMotor ? 2U : 0U) +
                                     (parts.hasLimits ? 1U : 0U));
}
HingeParts partsOf(std::uint8_t number) { return {(number & 4U) != 0, (number & 2U) != 0, (number & 1U) != 0}; }

/// Before lanes are filled. @param lanes  of the block that will be; the others hold the fixed world to itself, which
/// is all zeros
void emptyBlock(WideRevolute& block, std::uint32_t lanes, HingeParts parts) {
    static_assert(std::is_trivially_copyable_v<WideRevolute> && kFixedSlot == 0);
    if (lanes < kBlockLanes) { std::memset(static_cast<void*>(&block), 0, sizeof(block)); }
    block.movableA = block.movableB = 0;
    block.lanes = lanes;
    block.parts = parts;
    block.totalX = block.totalY = block.totalTwist = {};
    block.springImpulse = {};  // made anew by each warm start
}

}  // namespace

void HingeBlocks::noteKind(std::size_t hinge, const HingeLink& link, bool isHeld,
                           std::span<const BodyInertia> inertias) {
    const std::uint8_t colour = hingeColours_[hinge];
    Kind kind = kAlone;
    if (kernels_ != nullptr && colour != kOverflowColour && !isHeld) {
        // Parts of a joint whose bodies cannot turn do nothing, which only the scalar code knows.
        const bool turns = inertias[link.slotA].inverseInertia + inertias[link.slotB].inverseInertia > 0;
        if (turns || !link.parts.any()) { kind = numberOf(link.parts); }
    }
    hasParts_ = hasParts_ || link.parts.any();
    kinds_[hinge] = kind;
    ++counts_[colour][kind];
}

void HingeBlocks::listKinds(const SolverBatch& batch, const ConstraintGraph& graph) {
    counts_ = {};
    hasParts_ = false;
    if (batch.hingeStore != nullptr) {
        hingeColours_.assign(graph.hingeColours().begin(), graph.hingeColours().end());
        kinds_.resize(hingeColours_.size());
        for (std::size_t i = 0; i < kinds_.size(); ++i) { noteKind(i, batch.hingeLinks[i], false, batch.inertias); }
        return;
    }
    hingeColours_.resize(batch.revolutes.size());
    kinds_.resize(hingeColours_.size());
    for (const int colour : graph.activeColours()) {
        const ColourRange range = graph.range<RevoluteConstraint>(colour);
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const RevoluteConstraint& joint = batch.revolutes[i];
            hingeColours_[i] = static_cast<std::uint8_t>(colour);
            noteKind(i, {joint.slotA, joint.slotB, i, partsOf(joint)}, joint.isHeld, batch.inertias);
        }
    }
}

/// Empty blocks for hinges of one colour and kind, all but the one that may be left over.
ColourRange HingeBlocks::reserve(std::uint32_t hinges, Kind kind) {
    const std::uint32_t begin = count_;
    while (hinges >= kFewestLanes) {
        const std::uint32_t lanes = std::min(hinges, kLanes);
        if (count_ == blocks_.size()) { blocks_.emplace_back(); }
        emptyBlock(blocks_[count_++], lanes, partsOf(kind));
        hinges -= lanes;
    }
    return {begin, count_};
}

void HingeBlocks::layOut(const ConstraintGraph& graph) {
    count_ = 0;
    std::uint32_t rest = 0;
    for (const int active : graph.activeColours()) {
        const auto c = static_cast<std::size_t>(active);
        colours_[c] = {{count_, count_}, {rest, rest}};
        next_[c] = {};
        next_[c][kAlone] = rest;
        for (Kind kind = 0; kind < kAlone; ++kind) {
            const std::uint32_t count = counts_[c][kind];
            if (count == 0) { continue; }
            ranges_[c][kind] = reserve(count, kind);
            rest += count % kLanes < kFewestLanes ? count % kLanes : 0;
        }
        rest += counts_[c][kAlone];
        colours_[c].blocks.end = count_;
        colours_[c].rest.end = rest;
    }
    rest_.resize(rest);
}

HingePlace HingeBlocks::placeFor(Kind kind, std::size_t colour) {
    KindCounts& next = next_[colour];
    if (kind != kAlone) {
        const std::uint32_t place = next[kind]++;
        const std::uint32_t block = ranges_[colour][kind].begin + place / kLanes;
        if (block < ranges_[colour][kind].end) { return {block, static_cast<std::uint8_t>(place % kLanes), true}; }
    }
    return {next[kAlone]++, 0, false};
}

/// In the order of the hinges: so they stand in each colour.
void HingeBlocks::listPlaces(const SolverBatch& batch) {
    const bool areLinks = batch.hingeStore != nullptr;
    places_.resize(kinds_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
        places_[i] = placeFor(kinds_[i], hingeColours_[i]);
        if (!places_[i].isInBlock) {
            rest_[places_[i].index] = areLinks ? places_[i].index : static_cast<std::uint32_t>(i);
        }
    }
}

/// Blocks from constraints; what is left over stays where it is.
void HingeBlocks::fillFrom(const SolverBatch& batch) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const HingePlace& place = places_[i];
        if (!place.isInBlock) { continue; }
        const RevoluteConstraint& joint = batch.revolutes[i];
        WideRevolute& block = blocks_[place.index];
        fillHead(block, place.lane,
                 {.slotA = joint.slotA,
                  .slotB = joint.slotB,
                  .anchorA = joint.anchorA,
                  .anchorB = joint.anchorB,
                  .centerOffset = joint.centerOffset,
                  .softness = joint.softness,
                  .impulse = joint.linearImpulse},
                 batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
        if (block.parts.any()) { fillParts(block, place.lane, joint, joint.baseAngle); }
    }
}

void HingeBlocks::build(SolverBatch& batch, const ConstraintGraph& graph, bool wide, TaskSystem& loops) {
    const RevoluteKernels* const before = std::exchange(kernels_, wide ? revoluteKernels() : nullptr);
    count_ = 0;
    if (!batch.hasHinges()) { return; }
    // Parts may do nothing in one solve, and something in the next one.
    const bool areKept = batch.hingeStore != nullptr && graph.areHingesKept() && kernels_ == before && !hasParts_;
    if (!areKept) { listKinds(batch, graph); }
    layOut(graph);
    if (!areKept) { listPlaces(batch); }
    if (batch.hingeStore == nullptr) {
        fillFrom(batch);
    } else {
        batch.revolutes.resize(rest_.size());
        const HingeArrays to{std::span(blocks_).first(count_), batch.revolutes};
        loops.run(places_.size(), kPlaceGrain, [&](std::size_t begin, std::size_t end, int) {
            batch.hingeStore->fill(begin, std::span(places_).subspan(begin, end - begin), to);
        });
    }
    for (WideRevolute& block : std::span(blocks_).first(count_)) { closeBlock(block); }
    if (batch.hingeStore == nullptr) { return; }
    for (RevoluteConstraint& joint : batch.revolutes) {
        joint.total = {};
        prepare(joint, batch.inertias);
    }
}

std::size_t HingeBlocks::countOf(int colour) const {
    const auto& [blocks, rest] = colours_[static_cast<std::size_t>(colour)];
    return (blocks.end - blocks.begin) + (rest.end - rest.begin);
}

void HingeBlocks::warmStart(SolverBatch& batch, int colour, RangeCut& cut, bool hasMoved) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(blocks_, ranges.blocks); !blocks.empty()) {
        kernels_->warmStart(blocks, bodies, hasMoved);
    }
    for (const std::uint32_t place : cut.next(rest_, ranges.rest)) {
        swept::warmStart(std::span(&batch.revolutes[place], 1), bodies);
    }
}

void HingeBlocks::solve(SolverBatch& batch, int colour, RangeCut& cut, const ContactPass& pass) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(blocks_, ranges.blocks); !blocks.empty()) {
        ContactPass ofHinges = pass;
        ofHinges.hasMoved = pass.hasMoved && !pass.useBias;  // what warm starting has seen
        kernels_->solve(blocks, bodies, ofHinges);
    }
    for (const std::uint32_t place : cut.next(rest_, ranges.rest)) {
        swept::solve(std::span(&batch.revolutes[place], 1), bodies, pass.h, pass.useBias);
    }
}

void HingeBlocks::addUpRest(SolverBatch& batch) const {
    if (!batch.hasHinges()) { return; }
    for (const std::uint32_t place : rest_) { addUpReactions(std::span(&batch.revolutes[place], 1)); }
}

void HingeBlocks::readBack(SolverBatch& batch, TaskSystem& loops) {
    if (!batch.hasHinges()) { return; }
    if (batch.hingeStore != nullptr) {
        const HingeArrays from{std::span(blocks_).first(count_), batch.revolutes};
        loops.run(places_.size(), kPlaceGrain, [&](std::size_t begin, std::size_t end, int) {
            batch.hingeStore->take(begin, std::span(places_).subspan(begin, end - begin), from);
        });
        batch.revolutes.clear();
        return;
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const HingePlace& place = places_[i];
        if (place.isInBlock) { takeLane(blocks_[place.index], place.lane, batch.revolutes[i]); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

#include "hinge_blocks.h"

#include <utility>

#include "hinge_lanes.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const RevoluteKernels* revoluteKernels() { return nullptr; }
#endif

namespace {

/// Hinges, and blocks of them, of a block of a parallel loop.
constexpr std::size_t kPlaceGrain = 128;
constexpr std::size_t kBlockGrain = 16;

HingeParts partsOf(const RevoluteConstraint& joint) {
    return {joint.hasSpring, joint.hasMotor, joint.hasLimits, joint.isGliding};
}

std::uint8_t numberOf(const HingeParts& parts) {
    return static_cast<std::uint8_t>((parts.hasSpring ? 4U : 0U) + (parts.hasMotor ? 2U : 0U) +
                                     (parts.hasLimits ? 1U : 0U));
}
HingeParts partsOf(std::uint8_t number) { return {(number & 4U) != 0, (number & 2U) != 0, (number & 1U) != 0}; }

void emptyBlock(WideRevolute& block, std::uint32_t lanes, HingeParts parts) {
    emptyJoints(block, lanes);
    block.parts = parts;
    block.totalX = block.totalY = block.totalTwist = {};
}

}  // namespace

BlockLayout::Kind HingeBlocks::kindOf(const HingeLink& link, bool isHeld, int colour,
                                      std::span<const BodyInertia> inertias) const {
    if (kernels_ == nullptr || colour == kOverflowColour || isHeld || link.parts.isGliding) {
        return BlockLayout::kAlone;
    }
    // Parts of a joint whose bodies cannot turn do nothing, which only the scalar code knows.
    const bool turns = inertias[link.slotA].inverseInertia + inertias[link.slotB].inverseInertia > 0;
    return turns || !link.parts.any() ? numberOf(link.parts) : BlockLayout::kAlone;
}

void HingeBlocks::noteKind(std::size_t hinge, const HingeLink& link, bool isHeld, int colour,
                           std::span<const BodyInertia> inertias) {
    hasParts_ = hasParts_ || link.parts.any();
    layout_.note(hinge, static_cast<std::uint8_t>(colour), kindOf(link, isHeld, colour, inertias));
}

void HingeBlocks::listKinds(const SolverBatch& batch, const ConstraintGraph& graph) {
    hasParts_ = false;
    if (batch.hingeStore != nullptr) {
        const std::span<const std::uint8_t> colours = graph.hingeColours();
        layout_.begin(colours.size());
        for (std::size_t i = 0; i < colours.size(); ++i) {
            noteKind(i, batch.hingeLinks[i], false, colours[i], batch.inertias);
        }
        return;
    }
    layout_.begin(batch.revolutes.size());
    for (const int colour : graph.activeColours()) {
        const ColourRange range = graph.range<RevoluteConstraint>(colour);
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const RevoluteConstraint& joint = batch.revolutes[i];
            noteKind(i, {joint.slotA, joint.slotB, i, partsOf(joint)}, joint.isHeld, colour, batch.inertias);
        }
    }
}

void HingeBlocks::layOut(const ConstraintGraph& graph) {
    openings_.clear();
    layout_.layOut(graph.activeColours(), [this](std::uint32_t, std::uint32_t lanes, BlockLayout::Kind kind) {
        openings_.push_back({lanes, kind});
    });
    if (blocks_.size() < openings_.size()) { blocks_.resize(openings_.size()); }
    rest_.resize(layout_.restCount());
}

void HingeBlocks::listRest(const SolverBatch& batch) {
    const bool areLinks = batch.hingeStore != nullptr;
    const std::span<const BlockPlace> places = layout_.places();
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        if (!places[i].isInBlock) { rest_[places[i].index] = areLinks ? places[i].index : i; }
    }
}

/// Blocks from constraints; what is left over stays where it is.
void HingeBlocks::fillFrom(const SolverBatch& batch) {
    const std::span<const BlockPlace> places = layout_.places();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const BlockPlace& place = places[i];
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
    if (!areIn(batch)) { return layout_.forgetBlocks(); }
    // Parts may do nothing in one solve, and something in the next one.
    const bool areKept = batch.hingeStore != nullptr && graph.areHingesKept() && kernels_ == before && !hasParts_;
    if (!areKept) { listKinds(batch, graph); }
    layOut(graph);  // contacts may have brought other colours
    if (!areKept) {
        layout_.listPlaces();
        listRest(batch);
    }
    loops.run(openings_.size(), kBlockGrain, [this](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            emptyBlock(blocks_[i], openings_[i].lanes, partsOf(openings_[i].kind));
        }
    });
    const std::span<const BlockPlace> places = layout_.places();
    if (batch.hingeStore == nullptr) {
        fillFrom(batch);
    } else {
        batch.revolutes.resize(rest_.size());
        const HingeArrays to{blocks(), batch.revolutes};
        loops.run(places.size(), kPlaceGrain, [&](std::size_t begin, std::size_t end, int) {
            batch.hingeStore->fill(begin, places.subspan(begin, end - begin), to);
        });
    }
    loops.run(openings_.size(), kBlockGrain, [this](std::size_t begin, std::size_t end, int) {
        for (WideRevolute& block : blocks().subspan(begin, end - begin)) { closeBlock(block); }
    });
    if (batch.hingeStore == nullptr) { return; }
    for (RevoluteConstraint& joint : batch.revolutes) {
        joint.total = {};
        prepare(joint, batch.inertias);
    }
}

void HingeBlocks::warmStart(SolverBatch& batch, int colour, RangeCut& cut, bool hasMoved) {
    const BlockLayout::Colour& ranges = layout_.of(colour);
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto some = cut.next(blocks_, ranges.blocks); !some.empty()) {
        kernels_->warmStart(some, bodies, hasMoved);
    }
    for (const std::uint32_t place : cut.next(rest_, ranges.rest)) {
        swept::warmStart(std::span(&batch.revolutes[place], 1), bodies);
    }
}

void HingeBlocks::solve(SolverBatch& batch, int colour, RangeCut& cut, const ContactPass& pass) {
    const BlockLayout::Colour& ranges = layout_.of(colour);
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto some = cut.next(blocks_, ranges.blocks); !some.empty()) {
        kernels_->solve(some, bodies, ofJoints(pass));
    }
    for (const std::uint32_t place : cut.next(rest_, ranges.rest)) {
        swept::solve(std::span(&batch.revolutes[place], 1), bodies, pass.h, pass.useBias);
    }
}

void HingeBlocks::addUpRest(SolverBatch& batch) const {
    if (!areIn(batch)) { return; }
    for (const std::uint32_t place : rest_) { addUpReactions(std::span(&batch.revolutes[place], 1)); }
}

void HingeBlocks::readBack(SolverBatch& batch, TaskSystem& loops) {
    if (!areIn(batch)) { return; }
    const std::span<const BlockPlace> places = layout_.places();
    if (batch.hingeStore != nullptr) {
        const HingeArrays from{blocks(), batch.revolutes};
        loops.run(places.size(), kPlaceGrain, [&](std::size_t begin, std::size_t end, int) {
            batch.hingeStore->take(begin, places.subspan(begin, end - begin), from);
        });
        batch.revolutes.clear();
        return;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].isInBlock) { takeLane(blocks_[places[i].index], places[i].lane, batch.revolutes[i]); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

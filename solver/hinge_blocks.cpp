#include "hinge_blocks.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const RevoluteKernels* revoluteKernels() { return nullptr; }
#endif

namespace {

/// A block with fewer joints costs more than they do one by one.
constexpr std::size_t kFewestLanes = 2;

HingeParts partsOf(const RevoluteConstraint& joint) { return {joint.hasSpring, joint.hasMotor, joint.hasLimits}; }

std::size_t indexOf(const HingeParts& parts) {
    return (parts.hasSpring ? 4U : 0U) + (parts.hasMotor ? 2U : 0U) + (parts.hasLimits ? 1U : 0U);
}

/// Parts of a joint whose bodies cannot turn do nothing, which only the scalar code knows.
bool fitsBlocks(const RevoluteConstraint& joint, const BodyInertia& a, const BodyInertia& b) {
    return !joint.isHeld && (!partsOf(joint).any() || a.inverseInertia + b.inverseInertia > 0);
}

void fillPlace(WideRevolute& block, std::size_t lane, const RevoluteConstraint& joint, const BodyInertia& a,
               const BodyInertia& b) {
    block.slotA[lane] = joint.slotA;
    block.slotB[lane] = joint.slotB;
    block.movableA |= (isMovable(a) ? 1U : 0U) << lane;
    block.movableB |= (isMovable(b) ? 1U : 0U) << lane;
    block.anchorAX[lane] = joint.anchorA.x;
    block.anchorAY[lane] = joint.anchorA.y;
    block.anchorBX[lane] = joint.anchorB.x;
    block.anchorBY[lane] = joint.anchorB.y;
    block.offsetX[lane] = joint.centerOffset.x;
    block.offsetY[lane] = joint.centerOffset.y;
    block.baseAngle[lane] = joint.baseAngle;
    block.biasRate[lane] = joint.softness.biasRate;
    block.massScale[lane] = joint.softness.massScale;
    block.impulseScale[lane] = joint.softness.impulseScale;
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
}

void fillParts(WideRevolute& block, std::size_t lane, const RevoluteConstraint& joint) {
    block.lower[lane] = joint.lower;
    block.upper[lane] = joint.upper;
    block.motorSpeed[lane] = joint.motorSpeed;
    block.maxMotorImpulse[lane] = joint.maxMotorImpulse;
    block.springPush[lane] = joint.spring.push;
    block.springDrag[lane] = joint.spring.drag;
    block.lowerImpulse[lane] = joint.lowerImpulse;
    block.upperImpulse[lane] = joint.upperImpulse;
    block.motorImpulse[lane] = joint.motorImpulse;
    block.springImpulse[lane] = 0;  // made anew by each warm start
}

void fillLane(WideRevolute& block, std::size_t lane, const RevoluteConstraint& joint, const BodyInertia& a,
              const BodyInertia& b) {
    fillPlace(block, lane, joint, a, b);
    fillParts(block, lane, joint);
    block.impulseX[lane] = joint.linearImpulse.x;
    block.impulseY[lane] = joint.linearImpulse.y;
    block.totalX[lane] = joint.total.impulse.x;
    block.totalY[lane] = joint.total.impulse.y;
    block.totalTwist[lane] = joint.total.twist;
}

/// @param places  at most as many as there are lanes
void fillBlock(WideRevolute& block, const SolverBatch& batch, std::span<const std::uint32_t> places) {
    block.movableA = block.movableB = 0;
    block.lanes = static_cast<std::uint32_t>(places.size());
    block.parts = partsOf(batch.revolutes[places[0]]);
    for (std::size_t lane = 0; lane < places.size(); ++lane) {
        const RevoluteConstraint& joint = batch.revolutes[places[lane]];
        block.place[lane] = places[lane];
        fillLane(block, lane, joint, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
    }
    for (std::size_t lane = places.size(); lane < kBlockLanes; ++lane) { fillLane(block, lane, {}, {}, {}); }
}

}  // namespace

void HingeBlocks::fill(const SolverBatch& batch, std::span<const std::uint32_t> places) {
    while (places.size() >= kFewestLanes) {
        const std::size_t lanes = std::min(places.size(), kBlockLanes);
        if (count_ == blocks_.size()) { blocks_.emplace_back(); }
        fillBlock(blocks_[count_++], batch, places.first(lanes));
        places = places.subspan(lanes);
    }
    rest_.insert(rest_.end(), places.begin(), places.end());
}

void HingeBlocks::fillColour(const SolverBatch& batch, ColourRange range) {
    for (std::vector<std::uint32_t>& places : byParts_) { places.clear(); }
    for (std::uint32_t place = range.begin; place < range.end; ++place) {
        const RevoluteConstraint& joint = batch.revolutes[place];
        const bool fits = fitsBlocks(joint, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
        (fits ? byParts_[indexOf(partsOf(joint))] : rest_).push_back(place);
    }
    for (const std::vector<std::uint32_t>& places : byParts_) { fill(batch, places); }
}

void HingeBlocks::build(SolverBatch& batch, const ConstraintGraph& graph, bool wide) {
    kernels_ = wide ? revoluteKernels() : nullptr;
    count_ = 0;
    rest_.clear();
    if (batch.revolutes.empty()) { return; }
    for (const int c : graph.activeColours()) {
        Colour& colour = colours_[static_cast<std::size_t>(c)];
        const ColourRange range = graph.range<RevoluteConstraint>(c);
        colour.blocks.begin = count_;
        colour.rest.begin = static_cast<std::uint32_t>(rest_.size());
        if (kernels_ != nullptr && c != kOverflowColour) {
            fillColour(batch, range);
        } else {
            for (std::uint32_t place = range.begin; place < range.end; ++place) { rest_.push_back(place); }
        }
        colour.blocks.end = count_;
        colour.rest.end = static_cast<std::uint32_t>(rest_.size());
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
    for (const std::uint32_t place : rest_) { addUpReactions(std::span(&batch.revolutes[place], 1)); }
}

void HingeBlocks::readBack(SolverBatch& batch) const {
    for (const WideRevolute& block : std::span(blocks_).first(count_)) {
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            RevoluteConstraint& joint = batch.revolutes[block.place[lane]];
            joint.linearImpulse = {block.impulseX[lane], block.impulseY[lane]};
            joint.lowerImpulse = block.lowerImpulse[lane];
            joint.upperImpulse = block.upperImpulse[lane];
            joint.motorImpulse = block.motorImpulse[lane];
            joint.springImpulse = block.springImpulse[lane];
            joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

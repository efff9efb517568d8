#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../graph/block_layout.h"
#include "../graph/constraint_graph.h"
#include "../graph/range_cut.h"
#include "../solver_batch.h"
#include "joint_lanes.h"

namespace swept::inline SWEPT_PRECISION {

/// The joints of one sort of a solve as the kernels want them: of each colour what fills blocks, by its parts, and the
/// rest one by one. Impulses and totals of what stands in blocks are there from `build` to `readBack`, and old in the
/// batch.
/// @tparam Sort  names `Constraint`, its wide `Block`, and `Kernels`; `constraintsOf(batch)`, `kernels()`, the kind of
///               a constraint among the blocks, and how a block is emptied, and a lane filled and taken back
template <class Sort>
class JointBlocks {
public:
    using Constraint = typename Sort::Constraint;
    using Block = typename Sort::Block;

    static bool areIn(const SolverBatch& batch) { return !Sort::constraintsOf(batch).empty(); }

    /// @pre coloured; joints of the batch are prepared. @param wide  false: everything is solved one by one
    void build(SolverBatch& batch, const ConstraintGraph& graph, bool wide) {
        kernels_ = wide ? Sort::kernels() : nullptr;
        if (!areIn(batch)) { return layout_.forgetBlocks(); }
        const std::vector<Constraint>& joints = Sort::constraintsOf(batch);
        layout_.begin(joints.size());
        for (const int colour : graph.activeColours()) {
            const ColourRange range = graph.range<Constraint>(colour);
            const bool mayStandInBlocks = kernels_ != nullptr && colour != kOverflowColour;
            for (std::uint32_t i = range.begin; i < range.end; ++i) {
                layout_.note(i, static_cast<std::uint8_t>(colour),
                             mayStandInBlocks ? Sort::kindOf(joints[i], batch.inertias) : BlockLayout::kAlone);
            }
        }
        layout_.layOut(graph.activeColours(), [this](std::uint32_t block, std::uint32_t lanes, BlockLayout::Kind kind) {
            if (block == blocks_.size()) { blocks_.emplace_back(); }
            emptyJoints(blocks_[block], lanes);
            Sort::empty(blocks_[block], kind);
        });
        layout_.listPlaces();
        fill(batch);
    }
    int blockCount() const { return static_cast<int>(layout_.blockCount()); }
    /// Blocks, and joints on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const { return layout_.countOf(colour); }

    /// @param cut  of the parts of the colour; moves behind these joints
    /// @param hasMoved  bodies have moved since the pass before
    void warmStart(SolverBatch& batch, int colour, RangeCut& cut, bool hasMoved) {
        forEachOf(
            batch, colour, cut,
            [hasMoved, this](auto blocks, const SolverBodies& bodies) {
                kernels_->warmStart(blocks, bodies, hasMoved);
            },
            [](auto joint, const SolverBodies& bodies) { swept::warmStart(joint, bodies); });
    }
    void solve(SolverBatch& batch, int colour, RangeCut& cut, const ContactPass& pass) {
        forEachOf(
            batch, colour, cut,
            [&pass, this](auto blocks, const SolverBodies& bodies) { kernels_->solve(blocks, bodies, ofJoints(pass)); },
            [&pass](auto joint, const SolverBodies& bodies) { swept::solve(joint, bodies, pass.h, pass.useBias); });
    }
    /// Ends a sub-step for what is solved one by one; blocks had theirs by the last pass.
    void addUpRest(SolverBatch& batch) const {
        if (!areIn(batch)) { return; }
        for (const std::uint32_t place : rest_) { addUpReactions(std::span(&Sort::constraintsOf(batch)[place], 1)); }
    }
    void readBack(SolverBatch& batch) {
        if (!areIn(batch)) { return; }
        const std::span<const BlockPlace> places = layout_.places();
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!places[i].isInBlock) { continue; }
            Sort::take(blocks_[places[i].index], places[i].lane, Sort::constraintsOf(batch)[i]);
        }
    }

private:
    void fill(const SolverBatch& batch) {
        rest_.resize(layout_.restCount());
        const std::span<const BlockPlace> places = layout_.places();
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            if (!places[i].isInBlock) {
                rest_[places[i].index] = i;
                continue;
            }
            const Constraint& joint = Sort::constraintsOf(batch)[i];
            Block& block = blocks_[places[i].index];
            fillJoint(block, places[i].lane, joint, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
            Sort::fill(block, places[i].lane, joint);
        }
        for (Block& block : std::span(blocks_).first(layout_.blockCount())) { closeBlock(block); }
    }

    template <class OfBlocks, class OfOne>
    void forEachOf(SolverBatch& batch, int colour, RangeCut& cut, const OfBlocks& ofBlocks, const OfOne& ofOne) {
        const BlockLayout::Colour& ranges = layout_.of(colour);
        const SolverBodies bodies{batch.states, batch.inertias};
        if (const auto blocks = cut.next(blocks_, ranges.blocks); !blocks.empty()) { ofBlocks(blocks, bodies); }
        for (const std::uint32_t place : cut.next(rest_, ranges.rest)) {
            ofOne(std::span(&Sort::constraintsOf(batch)[place], 1), bodies);
        }
    }

    const typename Sort::Kernels* kernels_ = nullptr;
    BlockLayout layout_;
    std::vector<Block> blocks_;        ///< keeps its size
    std::vector<std::uint32_t> rest_;  ///< places in the batch
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/task_system.h"
#include "../graph/block_layout.h"
#include "../graph/constraint_graph.h"
#include "../graph/range_cut.h"
#include "../solver_batch.h"
#include "../wide/wide_revolutes.h"

namespace swept::inline SWEPT_PRECISION {

/// The hinges of a solve as the kernels want them: of each colour what fills blocks, by what they have beside their
/// point, and the rest one by one. Impulses and totals of what stands in blocks are there from `build` to `readBack`,
/// and old in the batch (or with the store of its hinges).
class HingeBlocks {
public:
    /// @pre coloured; joints of the batch are prepared. @param wide  false: everything is solved one by one
    void build(SolverBatch& batch, const ConstraintGraph& graph, bool wide, TaskSystem& loops);
    int blockCount() const { return static_cast<int>(layout_.blockCount()); }
    /// Blocks, and hinges on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const { return layout_.countOf(colour); }
    static bool areIn(const SolverBatch& batch) { return batch.hasHinges(); }
    /// @param cut  of the parts of the colour; moves behind the hinges
    /// @param hasMoved  bodies have moved since the pass before
    void warmStart(SolverBatch& batch, int colour, RangeCut& cut, bool hasMoved);
    void solve(SolverBatch& batch, int colour, RangeCut& cut, const ContactPass& pass);
    /// Ends a sub-step for what is solved one by one; blocks had theirs by the last pass.
    void addUpRest(SolverBatch& batch) const;
    void readBack(SolverBatch& batch, TaskSystem& loops);

private:
    void listKinds(const SolverBatch& batch, const ConstraintGraph& graph);
    BlockLayout::Kind kindOf(const HingeLink& link, bool isHeld, int colour,
                             std::span<const BodyInertia> inertias) const;
    void noteKind(std::size_t hinge, const HingeLink& link, bool isHeld, int colour,
                  std::span<const BodyInertia> inertias);
    void layOut(const ConstraintGraph& graph);
    void listRest(const SolverBatch& batch);
    void fillFrom(const SolverBatch& batch);
    std::span<WideRevolute> blocks() { return std::span(blocks_).first(layout_.blockCount()); }

    /// What a block is made for.
    struct Opening {
        std::uint32_t lanes = 0;
        BlockLayout::Kind kind = 0;
    };

    const RevoluteKernels* kernels_ = nullptr;
    bool hasParts_ = false;  ///< any hinge has something beside its point
    BlockLayout layout_;
    std::vector<Opening> openings_;     ///< by block
    std::vector<WideRevolute> blocks_;  ///< keeps its size
    std::vector<std::uint32_t> rest_;   ///< places in the batch
};

}  // namespace swept::inline SWEPT_PRECISION

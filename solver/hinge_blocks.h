#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "constraint_graph.h"
#include "range_cut.h"
#include "solver_batch.h"
#include "wide_revolutes.h"

namespace swept::inline SWEPT_PRECISION {

/// The hinges of a solve as the kernels want them: of each colour what fills blocks, by what they have beside their
/// point, and the rest one by one. Impulses and totals of what stands in blocks are there from `build` to `readBack`,
/// and old in the batch.
class HingeBlocks {
public:
    /// @pre coloured and prepared. @param wide  false: everything is solved one by one
    void build(SolverBatch& batch, const ConstraintGraph& graph, bool wide);
    int blockCount() const { return static_cast<int>(count_); }
    /// Blocks, and hinges on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const;
    /// @param cut  of the parts of the colour; moves behind the hinges
    /// @param hasMoved  bodies have moved since the pass before
    void warmStart(SolverBatch& batch, int colour, RangeCut& cut, bool hasMoved);
    void solve(SolverBatch& batch, int colour, RangeCut& cut, const ContactPass& pass);
    /// Ends a sub-step for what is solved one by one; blocks had theirs by the last pass.
    void addUpRest(SolverBatch& batch) const;
    void readBack(SolverBatch& batch) const;

private:
    struct Colour {
        ColourRange blocks;
        ColourRange rest;
    };

    void fillColour(const SolverBatch& batch, ColourRange range);
    void fill(const SolverBatch& batch, std::span<const std::uint32_t> places);

    const RevoluteKernels* kernels_ = nullptr;
    std::array<Colour, kColourCount> colours_{};
    std::vector<WideRevolute> blocks_;  ///< keeps its size
    std::uint32_t count_ = 0;           ///< in use
    std::vector<std::uint32_t> rest_;
    std::array<std::vector<std::uint32_t>, 8> byParts_;  ///< of the colour that is being filled
};

}  // namespace swept::inline SWEPT_PRECISION

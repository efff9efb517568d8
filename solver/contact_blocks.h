#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "constraint_graph.h"
#include "range_cut.h"
#include "solver_batch.h"
#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of a solve as the kernels want them: of each colour what fills blocks, by number of points, and the
/// rest one by one. Impulses of what stands in blocks are there from `build` to `readBack`, and old in the batch.
class ContactBlocks {
public:
    /// @pre coloured. @param wide  false: everything is solved one by one
    /// @param prepared  whether all contacts are (`prepareContact`); else what stands in blocks is prepared there alone
    void build(SolverBatch& batch, const ConstraintGraph& graph, bool wide, bool prepared);
    int blockCount() const { return static_cast<int>(one_.count + two_.count); }
    /// Blocks, and contacts on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const;
    /// @param cut  of the parts of the colour
    void warmStart(SolverBatch& batch, int colour, RangeCut cut);
    void solve(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass);
    /// Ends a sub-step for contacts with restitution, whose totals are in the batch; the others had theirs by the last
    /// pass.
    void addUpBouncing(SolverBatch& batch) const;
    void readBack(SolverBatch& batch) const;

private:
    /// Places in the arrays of one colour.
    struct Colour {
        ColourRange one;
        ColourRange two;
        ColourRange rest;
    };
    template <std::size_t kPoints>
    struct Blocks {
        std::vector<WideContact<kPoints>> blocks;  ///< keeps its size
        std::uint32_t count = 0;                   ///< in use
    };

    void sortColour(const SolverBatch& batch, std::span<const std::uint32_t> places);
    template <std::size_t kPoints>
    ColourRange fill(const SolverBatch& batch, std::span<const std::uint32_t> places, Blocks<kPoints>& to);

    const ContactKernels* kernels_ = nullptr;
    bool anyBounces_ = false;
    std::array<Colour, kColourCount> colours_{};
    Blocks<1> one_;
    Blocks<2> two_;
    std::vector<std::uint32_t> rest_;
    // Of the colour that is being filled.
    std::vector<std::uint32_t> withOne_;
    std::vector<std::uint32_t> withTwo_;
    std::vector<std::uint32_t> beginning_;
};

}  // namespace swept::inline SWEPT_PRECISION

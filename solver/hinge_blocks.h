#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "../shapes/task_system.h"
#include "constraint_graph.h"
#include "range_cut.h"
#include "solver_batch.h"
#include "wide_revolutes.h"

namespace swept::inline SWEPT_PRECISION {

/// The hinges of a solve as the kernels want them: of each colour what fills blocks, by what they have beside their
/// point, and the rest one by one. Impulses and totals of what stands in blocks are there from `build` to `readBack`,
/// and old in the batch (or with the store of its hinges).
class HingeBlocks {
public:
    /// @pre coloured; joints of the batch are prepared. @param wide  false: everything is solved one by one
    void build(SolverBatch& batch, const ConstraintGraph& graph, bool wide, TaskSystem& loops);
    int blockCount() const { return static_cast<int>(count_); }
    /// Blocks, and hinges on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const;
    /// @param cut  of the parts of the colour; moves behind the hinges
    /// @param hasMoved  bodies have moved since the pass before
    void warmStart(SolverBatch& batch, int colour, RangeCut& cut, bool hasMoved);
    void solve(SolverBatch& batch, int colour, RangeCut& cut, const ContactPass& pass);
    /// Ends a sub-step for what is solved one by one; blocks had theirs by the last pass.
    void addUpRest(SolverBatch& batch) const;
    void readBack(SolverBatch& batch, TaskSystem& loops);

private:
    struct Colour {
        ColourRange blocks;
        ColourRange rest;
    };
    /// What hinges have beside their point, as a number; or what stands alone.
    using Kind = std::uint8_t;
    static constexpr Kind kAlone = 8;
    /// By kind, of one colour.
    using KindCounts = std::array<std::uint32_t, kAlone + 1>;
    using KindRanges = std::array<ColourRange, kAlone>;

    void listKinds(const SolverBatch& batch, const ConstraintGraph& graph);
    void noteKind(std::size_t hinge, const HingeLink& link, bool isHeld, std::span<const BodyInertia> inertias);
    ColourRange reserve(std::uint32_t hinges, Kind kind);
    void layOut(const ConstraintGraph& graph);
    HingePlace placeFor(Kind kind, std::size_t colour);
    void listPlaces(const SolverBatch& batch);
    void fillFrom(const SolverBatch& batch);

    const RevoluteKernels* kernels_ = nullptr;
    bool hasParts_ = false;  ///< any hinge has something beside its point
    std::array<Colour, kColourCount> colours_{};
    std::vector<WideRevolute> blocks_;  ///< keeps its size
    std::uint32_t count_ = 0;           ///< in use
    std::vector<std::uint32_t> rest_;   ///< places in the batch
    // By hinge of the batch, or link.
    std::vector<std::uint8_t> hingeColours_;
    std::vector<Kind> kinds_;
    std::vector<HingePlace> places_;
    // By colour: as many hinges of each kind, the next place for one, blocks.
    std::array<KindCounts, kColourCount> counts_{};
    std::array<KindCounts, kColourCount> next_{};
    std::array<KindRanges, kColourCount> ranges_{};
};

}  // namespace swept::inline SWEPT_PRECISION

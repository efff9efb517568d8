#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "../shapes/task_system.h"
#include "constraint_graph.h"
#include "range_cut.h"
#include "solver_batch.h"
#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of a solve as the kernels want them: of each colour what fills blocks, by number of points, and the
/// rest one by one. Impulses of what stands in blocks are there from `build` to `readBack`, and old in the batch (or
/// with the store of its contacts).
class ContactBlocks {
public:
    struct BuildSettings {
        bool wide = true;       ///< false: everything is solved one by one
        bool prepared = false;  ///< whether all contacts are (`prepareContact`); blocks prepare their own again
    };
    /// @pre coloured
    void build(SolverBatch& batch, const ConstraintGraph& graph, const BuildSettings& settings, TaskSystem& loops);
    int blockCount() const { return static_cast<int>(one_.count + two_.count); }
    /// Lets a colour go on with what another one holds. @return false, and nothing is done, unless both hold only
    /// contacts on their own, which stand side by side. Then their order matters.
    bool join(int colour, int next);
    bool hasBlocks(int colour) const;
    /// Blocks, and contacts on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const;
    /// Of these those that meet the first half of the bodies.
    std::size_t middleOf(int colour) const;
    /// @param cut  of the parts of the colour
    void warmStart(SolverBatch& batch, int colour, RangeCut cut);
    void bounce(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass);
    void solve(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass);
    /// @pre built
    Real mostRestitution(const SolverBatch& batch) const;
    /// Ends a sub-step for contacts with restitution, whose totals are in the batch; the others had theirs by the last
    /// pass.
    void addUpBouncing(SolverBatch& batch) const;
    void readBack(SolverBatch& batch, TaskSystem& loops);

private:
    /// Places in the arrays of one colour.
    struct Colour {
        ColourRange one;
        ColourRange two;
        ColourRange rest;
        // Where, roughly, the blocks begin that hold contacts of the second half of the bodies:
        std::uint32_t middleOfOne = 0;
        std::uint32_t middleOfTwo = 0;
    };
    /// What kind of place a contact gets within its colour: where there are blocks, by its points there.
    enum Kind : std::uint8_t { kAlone, kOnePoint, kTwoPoints, kKindCount };
    using KindCounts = std::array<std::uint32_t, kKindCount>;
    /// Places for the contacts of a colour that have as many points in blocks.
    struct Places {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        ContactRank leftOver{};   ///< who gets none of these, if anybody
        bool isOneLeft = false;   ///< there is somebody
        std::uint32_t alone = 0;  ///< the place that he gets among those on their own
    };

    template <std::size_t kPoints>
    struct Blocks {
        std::vector<WideContact<kPoints>> blocks;  ///< keeps its size
        RawVector<std::uint8_t> lanes;             ///< in use, by block
        RawVector<std::uint32_t> places;           ///< of lanes: in the batch
        RawVector<ContactLink> links;              ///< likewise, of a store: instead
        std::uint32_t count = 0;                   ///< in use
        std::vector<ColourRange> halves;           ///< of colours, those of the first half of the bodies first
        std::size_t middle = 0;                    ///< blocks of the first half

        /// Room for the links of all lanes. @param unused  what lanes have that are not in use
        void makeRoomForLinks(const ContactLink& unused);
        /// Those of a range are empty then, each as long as it was laid out.
        void empty(std::size_t begin, std::size_t end);
        /// Goes through all on several workers, each of which meets the same bodies as in the solve, if it can.
        /// @param take  called with ranges of blocks that cover them exactly once
        template <class Take>
        void share(TaskSystem& loops, const Take& take) const;
        std::span<WideContact<kPoints>> all() { return std::span(blocks).first(count); }
        std::span<const WideContact<kPoints>> all() const { return std::span(blocks).first(count); }
        std::span<const std::uint32_t> placesOf(std::size_t begin, std::size_t end) const {
            return std::span(places).subspan(begin * kBlockLanes, (end - begin) * kBlockLanes);
        }
        std::span<const ContactLink> linksOf(std::size_t begin, std::size_t end) const {
            return std::span(links).subspan(begin * kBlockLanes, (end - begin) * kBlockLanes);
        }
    };

    bool mayHaveBlocks(int colour) const { return kernels_ != nullptr && colour != kOverflowColour; }
    template <std::size_t kPoints>
    ColourRange reserve(std::uint32_t contacts, Blocks<kPoints>& blocks);
    void layOut(const ConstraintGraph& graph);
    static Places placesFor(ColourRange blocks, std::uint32_t contacts, std::uint32_t inFront, std::uint32_t& alone);
    template <class Contacts, class List>
    void listPlaces(const ConstraintGraph& graph, const Contacts& contacts, TaskSystem& loops, const List& list) const;
    void listContacts(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops);
    void listLinks(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops);
    template <class TakeOne, class TakeTwo, class TakeRest>
    void forEachList(int colour, RangeCut cut, const TakeOne& takeOne, const TakeTwo& takeTwo,
                     const TakeRest& takeRest);
    void listHalves(const ConstraintGraph& graph);
    template <std::size_t kPoints>
    void fillFromStore(SolverBatch& batch, Blocks<kPoints>& blocks, TaskSystem& loops);
    template <std::size_t kPoints>
    void fillFromBatch(const SolverBatch& batch, Blocks<kPoints>& blocks, TaskSystem& loops);
    template <std::size_t kPoints>
    void prepare(std::span<WideContact<kPoints>> blocks) const;

    const ContactKernels* kernels_ = nullptr;
    bool anyBounces_ = false;
    std::array<Colour, kColourCount> colours_{};
    Blocks<1> one_;
    Blocks<2> two_;
    std::vector<std::uint32_t> rest_;                                    ///< places in the batch
    RawVector<ContactLink> restLinks_;                                   ///< of a store: likewise
    std::array<std::array<Places, kKindCount>, kColourCount> places_{};  ///< by points in blocks
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <vector>

#include "../solver_batch.h"
#include "contact_layout.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of a solve as the kernels want them (`ContactLayout`). Impulses of what stands in blocks are there from
/// `build` to `readBack`, and old in the batch (or with the store of its contacts). A colour is cut where the contacts
/// of the second half of the bodies begin (`ContactLayout` shows the order).
class ContactBlocks {
public:
    struct BuildSettings {
        bool wide = true;       ///< false: everything is solved one by one
        bool prepared = false;  ///< whether all contacts are (`prepareContact`); blocks prepare their own again
    };
    /// @pre coloured
    void build(SolverBatch& batch, const ConstraintGraph& graph, const BuildSettings& settings, TaskSystem& loops);
    int blockCount() const { return static_cast<int>(layout_.one().count() + layout_.two().count()); }
    /// As `ContactLayout::join`.
    bool join(int colour, int next) { return layout_.join(colour, next); }
    /// Blocks, and contacts on their own, of a colour. Those of a range may be solved beside those of another one.
    std::size_t countOf(int colour) const { return layout_[colour].count(); }
    /// Of these those of the first half of the bodies.
    std::size_t middleOf(int colour) const { return layout_[colour].middle(); }
    /// @param cut  of the parts of the colour
    void warmStart(SolverBatch& batch, int colour, RangeCut cut);
    void bounce(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass);
    void solve(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass);
    /// Lists what a colour holds, after those that are listed, for `solveListed`.
    void list(int colour);
    void clearList() { listed_.clear(); }
    /// The same as to solve the colours that are listed, one after the other: what is in them is known.
    void solveListed(SolverBatch& batch, const ContactPass& pass);
    /// @pre built
    Real mostRestitution(const SolverBatch& batch) const;
    /// Ends a sub-step for contacts with restitution, whose totals are in the batch; the others had theirs by the last
    /// pass.
    void addUpBouncing(SolverBatch& batch) const;
    void readBack(SolverBatch& batch, TaskSystem& loops);

private:
    template <std::size_t kPoints>
    struct Blocks {
        std::vector<WideContact<kPoints>> blocks;  ///< keeps its size; the first ones are in use
        RawVector<std::uint32_t> places;           ///< of lanes: in the batch
        RawVector<ContactLink> links;              ///< likewise, of a store: instead

        void makeRoom(std::size_t count);
        /// Room for the links of all lanes. @param unused  what lanes have that are not in use
        void makeRoomForLinks(const BlockRow& row, const ContactLink& unused);
        /// Those of a range, empty, each as long as it was laid out.
        std::span<WideContact<kPoints>> emptied(const BlockRow& row, std::size_t begin, std::size_t end);
        std::span<const std::uint32_t> placesOf(std::size_t begin, std::size_t end) const {
            return std::span(places).subspan(begin * kBlockLanes, (end - begin) * kBlockLanes);
        }
        std::span<const ContactLink> linksOf(std::size_t begin, std::size_t end) const {
            return std::span(links).subspan(begin * kBlockLanes, (end - begin) * kBlockLanes);
        }
    };

    /// Blocks of a colour, or contacts on their own.
    struct Listed {
        ContactLayout::Kind kind = ContactLayout::kAlone;
        ColourRange range;
    };

    template <class Visit>
    void forBothKinds(const Visit& visit);
    template <class Visit>
    void forBothKinds(const Visit& visit) const;
    void listContacts(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops);
    void listLinks(const SolverBatch& batch, const ConstraintGraph& graph, TaskSystem& loops);
    void fillFromStore(SolverBatch& batch, TaskSystem& loops);
    void fillFromBatch(const SolverBatch& batch, TaskSystem& loops);
    void prepare(std::span<WideContact<1>> blocks) const { kernels_->prepareOne(blocks); }
    void prepare(std::span<WideContact<2>> blocks) const { kernels_->prepareTwo(blocks); }
    template <class TakeOne, class TakeTwo, class TakeRest>
    void forEachList(int colour, RangeCut cut, const TakeOne& takeOne, const TakeTwo& takeTwo,
                     const TakeRest& takeRest);

    const ContactKernels* kernels_ = nullptr;
    bool anyBounces_ = false;
    ContactLayout layout_;
    Blocks<1> one_;
    Blocks<2> two_;
    std::vector<std::uint32_t> rest_;   ///< contacts on their own: places in the batch
    RawVector<ContactLink> restLinks_;  ///< of a store: likewise
    std::vector<Listed> listed_;
};

}  // namespace swept::inline SWEPT_PRECISION

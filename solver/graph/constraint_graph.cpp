#include "constraint_graph.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <type_traits>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint64_t bits(int from, int to) {
    return ((std::uint64_t{1} << to) - 1) & ~((std::uint64_t{1} << from) - 1);
}

/// Of a body that cannot be moved, in the place of the overflow, which takes nothing up.
constexpr std::uint64_t kIsFixed = std::uint64_t{1} << kOverflowColour;
static_assert(kOverflowColour == 63, "the highest bit");

constexpr std::size_t kUnknown = ~std::size_t{0};

std::array<BodySlot, 2> bodySlots(const ContactConstraint& contact) { return {contact.slotA, contact.slotB}; }
std::array<BodySlot, 2> bodySlots(const ContactLink& link) { return {link.slotA, link.slotB}; }

}  // namespace

template <std::size_t kBodies>
int ConstraintGraph::colourFor(const std::array<BodySlot, kBodies>& slots) {
    std::uint64_t taken = 0;
    for (const BodySlot slot : slots) { taken |= used_[slot]; }
    const bool allMovable = (taken & kIsFixed) == 0;
    const std::uint64_t allowed = allMovable ? bits(0, kFirstFixedColour) : bits(kFirstFixedColour, kOverflowColour);
    const std::uint64_t free = allowed & ~taken;
    if (free == 0) { return kOverflowColour; }
    const int colour = std::countr_zero(free);
    for (const BodySlot slot : slots) {  // without a branch: whether one of them is fixed is hard to foretell
        const std::uint64_t ofMovable = (used_[slot] >> kOverflowColour) - 1;
        used_[slot] |= std::uint64_t{1} << colour & ofMovable;
    }
    return colour;
}

/// @param ranges  of the colours, to be found
template <class Constraint>
void ConstraintGraph::listByColour(const std::vector<Constraint>& constraints, ColourRanges& ranges) {
    if (constraints.empty()) {
        if (ranges.back().end > 0) { ranges = {}; }  // in small solves it is most of the work
        return;
    }
    places_.resize(constraints.size());
    colours_.resize(constraints.size());
    ranges = {};
    std::array<std::uint32_t, kColourCount> counts{};
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const int colour = colourFor(bodySlots(constraints[i]));
        colours_[i] = static_cast<std::uint8_t>(colour);
        ++counts[static_cast<std::size_t>(colour)];
    }
    std::uint32_t begin = 0;
    std::array<std::uint32_t, kColourCount> next{};
    for (std::size_t c = 0; c < kColourCount; ++c) {
        ranges[c] = {begin, begin + counts[c]};
        next[c] = begin;
        begin += counts[c];
        isUsed_ |= std::uint64_t{counts[c] > 0} << c;
    }
    for (std::uint32_t i = 0; i < constraints.size(); ++i) { places_[next[colours_[i]]++] = i; }
}

void ConstraintGraph::forgetCounts() {
    for (const int colour : active_) { pointCounts_[static_cast<std::size_t>(colour)] = {}; }  // others have none
}

/// So that every worker can find the places of any contacts later. Without a branch: one in two would go wrong. @pre
/// its colour is known, and those before it have their ranks
template <class Contact>
void ConstraintGraph::rank(const Contact& contact, std::size_t i) {
    const std::size_t colour = colours_[i];
    const std::size_t points = colour == kOverflowColour ? 0 : pointsInBlock(contact);
    const bool isOfSecondHalf = 2 * std::size_t{std::max(contact.slotA, contact.slotB)} >= used_.size();
    const auto side = static_cast<std::uint32_t>(int{isOfSecondHalf} & int{points > 0});
    ranks_[i] = {side << ContactRank::kSideBit | pointCounts_[colour][points].ofSide[side]++};
}

/// What stands in blocks has its places there: no list by colour.
void ConstraintGraph::colourLinks(const RawVector<ContactLink>& links) {
    forgetCounts();
    colours_.resize(links.size());
    ranks_.resize(links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
        const int colour = colourFor(bodySlots(links[i]));
        colours_[i] = static_cast<std::uint8_t>(colour);
        isUsed_ |= std::uint64_t{1} << colour;
        rank(links[i], i);
    }
}

void ConstraintGraph::colourContactLinks(const RawVector<ContactLink>& links) {
    places_.clear();
    ColourRanges& ranges = rangesOf<ContactConstraint>();
    if (ranges.back().end > 0) { ranges = {}; }
    const bool areOthersKept = areBodiesKept_ && areHingesKept_ && !hasOthers_ && !before_.hasOthers;
    const bool areAsMany = links.size() == before_.contactCount;
    if (areOthersKept && areAsMany && links == before_.contacts) {
        isUsed_ = before_.isUsed;
        return;
    }
    colourLinks(links);
    before_.contactCount = links.size();
    before_.isUsed = isUsed_;
    if (areAsMany) {
        before_.contacts = links;
    } else {
        before_.contacts.clear();
    }
}

template <class Constraint>
void ConstraintGraph::sortAsListed(std::vector<Constraint>& constraints) {
    if (constraints.empty()) { return; }
    std::vector<Constraint>& sorted = std::get<Kind<Constraint>>(kinds_).scratch;
    sorted.resize(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i) { sorted[i] = constraints[places_[i]]; }
    constraints.swap(sorted);
}

/// Before all others. @param links  none: there are no hinges, or they have no links
void ConstraintGraph::colourHinges(const std::vector<HingeLink>& links) {
    areHingesKept_ = areBodiesKept_ && links == before_.hinges;
    if (links.empty()) { return before_.hinges.clear(); }
    if (areHingesKept_) {
        used_ = before_.usedByHinges;
        isUsed_ = before_.isUsedByHinges;
        return;
    }
    listByColour(links, rangesOf<RevoluteConstraint>());
    hingeColours_.swap(colours_);
    before_.hinges = links;
    before_.usedByHinges = used_;
    before_.isUsedByHinges = isUsed_;
}

void ConstraintGraph::begin(const SolverBatch& batch) {
    used_.resize(batch.inertias.size());
    for (std::size_t i = 0; i < used_.size(); ++i) { used_[i] = isMovable(batch.inertias[i]) ? 0 : kIsFixed; }
    noteFixed();
}

void ConstraintGraph::noteFixed() {
    isUsed_ = 0;
    hasOthers_ = false;
    areBodiesKept_ = used_ == before_.fixed;
    if (!areBodiesKept_) { before_.fixed = used_; }
}

void ConstraintGraph::finish(const SolverBatch& batch) {
    if (batch.store != nullptr) {
        colourContactLinks(batch.links);
    } else {
        forgetCounts();
        places_.clear();
        colours_.clear();
        listByColour(batch.contacts, rangesOf<ContactConstraint>());
        ranks_.resize(batch.contacts.size());
        for (std::size_t i = 0; i < batch.contacts.size(); ++i) { rank(batch.contacts[i], i); }
        before_.contactCount = kUnknown;
    }
    before_.hasOthers = hasOthers_;
    active_.clear();
    for (std::uint64_t left = isUsed_; left != 0; left &= left - 1) { active_.push_back(std::countr_zero(left)); }
}

void ConstraintGraph::colourJoints(SolverBatch& batch) {
    batch.forEachJointKind([&](auto& joints) {
        using Joint = typename std::remove_reference_t<decltype(joints)>::value_type;
        if constexpr (std::is_same_v<Joint, RevoluteConstraint>) {
            if (batch.hingeStore != nullptr) { return colourHinges(batch.hingeLinks); }
            colourHinges({});
        }
        listByColour(joints, rangesOf<Joint>());
        sortAsListed(joints);
        hasOthers_ = hasOthers_ || !joints.empty();
    });
}

void ConstraintGraph::colour(SolverBatch& batch) {
    begin(batch);
    colourJoints(batch);
    finish(batch);
}

void ConstraintGraph::colourContacts(const SolverBatch& batch) {
    begin(batch);
    colourHinges({});
    finish(batch);
}

void ConstraintGraph::colourAhead(SolverBatch& batch, bool onlyContacts, std::span<const BodySlot> standing) {
    used_.assign(batch.states.size(), 0);
    used_[kFixedSlot] = kIsFixed;
    for (const BodySlot slot : standing) { used_[slot] = kIsFixed; }
    noteFixed();
    if (!onlyContacts) {
        colourJoints(batch);
    } else {
        colourHinges({});
    }
    finish(batch);
}

void ConstraintGraph::sortContacts(SolverBatch& batch) {
    sortAsListed(batch.contacts);
    std::iota(places_.begin(), places_.end(), 0U);
    std::sort(colours_.begin(), colours_.end());
    forgetCounts();
    for (std::size_t i = 0; i < batch.contacts.size(); ++i) { rank(batch.contacts[i], i); }
}

}  // namespace swept::inline SWEPT_PRECISION

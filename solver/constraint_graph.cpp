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

std::array<BodySlot, 2> bodySlots(const ContactConstraint& contact) { return {contact.slotA, contact.slotB}; }
std::array<BodySlot, 2> bodySlots(const ContactLink& link) { return {link.slotA, link.slotB}; }

}  // namespace

template <std::size_t kBodies>
int ConstraintGraph::colourFor(const std::array<BodySlot, kBodies>& slots, std::span<const BodyInertia> inertias) {
    bool allMovable = true;
    std::uint64_t taken = 0;
    for (const BodySlot slot : slots) {
        const bool movable = isMovable(inertias[slot]);
        allMovable = allMovable && movable;
        taken |= movable ? used_[slot] : 0;
    }
    const std::uint64_t allowed = allMovable ? bits(0, kFirstFixedColour) : bits(kFirstFixedColour, kOverflowColour);
    const std::uint64_t free = allowed & ~taken;
    if (free == 0) { return kOverflowColour; }
    const int colour = std::countr_zero(free);
    for (const BodySlot slot : slots) {
        if (isMovable(inertias[slot])) { used_[slot] |= std::uint64_t{1} << colour; }
    }
    return colour;
}

/// @param ranges  of the colours, to be found
template <class Constraint>
void ConstraintGraph::listByColour(const std::vector<Constraint>& constraints, std::span<const BodyInertia> inertias,
                                   ColourRanges& ranges) {
    ranges = {};
    places_.resize(constraints.size());
    colours_.resize(constraints.size());
    if (constraints.empty()) { return; }
    std::array<std::uint32_t, kColourCount> counts{};
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const int colour = colourFor(bodySlots(constraints[i]), inertias);
        colours_[i] = static_cast<std::uint8_t>(colour);
        ++counts[static_cast<std::size_t>(colour)];
    }
    std::uint32_t begin = 0;
    std::array<std::uint32_t, kColourCount> next{};
    for (std::size_t c = 0; c < kColourCount; ++c) {
        ranges[c] = {begin, begin + counts[c]};
        next[c] = begin;
        begin += counts[c];
        isUsed_[c] = isUsed_[c] || counts[c] > 0;
    }
    for (std::uint32_t i = 0; i < constraints.size(); ++i) { places_[next[colours_[i]]++] = i; }
}

template <class Constraint>
void ConstraintGraph::sortAsListed(std::vector<Constraint>& constraints) {
    if (constraints.empty()) { return; }
    std::vector<Constraint>& sorted = std::get<Kind<Constraint>>(kinds_).scratch;
    sorted.resize(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i) { sorted[i] = constraints[places_[i]]; }
    constraints.swap(sorted);
}

void ConstraintGraph::begin(const SolverBatch& batch) {
    used_.assign(batch.states.size(), 0);
    isUsed_ = {};
}

void ConstraintGraph::finish(const SolverBatch& batch) {
    if (batch.store != nullptr) {
        listByColour(batch.links, batch.inertias, rangesOf<ContactConstraint>());
    } else {
        listByColour(batch.contacts, batch.inertias, rangesOf<ContactConstraint>());
    }
    active_.clear();
    for (int c = 0; c < kColourCount; ++c) {
        if (isUsed_[static_cast<std::size_t>(c)]) { active_.push_back(c); }
    }
}

void ConstraintGraph::colour(SolverBatch& batch) {
    begin(batch);
    batch.forEachJointKind([&](auto& joints) {
        using Joint = typename std::remove_reference_t<decltype(joints)>::value_type;
        if constexpr (std::is_same_v<Joint, RevoluteConstraint>) {
            if (batch.hingeStore != nullptr) {
                listByColour(batch.hingeLinks, batch.inertias, rangesOf<Joint>());
                hingeColours_.swap(colours_);
                return;
            }
        }
        listByColour(joints, batch.inertias, rangesOf<Joint>());
        sortAsListed(joints);
    });
    finish(batch);
}

void ConstraintGraph::colourContacts(const SolverBatch& batch) {
    begin(batch);
    finish(batch);
}

void ConstraintGraph::sortContacts(SolverBatch& batch) {
    sortAsListed(batch.contacts);
    std::iota(places_.begin(), places_.end(), 0U);
    std::sort(colours_.begin(), colours_.end());
}

}  // namespace swept::inline SWEPT_PRECISION

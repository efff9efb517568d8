#include "constraint_graph.h"

#include <bit>
#include <numeric>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint64_t bits(int from, int to) {
    return ((std::uint64_t{1} << to) - 1) & ~((std::uint64_t{1} << from) - 1);
}

std::array<BodySlot, 2> bodySlots(const ContactConstraint& contact) { return {contact.slotA, contact.slotB}; }

}  // namespace

int ConstraintGraph::colourFor(std::span<const BodySlot> slots, const std::vector<BodyInertia>& inertias) {
    bool allMovable = true;
    std::uint64_t taken = 0;
    for (const BodySlot slot : slots) {
        const bool movable = isMovable(inertias[slot]);
        allMovable = allMovable && movable;
        taken |= movable ? used_[slot] : 0;
    }
    const std::uint64_t allowed = allMovable ? bits(0, kFirstFixedColour) : bits(kFirstFixedColour, kOverflowColour);
    const std::uint64_t free = allowed & ~taken;
    if (free == 0) {
        return kOverflowColour;
    }
    const int colour = std::countr_zero(free);
    for (const BodySlot slot : slots) {
        if (isMovable(inertias[slot])) {
            used_[slot] |= std::uint64_t{1} << colour;
        }
    }
    return colour;
}

template <class Constraint>
void ConstraintGraph::listByColour(const std::vector<Constraint>& constraints,
                                   const std::vector<BodyInertia>& inertias) {
    Kind<Constraint>& kind = std::get<Kind<Constraint>>(kinds_);
    kind.ranges = {};
    places_.resize(constraints.size());
    if (constraints.empty()) {
        return;
    }
    colours_.clear();
    std::array<std::uint32_t, kColourCount> counts{};
    for (const Constraint& constraint : constraints) {
        const int colour = colourFor(bodySlots(constraint), inertias);
        colours_.push_back(static_cast<std::uint8_t>(colour));
        ++counts[static_cast<std::size_t>(colour)];
    }
    std::uint32_t begin = 0;
    std::array<std::uint32_t, kColourCount> next{};
    for (std::size_t c = 0; c < kColourCount; ++c) {
        kind.ranges[c] = {begin, begin + counts[c]};
        next[c] = begin;
        begin += counts[c];
        isUsed_[c] = isUsed_[c] || counts[c] > 0;
    }
    for (std::uint32_t i = 0; i < constraints.size(); ++i) {
        places_[next[colours_[i]]++] = i;
    }
}

template <class Constraint>
void ConstraintGraph::sortAsListed(std::vector<Constraint>& constraints) {
    if (constraints.empty()) {
        return;
    }
    std::vector<Constraint>& sorted = std::get<Kind<Constraint>>(kinds_).scratch;
    sorted.resize(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        sorted[i] = constraints[places_[i]];
    }
    constraints.swap(sorted);
}

void ConstraintGraph::begin(const SolverBatch& batch) {
    used_.assign(batch.states.size(), 0);
    isUsed_ = {};
}

void ConstraintGraph::finish(const SolverBatch& batch) {
    listByColour(batch.contacts, batch.inertias);
    active_.clear();
    for (int c = 0; c < kColourCount; ++c) {
        if (isUsed_[static_cast<std::size_t>(c)]) {
            active_.push_back(c);
        }
    }
}

void ConstraintGraph::colour(SolverBatch& batch) {
    begin(batch);
    batch.forEachJointKind([&](auto& joints) {
        listByColour(joints, batch.inertias);
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
}

}  // namespace swept::inline SWEPT_PRECISION

#include "constraint_graph.h"

#include <bit>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint64_t bits(int from, int to) {
    return ((std::uint64_t{1} << to) - 1) & ~((std::uint64_t{1} << from) - 1);
}

/// Kinematic bodies are read but never changed by a constraint, so they do not tie constraints together.
bool isMovable(BodySlot slot, const std::vector<BodyInertia>& inertias) {
    return inertias[slot].inverseMass > 0 || inertias[slot].inverseInertia > 0;
}

}  // namespace

int ConstraintGraph::colourFor(BodySlot a, BodySlot b, const std::vector<BodyInertia>& inertias) {
    const bool movableA = isMovable(a, inertias);
    const bool movableB = isMovable(b, inertias);
    const std::uint64_t allowed =
        movableA && movableB ? bits(0, kFirstFixedColour) : bits(kFirstFixedColour, kOverflowColour);
    const std::uint64_t taken = (movableA ? used_[a] : 0) | (movableB ? used_[b] : 0);
    const std::uint64_t free = allowed & ~taken;
    if (free == 0) { return kOverflowColour; }
    const int colour = std::countr_zero(free);
    const std::uint64_t bit = std::uint64_t{1} << colour;
    if (movableA) { used_[a] |= bit; }
    if (movableB) { used_[b] |= bit; }
    return colour;
}

template <class Constraint>
void ConstraintGraph::sortByColour(std::vector<Constraint>& constraints, std::vector<Constraint>& scratch,
                                   Ranges& ranges, const std::vector<BodyInertia>& inertias) {
    colours_.clear();
    std::array<std::uint32_t, kColourCount> counts{};
    for (const Constraint& constraint : constraints) {
        const int colour = colourFor(constraint.slotA, constraint.slotB, inertias);
        colours_.push_back(static_cast<std::uint8_t>(colour));
        ++counts[static_cast<std::size_t>(colour)];
    }
    std::uint32_t begin = 0;
    std::array<std::uint32_t, kColourCount> next{};
    for (std::size_t c = 0; c < kColourCount; ++c) {
        ranges[c] = {begin, begin + counts[c]};
        next[c] = begin;
        begin += counts[c];
    }
    scratch.resize(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i) { scratch[next[colours_[i]]++] = constraints[i]; }
    constraints.swap(scratch);
}

void ConstraintGraph::colour(SolverBatch& batch) {
    used_.assign(batch.states.size(), 0);
    sortByColour(batch.revolutes, revoluteScratch_, revoluteRanges_, batch.inertias);
    sortByColour(batch.distances, distanceScratch_, distanceRanges_, batch.inertias);
    sortByColour(batch.contacts, contactScratch_, contactRanges_, batch.inertias);
    active_.clear();
    for (int c = 0; c < kColourCount; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const bool used = contactRanges_[i].begin < contactRanges_[i].end ||
                          revoluteRanges_[i].begin < revoluteRanges_[i].end ||
                          distanceRanges_[i].begin < distanceRanges_[i].end;
        if (used) { active_.push_back(c); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

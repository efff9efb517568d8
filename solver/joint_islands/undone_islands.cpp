#include "undone_islands.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr BodySlot kNotYet = std::numeric_limits<BodySlot>::max();

/// The kinds of joints that islands may have, of two batches.
template <class First, class Second, class Visit>
void forEachKindOf(First& first, Second& second, const Visit& visit) {
    visit(first.revolutes, second.revolutes);
    visit(first.distances, second.distances);
    visit(first.prismatics, second.prismatics);
    visit(first.wheels, second.wheels);
    visit(first.welds, second.welds);
}

}  // namespace

BodySlot UndoneIslands::slotOf(const SolverBatch& from, BodySlot slot) {
    if (own_[slot] == kNotYet) {
        own_[slot] = batch_.addBody(from.states[slot], from.inertias[slot], from.drives[slot]);
        slots_.push_back(slot);
    }
    return own_[slot];
}

SolverBatch& UndoneIslands::take(const SolverBatch& from, const JointIslands& islands) {
    batch_.clear();
    batch_.mayGlide = from.mayGlide;
    slots_.assign(1, kFixedSlot);
    own_.assign(from.states.size(), kNotYet);
    own_[kFixedSlot] = kFixedSlot;
    const auto isUndone = [&](BodySlot slot) { return isMovable(from.inertias[slot]) && islands.isUndone(slot); };
    forEachKindOf(from, batch_, [&](const auto& all, auto& own) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!isUndone(all[i].slotA) && !isUndone(all[i].slotB)) { continue; }
            auto& joint = own.emplace_back(all[i]);
            joint.source = static_cast<std::uint32_t>(i);
            joint.slotA = slotOf(from, joint.slotA);
            joint.slotB = slotOf(from, joint.slotB);
        }
    });
    return batch_;
}

void UndoneIslands::giveBack(SolverBatch& to) const {
    for (std::size_t i = 1; i < slots_.size(); ++i) { to.states[slots_[i]] = batch_.states[i]; }
    // Solves sort joints by their colours.
    forEachKindOf(batch_, to, [](const auto& own, auto& all) {
        for (const auto& joint : own) {
            auto& place = all[joint.source];
            const JointConstraint before = place;
            place = joint;
            place.slotA = before.slotA;
            place.slotB = before.slotB;
            place.source = before.source;
        }
    });
}

}  // namespace swept::inline SWEPT_PRECISION

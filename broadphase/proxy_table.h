#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// The bit of one kind in a mask of kinds.
constexpr std::uint8_t kindBit(ProxyKind kind) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(kind)); }

/// Mask of the kinds that `kind` can meet.
constexpr std::uint8_t meetingKinds(ProxyKind kind) {
    unsigned mask = 0;
    for (int other = 0; other < kProxyKindCount; ++other) {
        if (canMeet(kind, static_cast<ProxyKind>(other))) {
            mask |= 1U << static_cast<unsigned>(other);
        }
    }
    return static_cast<std::uint8_t>(mask);
}

/// The one check of boxes that come from outside.
Status checkBox(const Aabb& box);

/// What every implementation keeps about its proxies: which slots are taken, of which kind, and which of them moved.
/// Removing and marking never allocate; adding does so only when there were never so many slots before.
class ProxyTable {
public:
    /// Takes the lowest free slot and marks it as moved. Error: `outOfMemory` when all 2³² − 1 slots are taken.
    Result<ProxyId> add(ProxyKind kind);
    /// Frees a slot that is taken.
    void release(ProxyId id);

    bool holds(ProxyId id) const {
        const auto slot = static_cast<std::uint32_t>(id);
        return slot < kindBits_.size() && kindBits_[slot] != 0;
    }
    /// One more than the highest slot that was ever taken.
    std::uint32_t slotCount() const { return static_cast<std::uint32_t>(kindBits_.size()); }

    /// `kindBit` of a slot below `slotCount()`; 0 when the slot is free.
    std::uint8_t bitAt(std::uint32_t slot) const { return kindBits_[slot]; }
    ProxyKind kindOf(ProxyId id) const;

    /// A free slot has not moved.
    bool hasMoved(std::uint32_t slot) const { return listed_[slot] != 0 && kindBits_[slot] != 0; }
    void markMoved(ProxyId id);
    /// Slots inserted or moved since the last `clearMoved`, ascending, each once; slots that are free again are left
    /// out.
    std::span<const std::uint32_t> sortedMoved();
    /// The same in no particular order, and with slots that are free again.
    std::span<const std::uint32_t> listedMoved() const { return moved_; }
    void clearMoved();

private:
    std::vector<std::uint8_t> kindBits_;  // one per slot, 0: free
    std::vector<std::uint8_t> listed_;    // one per slot, 1: stands in moved_, also when the slot was freed since
    std::vector<std::uint32_t> moved_;
    std::vector<std::uint32_t> free_;  // a heap with the lowest slot at the front
};

}  // namespace swept::inline SWEPT_PRECISION

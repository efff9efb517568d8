#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../shapes/listed_members.h"
#include "broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// The bit of one kind in a mask of kinds.
constexpr std::uint8_t kindBit(ProxyKind kind) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(kind)); }

/// Mask of the kinds that `kind` can meet.
constexpr std::uint8_t meetingKinds(ProxyKind kind) {
    unsigned mask = 0;
    for (int other = 0; other < kProxyKindCount; ++other) {
        if (canMeet(kind, static_cast<ProxyKind>(other))) { mask |= 1U << static_cast<unsigned>(other); }
    }
    return static_cast<std::uint8_t>(mask);
}

/// Overlaps no box with a finite bound, so itself neither; the hull of it and another box is the other box. Only a box
/// that is infinite on all four sides overlaps it: `askedAs` makes that finite.
inline constexpr Aabb kNoBox = {{std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity()},
                                {-std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()}};

/// Whether a query can find something: not where lower > upper, or where a bound is NaN.
constexpr bool isAskable(const Aabb& box) { return overlaps(box, box); }
/// The box of a query, overlapping the same proxies and never `kNoBox`: one finite bound is enough for that.
constexpr Aabb askedAs(Aabb box) {
    constexpr Real kMost = (std::numeric_limits<Real>::max)();
    box.upper.x = box.upper.x > kMost ? kMost : box.upper.x;
    return box;
}

/// The one check of boxes that come from outside.
Status refusalOf(const Aabb& box);
inline Status checkBox(const Aabb& box) { return isValid(box) ? Status::success() : refusalOf(box); }

/// What every implementation keeps about its proxies: which slots are taken, of which kind, their boxes now and when
/// pairs were found last, and which of them moved since.
/// Removing and marking never allocate; adding does so only when there were never so many slots before (or none since
/// the table was copied), and adds nothing where memory runs out.
class ProxyTable {
public:
    /// @param keepsKnown  false for those who keep the known boxes themselves.
    explicit ProxyTable(bool keepsKnown) : keepsKnown_(keepsKnown) {}

    /// Takes the lowest free slot and marks it as moved. Error: `noIdsLeft` when all 2³² − 1 slots are taken.
    Result<ProxyId> add(const Aabb& box, ProxyKind kind);
    /// Frees a slot that is taken.
    void release(ProxyId id);
    void move(ProxyId id, const Aabb& box);
    /// The same without marking it, for those who find out by themselves what moved. Different slots may be given their
    /// boxes at the same time.
    void moveUnmarked(std::uint32_t slot, const Aabb& box) { boxes_[slot] = box; }
    /// Takes back that pairs of the proxy were reported, and marks it as moved.
    void renew(ProxyId id);

    bool holds(ProxyId id) const {
        const auto slot = static_cast<std::uint32_t>(id);
        return slot < kindBits_.size() && kindBits_[slot] != 0;
    }
    /// One more than the highest slot that was ever taken.
    std::uint32_t slotCount() const { return static_cast<std::uint32_t>(kindBits_.size()); }

    /// `kindBit` of a slot below `slotCount()`; 0 when the slot is free.
    std::uint8_t bitAt(std::uint32_t slot) const { return kindBits_[slot]; }
    ProxyKind kindOf(ProxyId id) const;
    /// `kNoBox` when the slot is free.
    const Aabb& boxAt(std::uint32_t slot) const { return boxes_[slot]; }
    std::span<const Aabb> boxes() const { return boxes_; }
    /// The box when pairs were found last; `kNoBox` for what was inserted or renewed since. Two proxies whose known
    /// boxes overlap have been reported already: no set of pairs is needed to know that.
    const Aabb& knownBoxAt(std::uint32_t slot) const { return known_[slot]; }

    /// A free slot has not moved.
    bool hasMoved(std::uint32_t slot) const { return listed_[slot] != 0 && kindBits_[slot] != 0; }
    /// Slots inserted, moved or renewed since the last `finishPairs`, ascending, each once; slots that are free again
    /// are left out.
    std::span<const std::uint32_t> sortedMoved();
    /// The same in no particular order, and with slots that are free again.
    std::span<const std::uint32_t> listedMoved() const { return moved_; }
    /// From here on all boxes are known, and nothing has moved.
    void finishPairs();

    std::size_t memoryBytes() const;

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.kindBits_, self.listed_, self.boxes_, self.known_, self.moved_, self.free_,
                      leftOut(self.keepsKnown_));
    }

private:
    void makeRoomForOne();
    void markMoved(std::uint32_t slot);

    std::vector<std::uint8_t> kindBits_;  // one per slot, 0: free
    std::vector<std::uint8_t> listed_;    // one per slot, 1: stands in moved_, also when the slot was freed since
    std::vector<Aabb> boxes_;             // one per slot
    std::vector<Aabb> known_;             // one per slot, when they are kept
    std::vector<std::uint32_t> moved_;
    std::vector<std::uint32_t> free_;  // a heap with the lowest slot at the front
    bool keepsKnown_;
};

/// Room that a vector holds, in bytes.
template <class T>
std::size_t bytesOf(const std::vector<T>& items) {
    return items.capacity() * sizeof(T);
}

}  // namespace swept::inline SWEPT_PRECISION

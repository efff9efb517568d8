#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../../shapes/listed_members.h"
#include "../../shapes/room.h"

namespace swept {

/// Things with generational handles. Slots are reused last-freed first, so the numbering follows from the sequence of
/// calls alone; a slot whose generation would wrap is retired, so a stale id never comes to life again.
template <class T, class Id>
class SlotPool {
public:
    /// Asks for the memory of one more, and of the list in which `erase` writes down its slot: after it neither
    /// `insert` nor `erase` asks for any.
    void makeRoomForOne() {
        const std::size_t count = slotsWithOneMore();
        makeRoom(slots_, count);
        makeRoom(free_, count);
    }

    /// Empty when all slots are used up. Nothing has changed when memory runs out.
    std::optional<Id> insert(T value) {
        makeRoomForOne();
        if (free_.empty()) {
            if (slots_.size() >= std::numeric_limits<std::uint32_t>::max()) { return std::nullopt; }
            free_.push_back(slotCount());
            slots_.push_back({});
        }
        const std::uint32_t index = free_.back();
        free_.pop_back();
        Slot& slot = slots_[index];
        slot.value = std::move(value);
        slot.alive = true;
        ++alive_;
        return Id{index, slot.generation};
    }

    /// @pre `isValid(id)`
    void erase(Id id) {
        Slot& slot = slots_[id.index];
        slot.value = T{};
        slot.alive = false;
        --alive_;
        if (slot.generation < std::numeric_limits<std::uint32_t>::max()) {
            ++slot.generation;
            free_.push_back(id.index);
        }
    }

    bool isValid(Id id) const {
        return id.index < slots_.size() && slots_[id.index].alive && slots_[id.index].generation == id.generation;
    }
    T* find(Id id) { return isValid(id) ? &slots_[id.index].value : nullptr; }
    const T* find(Id id) const { return isValid(id) ? &slots_[id.index].value : nullptr; }

    /// By slot. @pre the slot is alive
    T& operator[](std::uint32_t index) { return slots_[index].value; }
    const T& operator[](std::uint32_t index) const { return slots_[index].value; }
    bool isAlive(std::uint32_t index) const { return slots_[index].alive; }
    /// What `idOf` asks for, from memory ahead of time.
    SWEPT_FORCE_INLINE void fetchId(std::uint32_t index) const { prefetch(&slots_[index].generation); }
    Id idOf(std::uint32_t index) const { return {index, slots_[index].generation}; }

    /// Slots ever used: the range of indices.
    std::uint32_t slotCount() const { return static_cast<std::uint32_t>(slots_.size()); }
    /// The same after one more is inserted.
    std::size_t slotsWithOneMore() const { return slots_.size() + (free_.empty() ? 1 : 0); }
    std::uint32_t size() const { return alive_; }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.slots_, self.free_, self.alive_);
    }

private:
    /// In lines of its own: what is asked of a thing first is in one line then, not in two.
    struct alignas(kCacheLine) Slot {
        T value{};
        std::uint32_t generation = 1;
        bool alive = false;
    };
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_;
    std::uint32_t alive_ = 0;
};

}  // namespace swept

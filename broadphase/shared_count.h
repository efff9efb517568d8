#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "../shapes/cache_line.h"
#include "../shapes/copied_atomic.h"

namespace swept {

/// A sum that several threads add to at the same time, each mostly on a cache line of its own: with one for all, two
/// threads that sweep shapes through a broadphase wait for that line longer than they search.
class SharedCount {
public:
    void add(std::uint64_t count) { parts_[placeOfThread()].count.fetch_add(count, std::memory_order_relaxed); }
    std::uint64_t sum() const {
        std::uint64_t all = 0;
        for (const Part& part : parts_) { all += part.count.load(std::memory_order_relaxed); }
        return all;
    }

private:
    static constexpr std::size_t kParts = 8;
    struct alignas(kCacheLine) Part {
        CopiedAtomic<std::uint64_t> count = 0;
    };

    /// Threads take the places in turn: which one has which is no matter to the sum.
    static std::size_t placeOfThread() {
        static std::atomic<std::size_t> next = 0;
        thread_local const std::size_t mine = next.fetch_add(1, std::memory_order_relaxed) % kParts;
        return mine;
    }

    std::array<Part, kParts> parts_;
};

}  // namespace swept

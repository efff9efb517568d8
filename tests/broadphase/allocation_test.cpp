#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "model.h"

namespace {
std::atomic<std::uint64_t> allocations = 0;

void* counted(std::size_t size) {
    ++allocations;
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) { return memory; }
    throw std::bad_alloc();
}
}  // namespace

// The whole test program counts its allocations.
void* operator new(std::size_t size, std::align_val_t alignment) {
    ++allocations;
    const auto unit = static_cast<std::size_t>(alignment);
    if (void* const memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) { return memory; }
    throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace swept::test {
namespace {

/// A round of everything a step does. The same program every time, so that the second round needs no more room.
void playRound(Broadphase& broadphase, const std::vector<Aabb>& boxes, std::vector<ProxyPair>& pairs) {
    const auto count = static_cast<std::uint32_t>(boxes.size());
    Random random(77);
    for (std::uint32_t i = 0; i < count; ++i) {
        (void)broadphase.insert(boxes[i], static_cast<ProxyKind>(i % kProxyKindCount));
    }
    broadphase.pairs(pairs);
    for (int step = 0; step < 10; ++step) {
        for (std::uint32_t i = 0; i < count; ++i) {
            (void)broadphase.move(static_cast<ProxyId>(i), boxes[below(random, count)]);
        }
        broadphase.pairs(pairs);
        broadphase.query(boxes[0], [](ProxyId) { return true; });
        broadphase.ray({-50, -50}, {100, 100}, 1, [](ProxyId, Real limit) { return limit; });
        broadphase.sweep(boxes[0], {10, 10}, 1, [](ProxyId, Real limit) { return limit; });
    }
    for (std::uint32_t i = 0; i < count; ++i) { (void)broadphase.remove(static_cast<ProxyId>((i * 7) % count)); }
}

TEST(Allocation, HappensOnlyUntilWarm) {
    for (const BroadphaseKind kind : kEveryKind) {
        Random random(3);
        std::vector<Aabb> boxes;
        for (int i = 0; i < 500; ++i) { boxes.push_back(randomBox(Family::scattered, random)); }
        const auto broadphase = makeBroadphase(kind);
        std::vector<ProxyPair> pairs;
        const std::uint64_t cold = allocations;
        playRound(*broadphase, boxes, pairs);
        const std::uint64_t warm = allocations;
        EXPECT_GT(warm, cold) << "the counter works";
        playRound(*broadphase, boxes, pairs);
        EXPECT_EQ(allocations, warm);
    }
}

}  // namespace
}  // namespace swept::test

#include "box2d_broadphase.h"

#include <box2d/b2_broad_phase.h>

#include <algorithm>
#include <bit>

#include "known_pairs.h"

namespace swept::bench {
namespace {

constexpr float kUnit = 0x1p30F;  // of its lengths in one of ours

b2Vec2 scaled(Vec2 v) { return {kUnit * v.x, kUnit * v.y}; }
b2Vec2 scaled(DVec2 v) { return {static_cast<float>(kUnit * v.x), static_cast<float>(kUnit * v.y)}; }

b2AABB scaled(const Aabb& box) {
    b2AABB result;
    result.lowerBound = scaled(box.lower);
    result.upperBound = scaled(box.upper);
    return result;
}

void* toUserData(std::uint32_t proxy) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(proxy)); }
std::uint32_t fromUserData(void* data) { return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(data)); }

/// Counts, for queries and rays; takes their names from the templates of the engine.
struct HitCounter {
    bool QueryCallback(int32) {
        ++hits;
        return true;
    }
    float RayCastCallback(const b2RayCastInput& input, int32) {
        ++hits;
        return input.maxFraction;
    }
    std::uint64_t hits = 0;
};

class Box2dBroadphase final : public BroadphaseContestant {
public:
    std::string name() const override { return "Box2D 2.4.1"; }

    void begin(std::span<const ProxyTraits> proxies) override {
        proxies_ = proxies;
        broadphase_ = std::make_unique<b2BroadPhase>();
        ids_.assign(proxies.size(), b2BroadPhase::e_nullProxy);
        known_ = {};
        mostProxies_ = 0;
    }

    void follow(const TraceStep& step) override {
        for (const std::uint32_t proxy : step.removed) { broadphase_->DestroyProxy(ids_[proxy]); }
        for (const ProxyBox& box : step.inserted) {
            ids_[box.proxy] = broadphase_->CreateProxy(scaled(box.box), toUserData(box.proxy));
        }
        mostProxies_ = std::max(mostProxies_, static_cast<std::size_t>(broadphase_->GetProxyCount()));
        for (const ProxyBox& box : step.moved) { broadphase_->MoveProxy(ids_[box.proxy], scaled(box.box), {0, 0}); }
    }

    void findPairs(std::vector<TracePair>& found) override {
        found.clear();
        found_ = &found;
        broadphase_->UpdatePairs(this);
    }

    /// Called by `UpdatePairs`.
    void AddPair(void* dataA, void* dataB) {
        const std::uint32_t a = fromUserData(dataA);
        const std::uint32_t b = fromUserData(dataB);
        if (mayPair(proxies_[a], proxies_[b]) && known_.insert(a, b)) { found_->push_back(orderedPair(a, b)); }
    }

    void forget(std::span<const TracePair> ended) override {
        for (const TracePair& pair : ended) { known_.erase(pair.a, pair.b); }
    }

    std::uint64_t countBoxHits(std::span<const Aabb> queries) const override {
        HitCounter counter;
        for (const Aabb& box : queries) { broadphase_->Query(&counter, scaled(box)); }
        return counter.hits;
    }

    std::uint64_t countRayHits(std::span<const RayQuery> queries) const override {
        HitCounter counter;
        for (const RayQuery& ray : queries) {
            b2RayCastInput input;
            input.p1 = scaled(ray.origin);
            input.p2 = scaled(ray.origin + ray.translation);
            input.maxFraction = 1;
            broadphase_->RayCast(&counter, input);
        }
        return counter.hits;
    }

    /// Nodes, for which it doubles its array, and a move buffer as long as there are proxies. Its pair buffer is not
    /// told; the set of known pairs is ours.
    std::size_t memoryBytes() const override {
        return std::bit_ceil(2 * mostProxies_) * sizeof(b2TreeNode) + std::bit_ceil(mostProxies_) * sizeof(int32);
    }

private:
    std::span<const ProxyTraits> proxies_;
    std::unique_ptr<b2BroadPhase> broadphase_;
    std::vector<int32> ids_;  // one per proxy of the trace
    KnownPairs known_;
    std::vector<TracePair>* found_ = nullptr;  // of the call under way
    std::size_t mostProxies_ = 0;
};

}  // namespace

std::unique_ptr<BroadphaseContestant> makeBox2dBroadphase() { return std::make_unique<Box2dBroadphase>(); }

}  // namespace swept::bench

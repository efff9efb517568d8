#include <algorithm>

#include "box2d_broadphase.h"
#include "broadphase_contestant.h"
#if defined(SWEPT_BENCH_BOX2D3)
#include "box2d3/box2d3_broadphase.h"
#endif

namespace swept::bench {
namespace {

constexpr BroadphaseKind kKinds[] = {
    BroadphaseKind::automatic, BroadphaseKind::allPairs, BroadphaseKind::sortAndSweep, BroadphaseKind::quadtree,
    BroadphaseKind::grid,      BroadphaseKind::bvh,      BroadphaseKind::wideBvh,
};
static_assert(std::size(kKinds) == kBroadphaseKindCount);

class OurBroadphase final : public BroadphaseContestant {
public:
    explicit OurBroadphase(BroadphaseKind kind) : kind_(kind) {}

    std::string name() const override { return nameOf(kind_); }

    void begin(std::span<const ProxyTraits> proxies) override {
        proxies_ = proxies;
        broadphase_ = makeBroadphase(kind_);
        ids_.assign(proxies.size(), ProxyId{});
        owners_.clear();
        owners_.reserve(proxies.size());
    }

    void follow(const TraceStep& step) override {
        for (const std::uint32_t proxy : step.removed) { (void)broadphase_->remove(ids_[proxy]); }
        for (const ProxyBox& box : step.inserted) { insert(box); }
        for (const ProxyBox& box : step.moved) { (void)broadphase_->move(ids_[box.proxy], box.box); }
    }

    void findPairs(std::vector<TracePair>& found) override {
        broadphase_->pairs(pairs_);
        found.clear();
        for (const ProxyPair& pair : pairs_) {
            const std::uint32_t a = owners_[static_cast<std::uint32_t>(pair.a)];
            const std::uint32_t b = owners_[static_cast<std::uint32_t>(pair.b)];
            if (mayPair(proxies_[a], proxies_[b])) { found.push_back(orderedPair(a, b)); }
        }
    }

    void forget(std::span<const TracePair>) override {}

    std::uint64_t countBoxHits(std::span<const Aabb> queries) const override {
        std::uint64_t hits = 0;
        const auto visit = [&hits](ProxyId) {
            ++hits;
            return true;
        };
        for (const Aabb& box : queries) { broadphase_->query(box, visit); }
        return hits;
    }

    std::uint64_t countRayHits(std::span<const RayQuery> queries) const override {
        std::uint64_t hits = 0;
        const auto visit = [&hits](ProxyId, Real limit) {
            ++hits;
            return limit;
        };
        for (const RayQuery& ray : queries) { broadphase_->ray(ray.origin, ray.translation, 1, visit); }
        return hits;
    }

    std::size_t memoryBytes() const override { return broadphase_->memoryBytes(); }
    std::uint64_t boxTests() const override { return broadphase_->counters().boxTests; }

private:
    void insert(const ProxyBox& box) {
        const Result<ProxyId> id = broadphase_->insert(box.box, proxies_[box.proxy].kind);
        ids_[box.proxy] = id.value();
        const auto slot = static_cast<std::uint32_t>(id.value());
        if (slot >= owners_.size()) { owners_.resize(slot + 1); }
        owners_[slot] = box.proxy;
    }

    BroadphaseKind kind_;
    std::span<const ProxyTraits> proxies_;
    std::unique_ptr<Broadphase> broadphase_;
    std::vector<ProxyId> ids_;           // one per proxy of the trace
    std::vector<std::uint32_t> owners_;  // one per slot: the proxy of the trace
    std::vector<ProxyPair> pairs_;
};

BroadphaseContestants everybody() {
    BroadphaseContestants all;
    for (const BroadphaseKind kind : kKinds) { all.push_back(makeOurBroadphase(kind)); }
    all.push_back(makeBox2dBroadphase());
#if defined(SWEPT_BENCH_BOX2D3)
    all.push_back(makeBox2d3Broadphase());
#endif
    return all;
}

}  // namespace

const char* nameOf(BroadphaseKind kind) {
    switch (kind) {
        case BroadphaseKind::automatic:
            return "automatic";
        case BroadphaseKind::allPairs:
            return "allPairs";
        case BroadphaseKind::sortAndSweep:
            return "sortAndSweep";
        case BroadphaseKind::quadtree:
            return "quadtree";
        case BroadphaseKind::grid:
            return "grid";
        case BroadphaseKind::bvh:
            return "bvh";
        case BroadphaseKind::wideBvh:
            return "wideBvh";
    }
    return "";  // unreachable, but GCC cannot know
}

std::unique_ptr<BroadphaseContestant> makeOurBroadphase(BroadphaseKind kind) {
    return std::make_unique<OurBroadphase>(kind);
}

BroadphaseContestants allBroadphases(std::span<const std::string> names) {
    BroadphaseContestants all = everybody();
    if (!names.empty()) {
        std::erase_if(
            all, [&](const auto& one) { return std::find(names.begin(), names.end(), one->name()) == names.end(); });
    }
    return all;
}

std::vector<std::string> broadphaseNames() {
    std::vector<std::string> names;
    for (const auto& contestant : everybody()) { names.push_back(contestant->name()); }
    return names;
}

}  // namespace swept::bench

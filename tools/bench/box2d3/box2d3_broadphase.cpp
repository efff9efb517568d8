#include "box2d3_broadphase.h"

#include <box2d/collision.h>
#include <box2d/types.h>

#include <array>

#include "../known_pairs.h"

namespace swept::bench {
namespace {

constexpr std::size_t kTrees = 3;
constexpr std::size_t kStaticTree = 0;
constexpr std::size_t kKinematicTree = 1;
constexpr std::size_t kDynamicTree = 2;

/// Sensors have no tree of their own there; no trace of ours has any.
std::size_t treeOf(ProxyKind kind) {
    switch (kind) {
        case ProxyKind::fixed:
            return kStaticTree;
        case ProxyKind::kinematic:
            return kKinematicTree;
        case ProxyKind::dynamic:
        case ProxyKind::sensor:
            return kDynamicTree;
    }
    return kDynamicTree;  // unreachable, but GCC cannot know
}

b2AABB toBox2d(const Aabb& box) { return {{box.lower.x, box.lower.y}, {box.upper.x, box.upper.y}}; }

bool countBox(int, std::uint64_t, void* context) {
    ++*static_cast<std::uint64_t*>(context);
    return true;
}

float countRay(const b2RayCastInput* input, int, std::uint64_t, void* context) {
    ++*static_cast<std::uint64_t*>(context);
    return input->maxFraction;
}

class Box2d3Broadphase final : public BroadphaseContestant {
public:
    ~Box2d3Broadphase() override { destroyTrees(); }

    std::string name() const override { return "Box2D 3"; }

    void begin(std::span<const ProxyTraits> proxies) override {
        destroyTrees();
        for (b2DynamicTree& tree : trees_) { tree = b2DynamicTree_Create(16); }
        alive_ = true;
        proxies_ = proxies;
        leaves_.assign(proxies.size(), -1);
        hasMoved_.assign(proxies.size(), 0);
        moved_.clear();
        known_ = {};
    }

    void follow(const TraceStep& step) override {
        for (const std::uint32_t proxy : step.removed) {
            hasMoved_[proxy] = 0;
            b2DynamicTree_DestroyProxy(&tree(proxy), leaves_[proxy]);
        }
        for (const ProxyBox& box : step.inserted) {
            leaves_[box.proxy] = b2DynamicTree_CreateProxy(&tree(box.proxy), toBox2d(box.box),
                                                           proxies_[box.proxy].filter.category, box.proxy);
            if (proxies_[box.proxy].kind != ProxyKind::fixed) { noteMove(box.proxy); }
        }
        for (const ProxyBox& box : step.moved) {
            b2DynamicTree_EnlargeProxy(&tree(box.proxy), leaves_[box.proxy], toBox2d(box.box));
            noteMove(box.proxy);
        }
    }

    void findPairs(std::vector<TracePair>& found) override {
        found.clear();
        found_ = &found;
        for (const std::uint32_t proxy : moved_) {
            if (hasMoved_[proxy] != 0) { queryTrees(proxy); }
        }
        b2DynamicTree_Rebuild(&trees_[kDynamicTree], false);
        b2DynamicTree_Rebuild(&trees_[kKinematicTree], false);
        for (const TracePair& pair : found) { known_.insert(pair.a, pair.b); }
        for (const std::uint32_t proxy : moved_) { hasMoved_[proxy] = 0; }
        moved_.clear();
    }

    void forget(std::span<const TracePair> ended) override {
        for (const TracePair& pair : ended) { known_.erase(pair.a, pair.b); }
    }

    std::uint64_t countBoxHits(std::span<const Aabb> queries) const override {
        std::uint64_t hits = 0;
        for (const Aabb& box : queries) {
            for (const b2DynamicTree& tree : trees_) {
                b2DynamicTree_Query(&tree, toBox2d(box), B2_DEFAULT_MASK_BITS, countBox, &hits);
            }
        }
        return hits;
    }

    std::uint64_t countRayHits(std::span<const RayQuery> queries) const override {
        std::uint64_t hits = 0;
        for (const RayQuery& ray : queries) {
            b2RayCastInput input{};
            input.origin = {static_cast<float>(ray.origin.x), static_cast<float>(ray.origin.y)};
            input.translation = {static_cast<float>(ray.translation.x), static_cast<float>(ray.translation.y)};
            input.maxFraction = 1;
            for (const b2DynamicTree& tree : trees_) {
                b2DynamicTree_RayCast(&tree, &input, B2_DEFAULT_MASK_BITS, countRay, &hits);
            }
        }
        return hits;
    }

    std::size_t memoryBytes() const override {
        std::size_t bytes = known_.memoryBytes() + moved_.capacity() * sizeof(std::uint32_t) + hasMoved_.size() / 8;
        for (const b2DynamicTree& tree : trees_) {
            bytes += static_cast<std::size_t>(b2DynamicTree_GetByteCount(&tree));
        }
        return bytes;
    }

private:
    struct Query {
        Box2d3Broadphase* self;
        std::uint32_t proxy;
        std::size_t tree;
    };

    b2DynamicTree& tree(std::uint32_t proxy) { return trees_[treeOf(proxies_[proxy].kind)]; }

    void noteMove(std::uint32_t proxy) {
        if (hasMoved_[proxy] == 0) {
            hasMoved_[proxy] = 1;
            moved_.push_back(proxy);
        }
    }

    void destroyTrees() {
        if (!alive_) { return; }
        for (b2DynamicTree& tree : trees_) { b2DynamicTree_Destroy(&tree); }
        alive_ = false;
    }

    void queryTrees(std::uint32_t proxy) {
        const b2AABB box = b2DynamicTree_GetAABB(&tree(proxy), leaves_[proxy]);
        Query query{this, proxy, kDynamicTree};
        if (proxies_[proxy].kind == ProxyKind::dynamic) {
            for (const std::size_t other : {kKinematicTree, kStaticTree}) {
                query.tree = other;
                b2DynamicTree_Query(&trees_[other], box, B2_DEFAULT_MASK_BITS, meet, &query);
            }
        }
        query.tree = kDynamicTree;
        b2DynamicTree_Query(&trees_[kDynamicTree], box, B2_DEFAULT_MASK_BITS, meet, &query);
    }

    static bool meet(int, std::uint64_t userData, void* context) {
        const Query& query = *static_cast<Query*>(context);
        query.self->meet(query, static_cast<std::uint32_t>(userData));
        return true;
    }

    void meet(const Query& query, std::uint32_t other) {
        const std::uint32_t proxy = query.proxy;
        if (other == proxy) { return; }
        // Of two that moved, the one with the smaller number asks; a kinematic one leaves it to the dynamic one.
        const bool bothDynamic = query.tree == kDynamicTree && proxies_[proxy].kind == ProxyKind::dynamic;
        if (query.tree == kDynamicTree && hasMoved_[other] != 0 && (!bothDynamic || other < proxy)) { return; }
        if (known_.contains(proxy, other) || !mayPair(proxies_[proxy], proxies_[other])) { return; }
        found_->push_back(orderedPair(proxy, other));
    }

    std::array<b2DynamicTree, kTrees> trees_{};
    bool alive_ = false;
    std::span<const ProxyTraits> proxies_;
    std::vector<int> leaves_;             // one per proxy of the trace
    std::vector<std::uint8_t> hasMoved_;  // one per proxy of the trace
    std::vector<std::uint32_t> moved_;
    KnownPairs known_;
    std::vector<TracePair>* found_ = nullptr;  // of the call under way
};

}  // namespace

std::unique_ptr<BroadphaseContestant> makeBox2d3Broadphase() { return std::make_unique<Box2d3Broadphase>(); }

}  // namespace swept::bench

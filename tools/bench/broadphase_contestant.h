#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "broadphase_trace.h"

namespace swept::bench {

struct RayQuery {
    DVec2 origin;
    DVec2 translation;
};

/// Somebody who finds pairs among boxes: one of our implementations, or another engine's. All of them are given the
/// same boxes in the same order, and must name the same new pairs after the same filters.
class BroadphaseContestant {
public:
    virtual ~BroadphaseContestant() = default;

    virtual std::string name() const = 0;

    /// Forgets everything and takes the traits of all proxies that will ever appear; the span outlives what follows.
    virtual void begin(std::span<const ProxyTraits> proxies) = 0;
    /// Removes, inserts, moves. Timed.
    virtual void follow(const TraceStep& step) = 0;
    /// New pairs, filtered, each once, in any order. Timed.
    virtual void findPairs(std::vector<TracePair>& found) = 0;
    /// Pairs whose boxes overlap no more. Not timed: engines do it where they look at their contacts anyway.
    virtual void forget(std::span<const TracePair> ended) = 0;

    /// Number of boxes met, all in all.
    virtual std::uint64_t countBoxHits(std::span<const Aabb> queries) const = 0;
    virtual std::uint64_t countRayHits(std::span<const RayQuery> queries) const = 0;

    virtual std::size_t memoryBytes() const = 0;
    /// Boxes compared in pair finding so far; 0 when it is not told.
    virtual std::uint64_t boxTests() const { return 0; }
};

using BroadphaseContestants = std::vector<std::unique_ptr<BroadphaseContestant>>;

std::unique_ptr<BroadphaseContestant> makeOurBroadphase(BroadphaseKind kind);
const char* nameOf(BroadphaseKind kind);

/// All of ours, then the other engines of this build.
/// @param names  only these, when there are any
BroadphaseContestants allBroadphases(std::span<const std::string> names = {});
std::vector<std::string> broadphaseNames();

}  // namespace swept::bench

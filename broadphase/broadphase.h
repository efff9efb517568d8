#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "../shapes/aabb.h"
#include "../shapes/dvec2.h"
#include "../shapes/function_ref.h"
#include "../shapes/status.h"
#include "../shapes/task_system.h"
#include "broadphase_kind.h"

namespace swept::inline SWEPT_PRECISION {

/// Slot of a proxy, dense and reused: given by `insert`, free again after `remove`. The lowest free slot is taken
/// first, so that the numbering does not depend on anything but the sequence of calls.
enum class ProxyId : std::uint32_t {};

/// The type lists: which kinds can meet at all. Static never meets static or kinematic, and kinematic not kinematic;
/// sensors meet everything but each other.
enum class ProxyKind : std::uint8_t { fixed, kinematic, dynamic, sensor };
inline constexpr int kProxyKindCount = 4;

constexpr bool canMeet(ProxyKind a, ProxyKind b) {
    if (a == ProxyKind::sensor || b == ProxyKind::sensor) { return a != b; }
    return a == ProxyKind::dynamic || b == ProxyKind::dynamic;
}

/// Two proxies whose boxes overlap, lower slot first.
struct ProxyPair {
    ProxyId a;
    ProxyId b;
    constexpr auto operator<=>(const ProxyPair&) const = default;
};

/// Counts since construction; never reset, so a caller takes differences.
struct BroadphaseCounters {
    std::uint64_t boxTests = 0;  ///< box against box, in pair finding and in queries
    std::uint64_t pairsReported = 0;
    std::uint64_t reinserted = 0;  ///< proxies moved
    std::uint64_t rebuilt = 0;     ///< times that the whole structure was built anew
};

/// Who might touch? Holds one box per proxy. The caller grows the boxes; touching boxes overlap.
/// Every implementation reports the same pairs in the same order, whatever happened between two calls of `pairs`: only
/// its cost differs.
/// Not thread-safe, except that queries, `ray` and `sweep` may run at the same time as each other.
class Broadphase {
public:
    virtual ~Broadphase() = default;
    /// Another one with the same proxies, which reports what this one would.
    virtual std::unique_ptr<Broadphase> clone() const = 0;

    /// @return `notFinite` or `outOfRange` (lower > upper) for a bad box.
    virtual Result<ProxyId> insert(const Aabb& box, ProxyKind kind) = 0;
    /// Replaces the box and marks the proxy as moved. Errors: `staleId`, and as `insert`.
    virtual Status move(ProxyId id, const Aabb& box) = 0;
    virtual Status remove(ProxyId id) = 0;

    /// Many moves at once: between these two, `moveInParallel` may be called for different proxies at the same time,
    /// each once, and nothing else but `box`, of a proxy that was not moved yet or by the thread that moved it. Errors
    /// as `move`.
    virtual void beginMoves() = 0;
    virtual Status moveInParallel(ProxyId id, const Aabb& box) = 0;
    /// From here on the proxies are where they were moved to. The default method shares what is left to be done.
    /// @return how many were moved
    virtual std::size_t endMoves(TaskSystem& loops) = 0;

    /// The box as it was given last. `id` must name a proxy that exists: a stale id is undefined (asserted).
    /// Valid until the next call that changes something.
    virtual const Aabb& box(ProxyId id) const = 0;
    /// The same of all proxies, by their number, for loops over many; between them lie boxes of proxies that are gone.
    /// As long valid.
    virtual std::span<const Aabb> boxes() const = 0;

    /// Writes every new pair: boxes of kinds that can meet, which overlap now and did not at the last call, or of which
    /// one was inserted or renewed since. Each pair once, in ascending order. `out` is cleared first and keeps its
    /// capacity. The same pairs and counts for every task system; the default method shares its search.
    virtual void pairs(std::vector<ProxyPair>& out, TaskSystem& loops) = 0;
    /// On the calling thread.
    void pairs(std::vector<ProxyPair>& out) {
        SerialTaskSystem serial;
        pairs(out, serial);
    }
    /// The next call of `pairs` reports all pairs of this proxy, as if it had just been inserted. Error: `staleId`.
    virtual Status renewPairs(ProxyId id) = 0;

    /// Calls `visit` for each proxy whose box overlaps; a visitor that returns false ends the query. Order is
    /// unspecified. Bounds may be infinite, here and in the two below; where lower > upper, or a bound is NaN,
    /// nothing is found.
    virtual void query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const = 0;

    /// As `query`, for static and kinematic proxies. An implementation that does not keep kinds apart visits others
    /// too.
    virtual void queryGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const { query(box, visit); }

    /// As `query` of each of these boxes, which lie near each other, for dynamic proxies; the visitor is told the index
    /// of the box. An implementation that does not keep kinds apart visits others too.
    virtual void queryDynamic(std::span<const Aabb> boxes, FunctionRef<void(std::size_t, ProxyId)> visit) const = 0;

    /// Calls `visit(id, limit)` for each proxy whose box meets origin + t·direction with t ≤ limit. The visitor returns
    /// the new limit: the given one to go on, a smaller one to shorten the ray, 0 to stop (less, where the given one is
    /// 0: up to there all that is met at the start is). All numbers are finite, and so are those of `sweep`.
    virtual void ray(DVec2 origin, DVec2 direction, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const = 0;

    /// The same for a box that is carried along `translation`.
    virtual void sweep(const Aabb& box, DVec2 translation, Real maxFraction,
                       FunctionRef<Real(ProxyId, Real)> visit) const = 0;

    virtual BroadphaseCounters counters() const = 0;
    /// Memory held for proxies, in bytes, reserves and scratch space included.
    virtual std::size_t memoryBytes() const = 0;
};

std::unique_ptr<Broadphase> makeBroadphase(BroadphaseKind kind);

/// Owns a broadphase, and is copied with it.
class OwnedBroadphase {
public:
    OwnedBroadphase(std::unique_ptr<Broadphase> broadphase) : broadphase_(std::move(broadphase)) {}
    OwnedBroadphase(const OwnedBroadphase& other) : broadphase_(other.broadphase_->clone()) {}
    OwnedBroadphase& operator=(const OwnedBroadphase& other) {
        if (this != &other) { broadphase_ = other.broadphase_->clone(); }
        return *this;
    }
    OwnedBroadphase(OwnedBroadphase&&) noexcept = default;
    OwnedBroadphase& operator=(OwnedBroadphase&&) noexcept = default;
    ~OwnedBroadphase() = default;

    Broadphase& operator*() const { return *broadphase_; }
    Broadphase* operator->() const { return broadphase_.get(); }

private:
    std::unique_ptr<Broadphase> broadphase_;
};

}  // namespace swept::inline SWEPT_PRECISION

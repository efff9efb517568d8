#pragma once

#include <algorithm>

#include "../shapes/listed_members.h"
#include "box_sweep.h"
#include "pair_order.h"
#include "proxy_table.h"
#include "shared_count.h"

namespace swept::inline SWEPT_PRECISION {

/// Where an implementation puts the overlapping pairs that it finds; only new ones get through.
class PairSink {
public:
    PairSink(const ProxyTable& table, std::vector<ProxyPair>& out) : table_(table), out_(out) {}

    /// Two overlapping boxes of kinds that can meet, of which one has moved; each pair may be given once only.
    void add(std::uint32_t a, std::uint32_t b) {
        if (overlaps(table_.knownBoxAt(a), table_.knownBoxAt(b))) { return; }
        out_.push_back({static_cast<ProxyId>((std::min)(a, b)), static_cast<ProxyId>((std::max)(a, b))});
    }
    /// For those who know what is new by themselves; lower slot first.
    std::vector<ProxyPair>& newPairs() { return out_; }

private:
    const ProxyTable& table_;
    std::vector<ProxyPair>& out_;
};

/// What a ray or sweep brings along through a structure: the limit that visitors shorten, and the count of box tests.
class SweepVisit {
public:
    SweepVisit(const BoxSweep& sweep, Real limit, FunctionRef<Real(ProxyId, Real)> visit)
        : sweep_(sweep), limit_(limit), visit_(visit) {}

    /// Fraction at which the sweep touches a box; `BoxSweep::kNever` when not by the limit.
    double touch(const Aabb& box) {
        ++tests_;
        return sweep_.firstTouch(box, static_cast<double>(limit_));
    }
    bool meets(const Aabb& box) { return touch(box) != BoxSweep::kNever; }
    /// Shows a proxy that is met to the visitor.
    void show(std::uint32_t slot) {
        const Real limit = visit_(static_cast<ProxyId>(slot), limit_);
        if (!(limit < limit_)) { return; }
        limit_ = limit;
        isOver_ = !(limit > 0);
    }
    const BoxSweep& sweep() const { return sweep_; }
    /// Whether a visitor stopped it. A limit that was 0 from the start leaves what is met there to be shown.
    bool isOver() const { return isOver_; }
    double limit() const { return static_cast<double>(limit_); }
    std::uint64_t tests() const { return tests_; }

private:
    const BoxSweep& sweep_;
    Real limit_;
    bool isOver_ = false;
    FunctionRef<Real(ProxyId, Real)> visit_;
    std::uint64_t tests_ = 0;
};

/// The part that all implementations share: checks, slots, boxes, marks, order of the pairs, counters. What is left to
/// each is its structure and the walks through it.
class TableBroadphase : public Broadphase {
public:
    /// @param keepsKnown  whether the table keeps the boxes of the last call of `pairs`; without them, `join` has to
    /// tell what is new by itself.
    explicit TableBroadphase(bool keepsKnown = true) : table_(keepsKnown) {}

    Result<ProxyId> insert(const Aabb& box, ProxyKind kind) final;
    Status move(ProxyId id, const Aabb& box) final;
    Status remove(ProxyId id) final;
    void beginMoves() final;
    Status moveInParallel(ProxyId id, const Aabb& box) final;
    std::size_t endMoves(TaskSystem& loops) final;
    Status renewPairs(ProxyId id) final;
    const Aabb& box(ProxyId id) const final;
    std::span<const Aabb> boxes() const final { return table_.boxes(); }
    using Broadphase::pairs;
    void pairs(std::vector<ProxyPair>& out, TaskSystem& loops) final;
    void query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const final;
    void queryGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const final;
    void queryDynamic(std::span<const Aabb> boxes, FunctionRef<void(std::size_t, ProxyId)> visit) const final;
    void ray(DVec2 origin, DVec2 direction, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const final;
    void sweep(const Aabb& box, DVec2 translation, Real maxFraction,
               FunctionRef<Real(ProxyId, Real)> visit) const final;
    BroadphaseCounters counters() const final;
    std::size_t memoryBytes() const final;

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.table_, leftOut(self.order_), leftOut(self.pendingBox_), leftOut(self.isPending_),
                      self.anyInParallel_, leftOut(self.counters_), leftOut(self.queryTests_));
    }

protected:
    ProxyTable& table() { return table_; }
    const ProxyTable& table() const { return table_; }
    void countRebuild() { ++counters_.rebuilt; }

private:
    // The table holds the change already.
    virtual void onInsert(std::uint32_t slot) = 0;
    virtual void onMove(std::uint32_t slot) = 0;
    virtual void onRenew(std::uint32_t) {}
    /// Room for `onMoveInParallel`, which may be called for different slots at the same time. By default moves wait
    /// until all are known.
    virtual void onBeginMoves();
    virtual void onMoveInParallel(std::uint32_t slot, const Aabb& box);
    /// @return how many were moved
    virtual std::size_t onEndMoves(TaskSystem& loops);
    /// The slot is still taken.
    virtual void onRemove(std::uint32_t slot) = 0;
    /// The known boxes of what has moved are about to become those of now.
    virtual void onPairsDone(TaskSystem&) {}
    /// Gives every overlapping pair of which one has moved to the sink. Returns the number of box tests.
    virtual std::uint64_t join(PairSink& sink, TaskSystem& loops) = 0;
    /// Returns the number of box tests.
    virtual std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const = 0;
    /// Likewise, of static and kinematic proxies at least.
    virtual std::uint64_t visitGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
        return visitOverlaps(box, visit);
    }
    virtual std::uint64_t visitDynamic(std::span<const Aabb> boxes,
                                       FunctionRef<void(std::size_t, ProxyId)> visit) const;
    /// Shows everything that is met until the visit is over.
    virtual void visitAlong(SweepVisit& visit) const = 0;
    virtual std::size_t structureBytes() const = 0;

    void castAlong(const BoxSweep& sweep, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const;

    ProxyTable table_;
    PairOrder order_;
    std::vector<Aabb> pendingBox_;         // by slot, of those that were moved in parallel
    std::vector<std::uint8_t> isPending_;  // by slot, 1: it was
    bool anyInParallel_ = false;           // some were since the last call of `pairs`
    BroadphaseCounters counters_;
    mutable SharedCount queryTests_;  // queries may run at the same time as each other
};

}  // namespace swept::inline SWEPT_PRECISION

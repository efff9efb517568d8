#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "../../shapes/manifold_batch.h"
#include "contact_manifold.h"
#include "shape_manifold.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts whose manifolds are found together, of one kind (`BatchKind`): the bits that each would have by itself.
class ContactBatch {
public:
    explicit ContactBatch(PairKind kind) : pairs_(kind) {}

    bool isFull() const { return pairs_.isFull(); }
    std::size_t size() const { return pairs_.size(); }

    /// @param probe, contact  stay where they are until they are renewed; a contact need not have a probe
    /// @pre not full; the contact is of the kind
    void add(const WorldState& world, ContactProbe* probe, Contact& contact, const Transform& bInA,
             ManifoldReach reach) {
        entries_[pairs_.size()] = {probe, &contact};
        const Shape& a = world.shapes[contact.shapeA];
        const Shape& b = world.shapes[contact.shapeB];
        const ManifoldBatch::Sizes sizes{contact.radiusA, contact.radiusB, contact.verticesA, contact.verticesB};
        if (isOfChains()) {
            pairs_.add(a.segment, a.closedEnds, a.polygon, b.polygon, sizes, bInA, reach);
        } else {
            pairs_.add(a.polygon, b.polygon, sizes, bInA, reach);
        }
    }

    /// What is in another one, which is empty then. @pre both are of kinds that a kernel may find together; there is
    /// room
    void takeOver(ContactBatch& other) {
        std::copy_n(other.entries_.begin(), other.size(), entries_.begin() + static_cast<std::ptrdiff_t>(size()));
        pairs_.takeOver(other.pairs_);
    }

    /// Gives all of them their manifolds, and is empty.
    /// @param done  called with probe, contact, and pose of B in the frame of A
    template <class Done>
    void renew(const WorldState& world, const Done& done) {
        if (pairs_.size() == 0) { return; }
        if (pairs_.size() == 1) { return renewAlone(world, done); }
        pairs_.collide();
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const Entry& entry = entries_[i];
            Contact& contact = *entry.contact;
            const Transform bInA = pairs_.poseOf(i);
            // Written where it belongs: a copy of what was just written has to wait for it.
            if (pairs_.isPlain(i) && keepsNormal(contact, i)) {
                if (pairs_.hasPoints(i, contact.manifold)) {  // as mostly: impulses stay where they are
                    pairs_.copyPoints(i, contact.manifold);
                } else {
                    const OldPoints before = oldPointsOf(contact);
                    pairs_.copyPoints(i, contact.manifold);
                    carryImpulses(before, contact);
                }
                contact.memory.verdict = ManifoldMemory::Verdict::none;
                keepManifold(contact, bInA);
            } else if (pairs_.isApart(i) && contact.manifold.count == 0) {
                pairs_.rememberApart(i, contact.memory);
                contact.manifold = {};
                keepManifold(contact, bInA);
            } else {
                renewOther(world, i, contact, bInA);
            }
            done(entry.probe, contact, bInA);
        }
        pairs_.clear();
    }

private:
    /// The kernel takes as long for one pair as for as many as registers hold, which is longer than without it.
    template <class Done>
    void renewAlone(const WorldState& world, const Done& done) {
        const auto [probe, contact] = entries_[0];
        const Transform bInA = pairs_.poseOf(0);
        renewManifold(world, *contact, bInA, pairs_.reachOf(0));
        done(probe, *contact, bInA);
        pairs_.clear();
    }

    /// Not set before it is added: a step makes batches of all kinds, and fills few.
    struct Entry {
        ContactProbe* probe;
        Contact* contact;
    };

    bool isOfChains() const { return pairs_.kind() == PairKind::chain; }
    /// Of a plain pair: whether its manifold is as it was found, as that of most of what stands on ground is, too.
    bool keepsNormal(const Contact& contact, std::size_t pair) const {
        return contact.dynamicA || isOfChains() || !mayTurnToGround(pairs_.polygonA(pair), pairs_.normalOf(pair));
    }
    /// What came apart, is beyond what batches are for, or stands on ground.
    void renewOther(const WorldState& world, std::size_t pair, Contact& contact, const Transform& bInA) const {
        Manifold closest;
        pairs_.takeManifold(pair, contact.memory, closest);
        if (!contact.dynamicA && !isOfChains()) {
            closest = turnedToGround(world, world.shapes[contact.shapeA], world.shapes[contact.shapeB], bInA,
                                     pairs_.reachOf(pair).points, closest);
        }
        takeManifold(contact, bInA, closest);
    }

    ManifoldBatch pairs_;
    std::array<Entry, ManifoldBatch::kPairs> entries_;
};

/// Which kernel finds the manifolds of a batch.
constexpr PairKind pairKindOf(BatchKind kind) {
    if (kind <= BatchKind::many) { return PairKind::sharp; }
    return kind < BatchKind::chainTwo ? PairKind::round : PairKind::chain;
}

/// By `BatchKind`, but for `none`.
template <std::size_t... Index>
std::array<ContactBatch, sizeof...(Index)> makeBatches(std::index_sequence<Index...> /*unused*/) {
    return {ContactBatch(pairKindOf(static_cast<BatchKind>(Index + 1)))...};
}

/// Contacts of all kinds that are given manifolds anew: in batches where they may be, else at once.
/// @tparam Done  called after that, once for each contact, with its probe, the contact, and the pose of B in the frame
///               of A
template <class Done>
class ContactBatches {
public:
    ContactBatches(const WorldState& world, Done done) : world_(world), done_(done) {}

    /// @param probe, contact  stay where they are until `finish`
    void add(ContactProbe* probe, Contact& contact, const Transform& bInA, ManifoldReach reach) {
        if (!haveBatches_ || contact.batch == BatchKind::none) {
            renewManifold(world_, contact, bInA, reach);
            return done_(probe, contact, bInA);
        }
        if (contact.memory.isApart(bInA, std::min(reach.points, reach.nearest))) {
            takeManifold(contact, bInA, {});
            return done_(probe, contact, bInA);
        }
        ContactBatch& batch = batchOf(contact.batch);
        batch.add(world_, probe, contact, bInA, reach);
        if (batch.isFull()) { batch.renew(world_, done_); }
    }
    /// What is left in batches.
    void finish() {
        unite(BatchKind::circles, BatchKind::roundFew);
        unite(BatchKind::chainTwo, BatchKind::chainFew);
        for (ContactBatch& batch : batches_) { batch.renew(world_, done_); }
    }

private:
    ContactBatch& batchOf(BatchKind kind) { return batches_[static_cast<std::size_t>(kind) - 1]; }
    /// What is left in batches of these kinds, in as few as may be: small worlds fill none, and would run each kernel
    /// once for two or three contacts, which costs more to fetch than to run.
    void unite(BatchKind first, BatchKind last) {
        ContactBatch* into = &batchOf(first);
        for (ContactBatch* next = into + 1; next <= &batchOf(last); ++next) {
            if (next->size() == 0) { continue; }
            if (into->size() + next->size() <= ManifoldBatch::kPairs) {
                into->takeOver(*next);
            } else {
                into = next;
            }
        }
    }

    const WorldState& world_;
    Done done_;
    bool haveBatches_ = canCollideInBatches();
    std::array<ContactBatch, kBatchKinds> batches_ = makeBatches(std::make_index_sequence<kBatchKinds>());
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <array>

#include "../shapes/manifold_batch.h"
#include "contact_manifold.h"
#include "shape_manifold.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts whose manifolds are found together, of one kind (`BatchKind`): the bits that each would have by itself.
class ContactBatch {
public:
    explicit ContactBatch(PairKind kind) : pairs_(kind) {}

    bool isFull() const { return pairs_.isFull(); }

    /// @param probe, contact  stay where they are until they are renewed
    /// @pre not full; the contact is of the kind
    void add(const WorldState& world, ContactProbe& probe, Contact& contact, const Transform& bInA,
             ManifoldReach reach) {
        // One by one: together they would be read from where some of them were just written, and wait for that.
        Entry& entry = entries_[pairs_.size()];
        entry.probe = &probe;
        entry.contact = &contact;
        entry.bInA.translation.x = bInA.translation.x;
        entry.bInA.translation.y = bInA.translation.y;
        entry.bInA.rotation.c = bInA.rotation.c;
        entry.bInA.rotation.s = bInA.rotation.s;
        entry.margin = reach.points;
        pairs_.add(world.shapes[contact.shapeA].polygon, world.shapes[contact.shapeB].polygon,
                   {contact.radiusA, contact.radiusB, contact.verticesA, contact.verticesB}, bInA, reach);
    }

    /// Gives all of them their manifolds, and is empty.
    /// @param done  called with probe, contact, and pose of B in the frame of A
    template <class Done>
    void renew(const WorldState& world, const Done& done) {
        if (pairs_.size() == 0) { return; }
        pairs_.collide();
        std::array<Manifold, ManifoldBatch::kPairs>
            closest;  // first all of them: copies wait for what was just written
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            pairs_.takeManifold(i, entries_[i].contact->memory, closest[i]);
        }
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const Entry& entry = entries_[i];
            Contact& contact = *entry.contact;
            if (contact.dynamicA) {
                takeManifold(contact, entry.bInA, closest[i]);
            } else {
                takeManifold(contact, entry.bInA,
                             turnedToGround(world, world.shapes[contact.shapeA], world.shapes[contact.shapeB],
                                            entry.bInA, entry.margin, closest[i]));
            }
            done(*entry.probe, contact, entry.bInA);
        }
        pairs_.clear();
    }

private:
    struct Entry {
        ContactProbe* probe = nullptr;
        Contact* contact = nullptr;
        Transform bInA{};
        Real margin = 0;
    };

    ManifoldBatch pairs_;
    std::array<Entry, ManifoldBatch::kPairs> entries_;
};

}  // namespace swept::inline SWEPT_PRECISION

#include "decks.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "../state/tolerances.h"
#include "contact_manifold.h"
#include "ghosts.h"
#include "pairs_of_shapes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isReached(const Contact& contact) {
    return contact.isSolid() && deepestSeparation(contact.manifold) <= kEndRatio * contact.extent;
}

/// World, from the deck to what it meets.
Vec2 normalOf(const WorldState& world, const Contact& contact, bool deckIsA) {
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    return deckIsA ? normal : -normal;
}

/// The contacts of each shape with pieces, in their order. Most shapes have one, which nothing hides: they are not
/// listed.
class DeckLists {
public:
    DeckLists(const WorldState& world, DeckContacts& scratch, std::span<const Contact> contacts,
              std::span<const std::uint32_t> renewed)
        : scratch_(scratch), contacts_(contacts), renewed_(renewed) {
        scratch_.contacts.clear();
        scratch_.ends.resize(world.shapes.slotCount());
        scratch_.counts.resize(world.shapes.slotCount(), 0);
        scratch_.contacts.reserve(2 * renewed.size());  // so that nothing throws while lists are half made
        scratch_.group.reserve(2 * renewed.size());
        forEachSide([this](std::uint32_t own, std::uint32_t, bool) {
            std::uint8_t& count = scratch_.counts[own];
            count = static_cast<std::uint8_t>(count + (count < 2 ? 1 : 0));
        });
        forEachSide([this](std::uint32_t own, std::uint32_t index, bool deckIsA) {
            if (scratch_.counts[own] > 1) { add({.own = own, .contact = index, .deckIsA = deckIsA}); }
        });
        forEachSide([this](std::uint32_t own, std::uint32_t, bool) { scratch_.counts[own] = 0; });
    }

    /// @param visit  gets the contacts of one shape with one body, if there are several; the lists are empty then
    template <class Visit>
    void take(const Visit& visit) {
        for (std::size_t i = 0; i < scratch_.contacts.size(); ++i) {
            DeckEnds& ends = scratch_.ends[scratch_.contacts[i].own];
            if (ends.first != i) { continue; }
            ends = {};
            takeShape(static_cast<std::uint32_t>(i), visit);
        }
    }

private:
    /// @param visit  gets the slot of the shape, the contact, and whether the piece is A
    template <class Visit>
    void forEachSide(const Visit& visit) const {
        for (const std::uint32_t i : renewed_) {
            const Contact& contact = contacts_[i];
            if (!contact.isSolid()) { continue; }
            if (contact.pieceA) { visit(contact.shapeB, i, true); }
            if (contact.pieceB) { visit(contact.shapeA, i, false); }
        }
    }

    std::uint32_t deckOf(const DeckContact& one) const {
        const Contact& contact = contacts_[one.contact];
        return one.deckIsA ? contact.bodyA : contact.bodyB;
    }

    void add(const DeckContact& one) {
        const auto place = static_cast<std::uint32_t>(scratch_.contacts.size());
        scratch_.contacts.push_back(one);
        DeckEnds& ends = scratch_.ends[one.own];
        (ends.last == kNoIndex ? ends.first : scratch_.contacts[ends.last].next) = place;
        ends.last = place;
    }

    /// Deck by deck; mostly there is one.
    template <class Visit>
    void takeShape(std::uint32_t first, const Visit& visit) {
        std::vector<DeckContact>& group = scratch_.group;
        for (std::uint32_t begin = first; begin != kNoIndex; begin = scratch_.contacts[begin].next) {
            if (scratch_.contacts[begin].isTaken) { continue; }
            const std::uint32_t deck = deckOf(scratch_.contacts[begin]);
            group.clear();
            for (std::uint32_t i = begin; i != kNoIndex; i = scratch_.contacts[i].next) {
                DeckContact& one = scratch_.contacts[i];
                if (one.isTaken || deckOf(one) != deck) { continue; }
                one.isTaken = true;
                group.push_back(one);
            }
            if (group.size() > 1) { visit(std::span(group)); }
        }
    }

    DeckContacts& scratch_;
    std::span<const Contact> contacts_;
    std::span<const std::uint32_t> renewed_;
};

/// As the same contact of B with A.
Manifold turnedAround(const Manifold& manifold, const Transform& bInA) {
    Manifold other = manifold;
    other.normal = -rotate(bInA.rotation, manifold.normal);
    for (ManifoldPoint& point : other.points) { point.point = apply(bInA, point.point); }
    other.isNormalOfB = !manifold.isNormalOfB;
    return other;
}

class GhostsOfDeck {
public:
    GhostsOfDeck(const WorldState& world, std::span<Contact> contacts, std::span<DeckContact> group)
        : world_(world), contacts_(contacts), group_(group) {}

    /// Two points each along one normal: nothing hides another one, as mostly.
    bool mayHide() const {
        const Vec2 first = normalOf(world_, contacts_[group_[0].contact], group_[0].deckIsA);
        return std::any_of(group_.begin(), group_.end(), [&](const DeckContact& one) {
            const Contact& contact = contacts_[one.contact];
            return contact.manifold.count < 2 || !(dot(normalOf(world_, contact, one.deckIsA), first) > kSameNormal);
        });
    }

    bool drop() const {
        std::array<bool, kGhostRanks> are{};
        for (DeckContact& one : group_) {
            one.rank = rankOf(one);
            are[one.rank] = true;
        }
        bool any = false;
        for (std::size_t rank = 0; rank < are.size(); ++rank) {
            if (!are[rank]) { continue; }
            for (const DeckContact& one : group_) {
                if (one.rank == rank && dropIfHidden(one)) { any = true; }
            }
        }
        return any;
    }

private:
    std::uint8_t rankOf(const DeckContact& one) const {
        const Contact& contact = contacts_[one.contact];
        if (contact.manifold.count > 1) { return kGhostRanks - 1; }  // the last one: a face, with two points
        return static_cast<std::uint8_t>(ghostRank(groundContactOf(world_, contact, one.deckIsA)));
    }

    bool dropIfHidden(const DeckContact& one) const {
        Contact& contact = contacts_[one.contact];
        const GroundContact seen = groundContactOf(world_, contact, one.deckIsA);
        for (const DeckContact& other : group_) {
            const Contact& stands = contacts_[other.contact];
            if (&stands == &contact || !isReached(stands)) { continue; }
            const GroundContact held = groundContactOf(world_, stands, other.deckIsA);
            if (!hides(held, seen)) { continue; }
            if (!turnToFace(contact, seen, one.deckIsA, held.normal)) { contact.manifold.count = 0; }
            return true;
        }
        return false;
    }

    /// As `turnToFlushFace` (ghosts.cpp), of either shape. @param normal  of what it stands on. @return whether it does
    bool turnToFace(Contact& contact, const GroundContact& seen, bool deckIsA, Vec2 normal) const {
        if (contact.ofChain || contact.manifold.isNormalOfB != deckIsA) { return false; }
        const int face = faceWithNormal(seen.ground, unrotate(seen.groundPose.rotation, normal));
        if (face < 0) { return false; }
        Real farthest = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
            farthest = std::max(farthest, contact.manifold.points[i].separation);
        }
        const Transform ownInDeck = relativeTransform(seen.groundPose, seen.ownPose);
        const Manifold onFace = collideOnFace(seen.ground, face, seen.own, ownInDeck, seen.slop + farthest, kFaceSine);
        if (onFace.count == 0) { return false; }
        const Transform bInA = relativePoseOf(world_, contact);
        takeManifold(contact, bInA, deckIsA ? onFace : turnedAround(onFace, bInA));
        return true;
    }

    const WorldState& world_;
    std::span<Contact> contacts_;
    std::span<DeckContact> group_;
};

}  // namespace

bool dropGhostsOfDecks(const WorldState& world, std::span<Contact> contacts, std::span<const std::uint32_t> renewed,
                       DeckContacts& scratch) {
    if (!world.anyPieces) { return false; }
    DeckLists lists(world, scratch, contacts, renewed);
    bool any = false;
    lists.take([&](std::span<DeckContact> group) {
        const GhostsOfDeck ghosts(world, contacts, group);
        if (ghosts.mayHide() && ghosts.drop()) { any = true; }
    });
    return any;
}

void notePieces(const WorldState& world, Contact& contact) {
    contact.pieceA = contact.dynamicA && world.shapes[contact.shapeA].isPiece;
    contact.pieceB = contact.dynamicB && world.shapes[contact.shapeB].isPiece;
}

void notePiecesOf(WorldState& world, std::span<const std::uint32_t> shapes) {
    for (const std::uint32_t place : pairsOf(world, shapes, [](const ContactPair&) { return true; })) {
        ContactProbe* const probe = probeAt(world, place);
        if (probe == nullptr) { return; }
        Contact& contact = world.contacts[probe->contact];
        notePieces(world, contact);
        probe->isOfDeck = contact.pieceA || contact.pieceB;
    }
}

}  // namespace swept::inline SWEPT_PRECISION

#include "decks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../state/tolerances.h"
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

/// The contacts of each shape with the pieces of each body, in their order. Most have one, which nothing hides: they
/// are not listed.
class DeckLists {
public:
    DeckLists(DeckContacts& scratch, std::span<const Contact> contacts, std::span<const std::uint32_t> renewed)
        : scratch_(scratch) {
        scratch_.contacts.clear();
        scratch_.contacts.reserve(2 * renewed.size());
        scratch_.counts.assign(std::bit_ceil(8 * renewed.size() + 1), 0);
        for (std::size_t place = 0; place < renewed.size(); ++place) {
            const std::uint32_t i = renewed[place];
            const Contact& contact = contacts[i];
            if (!contact.isSolid()) { continue; }
            const auto at = static_cast<std::uint32_t>(place);
            if (contact.pieceA) { note({contact.shapeB, contact.bodyA, i, at, true}); }
            if (contact.pieceB) { note({contact.shapeA, contact.bodyB, i, at, false}); }
        }
        std::erase_if(scratch_.contacts, [this](const DeckContact& one) { return countOf(one) < 2; });
        scratch_.lastOf.assign(std::bit_ceil(4 * scratch_.contacts.size() + 1), kNoIndex);
        for (std::size_t i = 0; i < scratch_.contacts.size(); ++i) { link(static_cast<std::uint32_t>(i)); }
    }

    /// @param visit  gets the contacts of one shape with one body, if there are several
    template <class Visit>
    void visitGroups(const Visit& visit) {
        for (std::size_t i = 0; i < scratch_.contacts.size(); ++i) {
            const DeckContact& first = scratch_.contacts[i];
            if (first.isTaken) { continue; }
            scratch_.group.clear();
            for (auto place = static_cast<std::uint32_t>(i); place != kNoIndex; place = scratch_.contacts[place].next) {
                DeckContact& one = scratch_.contacts[place];
                if (one.own != first.own || one.deck != first.deck) { continue; }
                one.isTaken = true;
                scratch_.group.push_back(one);
            }
            if (scratch_.group.size() > 1) { visit(std::span(scratch_.group)); }
        }
    }

private:
    /// That of a pair of a shape and a deck; another pair may have it, too.
    static std::size_t placeOf(const DeckContact& one, std::size_t places) {
        constexpr std::uint32_t kGolden = 0x9E3779B1U;
        const std::uint32_t key = (one.own * kGolden ^ one.deck) * kGolden;
        return (key ^ key >> 16U) & (places - 1);
    }
    std::uint8_t& countOf(const DeckContact& one) const {
        return scratch_.counts[placeOf(one, scratch_.counts.size())];
    }

    void note(const DeckContact& one) {
        std::uint8_t& count = countOf(one);
        count = static_cast<std::uint8_t>(count + (count < 2 ? 1 : 0));
        scratch_.contacts.push_back(one);
    }

    void link(std::uint32_t index) {
        DeckContact& one = scratch_.contacts[index];
        std::uint32_t& last = scratch_.lastOf[placeOf(one, scratch_.lastOf.size())];
        if (last != kNoIndex) { scratch_.contacts[last].next = index; }
        last = index;
    }

    DeckContacts& scratch_;
};

class GhostsOfDeck {
public:
    GhostsOfDeck(const WorldState& world, std::span<Contact> contacts, std::span<DeckContact> group,
                 std::vector<std::uint32_t>& changed)
        : world_(world), contacts_(contacts), group_(group), changed_(changed) {}

    /// Along one normal nothing trips on what it would be hidden by.
    bool mayHide() const {
        const Vec2 first = normalOf(world_, contacts_[group_[0].contact], group_[0].deckIsA);
        return std::any_of(group_.begin() + 1, group_.end(), [&](const DeckContact& one) {
            const Vec2 normal = normalOf(world_, contacts_[one.contact], one.deckIsA);
            return !(dot(normal, first) > 0) || std::fabs(cross(normal, first)) > kFaceSine;
        });
    }

    void drop() const {
        std::array<bool, kGhostRanks> are{};
        for (DeckContact& one : group_) {
            one.rank = rankOf(one);
            are[one.rank] = true;
        }
        for (std::size_t rank = 0; rank < are.size(); ++rank) {
            if (!are[rank]) { continue; }
            for (const DeckContact& one : group_) {
                if (one.rank == rank && dropIfHidden(one)) { changed_.push_back(one.place); }
            }
        }
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
            if (!turnToFlushFace(world_, contact, seen, one.deckIsA, held.normal)) { contact.manifold.count = 0; }
            return true;
        }
        return false;
    }

    const WorldState& world_;
    std::span<Contact> contacts_;
    std::span<DeckContact> group_;
    std::vector<std::uint32_t>& changed_;
};

}  // namespace

std::span<const std::uint32_t> dropGhostsOfDecks(const WorldState& world, std::span<Contact> contacts,
                                                 std::span<const std::uint32_t> renewed, DeckContacts& scratch) {
    scratch.changed.clear();
    if (!world.anyPieces || renewed.empty()) { return scratch.changed; }
    DeckLists lists(scratch, contacts, renewed);
    lists.visitGroups([&](std::span<DeckContact> group) {
        const GhostsOfDeck ghosts(world, contacts, group, scratch.changed);
        if (ghosts.mayHide()) { ghosts.drop(); }
    });
    return scratch.changed;
}

void dropGhostsOfDecks(WorldState& world) {
    if (!world.anyPieces) { return; }
    std::vector<std::uint32_t>& list = world.deckContacts.candidates;
    std::vector<std::uint32_t>& probes = world.deckContacts.probes;
    list.clear();
    probes.clear();
    for (const std::uint32_t i : world.lists.near) {
        const ContactProbe& probe = world.probes[i];
        if (!probe.isOfDeck || probe.points == 0) { continue; }
        list.push_back(probe.contact);
        probes.push_back(i);
    }
    for (const std::uint32_t place : dropGhostsOfDecks(world, world.contacts, list, world.deckContacts)) {
        world.probes[probes[place]].areUp = false;  // it tells what the contact had before
    }
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

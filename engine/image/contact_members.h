#pragma once

#include "../state/contact.h"
#include "../state/joint.h"
#include "../state/touching.h"
#include "members.h"

/// Members of contacts and of their like, which have bases and bit-fields: each list is checked to be complete.

namespace swept::inline SWEPT_PRECISION {

constexpr Flags<8> flagsOf(const TouchTraits& t) {
    return {t.dynamicA, t.dynamicB, t.bounces, t.isBelt, t.resistsRolling, t.isOpen, t.mayMeet, t.isDeep};
}
constexpr void setFlags(TouchTraits& t, const Flags<8>& flags) {
    t.dynamicA = flags[0];
    t.dynamicB = flags[1];
    t.bounces = flags[2];
    t.isBelt = flags[3];
    t.resistsRolling = flags[4];
    t.isOpen = flags[5];
    t.mayMeet = flags[6];
    t.isDeep = flags[7];
}
template <MaybeConst<TouchTraits> T>
constexpr auto allMembers(T& traits) {
    static_assert(areAllListed<TouchTraits>(1, 8));
    return listed(traits.points, flagsIn(traits));
}

constexpr Flags<7> flagsOf(const ContactProbe& p) {
    return {p.isIdle, p.isPlain, p.isUnseen, p.isOfDeck, p.wasKept, p.areUp, p.turns};
}
constexpr void setFlags(ContactProbe& p, const Flags<7>& flags) {
    p.isIdle = flags[0];
    p.isPlain = flags[1];
    p.isUnseen = flags[2];
    p.isOfDeck = flags[3];
    p.wasKept = flags[4];
    p.areUp = flags[5];
    p.turns = flags[6];
}
template <MaybeConst<ContactProbe> T>
constexpr auto allMembers(T& probe) {
    static_assert(areAllListed<ContactProbe>(6, 7));
    return listed(baseOf<ContactPair>(probe), baseOf<TouchTraits>(probe), probe.state, flagsIn(probe), probe.contact,
                  probe.apartUntil, probe.offset);
}

constexpr Flags<10> flagsOf(const Contact& c) {
    return {c.dynamicA, c.dynamicB, c.sensor, c.ofChain, c.passes,
            c.wasSeen,  c.isBelt,   c.pieceA, c.pieceB,  c.resistsRolling};
}
constexpr void setFlags(Contact& c, const Flags<10>& flags) {
    c.dynamicA = flags[0];
    c.dynamicB = flags[1];
    c.sensor = flags[2];
    c.ofChain = flags[3];
    c.passes = flags[4];
    c.wasSeen = flags[5];
    c.isBelt = flags[6];
    c.pieceA = flags[7];
    c.pieceB = flags[8];
    c.resistsRolling = flags[9];
}
template <MaybeConst<Contact> T>
constexpr auto allMembers(T& contact) {
    static_assert(areAllListed<Contact>(12, 10));
    return listed(baseOf<ContactRow>(contact), contact.extentA, contact.extentB, contact.verticesA, contact.verticesB,
                  flagsIn(contact), contact.batch, contact.touching, contact.pressed, contact.pressedOn, contact.isKept,
                  contact.kept, contact.memory);
}

}  // namespace swept::inline SWEPT_PRECISION

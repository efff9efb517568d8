#include "new_pairs.h"

#include "../bodies/awake.h"
#include "contact_making.h"
#include "may_touch.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Nobody asks about such a pair before it is near: what kinematic bodies may meet is looked for farther away, and
/// those that bounce off each other in flight ask for theirs (clash.h). But what was put beside each other asleep is
/// looked at once.
bool mayWait(const WorldState& world, const Shape& a, const Shape& b) {
    const Body& bodyA = world.bodies[a.body];
    const Body& bodyB = world.bodies[b.body];
    return !world.watched && !a.def.sensor && !b.def.sensor && bodyA.isDynamic() && bodyB.isDynamic() &&
           (bodyA.awake || bodyB.awake);
}

/// Nothing moves here, and yet the two met: something was put there. A kinematic body at rest wakes nobody, but what is
/// held is awake to the user.
void releaseWhatIsMet(WorldState& world, std::uint32_t a, std::uint32_t b) {
    if (disturbs(world, a) || disturbs(world, b)) { return; }
    for (const std::uint32_t slot : {a, b}) {
        if (world.bodies[slot].heldIn == kNoIndex) { continue; }
        if (world.bodies[slot == a ? b : a].def.type == BodyType::fixed) {
            wakeToRest(world, slot);
        } else {
            releaseHeld(world, slot);
        }
    }
}

/// @return false when the two may not touch, or have a contact already
bool addPair(WorldState& world, const NewPair& pair, bool isNear) {
    if (!pair.mayTouch || !world.pairs.insert(pair.shapeA, pair.shapeB)) { return false; }
    if (!isNear && pair.mayWait) {
        world.candidates.push_back(pair);
    } else {
        makeContact(world, pair.shapeA, pair.shapeB);
    }
    ++world.counters.pairsFound;
    return true;
}

}  // namespace

NewPair newPairOf(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB) {
    const Shape& a = world.shapes[shapeA];
    const Shape& b = world.shapes[shapeB];
    NewPair pair;
    pair.shapeA = shapeA;
    pair.shapeB = shapeB;
    pair.bodyA = a.body;
    pair.bodyB = b.body;
    pair.proxyA = a.proxy;
    pair.proxyB = b.proxy;
    pair.mayTouch = mayTouch(world, a, b);
    if (!pair.mayTouch) { return pair; }
    pair.mayWait = mayWait(world, a, b);
    pair.isKnown = disturbs(world, a.body) || disturbs(world, b.body);
    return pair;
}

bool addContact(WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB) {
    const NewPair pair = newPairOf(world, shapeA, shapeB);
    if (!addPair(world, pair, true)) { return false; }
    if (!pair.isKnown) { releaseWhatIsMet(world, pair.bodyA, pair.bodyB); }
    return true;
}

void addPairs(WorldState& world) {
    const std::vector<NewPair>& found = world.newPairKinds;
    world.metPairs.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i + kLookedUpAhead < found.size()) {
            const NewPair& coming = found[i + kLookedUpAhead];
            world.pairs.fetch(coming.shapeA, coming.shapeB);
        }
        if (addPair(world, found[i], false) && !found[i].isKnown) { world.metPairs.push_back(found[i]); }
    }
}

void releaseMet(WorldState& world) {
    for (const ContactPair& pair : world.metPairs) {
        const bool isHeld = world.bodies[pair.bodyA].heldIn != kNoIndex || world.bodies[pair.bodyB].heldIn != kNoIndex;
        world.parked.rested += isHeld ? 0 : 1;  // what is made asleep rests, though no step brought it to rest
        releaseWhatIsMet(world, pair.bodyA, pair.bodyB);
    }
    world.metPairs.clear();
}

}  // namespace swept::inline SWEPT_PRECISION

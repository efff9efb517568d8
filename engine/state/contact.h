#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "../../broadphase/broadphase.h"
#include "../../shapes/cache_line.h"
#include "../../shapes/manifold.h"
#include "../../solver/contacts/contact_row.h"
#include "touching.h"

namespace swept::inline SWEPT_PRECISION {

/// Where two points of a contact were found. As long as no point has moved farther than `kKeepRatio` of the extent
/// since (resting contacts, mostly), the same features touch, and what their motion makes of separations and normal is
/// known without a look at the shapes: up to the square of that motion, which is less than a rounding of `Real`. The
/// points themselves stay.
struct KeptManifold {
    Transform bInA{};
    Vec2 normal{};
    std::array<Real, 2> separations{};
};

/// Which contacts have their manifolds found together (contact_batch.h). Circles have one vertex, capsules and segments
/// two, few are `kFewVertices` at most.
enum class BatchKind : std::uint8_t {
    none,  ///< found one by one
    few,   ///< of sharp shapes
    many,
    circles,
    roundTwo,   ///< two at most
    circleFew,  ///< A is a circle
    twoFew,
    fewCircle,
    fewTwo,
    roundFew,
    roundMany,
    chainTwo,  ///< of chain segments, by what touches them
    chainFew,
    chainMany,
};
inline constexpr std::size_t kBatchKinds = 13;  ///< but for `none`

/// Two shapes whose boxes overlap. A is the sensor, else the chain segment, else what does not yield (static or
/// kinematic). Of cache lines of its own, and in each what is asked for together: in `Real` float the points, what a
/// solve adds to them and takes from them, and what spares a search for points.
struct alignas(kCacheLine) Contact : ContactRow {
    // Copies of what never changes, like the radii: the stage of contacts then need not fetch shapes and bodies, which
    // lie all over memory.
    Real extentA = 0;
    Real extentB = 0;
    std::uint8_t verticesA = 0;
    std::uint8_t verticesB = 0;
    bool dynamicA : 1 = false;  ///< the body is
    bool dynamicB : 1 = false;
    bool sensor : 1 = false;
    bool ofChain : 1 = false;  ///< A is a chain segment, and no sensor; what follows is of such ones alone
    bool passes : 1 = false;   ///< it comes through from the back (chain_passage.h)
    bool wasSeen : 1 = false;  ///< by a step before
    bool isBelt : 1 = false;   ///< of any contact: friction drags along a surface, as the shapes tell
    bool pieceA : 1 = false;   ///< A is one of several flush pieces of a dynamic body (decks.h)
    bool pieceB : 1 = false;
    bool resistsRolling : 1 = false;  ///< likewise: where it has one point (`ShapeDef::rollingResistance`)
    BatchKind batch = BatchKind::none;
    bool touching = false;   ///< begin was reported, end was not
    bool pressed = false;    ///< carried an impulse in the last step
    bool pressedOn = false;  ///< and in the one before: it is no blow that the next step would repeat
    bool isKept = false;     ///< there is a `KeptManifold`

    KeptManifold kept;
    ManifoldMemory memory;  ///< of the shapes' last query: spares work, changes nothing

    bool isSolid() const { return !sensor && manifold.count > 0; }
    bool rolls() const { return resistsRolling && manifold.count == 1; }
    /// Warm start, N·m·s, on B; its opposite on A. It stands where the friction of a second point would, which there is
    /// not: the row has no room for a number that few need. @pre `rolls()`
    Real& rollingImpulse() { return tangentImpulse[1]; }
    Real rollingImpulse() const { return tangentImpulse[1]; }

    /// One of its bodies that is dynamic: if both are, A.
    std::uint32_t dynamicBody() const { return dynamicA ? bodyA : bodyB; }
};
static_assert(sizeof(Contact) <= 48 * sizeof(Real), "a step reads most of some thousands");

/// What the stage of contacts found of one in this step; of a probe that is not in `ContactLists::noted`, in an earlier
/// one.
enum class ContactState : std::uint8_t {
    asleep,      ///< nothing: neither body is awake
    boxesApart,  ///< it ends
    apart,       ///< shapes too far apart for contact points, as was known: the contact was not looked at
    passing,     ///< likewise, but only as long as nothing stops either of them (hemmed_pairs.h)
    near,        ///< its manifold is new
};

/// Two shapes whose boxes in the broadphase overlap.
struct ContactPair {
    std::uint32_t bodyA = 0;  ///< slots
    std::uint32_t bodyB = 0;
    ProxyId proxyA{};
    ProxyId proxyB{};
};

/// What stands where a pair was removed: its place is found without a look at the others (pairs_of_shapes.h).
inline bool isGap(const ContactPair& pair) { return pair.bodyA == pair.bodyB; }
inline void makeGap(ContactPair& pair) { pair.bodyA = pair.bodyB; }

/// A new pair of boxes, as far as it does not depend on the other ones.
struct NewPair : ContactPair {
    std::uint32_t shapeA = 0;  ///< slots
    std::uint32_t shapeB = 0;
    bool mayTouch = false;
    bool mayWait = false;  ///< until it is near
    bool isKnown = false;  ///< one of the bodies `disturbs`
};

/// The part of a contact that decides whether the rest of it, some cache lines in `Contact`, is looked at at all. What
/// its traits tell of points is known in state `near`. Probes stand in the order in which their pairs came near;
/// contacts stay where they are while a step goes on.
struct ContactProbe : ContactPair, TouchTraits {
    ContactState state = ContactState::asleep;
    bool isIdle : 1 = false;  ///< it is no sensor, and had no points when they were renewed last, so it does not touch:
                              ///< while they are apart nothing changes
    bool isPlain : 1 =
        false;  ///< of dynamic bodies, and no sensor: what follows is all that is asked about it at first
    bool isUnseen : 1 = false;  ///< of a sensor, or made of what sleeps, and no step looked at it: the first one does,
                                ///< though all may sleep: what touches is told, and woken by what becomes of the other
    bool isOfDeck : 1 = false;  ///< one of them is one of several flush pieces (decks.h)
    bool wasKept : 1 = false;   ///< its manifold was, when it was near last: most likely it is again
    bool areUp : 1 = false;     ///< of state `near`: what of both is dynamic was awake, as the stage of contacts began;
                                ///< not of sensors
    bool turns : 1 = false;     ///< of state `near`: touching begins or ends
    std::uint32_t contact = 0;  ///< place in `WorldState::contacts`
    double apartUntil =
        0;          ///< there are no points as long as the bodies moved less since (travel.h), metres; 0: not known
    Vec2 offset{};  ///< from centre of mass to centre of mass at that time, world
};
static_assert(sizeof(ContactProbe) <= 48, "a step reads all of them");

}  // namespace swept::inline SWEPT_PRECISION

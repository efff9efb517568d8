#pragma once

#include <algorithm>
#include <cstdint>

#include "effort.h"

namespace swept::inline SWEPT_PRECISION {

/// What decides about the effort of an island: sums over its members. Kept for its capacity.
struct IslandLoad {
    std::uint32_t bodies = 0;
    std::uint32_t contacts = 0;
    std::uint32_t joints = 0;
    Real lightest = 0;         ///< kg
    Real lightestLink = 0;     ///< kg, of `BodyLoad::isLink`; without any the largest number
    Real lightestCarrier = 0;  ///< likewise, of `BodyLoad::mayCarry`
    std::uint32_t limitedHinges = 0;
    std::uint32_t plainJoints = 0;       ///< rigid, without springs, limits and motors
    std::uint32_t softJoints = 0;        ///< rods and welds that hold nothing rigidly
    std::uint32_t jointsWithDrives = 0;  ///< `JointTie::hasDrives`
    bool isAnchored = false;             ///< a joint ties it to what is not dynamic
    bool hasLoop = false;                ///< joints between some of its bodies, and the ground, close one
    bool hasWideLoop = false;            ///< not all chains that do are `JointChain::isThin`
    bool mayBeStruck = false;            ///< see blows.h
    bool wasStruck = false;              ///< one of its bodies was, in the last step
    std::uint32_t longestBeam = 0;       ///< joints that hold angles, of a chain that hangs on what is not dynamic
    std::uint32_t longestChain = 0;      ///< joints that hang together without contacts
    Real heaviestJointed = 0;
    Real thinnest = 0;  ///< smallest extent, metres
    double lowest = 0;  ///< centre of mass against gravity, metres
    double highest = 0;
    Real fastest = 0;             ///< square of the largest speed of a centre of mass, m²/s²
    std::uint32_t moving = 0;     ///< bodies on the move: fast for their size
    Real heaviestLoose = 0;       ///< kg, of the bodies that no joint holds
    std::uint32_t powered = 0;    ///< joints with a motor or a spring
    bool holdsAngles = false;     ///< some joint keeps its bodies from turning against each other
    std::uint32_t debt = 0;       ///< largest `Body::searchDebt`
    bool resistsRolling = false;  ///< somewhere; known where contacts may be solved all at once
    bool isContradicted = false;  ///< see contradictions.h
    bool staysPut = true;         ///< each body was solved all at once in the last step, or does not move at all
    Effort effort{};
};

inline Real heaviestOf(const IslandLoad& load) { return std::max(load.heaviestJointed, load.heaviestLoose); }

/// What a body adds to the load of its island.
struct BodyLoad {
    double height = 0;      ///< centre of mass against gravity, metres
    Real mass = 0;          ///< kg
    Real extent = 0;        ///< metres
    Real speedSquared = 0;  ///< m²/s²
    std::uint32_t root = 0;
    std::uint16_t debt = 0;
    bool isMoving = false;
    bool staysPut = false;
    bool isJointed = false;
    bool wasStruck = false;
    bool isLink = false;  ///< two joints hold it, or a joint and what it touches: others may pull at each other by it
    /// A link, or a wheel: that touches the ground again and again.
    bool mayCarry = false;
};

/// What some bodies add, one after the other among `WorldState::tied`: mostly all of them are in one island, and are
/// added up by whoever looks at them.
struct BlockLoad {
    std::uint32_t root = 0;
    std::uint32_t others = 0;  ///< bodies in other islands, whose `BodyLoad`s stand at the place of the block
    IslandLoad load;           ///< of the bodies of the root's island
};

/// Contacts of one island, one after the other among `WorldState::touching`.
struct IslandContacts {
    std::uint32_t root = 0;
    std::uint32_t count = 0;
};

}  // namespace swept::inline SWEPT_PRECISION

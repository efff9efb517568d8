#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"
#include "../../solver/direct/block_ldlt.h"
#include "../../solver/graph/island_finder.h"
#include "lent_energy_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Awake dynamic bodies that joints tie together, contacts aside, and the sums over their joints that the effort of an
/// island is about.
struct JointChain {
    std::uint32_t lowest = 0;  ///< slot of its lowest body
    std::uint32_t bodies = 0;
    std::uint32_t joints = 0;
    std::uint32_t ties = 0;              ///< those of them that may close a loop: not what drives an angle alone
    std::uint32_t doubled = 0;           ///< those of them whose two bodies one before ties already
    std::uint32_t plainJoints = 0;       ///< `JointTie::isPlain`
    std::uint32_t softJoints = 0;        ///< `JointTie::isSoft`
    std::uint32_t jointsWithDrives = 0;  ///< `JointTie::hasDrives`
    std::uint32_t poweredJoints = 0;
    std::uint32_t anchors = 0;      ///< joints that tie it to what is not dynamic
    std::uint32_t angleJoints = 0;  ///< `JointTie::holdsAngle`
    std::uint32_t limitedHinges = 0;
    bool isPassive = true;  ///< `JointTie::isPassive` of all
    bool isAdrift = true;   ///< no joint ties it to what is not dynamic, nor pushes from outside
    bool isThin = false;    ///< a large loop, whose factor fills up little (thin_loops.h)
    // What goes on from step to step (lent_energy.h).
    bool mayLend = false;        ///< by joints without motors, springs, and targets, and held to static things if any
    bool lends = false;          ///< scratch of a solve
    bool isDamped = false;       ///< scratch of a solve: any of its bodies
    std::uint64_t identity = 0;  ///< of its joints, all of them; only of what may lend
    LentEnergy lent{};

    /// What is not anchored has a tie less than bodies if it is a tree. Two bodies that are tied twice are no ring.
    bool hasLoop() const { return ties > bodies || (anchors == 0 && ties - doubled >= bodies); }
};

/// Scratch of thin_loops.cpp; empty where there are no large loops.
struct ThinLoops {
    struct Tie {
        std::uint32_t chain = 0;  ///< in `JointChains::list`
        BlockEdge bodies;         ///< as they are counted in the chain
    };
    std::vector<std::uint32_t> numbers;  ///< by slot
    std::vector<std::uint32_t> counts;   ///< by chain: of its bodies that have their number
    std::vector<Tie> ties;
    std::vector<BlockEdge> edges;
    BlockLdlt factor;
};

/// All chains. They persist: as long as no joint is made, changed or removed, and nothing that one holds wakes or falls
/// asleep, a step asks none of them, but unites each body with the lowest one of its chain.
struct JointChains {
    struct Member {
        std::uint32_t body = 0;    ///< slots
        std::uint32_t lowest = 0;  ///< of its chain
    };
    bool areCurrent = false;             ///< those of all joints of what is awake, as they are now
    bool tieSleepers = false;            ///< a joint ties what is awake to what sleeps
    bool isAnyLoose = false;             ///< some chain is passive, and not anchored
    bool isAnyAdrift = false;            ///< `JointChain::isAdrift` of any
    bool mayAnyLend = false;             ///< `JointChain::mayLend` of any
    std::vector<JointChain> list;        ///< in order of their lowest bodies
    std::vector<JointChain> before;      ///< scratch: those found the last time
    std::vector<Member> members;         ///< ascending; each awake dynamic body that a joint holds
    std::vector<std::uint32_t> bullets;  ///< slots of those of them that are marked so
    IslandFinder finder;                 ///< of their bodies
    std::vector<std::uint32_t> places;   ///< by slot of the lowest body: in `list`; others are those of before
    ThinLoops thinLoops;                 ///< scratch

    /// That of an awake dynamic body that a joint holds. @pre `areCurrent`
    const JointChain& of(std::uint32_t body) const { return list[places[finder.rootOf(body)]]; }
    /// A body wakes, or falls asleep. @param holdingJoints  of the body
    void noteTurn(std::uint32_t holdingJoints) { areCurrent = areCurrent && holdingJoints == 0; }
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/cache_line.h"
#include "../../shapes/raw_vector.h"
#include "../../shapes/rotation.h"
#include "../../shapes/task_system.h"
#include "../../solver/solver.h"
#include "../counters.h"
#include "../events.h"
#include "chain_spin.h"
#include "energy_account.h"

namespace swept::inline SWEPT_PRECISION {

/// Of some pairs that touch.
struct LinkCounts {
    std::uint32_t links = 0;
    std::uint32_t bouncing = 0;  ///< of these, with restitution
};

/// How kinematic ground turns in a solve, or that a body touches such ground (turning_ground.h).
struct GroundTurn {
    Rotation half{};         ///< of its turn
    Real shortening = 0;     ///< of the chord, as part of the arc
    bool isTouched = false;  ///< by ground that turns

    bool isAny() const { return half.s != 0; }
};

/// What presses an island in a solve (squeezed_bodies.h).
struct SqueezedIsland {
    Real lead = 0;            ///< of the fastest ground that it presses on, there, m/s
    Real speed = 0;           ///< of the fastest of its members before the solve, m/s
    BodySlot ground = 0;      ///< one that it presses on, and one more; 0: none
    bool isSqueezed = false;  ///< there are several
    bool isDriven = false;    ///< by motors or springs
};

/// Where a group is solved. Several may be at the same time, each at a desk of its own, as long as no body moves in two
/// of them. What a solve leaves for the whole step stays here until `clearDesk`. Kept for its capacity.
struct alignas(kCacheLine) SolveDesk {
    TaskSystem* loops = nullptr;  ///< where its parallel loops run
    SolverBatch batch;
    Solver solver;
    RawVector<std::uint8_t> takesPart;        ///< in the present solve: by place among the bodies of the group
    RawVector<std::uint32_t> bodies;          ///< slots in the world of what does, by slot of the solve less one
    std::vector<LinkCounts> linkCounts;       ///< scratch, by block of pairs
    std::vector<BodySlot> standing;           ///< slots of the solve that kinematic bodies have
    RawVector<Vec2> localCenters;             ///< of the bodies of the present solve, by their slot there
    std::vector<std::uint32_t> grounds;       ///< likewise (strained_bodies.h); empty if none is strained
    std::vector<GroundTurn> groundTurns;      ///< likewise (turning_ground.h); empty if no ground turns
    std::vector<SqueezedIsland> squeezed;     ///< scratch, by the slot in the world of their root
    std::vector<std::uint8_t> isLimited;      ///< scratch, by slot of the solve: whether it was slowed down there
    RawVector<EnergyEntry> energyEntries;     ///< likewise, by place in `bodies`
    std::vector<std::uint32_t> energyRoots;   ///< likewise
    std::vector<IslandMotion> islandMotions;  ///< likewise
    std::vector<IslandMotion> motionsBefore;  ///< scratch: the same, before the solve
    std::uint64_t energySolve = 0;            ///< its number
    bool isExact = false;                     ///< the present solve (`SolveReport`)
    bool anyGaveWay = false;                  ///< of its islands, where it is exact
    bool anyLeft = false;                     ///< likewise: solved with sub-steps after all
    std::vector<ChainSpin> chainSpins;        ///< scratch, by place in the list of chains
    std::vector<ChainSums> chainSums;         ///< scratch, likewise

    std::vector<ContactEvent> events;
    StepCounters counters;
    bool anyFlung = false;  ///< the solver may have moved some body as far as only a fast one moves

    /// Whether the present solve was exact for the island of a body that can be moved.
    bool isExactOf(BodySlot slot) const { return isExact && !(anyLeft && solver.isLeft(slot)); }
};

}  // namespace swept::inline SWEPT_PRECISION

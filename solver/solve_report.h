#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What the direct solver did in a step. Of parts that are searched by themselves the one counts that took most.
struct DirectReport {
    int factorisations = 0;
    int rounds = 0;   ///< of the search for what presses and what sticks
    int givenUp = 0;  ///< solves in which that was not found: left to iteration

    void takeLarger(const DirectReport& other) {
        factorisations = (std::max)(factorisations, other.factorisations);
        rounds = (std::max)(rounds, other.rounds);
    }
    void add(const DirectReport& other) {
        factorisations += other.factorisations;
        rounds += other.rounds;
    }
};

/// What the search for what presses and what sticks cost a body in a step.
struct SearchEffort {
    int rounds = 0;            ///< of what is searched together with it
    std::uint32_t bodies = 0;  ///< of that
    bool isLong = false;       ///< its island took more rounds than usual
    bool isInVain = false;
};

/// What a solve did.
struct SolveReport {
    int colours = 0;
    int hingeBlocks = 0;    ///< of hinges that were solved side by side
    int rodBlocks = 0;      ///< of distance joints, likewise
    int slideBlocks = 0;    ///< of prismatic joints
    int wheelBlocks = 0;    ///< of wheels
    int weldBlocks = 0;     ///< of welds
    int driveBlocks = 0;    ///< of motor joints
    int contactBlocks = 0;  ///< of contacts that were solved side by side
    int bounceRounds = 0;   ///< over all sub-steps
    int speedsLimited = 0;  ///< times that `maxSpeed` cut the speed of a body: in a sub-step of halves, of each
    bool isDirect = false;  ///< whether the direct solver took part
    /// Of joints alone, each island by itself: but for `Solver::gaveWay`, and what is left (`Solver::isLeft`), without
    /// error.
    bool isExact = false;
    bool anyLeft = false;  ///< some of its islands is left to sub-steps
    /// Sub-steps of the island that had most, and of each body, summed up; 0: those that were asked for.
    int mostSubSteps = 0;
    std::uint64_t bodySubSteps = 0;
    DirectReport direct{};

    /// What was left of a batch, and solved with so many sub-steps. @param bodies  in it
    void add(const SolveReport& rest, int subSteps, std::size_t bodies) {
        anyLeft = true;
        colours = std::max(colours, rest.colours);
        speedsLimited += rest.speedsLimited;
        mostSubSteps = std::max(mostSubSteps, subSteps);
        bodySubSteps += bodies * static_cast<std::uint64_t>(subSteps);
        direct.factorisations += rest.direct.factorisations;
        direct.rounds += rest.direct.rounds;
        direct.givenUp += rest.direct.givenUp;
    }
};

}  // namespace swept::inline SWEPT_PRECISION

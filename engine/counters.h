#pragma once

#include <cstdint>

namespace swept {

/// What the last step did. Always on.
struct StepCounters {
    std::uint64_t awakeBodies = 0;   ///< kinematic ones among them, which do not sleep
    std::uint64_t freeBodies = 0;    ///< took their parabola in one step
    std::uint64_t solvedBodies = 0;  ///< went through the sub-stepped solver
    std::uint64_t flyers = 0;        ///< went through the impact loop
    std::uint64_t clashes = 0;       ///< groups of bodies that bounced off each other in flight, without the solver
    std::uint64_t pairsFound = 0;    ///< new pairs of boxes
    std::uint64_t boxTests = 0;
    std::uint64_t contacts = 0;     ///< pairs of shapes whose boxes overlap
    std::uint64_t manifolds = 0;    ///< computed
    std::uint64_t touching = 0;     ///< contacts with points
    std::uint64_t constraints = 0;  ///< contacts and joints solved
    std::uint64_t colours = 0;
    std::uint64_t subSteps = 0;  ///< of the solver
    std::uint64_t bounceRounds = 0;
    std::uint64_t bodySubSteps = 0;     ///< sub-steps of each body, summed: what the solver costs
    std::uint64_t effortClasses = 0;    ///< solves: islands that need the same sub-steps and method are one
    std::uint64_t mostSubSteps = 0;     ///< of any of them
    std::uint64_t bodiesAgain = 0;      ///< solved again, with more sub-steps, since an error budget was missed
    std::uint64_t directBodies = 0;     ///< in islands whose rigid rows are solved all at once
    std::uint64_t settledBodies = 0;    ///< in islands that are right as they are, and only have to be held
    std::uint64_t factorisations = 0;   ///< of what is solved all at once: of each solve, as many as its busiest island
    std::uint64_t directRounds = 0;     ///< in which it was found what presses and what sticks; likewise
    std::uint64_t directGivenUp = 0;    ///< solves in which it was not: left to iteration
    std::uint64_t overPenetration = 0;  ///< contacts deeper than `maxPenetration` when the step began
    std::uint64_t overJointError = 0;   ///< joints farther apart than `maxJointError` when the step began
    std::uint64_t overLostTime = 0;     ///< bodies that lost more than `maxLostTime` in all, and lost some in the step
    std::uint64_t islands = 0;          ///< of bodies that contacts or joints tie together
    std::uint64_t sweeps = 0;           ///< bodies swept for continuous collision
    std::uint64_t toiCalls = 0;
    std::uint64_t toiIterations = 0;
    std::uint64_t sensorSweeps = 0;   ///< pairs of a sensor and what may have passed it, followed through the step
    std::uint64_t impacts = 0;        ///< resolved at their own time
    std::uint64_t aheadContacts = 0;  ///< made ahead, farther than other modes would, by mode `speculative`
    std::uint64_t speedsLimited = 0;  ///< by `maxSpeed`
    std::uint64_t speedsCapped = 0;   ///< bodies slowed by mode `speedLimit`
    std::uint64_t fellAsleep = 0;
    std::uint64_t wokeUp = 0;        ///< in the step, and by calls since the one before
    std::uint64_t putBack = 0;       ///< bodies whose state overflowed: at rest where they were before the step
    std::uint64_t proxiesMoved = 0;  ///< boxes handed to the broadphase anew
};

/// Wall-clock seconds of the stages of the last step; zeros unless `measureStageTimes` is set.
struct StageTimes {
    double pairs = 0;
    double collide = 0;
    double islands = 0;
    double solve = 0;
    double continuous = 0;
    double finish = 0;  ///< boxes, sleep, events
};

}  // namespace swept

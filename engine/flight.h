#pragma once

#include <cstdint>
#include <vector>

#include "../solver/contact_constraint.h"
#include "../toi/time_of_impact.h"
#include "events.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// A static or kinematic shape that a swept shape may meet.
struct FlightObstacle {
    std::uint32_t own = 0;    ///< slot of the swept body's shape
    std::uint32_t other = 0;  ///< slot of the obstacle
    double level = 0;         ///< separation at which the next impact is looked for, metres
    DVec2 lift{};               ///< overlap at the start, undone along the contact normal for the sweep
};

/// What one worker needs for sweeps, and what it found: kept for its capacity, merged after the parallel loop.
struct FlightScratch {
    std::vector<FlightObstacle> obstacles;
    std::vector<std::uint32_t> found;
    std::vector<Vec2> normals;
    std::vector<BodyState> states;
    std::vector<BodyInertia> inertias;
    std::vector<ContactConstraint> constraints;
    std::vector<ContactConstraint*> order;

    std::vector<ContactEvent> events;
    std::vector<LostTimeEntry> lostTime;
    std::vector<ImpactPose> impactPoses;
    std::uint64_t toiCalls = 0;
    std::uint64_t toiIterations = 0;
    std::uint64_t impacts = 0;
    std::uint64_t speedsLimited = 0;
};

/// Integrates the whole step of a flyer: free flight to its first impact, the impact with all contacts of that moment, and
/// on through the remaining time. Touches only the body's own state and the scratch, so flyers may run in any order.
void fly(WorldState& world, std::uint32_t body, double dt, FlightScratch& scratch);

/// Sweeps a body from its start pose of this step to its present pose; at an impact with something static or kinematic it
/// stays there, keeps its velocity (less what it gained by falling in the time it lost), and the rest of the step enters
/// the ledger.
void clampAtImpact(WorldState& world, std::uint32_t body, double dt, LostTimeReason reason, FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION

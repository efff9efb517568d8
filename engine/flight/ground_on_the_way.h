#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;
struct FlightScratch;

/// Into `FastIslands::ground`. @pre roles were given
void listMovingGround(WorldState& world);

/// Where kinematic bodies are while one island advances: at its own time within the step. Only what the island comes
/// near goes with it: there may be thousands of both, and none of it moves what is elsewhere. All that sweeps meet
/// tells itself (`findObstacles`); what contacts and joints know is told.
class GroundOnTheWay {
public:
    GroundOnTheWay(WorldState& world, FlightScratch& scratch);
    GroundOnTheWay(const GroundOnTheWay&) = delete;
    GroundOnTheWay& operator=(const GroundOnTheWay&) = delete;
    ~GroundOnTheWay() { goBack(); }

    /// From here on it goes with the island, if it is one of those. @param slot  of any body
    void meet(std::uint32_t slot);
    /// Where all that was met is at that time of the step, s.
    void goTo(double time);
    /// To the start of the step, and the island meets nothing any more.
    void goBack();
    /// Slots of what was met are added, in order of waking.
    void addMet(std::vector<std::uint32_t>& slots) const;

private:
    void place(std::uint32_t place);

    WorldState& world_;
    FlightScratch& scratch_;
    double time_ = 0;
};

}  // namespace swept::inline SWEPT_PRECISION

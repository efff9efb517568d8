#pragma once

#include <cstdint>
#include <vector>

#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// A bullet, or a dynamic body that one may meet in this step.
struct BulletPartner {
    Flight flight;          ///< while it flies
    Sweep path;             ///< from `pathFrom` to the end of the step
    double pathFrom = 0;    ///< seconds
    double nextImpact = 0;  ///< with something static or kinematic, seconds; infinity: none
    int impacts = 0;
    bool isBullet = false;
    bool flies = false;  ///< else it is on its way by the solver, or rests
    bool tied = false;   ///< to other bodies: it stays on its way, whatever hits it; only its velocity changes
    bool moved = false;  ///< here: what the solver made of its pose is out of date
};

/// Two of them, of which one is a bullet.
struct BulletPair {
    std::uint32_t first = 0;  ///< indices of partners
    std::uint32_t second = 0;
    double time = 0;        ///< of the next impact, seconds; infinity: none
    FlightObstacle shapes;  ///< that meet then: `own` of the second, `other` of the first
    Vec2 carrier{};         ///< normal of a contact that did not bounce: they may sag along it; zero: none
};

struct BulletWork {
    std::vector<std::uint32_t> candidates;
    std::vector<BulletPartner> partners;
    std::vector<BulletPair> pairs;
};

}  // namespace swept::inline SWEPT_PRECISION

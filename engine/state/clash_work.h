#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/aabb.h"
#include "flight_work.h"

namespace swept::inline SWEPT_PRECISION {

/// Two shapes of two bodies of a clash.
struct ClashPair {
    std::uint32_t contact = 0;  ///< index
    std::uint32_t first = 0;    ///< of the bodies: that of the contact's shape A
    std::uint32_t second = 0;
    FlightObstacle shapes{};
    std::array<Real, 2> impulse{};  ///< normal, so far, N·s
    bool isRide = false;            ///< a bullet's, and plastic
    bool isMet = false;             ///< now
    Vec2 normal{};                  ///< of the contact that is met, from first to second, world
    Real deepest = 0;               ///< separation there, metres
};

/// What one worker needs for a clash. Kept for its capacity.
struct alignas(kCacheLine) ClashScratch {
    std::vector<Flight> flights;
    std::vector<Sweep> paths;                ///< by flight: the rest of its step
    std::vector<std::uint8_t> isNearGround;  ///< by flight: something static or kinematic is beside its path
    std::vector<Aabb> hulls;                 ///< by flight, of clashes with bullets: of the way so far
    std::vector<ClashPair> pairs;
    std::vector<ContactConstraint> constraints;
    bool anyRides = false;
    bool anyBullets = false;  ///< among the members
    int impacts = 0;          ///< so far
};

enum class ClashEnd : std::uint8_t {
    none,       ///< this is no such island, or something comes to rest in it, so it is for the solver
    bounced,    ///< all are where they are at the end of the step
    dissolved,  ///< a bullet among them, or what it strikes, may meet somebody else on the way: all fly by themselves
};

}  // namespace swept::inline SWEPT_PRECISION

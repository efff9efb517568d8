#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/aabb.h"
#include "flight.h"

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

/// Every impact looks at all pairs of the clash anew: more bodies are cheaper in the solver.
inline constexpr std::size_t kMostClashing = 8;

enum class ClashEnd : std::uint8_t {
    none,       ///< this is no such island, or something comes to rest in it, so it is for the solver
    bounced,    ///< all are where they are at the end of the step
    dissolved,  ///< a bullet among them, or what it strikes, may meet somebody else on the way: all fly by themselves
};

/// A few bodies that bounce off each other in flight: nothing carries or joins them, so each flies on its own parabola
/// from impact to impact, and what meets at one moment is reflected together. Exact where sub-steps approximate, and
/// cheaper. What meets a bullet without restitution is among them: where the two ride on each other, they take turns at
/// sinking in a little and being set apart, so that a bullet on something that whirls stays on its side. Touches only
/// the state of the bodies, of the contacts, and the scratch, so clashes may go in any order.
/// @param members   slots of dynamic bodies, all of the island
/// @param contacts  indices of the probes of the contacts of the island: of all pairs of members that may meet, and of
/// ground
/// @return unless they bounced, nothing was changed
ClashEnd clash(WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> contacts,
               double dt, FlightScratch& scratch, ClashScratch& work);

}  // namespace swept::inline SWEPT_PRECISION

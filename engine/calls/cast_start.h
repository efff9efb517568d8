#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "../../toi/time_of_impact.h"
#include "../state/world_state.h"

/// How casts of shapes begin. Whatever stands somewhere overlaps what it stands on by a little, or is as near to it as
/// casts stop: it shall be able to look along its ground, and away from it, from where it stands.

namespace swept::inline SWEPT_PRECISION {

/// A polygon that is carried through the world without turning. Coordinates are relative to the start wherever it
/// matters, so that nothing is lost far from the origin.
struct CarriedShape {
    ToiPolygon core;
    Sweep sweep;
    DVec2 way;  ///< metres, as it was asked for: the ends of the sweep are rounded as their place in the world is
    Real extent = 0;
    DVec2 lift{};  ///< from where it was asked for to where the sweep starts, metres
};

CarriedShape carriedFrom(const Polygon& polygon, const WorldTransform& pose, Vec2 translation);

/// How a carried shape stands to another one as it starts.
enum class CastStart : std::uint8_t {
    apart,      ///< they meet later
    leadsPast,  ///< near, or overlapping no deeper than what contacts hold; never nearer along the normal than that
    leadsInto,  ///< likewise, but the way leads into it
    inside,     ///< deeper
};

/// The same with the normal it is judged by, which is also that of the hit: a way from which the part into the normal
/// was taken away leads past, with the roundings of that (`kAlongRoundings`).
struct Stance {
    CastStart start = CastStart::apart;
    DVec2 normal;  ///< unit, out of the other shape, world
    /// Metres along it, negative: so far off. As it starts, or, where only that tells which normal it is pressed
    /// against, a bit farther on. Of several the one that is deepest counts: that is the ground, not the edge beside a
    /// seam. Apart: 0.
    double depth = 0;
};

/// Where the carried shape meets another one, up to that fraction of its way, or as it starts.
Toi castOf(const WorldState& world, const Shape& shape, const CarriedShape& carried, double limit);
/// @param toi  of the two, a hit or an overlap
Stance stanceOf(const WorldState& world, const Shape& shape, const CarriedShape& carried, const Toi& toi);
/// Out of what it starts inside of: the shortest translation, metres, along the direction of least penetration.
DVec2 wayOut(const CarriedShape& carried, const Toi& toi);

/// What the carried shape is near as it starts, and its way does not lead into.
struct Support {
    std::uint32_t slot = 0;
    DVec2 normal;           ///< unit, out of it, world
    double missing = 0;     ///< to the clearance along the normal, metres
    bool isPassed = false;  ///< the way leads along it or away: the two never get nearer than they are
};
std::optional<Support> supportOf(const WorldState& world, std::uint32_t slot, const CarriedShape& carried);

/// Sets the start off its supports by a little more than the separation at which casts stop. Else what is flush with
/// the ground would stop it a bit farther on: the next segment of a chain, the next tile. In the order of the slots.
void lift(CarriedShape& carried, std::vector<Support>& supports);

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <vector>

#include "../../solver/direct/cone_balance.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// A point of a contact in an island whose balance is sought.
struct LoadPoint {
    std::uint32_t contact = 0;
    std::uint32_t carried = 0;  ///< slot of the body that it holds up
    std::uint32_t carrier = 0;  ///< of the one that takes its weight; `kNoIndex`: static
    std::uint8_t point = 0;     ///< of the manifold
    bool isAtSide = false;      ///< pushes against gravity hardly or not at all
    bool isOverlapped = false;  ///< has to press
    double friction = 0;
    DVec2 normal{};        ///< along which it pushes the carried body
    DVec2 tangent{};       ///< a positive tangential impulse does
    DVec2 armOfCarried{};  ///< from the centre of mass
    DVec2 armOfCarrier{};
    double push = 0;  ///< over the whole step, N·s
    double drag = 0;
};

/// Kept for its capacity.
struct LoadPaths {
    std::vector<LoadPoint> points;
    std::vector<LoadPoint> spare;
    std::vector<Wrench> loads;          ///< by slot: of the pulls and of what was handed down; torques over no lever
    std::vector<std::uint32_t> places;  ///< by slot: among `WorldState::tied`
    std::vector<std::uint32_t> firstPoint;  ///< by place: of those that carry it
    std::vector<std::uint32_t> waiting;     ///< by slot: points that hand something down to it, and did not yet
    std::vector<std::uint32_t> ready;       ///< slots, in the order in which loads are handed down
    ConeBalance balance;
};

/// Room for as many points as there may be, where a search may begin: the first one comes long after all else is warm.
void makeRoomForLoads(WorldState& world);

/// Gives the contacts of what is still, but not in balance, impulses that are: from the top down each body is held by
/// the points below it, which are changed as little as that takes (`ConeBalance`), and hands its load, with all that
/// lies on it, to the bodies there; the ground takes what arrives. One pass does for any height, where iteration takes
/// as many as its square: a pile that begins at rest is in balance before it moves. Points at the side keep what they
/// have, unless a body needs those against the ground. Where a body cannot be held so, its island stays as it is, and
/// is sought for again after a pause that grows.
/// @pre `IslandRest::isSought` of the islands that are meant. @return whether any was changed; those that were not are
/// sought no longer
bool handLoadsDown(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <vector>

#include "../../solver/direct/cone_balance.h"

namespace swept::inline SWEPT_PRECISION {

/// A point of a contact in an island whose balance is sought.
struct LoadPoint {
    std::uint32_t contact = 0;
    std::uint32_t carried = 0;  ///< slot of the body that it holds up
    std::uint32_t carrier = 0;  ///< of the one that takes its weight; `kNoIndex`: static
    std::uint8_t point = 0;     ///< of the manifold
    bool isAtSide = false;      ///< pushes against gravity hardly or not at all
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

}  // namespace swept::inline SWEPT_PRECISION

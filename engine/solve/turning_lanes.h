#pragma once

#include <bit>
#include <span>

#include "../../solver/contacts/contact_rows.h"
#include "../../solver/contacts/contact_store.h"
#include "turning_ground.h"

/// Contacts on ground that turns, as they are laid into a block.

namespace swept::inline SWEPT_PRECISION {

/// Calls `visit(lane)` for each bit.
template <class Visit>
void forEachLane(std::uint32_t lanes, const Visit& visit) {
    for (; lanes != 0; lanes &= lanes - 1) { visit(static_cast<std::size_t>(std::countr_zero(lanes))); }
}

/// @return one bit per lane: it is on ground that turns. @pre masses are in the block
template <std::size_t kPoints>
std::uint32_t lanesOnTurning(const SolveDesk& desk, const WideContact<kPoints>& block,
                             std::span<const ContactLink> links) {
    std::uint32_t lanes = 0;
    if (desk.groundTurns.empty()) { return lanes; }
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        if (block.inverseMassA[lane] > 0 && block.inverseMassB[lane] > 0) { continue; }
        lanes |= (anyTurns(desk, links[lane].slotA, links[lane].slotB) ? 1U : 0U) << lane;
    }
    return lanes;
}

/// Before the block is filled.
inline void turnLanes(std::uint32_t lanes, const SolveDesk& desk, std::span<const ContactLink> links,
                      ContactSources& from) {
    forEachLane(lanes, [&](std::size_t lane) {
        const ContactFrame frame = turned({.rotation = {from.rotationC[lane], from.rotationS[lane]},
                                           .localCenterA = {from.localCenterX[lane], from.localCenterY[lane]},
                                           .fromAToB = {from.fromAToBX[lane], from.fromAToBY[lane]}},
                                          groundTurnOf(desk, links[lane].slotA, links[lane].slotB));
        from.rotationC[lane] = frame.rotation.c;
        from.rotationS[lane] = frame.rotation.s;
        from.localCenterX[lane] = frame.localCenterA.x;
        from.localCenterY[lane] = frame.localCenterA.y;
        from.fromAToBX[lane] = frame.fromAToB.x;
        from.fromAToBY[lane] = frame.fromAToB.y;
    });
}

/// After the block is filled.
template <std::size_t kPoints>
void setTurningRadii(std::uint32_t lanes, const WorldState& world, const TiedGroup& group,
                     std::span<const ContactLink> links, WideContact<kPoints>& block) {
    forEachLane(lanes, [&](std::size_t lane) {
        const WideContactPoint& point = block.points[0];
        const ContactRadii radii = radiiOnTurning(world, group, links[lane], {block.normalX[lane], block.normalY[lane]},
                                                  point.tangentArmA[lane], point.tangentArmB[lane]);
        block.radiusA[lane] = radii.a;
        block.radiusB[lane] = radii.b;
    });
}

}  // namespace swept::inline SWEPT_PRECISION

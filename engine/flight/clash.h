#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "../state/clash_work.h"

namespace swept::inline SWEPT_PRECISION {

/// Every impact looks at all pairs of the clash anew: more bodies are cheaper in the solver.
inline constexpr std::size_t kMostClashing = 8;

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

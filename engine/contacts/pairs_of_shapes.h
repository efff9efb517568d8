#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/function_ref.h"
#include "../events.h"
#include "../state/contact.h"

namespace swept::inline SWEPT_PRECISION {

struct Joint;
struct WorldState;

/// Between steps: `found` becomes the places of the pairs for which `isMeant` is true, ascending. Several threads may
/// ask at once.
/// @param shapes  slots of one body, of which each pair that is meant has one
void findPairsOf(WorldState& world, std::span<const std::uint32_t> shapes,
                 FunctionRef<bool(const ContactPair&)> isMeant, std::vector<std::uint32_t>& found);
/// Likewise, by one thread. Valid until the next question.
std::span<const std::uint32_t> pairsOf(WorldState& world, std::span<const std::uint32_t> shapes,
                                       FunctionRef<bool(const ContactPair&)> isMeant);
/// The slots that a shape of the user's has: of a chain, one for each segment.
void listSlots(const WorldState& world, std::uint32_t head, std::vector<std::uint32_t>& slots);
/// Likewise all pairs of such a shape. @param slots  all that it has
void findPairsOfShape(WorldState& world, std::span<const std::uint32_t> slots, std::vector<std::uint32_t>& found);
std::span<const std::uint32_t> pairsOfShape(WorldState& world, std::span<const std::uint32_t> slots);
/// Likewise all between the bodies that a joint keeps apart, but for those of sensors.
std::span<const std::uint32_t> pairsBetween(WorldState& world, const Joint& joint);
/// @return nothing where the place is that of a candidate: these follow all contacts
ContactProbe* probeAt(WorldState& world, std::size_t place);
/// Wakes whom the body touches in one of these pairs.
void wakeAcross(WorldState& world, std::uint32_t body, std::span<const std::uint32_t> places);
/// Removes these pairs, and reports the end of those that touched.
void removePairs(WorldState& world, std::span<const std::uint32_t> places);
/// Contacts of a body that is put elsewhere, or leaves, say nothing any more; what rested on it, or is joined, wakes.
void dropContacts(WorldState& world, std::uint32_t body);
/// Of a contact that is about to be dropped: its end, if it touches.
void reportEnd(const WorldState& world, const ContactProbe& probe, std::vector<ContactEvent>& events);
/// As a step begins, or before anything else gives pairs other places: what stays moves up, in its order (who comes
/// first is solved first), and who asks next looks anew. Nobody may hold on to places then.
void closeUpPairs(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Where what holds bodies together cannot all hold: joints that keep two bodies deep in each other while their contact
/// pushes them apart, or two joints between the same two bodies that do not agree. Where joints are solved as if they
/// could not give way, what pushes against them goes off within a step. (A rope of links whose first hinge was in the
/// middle of a ball, with the second link inside of it, had gaps of metres; two links on two hinges that were off by a
/// millimetre were thrown by a hundred metres from a lift.) So such contacts and joints take turns, or are iterated:
/// those give way.

/// Into `IslandLoad::isContradicted`, of what no joint ties to the ground: what is tied to it is never solved so.
/// @pre loads are added up
void noteContradictions(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include "../../shapes/real.h"

/// A heavy body that falls on a light one squeezes it against the ground. Iteration passes the blow on by the light
/// body a part at a time, and what it carries over from one sub-step to the next throws the heavy one back: by 0.2 to
/// 0.3 of its speed at 7 : 1, without restitution, however short the step. More passes of relaxation in the few steps
/// of a blow take that away: each leaves R/(R + 1) of it at masses R : 1.

namespace swept::inline SWEPT_PRECISION {

struct Contact;
struct IslandLoad;
struct WorldState;

/// The fastest that points of a contact close in on each other along its normal, m/s, of those that may meet within the
/// step; at least 0.
Real closingSpeedOf(const WorldState& world, const Contact& contact, Real dt);

/// Whether blows are to be looked for in an island (`IslandLoad::mayBeStruck`): few loose bodies of different masses
/// that are iterated, some of them fast. One that was struck in the last step still carries over what that took.
/// @pre its effort is known
void expectBlows(IslandLoad& load, double gravity);

/// Gives islands in which something that is struck in this step is squeezed more passes (`Stir`).
/// @pre blows are expected, of all islands that touch something
void markStruckIslands(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION

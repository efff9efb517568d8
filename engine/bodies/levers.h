#pragma once

#include "../state/joint.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// What a joint holds by an anchor at distance L from its centre of mass turns about that anchor with I + m·L². To turn
/// it about its centre takes m·L²/I times less, and so it is for whatever a solve leaves of an impulse along the lever:
/// rounding, what a direct solve gives way, what the lever turned since. Where that factor is too large, bodies spin by
/// nothing else, and hinges gave energy without end (in float from a thousand radii on; in double from a few thousand).
/// So a body resists turns with a share of m·L² where its own inertia is less: with 2⁻¹⁷ of it in float, which levers
/// of more than 256 radii of a disc have, and in double with 2⁻²⁰, from 724 radii on. About its anchor that is no more
/// of a difference.

/// From the inertia and the joints of a body: what the step turns it with (`Body::inverseInertia`).
/// @pre it has its mass, inertia and centre
void resistTurns(WorldState& world, std::uint32_t body);
/// The same where a joint came to a body, without a look at its others.
void resistTurns(WorldState& world, std::uint32_t body, const Joint& joint);
/// Whether a lever, not the body's own inertia, decides.
bool isAtLever(const Body& body);

}  // namespace swept::inline SWEPT_PRECISION

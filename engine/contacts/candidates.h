#pragma once

#include "../state/world_state.h"

/// Pairs of dynamic bodies that were never near (`WorldState::candidates`): few of them ever become contacts.

namespace swept::inline SWEPT_PRECISION {

/// Candidates that came near become contacts.
void promoteCandidates(WorldState& world);
/// Closes the gaps that these left, and those whose boxes came apart, which are gone: not yet before, since others may
/// look at contacts meanwhile.
void closeCandidates(WorldState& world);
/// Those that are meant become contacts, without points until the next step looks at them.
void promoteCandidatesOf(WorldState& world, FunctionRef<bool(const ContactPair&)> isMeant);

}  // namespace swept::inline SWEPT_PRECISION

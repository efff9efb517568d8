#pragma once

#include <algorithm>

#include "../state/body.h"
#include "../state/contact.h"
#include "../state/no_index.h"
#include "../state/tolerances.h"

/// What contacts carry from one sub-step to the next, as its length changes.

namespace swept::inline SWEPT_PRECISION {

/// Impulses under what moves grow no more than so many times at once: what was pressed in two short steps may still
/// have been a blow.
inline constexpr Real kMostGrowth = 4;

/// Whether nothing struck it: it is still, or fell asleep by itself. (What a call puts to sleep may be in the middle of
/// a blow.)
inline bool wasStill(const Body& body) {
    const bool isTired = !body.awake && body.restSteps >= kRestSteps;
    return isTired || body.soughtSteps > 0 || body.heldIn != kNoIndex;
}

/// @return there is no blow in its impulses
inline bool wasStill(const Contact& contact, const Body& a, const Body& b) {
    return (contact.dynamicA && wasStill(a)) || (contact.dynamicB && wasStill(b));
}

/// @param factor     of the length of the sub-steps
/// @param isCarried  what it has is what it carried in a longer step before, if it was pressed in several
inline void scaleToSubStep(Contact& contact, Real factor, bool wasStill, bool isCarried = false) {
    const bool mayBeBlow = factor > 1 && !wasStill && !(isCarried && contact.pressedOn);
    const Real own = mayBeBlow ? (contact.pressedOn ? std::min(factor, kMostGrowth) : Real(1)) : factor;
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact.manifold.count); ++k) {
        contact.normalImpulse[k] *= own;
        contact.tangentImpulse[k] *= own;
    }
    if (contact.rolls()) { contact.rollingImpulse() *= own; }
}

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cmath>

#include "../state/body.h"

/// What a body is like as a whole, when it rolls, or is thrown.

namespace swept::inline SWEPT_PRECISION {

/// Of solid shapes, all of them: a circle about the centre of mass.
inline bool isRound(const Body& body) { return body.extent >= (2 - 8 * kEpsilon) * body.radius; }

/// Radians in a solve, or from one piece to the next, beyond which ground is no curve to it any more, but a corner.
inline constexpr Real kMostCurve = Real(1) / 4;

/// Radius of gyration, metres; 0 of what does not turn.
inline Real gyrationOf(const Body& body) {
    return body.inverseMass > 0 && body.inverseInertia > 0 ? std::sqrt(body.inverseMass / body.inverseInertia)
                                                           : Real(0);
}

/// Cuts a speed or a way, of the centre or of a turn, to a length. @return whether it was too long
inline bool shortenTo(Vec2& vector, Real most) {
    const Real size = length(vector);
    if (!(size > most)) { return false; }
    vector = (most / size) * vector;
    return true;
}
inline bool shortenTo(Real& number, Real most) {
    if (!(std::fabs(number) > most)) { return false; }
    number = std::copysign(most, number);
    return true;
}

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <array>

#include "../../solver/body_state.h"

namespace swept::inline SWEPT_PRECISION {

/// A point of a body that is too low.
struct LowPoint {
    Real arm = 0;    ///< cross(point − centre, normal), metres
    Real depth = 0;  ///< below where it is to be, metres; negative: above
};

/// A small displacement.
struct SetBack {
    Real along = 0;  ///< of the centre along the normal, metres
    Real turn = 0;   ///< radians
    Real arm = 0;    ///< that the push has whose turn was left out, metres; else 0
};

/// What a displacement costs, and what pays for it.
struct SetBackEnergy {
    Real pull = 0;      ///< acceleration of the body against the normal, m/s²
    Real velocity = 0;  ///< of its centre along the normal, relative to what it stands on, m/s
    Real spin = 0;      ///< rad/s
};

/// The displacement that raises two points (of one point: twice the same) to where they are to be, as impulses along
/// the normal would: of all that do, the least one by the inertia of the body. What a body fell through while nothing
/// held it is paid back so with the energy that the stop of its fall took, and no more; raised without a turn, a box on
/// one of its corners would gain height with every step.
/// @param radius  of the body about its centre, metres. No sweep sees what its turn does to the rest of it: where some
///                point would move many times as far by it as the lower one is deep, as of a heavy head on a long
///                lever, which turns in place, the body is raised without a turn.
SetBack setBackOf(const std::array<LowPoint, 2>& points, const BodyInertia& inertia, Real radius);

/// What is left of the speed that the points approach with, as a share, when that has paid for the height that the body
/// gains. What bounced with the whole of it would gain energy.
Real speedLeft(const SetBack& back, const SetBackEnergy& energy, const BodyInertia& inertia);

}  // namespace swept::inline SWEPT_PRECISION

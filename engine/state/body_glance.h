#pragma once

#include <algorithm>
#include <limits>

#include "../../shapes/vec2.h"
#include "body.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {

/// What contacts look at first of their bodies, as the stage of contacts began (travel.h).
struct alignas(kLineOfFloats) BodyGlance {
    DVec2 center{};
    double turned = std::numeric_limits<double>::infinity();  ///< `BodyTravel::turned`
    Real ahead = 0;                                           ///< how far its contacts reach, metres
    Real motion = -1;  ///< `motionBound`, metres; negative while the body is static or asleep
    Real reach =
        std::numeric_limits<Real>::infinity();  ///< none of its contact points is farther from the centre, metres
    // Of a dynamic body that is awake, as the stage of contacts began:
    bool isFast = false;     ///< `Body::fast`; of others, never
    bool isStirred = false;  ///< contacts reach ahead of it, though it may rest (stirred.h)
    Vec2 velocity{};
    Vec2 pull{};      ///< its acceleration without contacts and joints
    Real swing = 0;   ///< no point moves faster about the centre of mass, m/s
    Real widest = 0;  ///< `Body::widest`

    /// As the stage of contacts began.
    bool isAwake() const { return !(motion < 0); }
};

/// The motion by which contacts reach ahead of a body that moves by `motion`, metres: farther than that of what is
/// about to be struck (stirred.h). @param widest  `Body::widest`
inline Real reachMotion(Real motion, bool isStirred, Real widest) {
    return isStirred ? std::max(motion, kStirRatio * widest) : motion;
}
/// Of one that is awake.
inline Real reachMotion(const BodyGlance& glance) {
    return reachMotion(glance.motion, glance.isStirred, glance.widest);
}

/// How far any point of a body has turned about its centre since it was made, and the angle at which that was counted
/// last.
struct BodyTravel {
    double angle = 0;
    double turned = 0;    ///< metres, rounded up
    Real boxMotion = -1;  ///< of which its boxes were made last: `motionBound`, or more
    /// Its needed boxes hold it wherever it gets from there by moving and turning less than `boxRoom`, metres.
    double boxRoom = 0;
    DVec2 boxCenter{};
    double boxAngle = 0;
};

}  // namespace swept::inline SWEPT_PRECISION

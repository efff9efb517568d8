#pragma once

#include <algorithm>

#include "contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// What one point asks for now: its relative velocity along the normal to grow by `speed`, as firmly as the scales say.
struct NormalDemand {
    bool any = false;
    Real speed = 0;
    Real massScale = 1;
    Real impulseScale = 0;

    /// Of the impulse at a point, by itself. @param mass  impulse per speed, kg
    Real changeAt(const ContactConstraintPoint& point, Real mass) const {
        return mass * massScale * speed - impulseScale * point.normalImpulse;
    }
};

/// @param closing     speed at which the point closes, m/s. @pre its separation is the present one
/// @param mass        impulse per speed, kg
/// @param isCarrying  whether a relaxation may go on with the point: it starts no contact
/// @param pushShare   of the speed at which an overlap is pushed out
inline NormalDemand demandOf(const ContactConstraint& contact, const ContactConstraintPoint& point, Real mass,
                             Real closing, Real inverseH, bool useBias, bool isCarrying, Real pushShare = 1) {
    const Real separation = point.separation;
    // Relaxation stops nothing that is to bounce: it must arrive in the next sub-step with its speed.
    if (!useBias && closing > contact.bounceSpeed) { return {}; }
    // Its overlap or gap is the direct solver's: see `DirectSolver::project`.
    if (contact.isHeld && (point.normalImpulse > 0 || !(separation > 0))) { return {true, closing}; }
    if (separation > 0) {
        if (!useBias && !isCarrying) { return {}; }
        return {true, closing - separation * inverseH};  // apart: may close the gap within this sub-step, no more
    }
    if (!useBias) { return {true, closing}; }
    const Softness& softness = contact.softness;
    const Real bias = pushShare * (softness.biasRate * separation);
    const Real fastest = -(pushShare * contact.maxPushSpeed);
    // What an impact still pushes apart has only its speed bounded.
    if (!(closing > fastest)) {
        return {true, closing - std::max(bias, fastest), softness.massScale, softness.impulseScale};
    }
    // The speed out of an overlap is bounded, the load that the overlap bears is not: else whatever is pressed harder
    // than a light body can push back in a sub-step would sink through it, at a steady pace.
    const bool isTooFast = mass * softness.massScale * (fastest - bias) > softness.impulseScale * point.normalImpulse;
    if (isTooFast) { return {true, closing - fastest, softness.massScale, 0}; }
    return {true, closing - bias, softness.massScale, softness.impulseScale};
}

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <algorithm>
#include <cmath>

#include "joint_constraint.h"
#include "limit_pace.h"
#include "point_constraint.h"

/// Limits, motors and springs: what drives the one direction that a joint leaves free.

namespace swept::inline SWEPT_PRECISION {

/// One side of a pair of limits, whose impulse only pushes. @param room  what is left before the limit, negative beyond
/// it
/// @param speed  at which the room grows, less the limit's own; @return change of the accumulated impulse
inline Real limitChange(JointPass pass, Real mass, Real speed, Real room, Real accumulated) {
    Real change = 0;
    if (room > 0) {
        change = -mass * (speed + room / pass.h);  // may reach the limit within this sub-step, no more
    } else {
        change = scalarChange(mass, speed, pass.useBias ? room : Real(0), accumulated,
                              pass.useBias ? pass.softness : kRigid);
    }
    return std::max(accumulated + change, Real(0)) - accumulated;
}

/// Towards a speed, with limited impulse; the change of the accumulated one.
inline Real motorChange(Real mass, Real speed, Real wantedSpeed, Real accumulated, Real maxImpulse) {
    return std::clamp(accumulated - mass * (speed - wantedSpeed), -maxImpulse, maxImpulse) - accumulated;
}

/// The fastest approach that ends in time. @param acceleration  that there is to brake with
inline Real approachSpeed(Real distance, Real rate, Real acceleration) {
    return std::min(rate * distance, std::sqrt(2 * acceleration * distance));
}

/// Limits, motor and spring of one free direction of a joint: an angle or a translation.
struct FreedomParts {
    Real lower = 0;  ///< rad or metres, at the start of the sub-step; from its motion on at the end
    Real upper = 0;
    LimitMotion motion;
    Real motorSpeed = 0;       ///< rad/s or m/s
    Real maxMotorImpulse = 0;  ///< maximum torque or force times sub-step
    SpringGains spring;        ///< towards 0
    bool hasLimits = false;
    bool hasMotor = false;
    bool hasSpring = false;
    bool isGliding = false;  ///< the limits move
    /// Accumulated; warm start in, result out. N·s or N·m·s per sub-step. That of the spring is made anew by each warm
    /// start, but what is held holds an answer to the old one, and has to know it.
    Real lowerImpulse = 0;
    Real upperImpulse = 0;
    Real motorImpulse = 0;
    Real springImpulse = 0;

    constexpr Real impulse() const { return springImpulse + motorImpulse + lowerImpulse - upperImpulse; }
};

constexpr void dropUnused(FreedomParts& parts) {
    if (!parts.hasMotor) { parts.motorImpulse = 0; }
    if (!parts.hasLimits) { parts.lowerImpulse = parts.upperImpulse = 0; }
    if (!parts.hasSpring) { parts.springImpulse = 0; }
}

/// The spring's push, at the start of a sub-step: part of warm starting, where it takes the place of an old impulse.
constexpr void pushSpring(FreedomParts& parts, Real mass, Real place) {
    parts.springImpulse = parts.hasSpring ? -mass * (parts.spring.push * place) : Real(0);
}

/// The direction that a joint leaves free, as it is in a sub-step.
struct FreeDirection {
    Real mass = 0;   ///< impulse per speed; 0: nothing to move
    Real place = 0;  ///< rad or metres along it
};

/// Limits, one after the other. @tparam kGlide  they move
template <bool kGlide, class SpeedNow, class Push>
void solveLimits(FreedomParts& parts, FreeDirection free, JointPass pass, SpeedNow&& speed, Push&& push) {
    const LimitPace asked = kGlide ? parts.motion.asked(pass.useBias) : LimitPace{};
    const Real lower =
        limitChange(pass, free.mass, speed() - asked.lower, free.place - parts.lower, parts.lowerImpulse);
    parts.lowerImpulse += lower;
    push(lower);
    const Real upper =
        limitChange(pass, free.mass, -(speed() - asked.upper), parts.upper - free.place, parts.upperImpulse);
    parts.upperImpulse += upper;
    push(-upper);
}

/// Drag of the spring, motor and limits in this order: limits have the last word. @param speed  the present one, called
/// anew for each
/// @param push  applies an impulse
template <class SpeedNow, class Push>
void solveFreedom(FreedomParts& parts, FreeDirection free, JointPass pass, SpeedNow&& speed, Push&& push) {
    if (!(free.mass > 0)) { return; }       // nothing to move; and 0 times the room of a limit at infinity is no number
    if (parts.hasSpring && pass.useBias) {  // once per sub-step
        const Real change = dragChange(parts.spring, parts.springImpulse, free.mass * speed());
        parts.springImpulse += change;
        push(change);
    }
    if (parts.hasMotor && pass.drives) {
        const Real change =
            motorChange(free.mass, speed(), parts.motorSpeed, parts.motorImpulse, parts.maxMotorImpulse);
        parts.motorImpulse += change;
        push(change);
    }
    if (!parts.hasLimits) { return; }
    if (parts.isGliding) [[unlikely]] {
        solveLimits<true>(parts, free, pass, speed, push);
    } else {
        solveLimits<false>(parts, free, pass, speed, push);
    }
}

}  // namespace swept::inline SWEPT_PRECISION

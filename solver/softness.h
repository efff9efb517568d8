#pragma once

#include <numbers>

#include "../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

inline constexpr Real kTwoPi = static_cast<Real>(2 * std::numbers::pi);

/// A constraint as a damped spring, integrated implicitly over one sub-step (Catto, "Soft Constraints", GDC 2011): the
/// bias velocity is biasRate·C, the effective mass is scaled, and a part of the accumulated impulse is given back.
struct Softness {
    Real biasRate = 0;  ///< 1/s
    Real massScale = 1;
    Real impulseScale = 0;
};

inline constexpr Softness kRigid{};

/// @param angularFrequency  2π·hertz, rad/s, greater than 0
/// @param dampingRatio      at least 0
/// @param h                 length of the sub-step, s
constexpr Softness softnessOf(Real angularFrequency, Real dampingRatio, Real h) {
    const Real a1 = 2 * dampingRatio + h * angularFrequency;
    const Real a2 = h * angularFrequency * a1;
    const Real a3 = 1 / (1 + a2);
    return {angularFrequency / a1, a2 * a3, a3};
}

/// Stiffness that follows the sub-step rate: `cycles` oscillations a sub-step, at most a quarter, the stiffest spring
/// that one sub-step still samples well. The error of resting scenes then falls with the square of the number of
/// sub-steps.
/// @param closing  s, at least h: the sub-step whose rate it follows
/// @param h        of the sub-step in which it acts, s
constexpr Softness softnessOfSubStep(Real cycles, Real dampingRatio, Real closing, Real h) {
    return softnessOf(kTwoPi * cycles / closing, dampingRatio, h);
}
constexpr Softness softnessOfSubStep(Real cycles, Real dampingRatio, Real h) {
    return softnessOfSubStep(cycles, dampingRatio, h, h);
}

/// How far such a spring gives way at rest, metres.
/// @param impulse   that it has to give in each sub-step, N·s
/// @param response  of its point to an impulse, 1/kg
constexpr Real giveOfSubStep(Real cycles, Real h, Real impulse, Real response) {
    return impulse * response * h / ((kTwoPi * cycles) * (kTwoPi * cycles));
}

/// A spring that a user gave, over one sub-step, in two parts: at its start a push of `push`·C, a force that is known
/// before anything is solved, and within the solve a drag that takes the part `drag` of the velocity that there is
/// then, and gives the part `lag` of the push once more. (Warm-started with the impulse of the sub-step before, eight
/// stiff springs at one body fed on each other.)
///
/// With θ = ω·h and D = (1 + ζθ)² the step (x, v) → (x + h·v₁, v₁), v₁ = (v − h·ω²·x)/D, has determinant 1/D: an
/// undamped spring is symplectic and keeps its amplitude for ever (implicit Euler takes e^(−ωθ·t/2) from it), a
/// critical one has the double root 1/(1 + θ), and a load at rest is carried with the exact deflection. Frequency and
/// decay are right to ζθ/2 and θ²/24. The push is all of h·ω²·x, however damped: with what it carries at rest nothing
/// moves before the drag either, and what lies on a sprung body, or hangs from it, does not take for motion what the
/// drag will end. (Of a push of h·ω²·x/D the rest came with the drag: a crate of 2 kg beside one of 5 t on a platform
/// with ζ = 1 sank in by 56 mm in profile `fast`.)
///
/// An explicit force needs θ² < 4 over all springs that pull at a body: what is stiffer than `kUndampedPhase` is damped
/// by D = (1 + ζθ)² + b, b = θ² − kUndampedPhase², close to implicit Euler, and what is stiffer than `kStiffestPhase`
/// is not made any stiffer. Of those, and of the strongly damped (`kPushedLoss`), h·ω²·x/(1 + c) is pushed, c ≥ b.
struct SpringGains {
    Real push = 0;  ///< 1/s
    Real drag = 0;  ///< 0 … 1: 1 − 1/D
    Real lag = 0;   ///< 0 … 1: c/D
};

/// Radians of oscillation in a sub-step up to which a spring is undamped unless it is told otherwise: 25 sub-steps a
/// period (38 Hz at 960 sub-steps a second). Its square leaves room for 64 such springs at one body.
inline constexpr Real kUndampedPhase = Real(1) / 4;
/// A load g then rests h²·g beside its place, 10 µm at 960 sub-steps a second on earth.
inline constexpr Real kStiffestPhase = 1;
/// More strongly damped is the same: no speed is left.
inline constexpr Real kStrongestDamping = 65536;

/// What damping alone adds to D, up to which all is pushed. Springs that drag a multiple of the speed feed on each
/// other's pushes: of 300 grids of soft welds with a damping ratio up to 16 12 had more than 1.5 times their energy
/// without this bound, in profile `fast`.
inline constexpr Real kPushedLoss = Real(1) / 2;

/// c. @param ofDamping  (1 + ζθ)² − 1
/// @param beyond  b
constexpr Real heldBack(Real ofDamping, Real beyond) {
    return ofDamping > kPushedLoss ? beyond + (ofDamping - kPushedLoss) : beyond;
}

/// @param angularFrequency  2π·hertz, rad/s, greater than 0
/// @param dampingRatio      at least 0
/// @param h                 length of the sub-step, s
constexpr SpringGains springGainsOf(Real angularFrequency, Real dampingRatio, Real h) {
    const Real phase = angularFrequency * h < kStiffestPhase ? angularFrequency * h : kStiffestPhase;
    const Real damped = dampingRatio * phase < kStrongestDamping ? dampingRatio * phase : kStrongestDamping;
    const Real beyond = phase > kUndampedPhase ? phase * phase - kUndampedPhase * kUndampedPhase : Real(0);
    const Real ofDamping = damped * (2 + damped);
    const Real held = heldBack(ofDamping, beyond);
    const Real whole = 1 + (ofDamping + beyond);
    return {phase * phase / ((1 + held) * h), (ofDamping + beyond) / whole, held / whole};
}

/// A spring that turns with its joint: of fixed stiffness. What hangs on it may weigh less and less as its arms turn,
/// and where the stiffness followed that, at a fixed frequency, springs fed energy to what whirled on them without end
/// (of 200 pairs on undamped soft welds, thrown without gravity, half had 7800 times as much after a minute).
struct TurningSpring {
    Real stiffness = 0;  ///< kg: that of the spring, N/m, times the square of a sub-step
    Real loss = 0;       ///< D − 1 of its damping ratio alone
    Real rate = 0;       ///< of sub-steps, 1/s
};

/// @param mass  with which it has its frequency, kg
constexpr TurningSpring turningSpringOf(Real angularFrequency, Real dampingRatio, Real h, Real mass) {
    const Real phase = angularFrequency * h < kStiffestPhase ? angularFrequency * h : kStiffestPhase;
    const Real damped = dampingRatio * phase < kStrongestDamping ? dampingRatio * phase : kStrongestDamping;
    return {mass * (phase * phase), damped * (2 + damped), 1 / h};
}

/// As `springGainsOf`. @param phaseSquared  θ² with what moves now
constexpr SpringGains gainsAt(const TurningSpring& spring, Real phaseSquared) {
    constexpr Real kUndamped = kUndampedPhase * kUndampedPhase;
    const Real beyond = phaseSquared > kUndamped ? phaseSquared - kUndamped : Real(0);
    const Real held = heldBack(spring.loss, beyond);
    const Real whole = 1 + (spring.loss + beyond);
    return {phaseSquared * spring.rate / (1 + held), (spring.loss + beyond) / whole, held / whole};
}

/// What the drag changes of the impulse of a spring. @param pushed  of its push
/// @param motion  mass times velocity now
template <class Impulse>
constexpr Impulse dragChange(const SpringGains& gains, Impulse pushed, Impulse motion) {
    return gains.lag * pushed - gains.drag * motion;
}

/// @param response  speed per impulse of what moves now, 1/kg
constexpr Real phaseSquaredAt(const TurningSpring& spring, Real response) {
    constexpr Real kStiffest = kStiffestPhase * kStiffestPhase;
    const Real phaseSquared = spring.stiffness * response;
    return phaseSquared < kStiffest ? phaseSquared : kStiffest;
}

/// Half of what a joint can take: the two points of a wide flat contact push on each other through its rotation, and
/// with a quarter a stack of twenty planks of 37:1 never came to rest.
inline constexpr Real kContactCycles = Real(1) / 8;
inline constexpr Real kJointCycles = Real(1) / 4;
/// Strongly overdamped: a contact must push out without bouncing.
inline constexpr Real kContactDampingRatio = 10;
inline constexpr Real kJointDampingRatio = 2;

/// How soft the point of a hinge is between two bodies that can be moved, while its motor has the speed that it wants:
/// in units of what it is else, this part of the ratio of their masses, at least 1 and no more than `kMostMotorGive`.
/// Of two hinges with brakes the one on the ground, which comes last in order, fed the gap of the other from 6 : 1 on
/// in profile `fast`, where that was as stiff as any. (A motor at its limit is a force, and ragdolls whose joints have
/// friction had three times the gaps with points that were four times as soft in any case.)
inline constexpr Real kMotorGive = Real(1) / 2;
inline constexpr Real kMostMotorGive = 8;

/// What motor joints that seek a pose give way by under a load, in units of what welds do, where other joints hold
/// their bodies as well. Without that, chains of them fed on their own error where they are iterated: in profile `fast`
/// three equal bars end to end whirled with 200 m/s. (By half of it two bars did with one ten times as heavy.)
inline constexpr Real kDriveGive = 2;

}  // namespace swept::inline SWEPT_PRECISION

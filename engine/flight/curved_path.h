#pragma once

#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// Ground that curves is made of flat pieces. What flies along it (in a pipe, overhead, nothing carries it) meets each
/// of them at the angle θ between it and the one before, without bouncing, which takes ½mv²θ²; round a pipe that is
/// most of its energy soon. What is round gets that back: what it lost to the turn of the ground since it met it last,
/// in this step or the one before, and did not leave it; not what it lost to falling on it. It never has more than
/// before.

/// After an impact. Remembers where the flyer is, for the next one.
/// @param before   its velocity then, m/s
/// @param setBack  how far it was set back out of ground, metres: the lift is paid for
/// @pre the separations of `FlightScratch::constraints` are those of the impact
void goAlongCurve(Flight& flight, Vec2 before, Vec2 setBack);

/// With which a flight begins: along which the body went in the step before. @param center  of the body, metres
GroundMetLast groundOfStepBefore(const Body& body, DVec2 center);
/// For the next step: the ground that the flyer met last, if that is hardly farther away than then.
void rememberGround(const Flight& flight, Body& body);

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include "time_of_impact.h"

namespace swept {

/// One step of a search: where it looked, and how far it found the way free. World coordinates, metres.
struct ToiStep {
    double fraction = 0;    ///< at which it measured
    double separation = 0;  ///< there, radii included
    DVec2 normal;           ///< the closest direction there, unit, from A to B
    DVec2 pointA;           ///< witness points on the rounded surfaces
    DVec2 pointB;
    double next = 0;  ///< the fraction it goes on to: before it the separation is above target − tolerance, for certain
};

/// Watches `timeOfImpact` or `conservativeAdvancement`: for pictures, tables, curiosity. Watching does not change the
/// answer by a bit, and costs a comparison a step when nobody does.
class ToiObserver {
public:
    virtual ~ToiObserver() = default;
    /// Before each step that goes on to another fraction. The first one need not start at 0: as long as the circles
    /// that hold the bodies cannot meet, there is nothing to look at. The last look is the answer itself.
    virtual void onStep(const ToiStep& step) = 0;
};

/// How far the motion is free for certain as seen from one fraction: the largest one, up to `settings.tMax`, at which
/// the bounds that `timeOfImpact` steps by are still above `level`. Asked for all levels below the separation it draws
/// the bound that the search has at that fraction.
/// @param level  metres, radii included, below the separation at `fraction`.
double certainUntil(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                    const ToiSettings& settings, double fraction, double level);

}  // namespace swept

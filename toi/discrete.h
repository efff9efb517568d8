#pragma once

#include "time_of_impact.h"

namespace swept {

/// The overlap test of engines without continuous collision: looks at the pose at tMax and nowhere else.
///
/// @return `hit` at tMax when the separation there is at most the target, however deep; else `separated`. Never another
///         state: it does not know the start either. No bracket.
/// Source: folklore; what every engine does for slow bodies. Cost: one distance evaluation.
/// Fails: whatever happens before the end is missed (tunnelling) or found late, already sunk in. Right only for bodies
/// that move less than their partner is thick.
Toi discreteTest(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings);

}  // namespace swept

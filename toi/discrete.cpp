#include "discrete.h"

namespace swept {

Toi discreteTest(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings) {
    Toi toi = separationAt(a, sweepA, b, sweepB, settings.tMax);
    toi.state = toi.separation <= settings.target ? ToiState::hit : ToiState::separated;
    toi.target = settings.target;
    toi.fractionLower = toi.fraction;
    toi.separationLower = toi.separation;
    return toi;
}

}  // namespace swept

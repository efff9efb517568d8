#include "discrete.h"

namespace swept {

Toi discreteTest(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings) {
    Toi toi = separationAt(a, sweepA, b, sweepB, settings.tMax);
    toi.state = toi.separation <= settings.target ? ToiState::hit : ToiState::separated;
    return toi;
}

}  // namespace swept

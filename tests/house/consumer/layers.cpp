#include <swept/shapes/polygon.h>
#include <swept/toi/toi_polygon.h>

#include <cmath>
#include <cstdio>

/// A ball flies at a box: shapes from shapes, the time of impact from toi, nothing else is linked.
int main() {
    const auto box = swept::makeBox({1, 1});
    const auto ball = swept::makeCircle({0, 0}, 1);
    if (!box.ok() || !ball.ok()) { return 1; }
    const swept::ToiPolygon wall = swept::asToiPolygon(box.value());
    const swept::ToiPolygon bullet = swept::asToiPolygon(ball.value());

    swept::Sweep still;
    swept::Sweep flight;
    flight.c0 = {-6, 0};
    flight.c1 = {2, 0};
    const swept::ToiSettings settings = swept::defaultToiSettings(wall, bullet);
    if (!swept::validateToi(wall, still, bullet, flight, settings).ok()) { return 1; }
    const swept::Toi toi = swept::timeOfImpact(wall, still, bullet, flight, settings);
    std::printf("impact at %.6f of the way\n", toi.fraction);
    const double expected = (4 - settings.target) / 8;  // the gap over the way
    const bool close = std::abs(toi.fraction - expected) <= settings.tolerance / 8;
    return toi.state == swept::ToiState::hit && close ? 0 : 1;
}

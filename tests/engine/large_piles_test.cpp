#include "world_support.h"

/// A pile that takes its time.

namespace swept::test {
namespace {

/// Unit boxes, μ 0.6, columns 1.05 apart: 1275 of them, for ten seconds.
TEST(LargePiles, Pyramid50) {
    constexpr int kRows = 50;
    World world = makeWorld();
    addStatic(world, box(100, 0.5), material(0.6), {0, -0.5});
    std::vector<BodyId> bodies;
    std::vector<DVec2> places;
    for (int row = 0; row < kRows; ++row) {
        for (int i = 0; i < kRows - row; ++i) {
            places.push_back({1.05 * (i - 0.5 * (kRows - row - 1)), row + 0.5});
            bodies.push_back(addBody(world, dynamicAt(places.back()), box(0.5, 0.5), material(0.6)));
        }
    }
    runFor(world, 10);
    double worst = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        worst = std::max(worst, length(world.position(bodies[i]) - places[i]));
    }
    // Iterated, as in Box2D 3 at its stiffest (1.3e-2): springs of 16 sub-steps give way by as much. Twice that.
    expectAtMost("pyramid-50 move, m", worst, 0.026);
}

}  // namespace
}  // namespace swept::test

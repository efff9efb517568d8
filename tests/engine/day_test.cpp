#include "world_support.h"

/// Twenty-four hours at 60 Hz: nothing that rests or swings drifts, however often it is stepped.

namespace swept::test {
namespace {

TEST(Day, NothingDriftsInTwentyFourHours) {
    World world = makeWorld();
    addStatic(world, box(20, 0.5), material(0.6), {0, -0.5});
    std::vector<BodyId> boxes;
    for (int i = 0; i < 3; ++i) {
        boxes.push_back(addBody(world, dynamicAt({-5, i + 0.5}), box(0.5, 0.5), material(0.6)));
    }
    ShapeDef ghost;
    ghost.filter.mask = 0;
    const BodyId pivot = addStatic(world, circle(0.02), ghost, {5, 5});
    const BodyId bob = addBody(world, dynamicAt({6, 5}), circle(0.1), ghost);
    RevoluteJointDef hinge;
    hinge.base.bodyA = pivot;
    hinge.base.bodyB = bob;
    hinge.anchor = {5, 5};
    must(world.createJoint(hinge));
    const BodyId bodies[] = {bob};
    const double start = energyOf(world, bodies, kGravity);
    const double scale = world.mass(bob) * kGravity;
    double worstEnergy = 0;
    double worstGap = 0;
    constexpr int kMinutes = 24 * 60;
    for (int minute = 0; minute < kMinutes; ++minute) {
        run(world, 60 * 60);
        worstEnergy = std::max(worstEnergy, std::abs(energyOf(world, bodies, kGravity) - start) / scale);
        worstGap = std::max(worstGap, std::abs(length(world.position(bob) - DVec2{5, 5}) - 1));
    }
    double worstMove = 0;
    for (int i = 0; i < 3; ++i) {
        worstMove =
            std::max(worstMove, length(world.position(boxes[static_cast<std::size_t>(i)]) - DVec2{-5, i + 0.5}));
    }
    // In double the step is symmetric in time to rounding, and what there is (1e-8) comes and goes with each swing; in
    // float the rounding of its ends goes to and fro by 4e-5.
    expectAtMost("energy of the pendulum", worstEnergy, kIsDouble ? 1e-6 : 5e-4);
    expectAtMost("gap of its hinge", worstGap, kIsDouble ? 1e-11 : 1e-6);
    expectAtMost("move of the stack", worstMove, kIsDouble ? 1e-6 : 2e-3);
}

}  // namespace
}  // namespace swept::test

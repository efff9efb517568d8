#include <functional>

#include "world_support.h"

/// What a game changes between two steps, a speed or the length of the step, counts in the very next one: a slow box
/// stops at what it meets, however its boxes in the broadphase were made before.

namespace swept::test {
namespace {

constexpr int kWarmUp = 50;  ///< steps, so that boxes are those of something that has long been at rest

struct Approach {
    World world = makeWorld(0);
    BodyId mover;

    explicit Approach(double gap) {
        addStatic(world, box(0.5, 2), material(0.6), {0.5, 0});
        mover = addBody(world, dynamicAt({-0.5 - gap, 0}, {}), box(0.5, 0.5), material(0.6));
    }
    void rest(double dt) {
        for (int i = 0; i < kWarmUp; ++i) { must(world.step(dt)); }
    }
    /// How deep the two are after the next step, over their extent.
    double depthAfter(double dt) {
        must(world.step(dt));
        return world.position(mover).x + 0.5;
    }
};

/// A box of one metre: what moves farther than a quarter of it in a step is fast, and swept.
constexpr double kWay = 0.24;
/// Within the margin of its boxes, and beyond.
constexpr double kGaps[] = {0.03, 0.1, 0.15, 0.2, 0.23};

void expectStops(const std::string& name, double gap, const std::function<void(Approach&)>& give) {
    Approach approach(gap);
    approach.rest(kStep);
    give(approach);
    expectAtMost(name + ", gap " + std::to_string(gap), approach.depthAfter(kStep), 0x1p-10);
}

TEST(Reach, OfAVelocityThatWasGiven) {
    constexpr double kSpeed = kWay / kStep;
    for (const double gap : kGaps) {
        expectStops("velocity", gap, [](Approach& m) { must(m.world.setVelocity(m.mover, vec(kSpeed, 0), 0)); });
        expectStops("impulse", gap, [](Approach& m) {
            must(m.world.applyImpulse(m.mover, vec(kSpeed * m.world.mass(m.mover), 0), m.world.position(m.mover)));
        });
        expectStops("velocity of a sleeper", gap, [](Approach& m) {
            must(m.world.setAwake(m.mover, false));
            must(m.world.setVelocity(m.mover, vec(kSpeed, 0), 0));
        });
    }
}

TEST(Reach, OfAStepThatIsLonger) {
    for (const double gap : kGaps) {
        Approach approach(gap);
        approach.rest(kStep / 64);
        must(approach.world.setVelocity(approach.mover, vec(kWay / kStep, 0), 0));
        expectAtMost("longer step, gap " + std::to_string(gap), approach.depthAfter(kStep), 0x1p-10);
    }
}

/// Nothing was known of its length when the boxes were made.
TEST(Reach, OfTheFirstStep) {
    for (const double gap : kGaps) {
        World world = makeWorld(0);
        addStatic(world, box(0.5, 2), material(0.6), {0.5, 0});
        const BodyId mover =
            addBody(world, dynamicAt({-0.5 - gap, 0}, vec(kWay / kStep, 0)), box(0.5, 0.5), material(0.6));
        must(world.step(kStep));
        expectAtMost("first step, gap " + std::to_string(gap), world.position(mover).x + 0.5, 0x1p-10);
    }
}

}  // namespace
}  // namespace swept::test

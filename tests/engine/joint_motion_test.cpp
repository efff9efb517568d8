#include "joint_support.h"

#include <random>

/// Joints against closed forms: pendulums, springs, limits, motors, ropes.

namespace swept::test {
namespace {

struct Swing {
    double period = 0;       ///< mean, s
    double energyError = 0;  ///< largest |E − E₀| / (range of the potential energy)
    double gap = 0;          ///< largest joint error, m
};

/// Swings for a time and measures; `bob` is at rest at the start, `turn` radians from hanging; the pivot is the origin.
Swing swingOf(World& world, BodyId bob, JointId joint, double seconds) {
    const auto offset = [&] {
        const DVec2 c = world.centerOfMass(bob);
        return std::atan2(c.x, -c.y);
    };
    const auto energy = [&] { return energyOf(world, std::span(&bob, 1), kGravity); };
    const double start = energy();
    const double range = world.mass(bob) * kGravity * length(world.centerOfMass(bob)) * (1 - std::cos(offset()));
    Swing swing;
    double first = 0;
    double last = 0;
    int crossings = 0;
    double before = offset();
    const int steps = static_cast<int>(std::lround(seconds / kStep));
    for (int i = 1; i <= steps; ++i) {
        must(world.step(kStep));
        const double now = offset();
        if (before * now < 0) {
            last = (i - now / (now - before)) * kStep;
            if (crossings++ == 0) { first = last; }
        }
        before = now;
        swing.energyError = std::max(swing.energyError, std::abs(energy() - start) / range);
        swing.gap = std::max(swing.gap, static_cast<double>(world.jointError(joint)));
    }
    swing.period = crossings > 1 ? 2 * (last - first) / (crossings - 1) : 0;
    return swing;
}

/// Exact period: 4 √(L/g) K(sin(turn/2)), L the reduced length.
double exactPeriod(double reducedLength, double turn) {
    return 4 * std::sqrt(reducedLength / kGravity) * std::comp_ellint_1(std::sin(turn / 2));
}

Swing swingOnHinge(double turn, double seconds, double& expected) {
    World world = makeWorld();
    const BodyId pivot = must(world.createBody(bodyAt(BodyType::fixed, {})));
    BodyDef def = dynamicAt({std::sin(turn), -std::cos(turn)});
    def.angle = turn;
    const BodyId bob = addBody(world, def, circle(0.1));
    RevoluteJointDef hinge;
    hinge.base.bodyA = pivot;
    hinge.base.bodyB = bob;
    const JointId joint = must(world.createJoint(hinge));
    expected = exactPeriod(1 + world.inertia(bob) / world.mass(bob), turn);
    return swingOf(world, bob, joint, seconds);
}

TEST(JointMotion, SmallPendulumKeepsItsPeriod) {
    double expected = 0;
    const Swing swing = swingOnHinge(kPi / 180, 60, expected);
    expectAtMost("period", std::abs(swing.period / expected - 1), 1e-5);
    expectAtMost("gap", swing.gap, 2e-5);
}

TEST(JointMotion, WidePendulumKeepsItsPeriodAndEnergy) {
    double expected = 0;
    const Swing swing = swingOnHinge(kPi / 2, 60, expected);
    expectAtMost("period", std::abs(swing.period / expected - 1), 1e-4);
    expectAtMost("energy", swing.energyError, 5e-3);
    expectAtMost("gap", swing.gap, 2e-4);
}

TEST(JointMotion, RodPendulumKeepsItsPeriodAndEnergy) {
    const double turn = kPi / 2;
    World world = makeWorld();
    const BodyId pivot = must(world.createBody(bodyAt(BodyType::fixed, {})));
    const BodyId bob = addBody(world, dynamicAt({std::sin(turn), -std::cos(turn)}), circle(0.1));
    DistanceJointDef rod;
    rod.base.bodyA = pivot;
    rod.base.bodyB = bob;
    rod.anchorB = world.position(bob);
    const JointId joint = must(world.createJoint(rod));
    const Swing swing = swingOf(world, bob, joint, 60);
    expectAtMost("period", std::abs(swing.period / exactPeriod(1, turn) - 1), 1e-4);
    expectAtMost("energy", swing.energyError, 5e-3);
    expectAtMost("gap", swing.gap, 2e-4);
}

TEST(JointMotion, DoublePendulumKeepsItsEnergy) {
    World world = makeWorld();
    BodyId previous = must(world.createBody(bodyAt(BodyType::fixed, {})));
    std::vector<BodyId> rods;
    std::vector<JointId> joints;
    for (int i = 0; i < 2; ++i) {
        rods.push_back(addBody(world, dynamicAt({i + 0.5, 0}), box(0.5, 0.05)));
        RevoluteJointDef hinge;
        hinge.base.bodyA = previous;
        hinge.base.bodyB = rods.back();
        hinge.anchor = {static_cast<double>(i), 0};
        joints.push_back(must(world.createJoint(hinge)));
        previous = rods.back();
    }
    double worst = 0;
    double gap = 0;
    for (int i = 0; i < 1800; ++i) {
        must(world.step(kStep));
        worst = std::max(worst, std::abs(energyOf(world, rods, kGravity)) / (world.mass(rods[0]) * kGravity * 2));
        for (const JointId joint : joints) { gap = std::max(gap, static_cast<double>(world.jointError(joint))); }
    }
    expectAtMost("energy / (m g 2 m)", worst, 0.02);
    expectAtMost("gap", gap, 1e-3);
}

TEST(JointMotion, SpringSwingsAtItsFrequency) {
    for (const double hertz : {0.5, 1.0, 4.0}) {
        World world = makeWorld(0);
        const BodyId wall = must(world.createBody(bodyAt(BodyType::fixed, {})));
        const BodyId mass = addBody(world, dynamicAt({1.25, 0}), circle(0.1));
        DistanceJointDef spring;
        spring.base.bodyA = wall;
        spring.base.bodyB = mass;
        spring.anchorB = {1.25, 0};
        spring.length = real(1);
        spring.spring = Spring{real(hertz), 0};
        must(world.createJoint(spring));
        double first = 0;
        double last = 0;
        int crossings = 0;
        double before = 0.25;
        for (int i = 1; i <= 600; ++i) {
            must(world.step(kStep));
            const double now = world.position(mass).x - 1;
            if (before * now < 0) {
                last = (i - now / (now - before)) * kStep;
                if (crossings++ == 0) { first = last; }
            }
            before = now;
        }
        ASSERT_GT(crossings, 4) << hertz << " Hz";
        expectAtMost(std::to_string(hertz) + " Hz", std::abs((crossings - 1) / (2 * (last - first)) / hertz - 1), 1e-3);
    }
}

TEST(JointMotion, CriticalSpringReturnsWithoutSwinging) {
    World world = makeWorld(0);
    const BodyId wall = must(world.createBody(bodyAt(BodyType::fixed, {})));
    const BodyId mass = addBody(world, dynamicAt({1.25, 0}), circle(0.1));
    DistanceJointDef spring;
    spring.base.bodyA = wall;
    spring.base.bodyB = mass;
    spring.anchorB = {1.25, 0};
    spring.length = real(1);
    spring.spring = Spring{1, 1};
    must(world.createJoint(spring));
    const double w = 2 * kPi;
    double worst = 0;
    for (int i = 1; i <= 120; ++i) {
        must(world.step(kStep));
        const double t = i * kStep;
        worst = std::max(worst, std::abs(world.position(mass).x - 1 - 0.25 * (1 + w * t) * std::exp(-w * t)));
    }
    expectAtMost("deviation from (1 + ωt) e^−ωt", worst / 0.25, 0.003);
}

/// A bar of 1 m on a hinge at the origin, level, pointing right.
struct HingedBar {
    World world;
    BodyId bar;
    JointId joint;

    HingedBar(double gravity, RevoluteJointDef hinge) : world(makeWorld(gravity)) {
        hinge.base.bodyA = must(world.createBody(bodyAt(BodyType::fixed, {})));
        bar = addBody(world, dynamicAt({0.5, 0}), box(0.5, 0.05));
        hinge.base.bodyB = bar;
        joint = must(world.createJoint(hinge));
    }
    double inertia() const { return world.inertia(bar) + 0.25 * world.mass(bar); }
};

TEST(JointMotion, LimitStopsAFallingBar) {
    RevoluteJointDef hinge;
    hinge.limits = AngleLimits{real(-0.5), real(0.5)};
    HingedBar scene(kGravity, hinge);
    double lowest = 0;
    for (int i = 0; i < 300; ++i) {
        must(scene.world.step(kStep));
        lowest = std::min(lowest, scene.world.angle(scene.bar));
    }
    expectAtMost("overshoot", -0.5 - lowest, 2e-4);
    expectAtMost("rest", std::abs(scene.world.angle(scene.bar) + 0.5), 2e-4);
    expectAtMost("spin", std::abs(spinOf(scene.world, scene.bar)), 1e-3);
}

TEST(JointMotion, MotorAcceleratesByItsTorqueUpToItsSpeed) {
    const double torque = 0.05;
    RevoluteJointDef hinge;
    hinge.motor = AngularMotor{2, real(torque)};
    HingedBar scene(0, hinge);
    const double rate = torque / scene.inertia();
    ASSERT_GT(2 / rate, 0.3) << "the first 15 steps must lie before the final speed";
    run(scene.world, 15);
    expectAtMost("spin under full torque", std::abs(spinOf(scene.world, scene.bar) / (15 * kStep * rate) - 1), 5e-3);
    expectAtMost("torque", std::abs(static_cast<double>(scene.world.jointTorque(scene.joint)) / torque - 1), 1e-3);
    run(scene.world, 300);
    expectAtMost("final spin", std::abs(spinOf(scene.world, scene.bar) / 2 - 1), 1e-4);
}

TEST(JointMotion, RopeLetsFallAndHolds) {
    World world = makeWorld();
    const BodyId ceiling = must(world.createBody(bodyAt(BodyType::fixed, {})));
    const BodyId ball = addBody(world, dynamicAt({0, -0.5}), circle(0.1));
    DistanceJointDef rope;
    rope.base.bodyA = ceiling;
    rope.base.bodyB = ball;
    rope.anchorB = world.position(ball);
    rope.limits = LengthLimits{0, 2};
    const JointId joint = must(world.createJoint(rope));
    run(world, 30);  // slack: 0.5 s of free fall
    expectAtMost("fall", std::abs(world.position(ball).y + 0.5 + 1.25), 0.006);
    double lowest = 0;
    for (int i = 0; i < 300; ++i) {
        must(world.step(kStep));
        lowest = std::min(lowest, world.position(ball).y);
    }
    expectAtMost("overshoot", -2 - lowest, 1e-4);
    expectAtMost("rest", std::abs(world.position(ball).y + 2), 1e-4);
    expectAtMost("tension",
                 std::abs(static_cast<double>(world.jointForce(joint).y) / (world.mass(ball) * kGravity) - 1), 1e-4);
}

/// Links of masses far apart that whirl, every third one held to its rotation and tied by a slide; all masses times
/// eight are the same motion bit for bit.
std::vector<double> whirl(std::uint32_t seed, double unit) {
    std::mt19937 engine(seed);
    const auto chance = [&engine](double low, double high) {
        return low + (high - low) * static_cast<double>(engine()) * 0x1p-32;
    };
    World world = makeWorld();
    std::vector<BodyId> bodies{must(world.createBody(bodyAt(BodyType::fixed, {})))};
    for (int i = 0; i < 4; ++i) {
        BodyDef def = dynamicAt({i + 1.0, 0}, vec(chance(-200, 200), chance(-200, 200)));
        def.mass = real(std::exp2(chance(-10, 10)));
        def.inertia = real(chance(0.01, 1)) * def.mass;
        def.mass *= real(unit);
        def.inertia *= real(unit);
        def.fixedRotation = i % 3 == 2;
        const BodyId body = must(world.createBody(def));
        const DVec2 anchor{i + 0.5, 0};
        if (i % 3 == 2) {
            PrismaticJointDef slide;
            slide.base = {bodies.back(), body};
            slide.anchor = anchor;
            must(world.createJoint(slide));
        } else if (i % 3 == 1) {
            DistanceJointDef rod;
            rod.base = {bodies.back(), body};
            rod.anchorA = {i + 0.0, 0};
            rod.anchorB = {i + 1.0, 0};
            must(world.createJoint(rod));
        } else {
            RevoluteJointDef hinge;
            hinge.base = {bodies.back(), body};
            hinge.anchor = anchor;
            must(world.createJoint(hinge));
        }
        bodies.push_back(body);
    }
    run(world, 4);
    std::vector<double> places;
    for (const BodyId body : bodies) {
        places.insert(places.end(), {world.position(body).x, world.position(body).y, world.angle(body)});
    }
    return places;
}

TEST(JointMotion, WhirlingChainsKnowNoUnitOfMass) {
    for (std::uint32_t seed = 0; seed < 24; ++seed) { EXPECT_EQ(whirl(seed, 1), whirl(seed, 8)) << "seed " << seed; }
}

/// Sub-steps of the parts of a step in which a small disk that whirls presses on a bar that hangs on the ground, or on
/// a second bar that does.
std::uint64_t subStepsBesideAWhirl(bool isChained) {
    WorldSettings settings = awakeSettings(Profile::fast, 0);
    World world = makeWorld(settings);
    const BodyId bar = addBody(world, dynamicAt({0, 0}), box(1, 0.1));
    RevoluteJointDef hinge;
    hinge.base = between(anchorOf(world), bar);
    must(world.createJoint(hinge));
    if (isChained) {
        RevoluteJointDef next;
        next.base = between(bar, addBody(world, dynamicAt({-2, 0}), box(1, 0.1)));
        next.anchor = {-1, 0};
        must(world.createJoint(next));
    }
    addBody(world, dynamicAt({0.8, 0.199}, vec(0, -1), 90), circle(0.1));  // 1.5 rad in a step, in parts of 0.5
    must(world.step(kStep));
    return world.counters().subSteps;
}

/// No joint has to hand on what a whirling neighbour does to the only body that joints hold.
TEST(JointMotion, WhatWhirlsBesideABarOnTheGroundAsksForNoMoreSubSteps) {
    constexpr std::uint64_t kUsual = 4;
    EXPECT_LE(subStepsBesideAWhirl(false), 2 * kUsual);
    EXPECT_GE(subStepsBesideAWhirl(true), 3 * kUsual);
}

}  // namespace
}  // namespace swept::test

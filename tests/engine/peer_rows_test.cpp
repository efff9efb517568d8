#include "extreme_scenes.h"

/// Scenes whose outcome other engines were measured by, each by the name that it has in `swept bench accuracy`. Limits
/// are ten times what was measured, or more, unless they say otherwise.

namespace swept::test {
namespace {

void expectStands(const std::string& name, const Tower& tower, double side, double sag, double drift) {
    expectAtMost(name + " sag", tower.sag(side), sag);
    expectAtMost(name + " drift, sides", tower.drift() / side, drift);
    expectAtMost(name + " speed, part of √(g·side)", tower.fastest() / std::sqrt(tower.gravity * side), 1e-5);
}

TEST(PeerRows, Stack10AndStack100) {
    for (const int count : {10, 100}) {
        Tower tower(count, 1);
        runFor(tower.world, 10);
        expectStands("stack-" + std::to_string(count), tower, 1, kIsDouble ? 1e-7 : 2e-6, 1e-7);
        EXPECT_EQ(tower.world.counters().directGivenUp, 0U);
    }
}

/// The same motion at every size: gravity grows with it.
TEST(PeerRows, Units) {
    for (const double side : {1e-3, 1e3}) {
        Tower tower(10, side, 1, kGravity * side);
        runFor(tower.world, 10);
        expectStands(side < 1 ? "units-1e-3" : "units-1e3", tower, side, kIsDouble ? 1e-7 : 2e-5, 1e-5);
    }
}

/// Positions are double in both builds: far out a stack rests as it does at the origin, up to what a position there can
/// express.
TEST(PeerRows, StacksFarOut) {
    for (const double x : {1e4, 1e6, 1e7}) {
        World world = makeWorld();
        addStatic(world, box(20, 0.5), material(0.6), {x, x - 0.5});
        std::vector<BodyId> boxes;
        for (int i = 0; i < 10; ++i) {
            boxes.push_back(addBody(world, dynamicAt({x, x + i + 0.5}), box(0.5, 0.5), material(0.6)));
        }
        runFor(world, 10);
        double move = 0;
        double speed = 0;
        for (int i = 0; i < 10; ++i) {
            const BodyId body = boxes[static_cast<std::size_t>(i)];
            move = std::max(move, length(world.position(body) - DVec2{x, x + i + 0.5}));
            speed = std::max(speed, length(velocityOf(world, body)));
        }
        const std::string name = "stack-at-" + std::to_string(x);
        expectAtMost(name + " move", move,
                     (kIsDouble ? 1e-7 : 2e-5) + 100 * x * std::numeric_limits<double>::epsilon());
        expectAtMost(name + " jitter", speed, 1e-5);
    }
}

TEST(PeerRows, Spin) {
    for (const double omega : {10.0, 100.0, 500.0}) {
        World world = makeWorld(0);
        const BodyId bar = addBody(world, dynamicAt({0, 0}, {}, omega), box(0.5, 0.05));
        runFor(world, 10);
        expectAtMost("spin-" + std::to_string(omega), std::abs(world.angle(bar) / (10 * omega) - 1), 1e-14);
    }
}

TEST(PeerRows, Pendulum170) {
    Pendulum pendulum(170);
    double first = -1;
    double last = -1;
    int passes = 0;
    DVec2 before = pendulum.world.position(pendulum.bob);
    for (int i = 1; i <= 60 * 60; ++i) {
        must(pendulum.world.step(kStep));
        const DVec2 now = pendulum.world.position(pendulum.bob);
        if ((before.x > 0) != (now.x > 0) && now.y < 0) {
            last = kStep * (i - 1 + before.x / (before.x - now.x));
            first = first < 0 ? last : first;
            ++passes;
        }
        before = now;
    }
    expectAtMost("pendulum-170 energy", pendulum.energyError(), kIsDouble ? 1e-7 : 3e-5);
    // 4·K(sin 85°)·√((1 + r²/2)/g), K = 3.8317419997841462 (Abramowitz & Stegun, table 17.2); times of passes are read
    // off straight lines between frames.
    const double exact = 4 * 3.8317419997841462 * std::sqrt((1 + 0.5 * 0.1 * 0.1) / kGravity);
    expectAtMost("pendulum-170 period", std::abs(2 * (last - first) / (passes - 1) / exact - 1),
                 kIsDouble ? 2e-6 : 2e-4);
}

/// Two rods of 1 m by 0.1 m, let go level: the energy at any time of 30 s, as a part of the two metres they may fall.
TEST(PeerRows, DoublePendulum) {
    World world = makeWorld();
    ShapeDef none;
    none.filter.mask = 0;
    BodyId before = addStatic(world, circle(0.02), none);
    std::vector<BodyId> rods;
    for (int i = 0; i < 2; ++i) {
        rods.push_back(addBody(world, dynamicAt({0.5 + i, 0}), box(0.5, 0.05), none));
        RevoluteJointDef hinge;
        hinge.base.bodyA = before;
        hinge.base.bodyB = rods.back();
        hinge.anchor = {static_cast<double>(i), 0};
        must(world.createJoint(hinge));
        before = rods.back();
    }
    const double start = energyOf(world, rods, kGravity);
    const double scale = world.mass(rods[0]) * kGravity * 2;
    double worst = 0;
    for (int i = 0; i < 30 * 60; ++i) {
        must(world.step(kStep));
        worst = std::max(worst, std::abs(energyOf(world, rods, kGravity) - start) / scale);
    }
    // Box2D 3, as stiff as it can be: 1.7e-3 at the end, at the same cost. Three times what was measured.
    expectAtMost("double-pendulum energy at any time", worst, 5e-5);
}

/// Where a body of a pendulum of `rods` is after 2 s, let go level.
DVec2 endOfPendulum(int rods, double hertz) {
    World world = makeWorld();
    ShapeDef none;
    none.filter.mask = 0;
    BodyId last = addStatic(world, circle(0.02), none);
    for (int i = 0; i < rods; ++i) {
        RevoluteJointDef hinge;
        hinge.base.bodyA = last;
        hinge.base.bodyB = last = addBody(world, dynamicAt({0.5 + i, 0}), box(0.5, 0.05), none);
        hinge.anchor = {static_cast<double>(i), 0};
        must(world.createJoint(hinge));
    }
    run(world, static_cast<int>(2 * hertz), 1 / hertz);
    return world.position(last);
}

/// No other engine's error falls by more than half with half the step. Here it is 13 to 17 times, until rounding is
/// left (projectiles and bounces are exact at any step: `FreeFlight`, `Bounce`).
TEST(PeerRows, ErrorsFallFasterThanTheStep) {
    for (const int rods : {1, 2}) {
        const DVec2 exact = endOfPendulum(rods, 960);
        const double coarse = length(endOfPendulum(rods, 30) - exact);
        const double fine = length(endOfPendulum(rods, 60) - exact);
        const double rounding = kIsDouble ? 1e-9 : 2e-5;
        const std::string name = std::to_string(rods) + " rods ";
        expectAtMost(name + "at 30 Hz", coarse, 1e-3);
        expectAtMost(name + "at 60 Hz", fine, coarse / 6 + rounding);
    }
}

TEST(PeerRows, ChainsAtRest) {
    for (const double ratio : {1e1, 1e2, 1e3}) {
        expectAtMost("chain-R" + std::to_string(ratio), Chain(ratio, false).stretch(10), kIsDouble ? 1e-11 : 1e-6);
    }
}

}  // namespace
}  // namespace swept::test

#include <algorithm>
#include <cmath>
#include <vector>

#include "joint_support.h"

/// Beams of welded bars: what their welds tell, against statics.

namespace swept::test {
namespace {

constexpr int kSecond = 60;  // steps
constexpr double kBarMass = 10;
constexpr Filter kBeam{.category = 2, .mask = 4};
constexpr Filter kLoad{.category = 4};

/// Bars of 1 m from x = 0 to the right, welded to each other.
struct Beam {
    World world = makeWorld();
    std::vector<BodyId> bars;
    std::vector<JointId> welds;  ///< the first one to the ground, if at all

    Beam(int count, bool isAnchored) {
        const BodyId ground = anchorOf(world);
        for (int i = 0; i < count; ++i) {
            const BodyId before = i > 0 ? bars.back() : ground;
            bars.push_back(addBody(world, dynamicAt({i + 0.5, 0}), box(0.5, 0.1),
                                   {.density = real(kBarMass / 0.2), .filter = kBeam}));
            if (i == 0 && !isAnchored) { continue; }
            welds.push_back(must(world.createJoint(
                WeldJointDef{.base = between(before, bars.back()), .anchor = {static_cast<double>(i), 0}})));
        }
    }
    BodyId drop(double x, double mass) {
        BodyDef def = dynamicAt({x, 0.25});
        def.mass = real(mass);
        return addBody(world, def, circle(0.1), {.filter = kLoad});
    }
    double torque(std::size_t weld) const { return std::fabs(static_cast<double>(world.jointTorque(welds[weld]))); }
};

/// About the wall.
double torqueAtWall(int bars, double load) { return kGravity * (kBarMass * bars * bars / 2 + load * (bars - 0.5)); }

/// A ball falls on the tip by 5 cm, and lies there. (The weld at the wall told up to 80 times what it carries, in
/// bursts, for as long as it lay there.)
TEST(Beams, CantileversBearWhatLiesOnTheirTip) {
    for (const int bars : {4, 8, 16, 30, 120}) {
        for (const double load : {0.1, 50.0}) {
            Beam beam(bars, true);
            run(beam.world, kSecond);
            EXPECT_NEAR(beam.torque(0), torqueAtWall(bars, 0), 1e-3 * torqueAtWall(bars, 0));
            const BodyId ball = beam.drop(bars - 0.5, load);
            run(beam.world, 4 * kSecond);
            const double right = torqueAtWall(bars, load);
            double farthest = 0;
            for (int i = 0; i < 2 * kSecond; ++i) {
                must(beam.world.step(kStep));
                farthest = std::max(farthest, std::fabs(beam.torque(0) - right));
            }
            EXPECT_LT(farthest, 0.02 * right) << bars << " bars, " << load << " kg";
            EXPECT_NEAR(beam.world.position(beam.bars.back()).y, 0, 1e-4) << bars << " bars, " << load << " kg";
            EXPECT_NEAR(beam.world.position(ball).y, 0.2, 1e-3) << bars << " bars, " << load << " kg";
        }
    }
}

/// (It broke within a second.)
TEST(Beams, AWeldThatMayBearThreeTimesItsLoadHolds) {
    for (const double load : {0.1, 5.0}) {
        Beam beam(30, true);
        run(beam.world, kSecond);
        must(beam.world.setBreakLimits(beam.welds[0], {}, real(3 * torqueAtWall(30, load))));
        beam.drop(29.5, load);
        for (int i = 0; i < 5 * kSecond; ++i) {
            must(beam.world.step(kStep));
            ASSERT_TRUE(beam.world.jointBreaks().empty()) << load << " kg, step " << i;
        }
    }
}

/// On two posts, a metre wide each, which bear it somewhere on their tops. (The weld in the middle of forty bars told
/// up to 2.2 times what it carries, and at other times next to nothing.)
TEST(Beams, BeamsOnTwoPostsBearWhatLiesOnTheirMiddle) {
    for (const int bars : {20, 40}) {
        for (const double load : {1.0, 50.0}) {
            Beam beam(bars, false);
            for (const double x : {0.5, bars - 0.5}) {
                addStatic(beam.world, box(0.5, 0.5), {.filter = kLoad}, {x, -0.6});
            }
            beam.drop(0.5 * bars, load);
            run(beam.world, 4 * kSecond);
            const double support = 0.5 * kGravity * (kBarMass * bars + load);
            const double ofHalf = kGravity * kBarMass * bars * bars / 8;
            for (int i = 0; i < 2 * kSecond; ++i) {
                must(beam.world.step(kStep));
                const double torque = beam.torque(beam.welds.size() / 2);
                ASSERT_GT(torque, 0.98 * (support * (0.5 * bars - 1) - ofHalf)) << bars << " bars, " << load << " kg";
                ASSERT_LT(torque, 1.02 * (support * 0.5 * bars - ofHalf)) << bars << " bars, " << load << " kg";
            }
        }
    }
}

/// A crane: two sliders that hold their place, and two fingers whose motors press on a crate of 80 N. It is no beam.
/// (As one its joints and contacts took turns: the crate climbed through the fingers by 1.8 mm/s.)
TEST(Beams, WhatTheFingersOfACraneGripStays) {
    constexpr Filter kNothing{.category = 2, .mask = 0};
    for (const double tilt : {0.0, 0.05}) {
        World world = makeWorld();
        const BodyId ground = anchorOf(world);
        const auto slider = [&](BodyId from, double y, DVec2 axis) {
            const BodyId body = addBody(world, dynamicAt({0, y}), box(0.5, 0.15), {.density = 50, .filter = kNothing});
            PrismaticJointDef def{.base = between(from, body), .anchor = {0, y}, .axis = axis};
            def.motor = LinearMotor{.speed = 0, .maxForce = 10'000};
            must(world.createJoint(def));
            return body;
        };
        const BodyId head = slider(slider(ground, 9, {1, 0}), 7.5, {0, 1});
        BodyDef lying = dynamicAt({0, 6.5});
        lying.angle = tilt;
        const BodyId crate = addBody(world, lying, box(0.4, 0.4), {.density = 20, .friction = real(0.6)});
        for (const int side : {-1, 1}) {
            const DVec2 hinge{0.5 * side, 7.4};
            const Polygon shape = must(makeBox(vec(0.06, 0.45), vec(0.1 * side, -0.45)));
            const BodyId finger = addBody(world, dynamicAt(hinge), shape, {.density = 40, .friction = real(0.9)});
            RevoluteJointDef def{.base = between(head, finger), .anchor = hinge};
            def.motor = AngularMotor{.speed = real(-1.5 * side), .maxTorque = 400};
            must(world.createJoint(def));
        }
        run(world, 2 * kSecond);
        const double start = world.position(crate).y;
        run(world, 10 * kSecond);
        EXPECT_NEAR(world.position(crate).y, start, 5e-4) << "tilted by " << tilt;
    }
}

}  // namespace
}  // namespace swept::test

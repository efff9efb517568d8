#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "joint_support.h"

/// Sub-steps are shorter where heavy bodies swing past a light link, and only there: what is light and hangs at the
/// end of joints, or lies loose on what they hold, costs no more than what is heavy.

namespace swept::test {
namespace {

constexpr std::uint64_t kUsualSubSteps = 16;
constexpr double kLight = 0.1;  ///< kg

/// What two seconds came to.
struct Cost {
    std::uint64_t subSteps = 0;  ///< the most of a step
    double jointError = 0;       ///< the largest, metres
};

Cost costOf(World& world, const std::vector<JointId>& joints) {
    Cost cost;
    for (int i = 0; i < 120; ++i) {
        must(world.step(kStep));
        cost.subSteps = std::max(cost.subSteps, world.counters().mostSubSteps);
        for (const JointId joint : joints) {
            cost.jointError = std::max(cost.jointError, static_cast<double>(world.jointError(joint)));
        }
    }
    return cost;
}

BodyDef weighing(double mass, DVec2 position) {
    BodyDef def = dynamicAt(position);
    def.mass = real(mass);
    return def;
}

JointId pivot(World& world, BodyId a, BodyId b, DVec2 anchor) {
    return must(world.createJoint(RevoluteJointDef{.base = between(a, b), .anchor = anchor}));
}

/// A motor turns a wheel of 60 kg with what is light on its rim.
TEST(LightLinks, WhatIsWeldedToARimIsNone) {
    World world = makeWorld(awakeSettings(Profile::accurate));
    const BodyId wheel = addBody(world, weighing(600 * kLight, {}), circle(2));
    RevoluteJointDef axle{.base = between(anchorOf(world), wheel)};
    axle.motor = AngularMotor{2, 200};
    std::vector<JointId> joints{must(world.createJoint(axle))};
    for (int i = 0; i < 4; ++i) {
        const DVec2 place = turned({2.15, 0}, i * kPi / 2);
        const BodyId bell = addBody(world, weighing(kLight, place), circle(0.15));
        joints.push_back(must(world.createJoint(WeldJointDef{.base = between(wheel, bell), .anchor = place})));
    }
    const Cost cost = costOf(world, joints);
    EXPECT_EQ(cost.subSteps, kUsualSubSteps);
    expectAtMost("joint error, m", cost.jointError, 1e-4);
}

/// A truck of 300 kg is driven, light crates lie on it.
TEST(LightLinks, WhatLiesLooseOnATruckIsNone) {
    World world = makeWorld(awakeSettings(Profile::accurate));
    addStatic(world, box(100, 0.5), material(0.9), {0, -0.5});
    const BodyId chassis = addBody(world, weighing(3000 * kLight, {0, 1}), box(1.5, 0.3), material(0.6));
    std::vector<JointId> joints;
    for (const double x : {-1.0, 1.0}) {
        const DVec2 hub{x, 0.6};
        const BodyId wheel = addBody(world, weighing(300 * kLight, hub), circle(0.4), material(0.9));
        WheelJointDef axle{.base = between(chassis, wheel), .anchor = hub, .axis = {0, 1}};
        axle.spring = Spring{4, real(0.7)};
        axle.motor = AngularMotor{-5, 300};
        joints.push_back(must(world.createJoint(axle)));
    }
    std::vector<BodyId> crates;
    for (const double x : {-0.6, 0.0, 0.6}) {
        crates.push_back(addBody(world, weighing(kLight, {x, 1.4}), box(0.1, 0.1), material(0.6)));
    }
    const Cost cost = costOf(world, joints);
    EXPECT_EQ(cost.subSteps, kUsualSubSteps);
    expectAtMost("joint error, m", cost.jointError, 1e-4);
    for (const BodyId crate : crates) { EXPECT_GT(world.position(crate).y, world.position(chassis).y + 0.39); }
}

/// 60 kg swing on a light link that the ground holds.
TEST(LightLinks, BetweenTheGroundAndALoadTheyAre) {
    World world = makeWorld(awakeSettings(Profile::accurate));
    const BodyId link = addBody(world, weighing(kLight, {0.25, 0}), capsule(0.25, 0.05));
    const BodyId load = addBody(world, weighing(600 * kLight, {1, 0}), box(0.4, 0.4));
    const std::vector<JointId> joints{pivot(world, anchorOf(world), link, {}), pivot(world, link, load, {0.5, 0})};
    // Joints that nothing touches are not solved by sub-steps.
    addBody(world, weighing(kLight, {1, 0.5}), box(0.1, 0.1));
    const Cost cost = costOf(world, joints);
    EXPECT_GT(cost.subSteps, kUsualSubSteps);
    expectAtMost("joint error, m", cost.jointError, 1e-3);
}

}  // namespace
}  // namespace swept::test

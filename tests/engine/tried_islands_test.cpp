#include <array>
#include <vector>

#include "world_support.h"

/// Islands with something fast are solved together with all else first, whatever of these joints they have, and put
/// back if they strike something.

namespace swept::test {
namespace {

template <class Def>
Def jointOf(BodyId a, BodyId b, DVec2 anchor) {
    Def def;
    def.base.bodyA = a;
    def.base.bodyB = b;
    def.anchor = anchor;
    return def;
}

/// Two driven wheels on springs, a load welded on, a tool on a slider with limits, a tow on a rod.
std::vector<BodyId> addTruck(World& world, DVec2 at, double speed, double spin) {
    const Vec2 velocity = vec(speed, 0);
    const auto add = [&](DVec2 place, const Polygon& shape, double turn) {
        return addBody(world, dynamicAt(at + place, velocity, turn), shape, material(0.9));
    };
    const BodyId chassis = add({0, 0.6}, box(1.5, 0.25), 0);
    std::vector<BodyId> bodies{chassis};
    for (const double side : {-1.0, 1.0}) {
        const DVec2 axle{side, 0.3};
        bodies.push_back(add(axle, circle(0.3), spin));
        auto wheel = jointOf<WheelJointDef>(chassis, bodies.back(), at + axle);
        wheel.axis = {0, 1};
        wheel.spring = Spring{.hertz = 4, .dampingRatio = 0.7F};
        wheel.motor = AngularMotor{.speed = static_cast<Real>(spin), .maxTorque = 50};
        must(world.createJoint(wheel));
    }
    bodies.push_back(add({-0.8, 1.1}, box(0.3, 0.2), 0));
    must(world.createJoint(jointOf<WeldJointDef>(chassis, bodies.back(), at + DVec2{-0.8, 0.9})));
    bodies.push_back(add({0.8, 1.4}, box(0.2, 0.2), 0));
    auto slider = jointOf<PrismaticJointDef>(chassis, bodies.back(), at + DVec2{0.8, 1.4});
    slider.axis = {0, 1};
    slider.limits = TranslationLimits{.lower = -0.2F, .upper = 0.2F};
    must(world.createJoint(slider));
    bodies.push_back(add({-3, 0.3}, circle(0.3), spin));
    DistanceJointDef rod;
    rod.base.bodyA = chassis;
    rod.base.bodyB = bodies.back();
    rod.anchorA = at + DVec2{-1.5, 0.6};
    rod.anchorB = at + DVec2{-3, 0.3};
    must(world.createJoint(rod));
    return bodies;
}

constexpr double kTruckSpeed = 20;
constexpr double kTruckWheelSpin = -kTruckSpeed / 0.3;

/// One strikes a wall, half way through a step, and one does not: neither shows in how they move, to the bit.
TEST(TriedIslands, TrucksMoveAsIfAlone) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        std::array<World, 3> worlds{makeWorld(awakeSettings(profile)), makeWorld(awakeSettings(profile)),
                                    makeWorld(awakeSettings(profile))};
        for (World& world : worlds) {
            addStatic(world, box(1000, 1), material(0.9), {0, -1});
            addStatic(world, segment(8, -1, 8, 30), material(0.3));
        }
        std::array<std::vector<BodyId>, 2> both;  // in the last of the worlds
        std::array<std::vector<BodyId>, 2> alone;
        for (std::size_t i = 0; i < both.size(); ++i) {
            const DVec2 at{-30 * static_cast<double>(i), 0};
            both[i] = addTruck(worlds[2], at, kTruckSpeed, kTruckWheelSpin);
            alone[i] = addTruck(worlds[i], at, kTruckSpeed, kTruckWheelSpin);
        }
        for (int step = 0; step < 60; ++step) {
            for (World& world : worlds) { must(world.step(kStep)); }
            if (step == 10 && profile == Profile::fast) { EXPECT_EQ(worlds[2].counters().effortClasses, 1U); }
            for (std::size_t i = 0; i < both.size(); ++i) {
                for (std::size_t k = 0; k < both[i].size(); ++k) {
                    const DVec2 apart = worlds[2].position(both[i][k]) - worlds[i].position(alone[i][k]);
                    EXPECT_EQ(length(apart), 0) << profileName(profile) << ", step " << step << ", body " << k;
                }
            }
        }
        for (const BodyId body : both[0]) { EXPECT_LT(worlds[2].position(body).x, 8); }
    }
}

/// A wheel on its axle looks the same however far it turns, so a truck that drives needs no shorter parts of a step.
TEST(TriedIslands, TrucksThatDriveFastAreSolvedOnce) {
    World world = makeWorld(awakeSettings(Profile::fast));
    addStatic(world, box(1000, 1), material(0.9), {0, -1});
    for (int i = 0; i < 8; ++i) { addTruck(world, {-100.0 + 20 * i, 0}, 2 * kTruckSpeed, 2 * kTruckWheelSpin); }
    for (int step = 0; step < 60; ++step) {
        must(world.step(kStep));
        if (step >= 10) {
            EXPECT_EQ(world.counters().effortClasses, 1U) << step;
            EXPECT_EQ(world.counters().subSteps, 4U) << step;
        }
    }
}

}  // namespace
}  // namespace swept::test

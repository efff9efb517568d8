#include <algorithm>
#include <string>
#include <vector>

#include "joint_support.h"

/// A motor gives its bodies no more than its strength times its speed, however the solver takes it from there.

namespace swept::test {
namespace {

/// A row of six boxes on sliders, the first one with a wheel on a weak motor.
struct SliderRow {
    World world;
    std::vector<BodyId> bodies;

    SliderRow(Profile profile, bool areDriven) : world(makeWorld(profile, 0)) {
        bodies = addSliderRow(world, 6, [areDriven](PrismaticJointDef& slider, int i) {
            if (areDriven) {
                slider.motor = LinearMotor{.speed = real(i % 2 == 0 ? -1 : 1), .maxForce = 2};
            } else {
                slider.limits = TranslationLimits{.lower = real(-1.2), .upper = real(1.2)};
            }
        });
        const BodyId wheel = addBody(world, dynamicAt({0, -0.5}), circle(0.2));
        RevoluteJointDef axle;
        axle.base = between(bodies.front(), wheel);
        axle.anchor = {0, -0.5};
        axle.motor = AngularMotor{.speed = 3, .maxTorque = real(0.2)};
        must(world.createJoint(axle));
        must(world.applyImpulse(bodies.back(), vec(0.1, 0.2)));
    }
    double fastest() const {
        double fastest = 0;
        for (const BodyId body : bodies) { fastest = std::max(fastest, length(velocityOf(world, body))); }
        return fastest;
    }
};

/// Rows of sliders feed on what they do to each other, and where a motor was among the joints nothing took that back:
/// 132 m/s in `fast`, with motors of their own 3 km/s in `accurate`.
TEST(MotorEnergy, SlidersBesideAMotorMakeNone) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const bool areDriven : {false, true}) {
            SliderRow row(profile, areDriven);
            double fastest = 0;
            for (int i = 0; i < 1200; ++i) {
                must(row.world.step(kStep));
                fastest = std::max(fastest, row.fastest());
            }
            expectAtMost(profileName(profile) + (areDriven ? ", driven" : ", limited"), fastest, areDriven ? 6 : 1.5);
        }
    }
}

/// What a motor may do it still does: a wheel is spun up as fast as its torque can.
TEST(MotorEnergy, IsThatOfStatics) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        World world = makeWorld(profile, 0);
        const BodyId frame = addBody(world, dynamicAt({}), box(2, 0.5), material(0.6, 0, 10));
        const BodyId wheel = addBody(world, dynamicAt({}), circle(0.5));
        RevoluteJointDef axle;
        axle.base = between(frame, wheel);
        axle.motor = AngularMotor{.speed = 20, .maxTorque = real(0.1)};
        must(world.createJoint(axle));
        runFor(world, 2);
        EXPECT_NEAR(spinOf(world, wheel), 0.1 * 2 / world.inertia(wheel), 1e-3) << profileName(profile);
        EXPECT_NEAR(spinOf(world, frame), -0.1 * 2 / world.inertia(frame), 1e-3) << profileName(profile);
        runFor(world, 60);
        EXPECT_NEAR(spinOf(world, wheel) - spinOf(world, frame), 20, 1e-3) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test

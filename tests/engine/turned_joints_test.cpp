#include "../support/random.h"
#include "joint_support.h"

/// Joints that take hold of their bodies again, many turns from where they were made.

namespace swept::test {
namespace {

struct TurnedJoint {
    BodyId wheel;
    JointId joint;
    double wanted = 0;  ///< rad: no joint would turn it from there
};

/// Held within limits, or driven to an offset, that may be some turns from 0.
TurnedJoint addTurned(World& world, Random& random, bool isMotor) {
    TurnedJoint turned;
    turned.wheel = addBody(world, dynamicAt({0, 0}), circle(0.5));
    turned.wanted = random.range(-30, 30);
    const JointDef base = between(anchorOf(world), turned.wheel);
    if (isMotor) {
        MotorJointDef def{.base = base};
        def.drive.maxForce = real(1000);
        def.drive.maxTorque = real(100);
        def.drive.angularOffset = real(turned.wanted);
        turned.joint = must(world.createJoint(def));
    } else {
        RevoluteJointDef def{.base = base};
        def.limits =
            AngleLimits{real(turned.wanted - random.range(0.1, 0.5)), real(turned.wanted + random.range(0.1, 0.5))};
        turned.joint = must(world.createJoint(def));
    }
    must(world.setPose(turned.wheel, {0, 0}, turned.wanted));
    run(world, 5);
    return turned;
}

/// A joint does not turn what is where it may be, however many turns from where it was made that is.
TEST(TurnedJoints, TurnNothingThatIsWhereTheyWantIt) {
    Random random(21);
    int several = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i);
        World world = makeWorld(0);
        const TurnedJoint turned = addTurned(world, random, i % 2 == 0);
        several += std::fabs(turned.wanted) > kPi ? 1 : 0;
        must(world.setEnabled(turned.wheel, false));
        must(world.setEnabled(turned.wheel, true));
        ASSERT_NEAR(world.jointAngle(turned.joint), turned.wanted, 1e-3);
        run(world, 30);
        ASSERT_NEAR(world.angle(turned.wheel), turned.wanted, 1e-3);
    }
    EXPECT_GT(several, 100);
}

/// Nor what is there but for whole turns; what is not goes the shorter way.
TEST(TurnedJoints, TurnWhatIsElsewhereByHalfATurnAtMost) {
    Random random(22);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i);
        World world = makeWorld(0);
        const TurnedJoint turned = addTurned(world, random, i % 2 == 0);
        must(world.setEnabled(turned.wheel, false));
        const double place = turned.wanted + 2 * kPi * random.integer(-4, 4);
        const double off = i % 4 < 2 ? 0 : random.range(-0.7, 0.7) * kPi;
        must(world.setPose(turned.wheel, {0, 0}, place + off));
        must(world.setEnabled(turned.wheel, true));
        ASSERT_LE(std::fabs(world.jointAngle(turned.joint) - turned.wanted), std::fabs(off) + 1e-3);
        for (int step = 0; step < 120; ++step) {
            run(world, 1);
            ASSERT_LE(std::fabs(world.angle(turned.wheel) - place), std::fabs(off) + 0.05) << "step " << step;
        }
        if (off == 0) { ASSERT_NEAR(world.angle(turned.wheel), place, 1e-3); }
    }
}

}  // namespace
}  // namespace swept::test

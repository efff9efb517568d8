#include <limits>
#include <string>

#include "joint_support.h"

/// What a joint that is made where its bodies are not at rest in it may not be told.

namespace swept::test {
namespace {

TEST(JointFrames, ThatAreNoNumbersAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    World world = makeWorld();
    const JointDef base = between(addStatic(world, box(1, 1)), addBody(world, dynamicAt({3, 0}), box(1, 1)));
    const auto expectRefused = [&](auto def, StatusCode code, const std::string& field) {
        def.base = base;
        const Status status = world.createJoint(def).status();
        EXPECT_EQ(status.code, code) << field;
        EXPECT_EQ(std::string(status.field), field);
        EXPECT_EQ(world.jointCount(), 0U);
    };
    const auto expectGripRefused = [&](auto def) {
        def.anchorB = DVec2{0, nan};
        expectRefused(def, StatusCode::notFinite, "anchorB");
        def.anchorB = DVec2{1e200, 0};
        expectRefused(def, StatusCode::outOfRange, "anchorB");
        def.anchorB.reset();
        def.referenceAngle = infinity;
        expectRefused(def, StatusCode::notFinite, "referenceAngle");
        def.referenceAngle = 1e200;
        expectRefused(def, StatusCode::outOfRange, "referenceAngle");
    };
    expectGripRefused(RevoluteJointDef{});
    expectGripRefused(PrismaticJointDef{});
    expectGripRefused(WheelJointDef{});
    expectGripRefused(WeldJointDef{});
    expectRefused(MotorJointDef{.referenceAngle = nan}, StatusCode::notFinite, "referenceAngle");
    PulleyJointDef pulley;
    pulley.length = real(0);
    expectRefused(pulley, StatusCode::notPositive, "length");
    pulley.length = real(infinity);
    expectRefused(pulley, StatusCode::notFinite, "length");
}

}  // namespace
}  // namespace swept::test

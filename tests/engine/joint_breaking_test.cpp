#include <functional>

#include "joint_support.h"

/// Joints that break: each kind carries a load whose weight is known, holds at a little more, and breaks at a little
/// less.

namespace swept::test {
namespace {

constexpr double kMass = 1;
constexpr double kArm = 0.5;  // from the joint to the centre of mass of a load that turns
const double kWeight = kMass * kGravity;

/// A scene with one joint that bears a load.
struct Bearer {
    World world = makeWorld();
    BodyId base = anchorOf(world);
    BodyId load{};
    JointId joint{};

    /// A box of one kilogram. @param x  of its centre: where that is not 0, the joint at the origin bears its torque
    /// too
    JointDef hang(double x) {
        load = addBody(world, dynamicAt({x, 0}), box(0.5, 0.5));
        return between(base, load);
    }
};

struct Kind {
    const char* name;
    /// Makes the joint with that strength. @param x  where the load is
    std::function<void(Bearer&, double x, std::optional<Real> force, std::optional<Real> torque)> make;
};

template <class Def>
void join(Bearer& bearer, Def def, std::optional<Real> force, std::optional<Real> torque) {
    def.base.breakForce = force;
    def.base.breakTorque = torque;
    bearer.joint = must(bearer.world.createJoint(def));
}

/// Kinds that do not let the load turn.
std::vector<Kind> rigidKinds() {
    return {{"weld",
             [](Bearer& b, double x, auto force, auto torque) {
                 WeldJointDef def;
                 def.base = b.hang(x);
                 join(b, def, force, torque);
             }},
            {"prismatic, across its axis",
             [](Bearer& b, double x, auto force, auto torque) {
                 PrismaticJointDef def;
                 def.base = b.hang(x);
                 def.axis = {1, 0};
                 join(b, def, force, torque);
             }},
            {"revolute, at its limit",
             [](Bearer& b, double x, auto force, auto torque) {
                 RevoluteJointDef def;
                 def.base = b.hang(x);
                 def.limits = AngleLimits{0, 0};
                 join(b, def, force, torque);
             }},
            {"wheel, by its motor", [](Bearer& b, double x, auto force, auto torque) {
                 WheelJointDef def;
                 def.base = b.hang(x);
                 def.axis = {1, 0};
                 def.motor = AngularMotor{0, 100};
                 join(b, def, force, torque);
             }}};
}

/// Kinds that carry a weight below them.
std::vector<Kind> carryingKinds() {
    return {{"distance",
             [](Bearer& b, double x, auto force, auto torque) {
                 DistanceJointDef def;
                 def.base = b.hang(x);
                 def.anchorA = {x, 2};
                 def.anchorB = {x, 0.5};
                 join(b, def, force, torque);
             }},
            {"prismatic, by its motor",
             [](Bearer& b, double x, auto force, auto torque) {
                 PrismaticJointDef def;
                 def.base = b.hang(x);
                 def.axis = {0, 1};
                 def.motor = LinearMotor{0, 100};
                 join(b, def, force, torque);
             }},
            {"motor",
             [](Bearer& b, double x, auto force, auto torque) {
                 MotorJointDef def;
                 def.base = b.hang(x);
                 def.drive.maxForce = real(100);
                 def.drive.maxTorque = real(100);
                 join(b, def, force, torque);
             }},
            {"mouse",
             [](Bearer& b, double x, auto force, auto torque) {
                 MouseJointDef def;
                 def.base = b.hang(x);
                 def.target = {x, 0};
                 join(b, def, force, torque);
             }},
            {"pulley",
             [](Bearer& b, double x, auto force, auto torque) {
                 PulleyJointDef def;
                 def.base = b.hang(x);
                 def.base.bodyA = addBody(b.world, dynamicAt({x + 2, 0}), box(0.5, 0.5));
                 def.groundA = def.groundB = {x + 2, 5};
                 def.groundB.x = x;
                 def.anchorA = {x + 2, 0.5};
                 def.anchorB = {x, 0.5};
                 join(b, def, force, torque);
             }},
            {"gear", [](Bearer& b, double x, auto force, auto torque) {
                 PrismaticJointDef rail;  // a rack that hangs on a pinion that cannot turn
                 rail.base = b.hang(x);
                 rail.axis = {0, 1};
                 const BodyId pinion = addBody(b.world, dynamicAt({-3, 0}), circle(0.5));
                 RevoluteJointDef hinge;
                 hinge.base = between(b.base, pinion);
                 hinge.anchor = {-3, 0};
                 hinge.limits = AngleLimits{0, 0};
                 GearJointDef def;
                 def.jointA = must(b.world.createJoint(hinge));
                 def.jointB = must(b.world.createJoint(rail));
                 join(b, def, force, torque);
             }}};
}

/// Whether the joint breaks within half a second; that it is reported once, by its name, and gone then.
bool breaks(Bearer& bearer) {
    World& world = bearer.world;
    const std::uint32_t before = world.jointCount();
    for (int i = 0; i < 30; ++i) {
        must(world.step(kStep));
        if (world.jointBreaks().empty()) { continue; }
        EXPECT_EQ(world.jointBreaks().size(), 1U);
        EXPECT_EQ(world.jointBreaks()[0].joint, bearer.joint);
        EXPECT_EQ(world.jointBreaks()[0].bodyB, bearer.load);
        const JointBreakEvent& told = world.jointBreaks()[0];
        EXPECT_TRUE(length(told.force) > 0 || told.torque != 0);
        EXPECT_FALSE(world.isValid(bearer.joint));
        EXPECT_EQ(world.jointCount(), before - 1);
        must(world.step(kStep));
        EXPECT_TRUE(world.jointBreaks().empty()) << "told once";
        return true;
    }
    EXPECT_TRUE(world.isValid(bearer.joint));
    return false;
}

TEST(JointBreaking, EveryKindBreaksAboveItsForceOnly) {
    std::vector<Kind> kinds = rigidKinds();
    const std::vector<Kind> more = carryingKinds();
    kinds.insert(kinds.end(), more.begin(), more.end());
    for (const Kind& kind : kinds) {
        for (const double strength : {0.1, 0.95, 1.05}) {
            SCOPED_TRACE(std::string(kind.name) + ' ' + std::to_string(strength));
            Bearer bearer;
            kind.make(bearer, 0, real(strength * kWeight), std::nullopt);
            EXPECT_EQ(breaks(bearer), strength < 1);
        }
    }
}

TEST(JointBreaking, WhatHoldsALeverBreaksAboveItsTorqueOnly) {
    for (const Kind& kind : rigidKinds()) {
        for (const double strength : {0.1, 0.95, 1.05}) {
            SCOPED_TRACE(std::string(kind.name) + ' ' + std::to_string(strength));
            Bearer bearer;
            kind.make(bearer, kArm, std::nullopt, real(strength * kWeight * kArm));
            EXPECT_EQ(breaks(bearer), strength < 1);
        }
    }
}

/// What was set last counts, and a joint whose limits are taken away does not break.
TEST(JointBreaking, LimitsCanBeSetLater) {
    for (const bool stays : {true, false}) {
        Bearer bearer;
        rigidKinds()[0].make(bearer, 0, real(2 * kWeight), std::nullopt);
        run(bearer.world, 10);
        must(bearer.world.setBreakLimits(bearer.joint, stays ? std::optional<Real>() : real(0.5 * kWeight), {}));
        EXPECT_NE(breaks(bearer), stays);
    }
}

/// From the step in which it breaks on, the load falls freely.
TEST(JointBreaking, TheLoadFallsFromThere) {
    Bearer bearer;
    rigidKinds()[0].make(bearer, 0, real(2 * kWeight), std::nullopt);
    run(bearer.world, 10);
    must(bearer.world.setBreakLimits(bearer.joint, real(0.5 * kWeight), {}));
    must(bearer.world.step(kStep));
    ASSERT_EQ(bearer.world.jointBreaks().size(), 1U);
    EXPECT_NEAR(bearer.world.jointBreaks()[0].force.y, kWeight, 1e-3 * kWeight);
    const double speed = velocityOf(bearer.world, bearer.load).y;
    EXPECT_NEAR(speed, 0, 1e-3) << "it held to the end of that step";
    run(bearer.world, 30);
    EXPECT_NEAR(velocityOf(bearer.world, bearer.load).y, speed - 30 * kStep * kGravity, 1e-3);
}

}  // namespace
}  // namespace swept::test

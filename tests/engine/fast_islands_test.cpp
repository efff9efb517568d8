#include "../support/random.h"
#include "world_support.h"

/// What joints tie together goes through its impacts together: nothing escapes, comes apart or stands still.

namespace swept::test {
namespace {

double lostIn(const World& world) {
    double lost = 0;
    for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
    return lost;
}

struct Whirl {
    bool escaped = false;
    double stretch = 0;  ///< of the hinge, m
    double gain = 0;     ///< largest kinetic energy, as a part of that at the start
    double lost = 0;     ///< s
};

/// A bar of 2 × 0.01 m that turns about a point `offset` from its centre, into a pin.
Whirl whirl(double spin, double offset, double start, double restitution) {
    World world = makeWorld(0);
    const ShapeDef surface = material(0.3, restitution);
    const BodyId pin = addStatic(world, circle(0.02), surface, {0.9 - offset, 0});
    const DVec2 arm = turned({-offset, 0}, -start);  // from the centre to the pivot, which is at (−offset, 0)
    BodyDef def = dynamicAt(DVec2{-offset, 0} - arm, toReal(spin * DVec2{arm.y, -arm.x}), spin);
    def.angle = -start;
    const BodyId bar = addBody(world, def, box(1, 0.005), surface);
    RevoluteJointDef hinge;
    hinge.base.bodyA = pin;
    hinge.base.bodyB = bar;
    hinge.base.collideConnected = true;
    hinge.anchor = {-offset, 0};
    const JointId joint = must(world.createJoint(hinge));
    const double before = kineticEnergy(world, bar);
    Whirl result;
    for (int i = 0; i < 60; ++i) {
        must(world.step(kStep));
        result.stretch = std::max(result.stretch, static_cast<double>(world.jointError(joint)));
        result.gain = std::max(result.gain, kineticEnergy(world, bar) / before);
        result.lost += lostIn(world);
    }
    result.escaped = world.angle(bar) > 0 || world.angle(bar) < -2 * kPi;
    return result;
}

TEST(FastIslands, AHingedBarStaysOnItsSideOfAPin) {
    for (const double offset : {0.0, 0.4, 1.0}) {
        for (const double restitution : {0.0, 1.0}) {
            for (const double spin : {10.0, 90.0, 500.0}) {
                Random random(3);
                for (int i = 0; i < 15; ++i) {
                    const double start = random.range(0.5, 2.5);
                    const Whirl result = whirl(spin, offset, start, restitution);
                    const std::string name = std::to_string(spin) + " rad/s, pivot at " + std::to_string(offset) +
                                             ", e " + std::to_string(restitution) + ", from " + std::to_string(start);
                    EXPECT_FALSE(result.escaped) << name;
                    EXPECT_LE(result.stretch, 0.1) << name;
                    EXPECT_LE(result.gain, 1 + 1e-4) << name;
                    EXPECT_LE(result.lost, 0.001) << name;
                }
            }
        }
    }
}

/// Ten capsules and a head.
struct Ragdoll {
    std::vector<BodyId> bodies;
    std::vector<JointId> joints;

    Ragdoll(World& world, DVec2 place, DVec2 velocity, double restitution, double spin) {
        const ShapeDef surface = material(0.3, restitution);
        const auto add = [&](double x, double y, const Polygon& polygon) {
            bodies.push_back(addBody(
                world, dynamicAt({place.x + x, place.y + y}, toReal(velocity + spin * DVec2{-y, x}), spin), polygon,
                surface));
            return bodies.back();
        };
        const auto limb = [](double half, double radius) {
            return must(makeCapsule(vec(0, -half), vec(0, half), real(radius)));
        };
        const auto join = [&](BodyId a, BodyId b, double x, double y) {
            RevoluteJointDef hinge;
            hinge.base.bodyA = a;
            hinge.base.bodyB = b;
            hinge.anchor = {place.x + x, place.y + y};
            hinge.limits = AngleLimits{real(-1), real(1)};
            joints.push_back(must(world.createJoint(hinge)));
        };
        const BodyId torso = add(0, 0, limb(0.25, 0.12));
        join(torso, add(0, 0.5, circle(0.12)), 0, 0.37);
        for (const double side : {-1.0, 1.0}) {
            const BodyId upperArm = add(side * 0.25, 0.1, limb(0.15, 0.05));
            join(torso, upperArm, side * 0.15, 0.25);
            join(upperArm, add(side * 0.25, -0.25, limb(0.15, 0.04)), side * 0.25, -0.07);
            const BodyId thigh = add(side * 0.1, -0.55, limb(0.18, 0.07));
            join(torso, thigh, side * 0.1, -0.33);
            join(thigh, add(side * 0.1, -0.95, limb(0.18, 0.05)), side * 0.1, -0.75);
        }
    }
};

TEST(FastIslands, ARagdollStaysTogetherAndOnItsSideOfAWall) {
    for (const double restitution : {0.0, 0.5}) {
        for (const double speed : {10.0, 30.0, 100.0, 300.0}) {
            Random random(9);
            for (int i = 0; i < 4; ++i) {
                World world = makeWorld();
                addStatic(world, segment(0, -300, 0, 300), material(0.3, restitution));
                const double way = 1.5 + random.uniform() * speed * kStep;
                const double aim = random.range(-0.5, 0.5);
                const Ragdoll doll(world, {-way, 0}, speed * DVec2{std::cos(aim), std::sin(aim)}, restitution,
                                   random.range(-10, 10));
                const std::string name =
                    std::to_string(speed) + " m/s, e " + std::to_string(restitution) + ", shot " + std::to_string(i);
                double lost = 0;
                double stretch = 0;
                for (int step = 0; step < 60; ++step) {
                    must(world.step(kStep));
                    lost += lostIn(world);
                    for (const JointId joint : doll.joints) {
                        stretch = std::max(stretch, static_cast<double>(world.jointError(joint)));
                    }
                }
                for (const BodyId body : doll.bodies) { EXPECT_LT(world.centerOfMass(body).x, 0) << name; }
                EXPECT_LE(stretch, 0.06) << name;
                EXPECT_LE(lost / (60 * kStep * static_cast<double>(doll.bodies.size())), 1e-3) << name;
            }
        }
    }
}

TEST(FastIslands, AMotorThatPressesLosesNoTime) {
    for (const double speed : {5.0, 50.0, 200.0}) {
        World world = makeWorld(0);
        const BodyId wall = addStatic(world, segment(0.8, -5, 0.8, 5), material(0.3));
        const BodyId bar = addBody(world, dynamicAt({}), box(1, 0.02), material(0.3));
        RevoluteJointDef hinge;
        hinge.base.bodyA = wall;
        hinge.base.bodyB = bar;
        hinge.base.collideConnected = true;
        hinge.motor = AngularMotor{real(-speed), real(2)};
        must(world.setPose(bar, {}, 1.2));
        must(world.createJoint(hinge));
        runFor(world, 1);
        double lost = 0;
        for (int i = 0; i < 120; ++i) {
            must(world.step(kStep));
            lost += lostIn(world);
        }
        EXPECT_EQ(lost, 0) << speed << " rad/s";
        EXPECT_NEAR(world.angle(bar), std::acos(0.8), 0.03) << speed << " rad/s";
    }
}

}  // namespace
}  // namespace swept::test

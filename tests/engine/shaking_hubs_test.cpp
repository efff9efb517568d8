#include "joint_support.h"

#include <algorithm>
#include <cmath>
#include <vector>

/// Several rigid joints on one body: what a pass over them leaves of a kick shakes on, and each step may make a little
/// of it. It adds up to nothing.

namespace swept::test {
namespace {

ShapeDef loose() {
    ShapeDef def = material(0.6);
    def.filter.mask = 0;
    return def;
}

/// A disc of 10 kg with bars welded on all around it.
struct Star {
    World world = makeWorld(awakeSettings(Profile::fast));
    std::vector<BodyId> bodies;

    Star(int arms, double mass, BodyDef like) {
        like.type = BodyType::dynamic;
        like.mass = 10;
        bodies.push_back(addBody(world, like, circle(0.5), loose()));
        like.mass = real(mass);
        for (int i = 0; i < arms; ++i) {
            like.angle = 2 * kPi * i / arms + 0.1;
            const DVec2 along = turned({1, 0}, like.angle);
            like.position = along;
            bodies.push_back(addBody(world, like, box(0.5, 0.05), loose()));
            WeldJointDef weld;
            weld.base = between(bodies.front(), bodies.back());
            weld.anchor = 0.5 * along;
            must(world.createJoint(weld));
        }
    }

    void spin(double speed) {
        for (const BodyId body : bodies) {
            const DVec2 place = world.position(body);
            must(world.setVelocity(body, vec(-speed * place.y, speed * place.x), real(speed)));
        }
    }
    double mass() const {
        double sum = 0;
        for (const BodyId body : bodies) { sum += world.mass(body); }
        return sum;
    }
    /// Kinetic, as seen from the centre of mass, J.
    double ownEnergy() const {
        const DVec2 momentum = momentumOf(world, bodies);
        return energyOf(world, bodies, 0) - dot(momentum, momentum) / (2 * mass());
    }
};

BodyDef damped(double damping) {
    BodyDef def;
    def.linearDamping = def.angularDamping = real(damping);
    return def;
}

/// (960 J after a minute, and 3100 with damping.)
TEST(ShakingHubs, OnAHingeComeToRest) {
    for (const double damping : {0.0, 1.0}) {
        Star star(4, 10, damped(damping));
        RevoluteJointDef hinge;
        hinge.base = between(anchorOf(star.world), star.bodies[0]);
        must(star.world.createJoint(hinge));
        for (int i = 0; i < 10; ++i) { must(star.world.step(kStep)); }
        must(star.world.applyImpulse(star.bodies[1], {0, 10}));  // 5 J
        for (int i = 0; i < 1800; ++i) {
            must(star.world.step(kStep));
            ASSERT_LT(energyOf(star.world, star.bodies, 0), 10) << "damping " << damping << " step " << i;
        }
        EXPECT_LT(energyOf(star.world, star.bodies, 0), 0.2) << "damping " << damping;
    }
}

/// As fast as it falls, what gravity gives and damping takes in a step is many times what it has of its own. (Its parts
/// went at 205 m/s after half a minute.)
TEST(ShakingHubs, ThatFallThroughAirTurnMoreAndMoreSlowly) {
    constexpr double kDamping = 0.2;
    for (const int arms : {4, 6}) {
        for (const double mass : {5.0, 10.0, 20.0}) {
            Star star(arms, mass, damped(kDamping));
            star.spin(3);
            const double start = star.ownEnergy();
            for (int i = 0; i < 900; ++i) {
                must(star.world.step(kStep));
                const double most = start * std::exp(-2 * kDamping * kStep * i);
                ASSERT_LT(star.ownEnergy(), 1.05 * most) << arms << " arms of " << mass << " kg, step " << i;
            }
            const double terminal = kGravity / kDamping;
            const double fall = length(momentumOf(star.world, star.bodies)) / star.mass();
            EXPECT_NEAR(fall, terminal * (1 - std::exp(-kDamping * 15)), 0.01 * terminal)
                << arms << " arms of " << mass << " kg";
        }
    }
}

/// (Its own energy doubled in half a minute.) What it keeps is that of its turning, but for what shakes.
TEST(ShakingHubs, ThatFlyKeepTheirEnergyAndNoMore) {
    for (const int arms : {4, 6}) {
        for (const double mass : {5.0, 10.0, 20.0}) {
            Star star(arms, mass, {});
            star.spin(3);
            const double start = star.ownEnergy();
            for (int i = 0; i < 1800; ++i) {
                must(star.world.step(kStep));
                ASSERT_LT(star.ownEnergy(), 1.02 * start) << arms << " arms of " << mass << " kg, step " << i;
            }
            EXPECT_GT(star.ownEnergy(), 0.9 * start) << arms << " arms of " << mass << " kg";
            const double fall = length(momentumOf(star.world, star.bodies)) / star.mass();
            EXPECT_NEAR(fall, kGravity * 30, 0.001 * kGravity * 30) << arms << " arms of " << mass << " kg";
        }
    }
}

/// A bridge of twenty planks that is struck: its waves go on, as joints that opened a little close again.
TEST(ShakingHubs, AreNoWavesOfABridge) {
    World world = makeWorld(awakeSettings(Profile::fast));
    const BodyId ground = anchorOf(world);
    const auto hinge = [&](BodyId a, BodyId b, double x) {
        RevoluteJointDef def;
        def.base = between(a, b);
        def.anchor = {x, 0};
        must(world.createJoint(def));
    };
    constexpr int kPlanks = 20;
    std::vector<BodyId> planks;
    for (int i = 0; i < kPlanks; ++i) {
        BodyDef def = dynamicAt({i + 0.5, 0});
        def.mass = 1;
        planks.push_back(addBody(world, def, box(0.5, 0.05), loose()));
        hinge(i == 0 ? ground : planks[planks.size() - 2], planks.back(), i);
    }
    hinge(planks.back(), ground, kPlanks);
    for (int i = 0; i < 60; ++i) { must(world.step(kStep)); }
    must(world.applyImpulse(planks[7], {0, 20}));
    double sum = 0;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        if (i >= 480) { sum += energyOf(world, planks, 0) / 120; }
    }
    EXPECT_GT(sum, 1);  // J; 2.2, and 0.000 where what opened joints was forgotten at once
}

}  // namespace
}  // namespace swept::test

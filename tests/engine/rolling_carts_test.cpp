#include <cmath>
#include <string>

#include "world_support.h"

/// Carts whose wheels resist rolling, against a closed form, and at rest.

namespace swept::test {
namespace {

constexpr double kCartWheel = 0.5;
constexpr double kCartResistance = 0.08;

struct RollingCart {
    BodyId chassis{};
    double carried = 0;  ///< kg
    double moved = 0;    ///< kg, with what its wheels turn
};

RollingCart addCart(World& world, double speed, double density) {
    addStatic(world, box(100, 1), material(1), {0, -1});
    RollingCart cart;
    cart.chassis = addBody(world, dynamicAt({0, 0.8}, vec(speed, 0)), box(1, 0.2), material(1, 0, density));
    cart.carried = cart.moved = world.mass(cart.chassis);
    for (const double x : {-0.8, 0.8}) {
        BodyDef def = dynamicAt({x, kCartWheel}, vec(speed, 0));
        def.angularVelocity = real(-speed / kCartWheel);
        ShapeDef rubber = material(4);
        rubber.rollingResistance = real(kCartResistance);
        const BodyId wheel = addBody(world, def, circle(kCartWheel), rubber);
        RevoluteJointDef hinge;
        hinge.base.bodyA = cart.chassis;
        hinge.base.bodyB = wheel;
        hinge.anchor = {x, kCartWheel};
        must(world.createJoint(hinge));
        cart.carried += world.mass(wheel);
        cart.moved += world.mass(wheel) + world.inertia(wheel) / (kCartWheel * kCartWheel);
    }
    return cart;
}

/// A cart on two wheels: contacts are iterated with its joints, or, where it is heavy, on what these answer.
TEST(RollingCarts, SlowsDownACart) {
    for (const Profile profile : kProfiles) {
        for (const double density : {1.0, 200.0}) {
            World world = makeWorld(profile);
            const RollingCart cart = addCart(world, 3, density);
            runFor(world, 2);
            const double brake = kCartResistance * kGravity * cart.carried / cart.moved;
            expectAtMost(profileName(profile) + " at " + std::to_string(density) + " kg/m², lost",
                         std::abs((3 - velocityOf(world, cart.chassis).x) / (2 * brake) - 1), 0.01);
        }
    }
}

/// (It trembled for ever, at up to 0.18 m/s: the joints and contacts of what resists rolling took turns.)
TEST(RollingCarts, LetsAHeavyCartComeToRest) {
    for (const double density : {10.0, 100.0, 1000.0, 4000.0}) {
        WorldSettings settings;
        settings.gravity = vec(0, -22);
        World world = makeWorld(settings);
        const RollingCart cart = addCart(world, 0, density);
        runFor(world, 3);
        EXPECT_FALSE(world.isAwake(cart.chassis)) << density << " kg/m²";
    }
}

}  // namespace
}  // namespace swept::test

#include <algorithm>
#include <cmath>
#include <string>

#include "../support/random.h"
#include "../support/some_of.h"
#include "world_support.h"

/// What bounces off something that joints hold to the ground bounces as that can move: off a plate that is welded to
/// the level as off the level, off a flap as its turning about the hinge takes up.

namespace swept::test {
namespace {

enum class Hold { weld, limit, twoHinges, sliderAtItsEnd };
constexpr Hold kHolds[] = {Hold::weld, Hold::limit, Hold::twoHinges, Hold::sliderAtItsEnd};

void hold(World& world, BodyId level, BodyId plate, Hold how) {
    if (how == Hold::weld) {
        must(world.createJoint(WeldJointDef{.base = {.bodyA = level, .bodyB = plate}, .anchor = {-0.3, 0}}));
    } else if (how == Hold::limit) {
        RevoluteJointDef hinge{.base = {.bodyA = level, .bodyB = plate}, .anchor = {-0.3, 0}};
        hinge.limits = AngleLimits{.lower = 0, .upper = 1};
        must(world.createJoint(hinge));
    } else if (how == Hold::sliderAtItsEnd) {
        PrismaticJointDef slider{.base = {.bodyA = level, .bodyB = plate}, .anchor = {0, 0}, .axis = {0, 1}};
        slider.limits = TranslationLimits{.lower = 0, .upper = 1};
        must(world.createJoint(slider));
    } else {
        for (const double x : {-0.3, 0.3}) {
            must(world.createJoint(RevoluteJointDef{.base = {.bodyA = level, .bodyB = plate}, .anchor = {x, 0}}));
        }
    }
}

/// @return the speed with which a ball of 3 m/s leaves a plate that cannot move
double bounceOff(Profile profile, Hold how, double ratio, double restitution, bool isBullet, bool isBox) {
    World world = makeWorld(awakeSettings(profile, 0));
    const BodyId level = must(world.createBody({}));
    const BodyId plate = addBody(world, dynamicAt({0, 0}), box(0.3, 0.02), material(0));
    BodyDef def = dynamicAt({0.15, 0.2}, vec(0, -3));
    def.bullet = isBullet;
    def.mass = 1;
    const BodyId ball = addBody(world, def, isBox ? box(0.05, 0.05) : circle(0.05), material(0, restitution));
    BodyDef heavy = world.definition(plate);
    heavy.mass = real(ratio);
    must(world.redefine(plate, heavy));
    hold(world, level, plate, how);
    run(world, 20);
    return velocityOf(world, ball).y;
}

/// (Of plates as heavy as the ball it left with 0 to 0.3 of that; in Box2D 3 0.4 to 0.6.)
TEST(HeldBounce, OffWhatCannotMove) {
    for (const Profile profile : kProfiles) {
        for (const Hold how : kHolds) {
            for (const double ratio : {0.001, 0.1, 1.0, 10.0}) {
                for (const double restitution : {0.5, 0.9}) {
                    for (const bool isBullet : {false, true}) {
                        for (const bool isBox : {false, true}) {
                            const double speed = bounceOff(profile, how, ratio, restitution, isBullet, isBox);
                            expectAtMost("hold " + std::to_string(static_cast<int>(how)) + ", " +
                                             std::to_string(ratio) + " : 1, e " + std::to_string(restitution) +
                                             (isBullet ? ", bullet" : "") + (isBox ? ", box" : ""),
                                         std::abs(speed / (3 * restitution) - 1), 1e-4);
                        }
                    }
                }
            }
        }
    }
}

/// A ball strikes a bar of 0.6 m that turns about its end: J = (1 + e)·v / (1/m + d²/I).
TEST(HeldBounce, OffAFlap) {
    for (const Profile profile : kProfiles) {
        for (const double density : {20.0, 140.0, 1000.0}) {
            for (const double restitution : {0.4, 0.9, 1.0}) {
                for (const bool isBullet : {false, true}) {
                    for (const double lever : {0.15, 0.3, 0.5}) {
                        World world = makeWorld(awakeSettings(profile, 0));
                        const BodyId level = must(world.createBody({}));
                        const BodyId bar = addBody(world, dynamicAt({0.3, 0}), box(0.3, 0.02), material(0, 0, density));
                        must(world.createJoint(
                            RevoluteJointDef{.base = {.bodyA = level, .bodyB = bar}, .anchor = {0, 0}}));
                        BodyDef def = dynamicAt({lever, 0.2}, vec(0, -2));
                        def.bullet = isBullet;
                        const BodyId ball = addBody(world, def, circle(0.05), material(0, restitution, 140));
                        for (int i = 0; i < 20 && world.angularVelocity(bar) == 0; ++i) { run(world, 1); }
                        const double inertia = world.inertia(bar) + world.mass(bar) * 0.09;
                        const double impulse = (1 + restitution) * 2 / (1 / world.mass(ball) + lever * lever / inertia);
                        const std::string name = std::to_string(density) + " kg/m2, e " + std::to_string(restitution) +
                                                 ", " + std::to_string(lever) + " m";
                        expectAtMost(name, std::abs(velocityOf(world, ball).y + 2 - impulse / world.mass(ball)), 2e-3);
                        expectAtMost(
                            name, std::abs(static_cast<double>(world.angularVelocity(bar)) + impulse * lever / inertia),
                            5e-3 * impulse * lever / inertia);
                    }
                }
            }
        }
    }
}

double kineticEnergyOf(const World& world, BodyId id) {
    const double speed = length(toDouble(world.velocity(id)));
    const auto spin = static_cast<double>(world.angularVelocity(id));
    return 0.5 * (world.mass(id) * speed * speed + world.inertia(id) * spin * spin);
}

/// Whatever holds it, whatever strikes it, with friction and without.
TEST(HeldBounce, MakesNoEnergy) {
    int bounced = 0;
    for (std::uint64_t seed = 0; seed < someOf(std::uint64_t{600}); ++seed) {
        Random random(seed);
        World world = makeWorld(awakeSettings(random.chance(0.5) ? Profile::accurate : Profile::fast, 0));
        const BodyId level = must(world.createBody({}));
        const double friction = random.chance(0.5) ? random.range(0, 1) : 0;
        const bool isRound = random.chance(0.3);
        const double density = std::exp(random.range(-2, 3));
        const BodyId plate =
            addBody(world, dynamicAt({0, 0}), isRound ? circle(0.2) : box(0.3, 0.05), material(friction, 0, density));
        const double kind = random.uniform();
        const DVec2 anchor{random.range(-0.3, 0.3), random.range(-0.05, 0.05)};
        if (kind < 0.4) {
            must(world.createJoint(RevoluteJointDef{.base = {.bodyA = level, .bodyB = plate}, .anchor = anchor}));
        } else if (kind < 0.6) {
            must(world.createJoint(
                DistanceJointDef{.base = {.bodyA = level, .bodyB = plate}, .anchorA = {0.2, -1}, .anchorB = anchor}));
        } else if (kind < 0.8) {
            const double angle = random.range(0, 3);
            must(world.createJoint(PrismaticJointDef{.base = {.bodyA = level, .bodyB = plate},
                                                     .anchor = anchor,
                                                     .axis = {std::cos(angle), std::sin(angle)}}));
        } else {
            must(world.createJoint(WeldJointDef{.base = {.bodyA = level, .bodyB = plate}, .anchor = anchor}));
        }
        const double angle = random.range(0, 2 * kPi);
        const double speed = random.range(1, 8);
        const DVec2 from{0.8 * std::cos(angle), 0.8 * std::sin(angle)};
        const double aside = random.range(-0.2, 0.2);
        BodyDef def = dynamicAt({from.x - aside * std::sin(angle), from.y + aside * std::cos(angle)},
                                vec(-speed * std::cos(angle), -speed * std::sin(angle)));
        def.bullet = random.chance(0.5);
        def.angularVelocity = real(random.range(-10, 10));
        const double restitution = random.range(0.1, 1);
        const bool isBall = random.chance(0.5);
        const BodyId ball = addBody(world, def, isBall ? circle(0.1) : box(0.1, 0.1), material(friction, restitution));
        const double before = kineticEnergyOf(world, ball);
        double most = 0;
        for (int i = 0; i < 40; ++i) {
            run(world, 1);
            most = std::max(most, kineticEnergyOf(world, ball) + kineticEnergyOf(world, plate));
            for (const ContactEvent& event : world.contactEvents()) {
                bounced += event.type == ContactEventType::hit ? 1 : 0;
            }
        }
        expectAtMost("seed " + std::to_string(seed), most / before, 1.002);
    }
    EXPECT_GT(bounced, 100);
}

/// Fastest of a plank of 1 to 2 m in 10 s, on a static hinge in or beside the edge of a static block that bounces by so
/// much.
double fastestOfJammed(Profile profile, double restitution, DVec2 pivot, double angle, double half) {
    World world = makeWorld(awakeSettings(profile));
    const BodyId post = must(world.createBody({}));
    const BodyId block = must(world.createBody({}));
    must(world.addShape(block, must(makeBox(vec(2, 1), vec(-2, -1))), material(0.6, restitution)));
    const DVec2 along{std::cos(angle), std::sin(angle)};
    const BodyId plank =
        addBody(world, dynamicAt(pivot + half * along, {}, angle), box(half + 0.2, 0.2), material(0.6));
    must(world.createJoint(RevoluteJointDef{.base = {.bodyA = post, .bodyB = plank}, .anchor = pivot}));
    double fastest = 0;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        fastest = std::max(fastest, length(velocityOf(world, plank)));
    }
    return fastest;
}

/// Joints and contacts oppose each other, and leave the plank next to no way to yield: thrown back along that it was at
/// up to 10⁹ m/s, and at 0 to 9 m/s without restitution.
TEST(HeldBounce, WhatIsJammedIsNotThrown) {
    for (const Profile profile : kProfiles) {
        for (const double restitution : {0.1, 0.3}) {
            for (const double x : {-0.2, -0.1, 0.0}) {
                for (const double y : {-0.2, -0.1, 0.0}) {
                    for (const double angle : {-1.0, -0.5, 0.5, 1.0}) {
                        EXPECT_LT(fastestOfJammed(profile, restitution, {x, y}, angle, 0.5), 12)
                            << profileName(profile) << ' ' << restitution << " at " << x << ", " << y << ", " << angle;
                    }
                }
            }
        }
    }
}

/// A box on a hinge to something kinematic that is at rest, and overlaps it: it was at up to 10¹⁸ m/s, where it yielded
/// as its hinge lets it. (Such contradictions give up to 88 m/s without restitution, too.)
TEST(HeldBounce, WhatOverlapsSomethingKinematicIsNotThrown) {
    for (const Profile profile : kProfiles) {
        for (const double restitution : {0.001, 0.1, 0.5}) {
            WorldSettings settings;
            settings.profile = profile;
            settings.gravity = {};
            World world = makeWorld(settings);
            const BodyId pusher = must(world.createBody({.type = BodyType::kinematic}));
            must(world.addShape(pusher, box(0.5, 0.5)));
            const BodyId held =
                addBody(world, dynamicAt({0.6, 0.1}, {}, 0.3), box(0.5, 0.2), material(0.6, restitution));
            must(world.createJoint(RevoluteJointDef{.base = {.bodyA = pusher, .bodyB = held, .collideConnected = true},
                                                    .anchor = {0.3, 0}}));
            for (int i = 0; i < 600; ++i) {
                must(world.step(kStep));
                ASSERT_LT(length(velocityOf(world, held)), 100) << profileName(profile) << ' ' << restitution;
            }
        }
    }
}

/// A weld on springs does not hold its plate in a blow: of two equal boxes the one that strikes stays where it is, and
/// the other has all of its speed. (As if the springs were rigid, it went back at 4 m/s.)
TEST(HeldBounce, OffWhatSpringsHold) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        const BodyId level = must(world.createBody({}));
        const BodyId plate = addBody(world, dynamicAt({0, 0}), box(0.5, 0.5), material(0, 1));
        WeldJointDef weld{.base = {.bodyA = level, .bodyB = plate}, .anchor = {0, 0}};
        weld.linearSpring = weld.angularSpring = Spring{real(0.5), 0};
        must(world.createJoint(weld));
        const BodyId striker = addBody(world, dynamicAt({-2, 0}, vec(4, 0)), box(0.5, 0.5), material(0, 1));
        run(world, 22);  // it is there after a quarter of a second
        const double seconds = 22 * kStep - 0.25;
        EXPECT_NEAR(velocityOf(world, striker).x, 0, 0.05) << profileName(profile);
        EXPECT_NEAR(velocityOf(world, plate).x, 4 * std::cos(kPi * seconds), 0.2) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test

#include <functional>

#include "joint_support.h"

/// Bodies that joints hold, and that become of another type: frozen, led, and set free again.

namespace swept::test {
namespace {

void makeType(World& world, BodyId body, BodyType type) {
    BodyDef def = world.definition(body);
    def.type = type;
    must(world.redefine(body, def));
}

JointId hinge(World& world, BodyId a, BodyId b, DVec2 anchor) {
    RevoluteJointDef def;
    def.base = between(a, b);
    def.anchor = anchor;
    return must(world.createJoint(def));
}

/// A ball on a hinge 2 m to the left, that swings down.
BodyId addPendulum(World& world) {
    const BodyId ball = addBody(world, dynamicAt({2, 0}), circle(0.25));
    hinge(world, anchorOf(world), ball, {});
    return ball;
}

/// It swings on, once it is given back what it had, as if no time had gone by.
TEST(JointedTypes, AFrozenPendulumSwingsOn) {
    World plain = makeWorld();
    const BodyId free = addPendulum(plain);
    run(plain, 60);
    World world = makeWorld();
    const BodyId ball = addPendulum(world);
    run(world, 30);
    const DVec2 place = world.position(ball);
    const Vec2 velocity = world.velocity(ball);
    const Real spin = world.angularVelocity(ball);
    for (const BodyType type : {BodyType::fixed, BodyType::kinematic, BodyType::fixed}) {
        makeType(world, ball, type);
        must(type == BodyType::fixed ? Status::success() : world.setVelocity(ball, {}, 0));
        run(world, 20);
        EXPECT_EQ(world.position(ball), place);
    }
    makeType(world, ball, BodyType::dynamic);
    must(world.setVelocity(ball, velocity, spin));
    run(world, 30);
    expectAtMost("off by", length(world.position(ball) - plain.position(free)), 1e-4);
}

struct LooseChain {
    std::vector<BodyId> links;
    std::vector<JointId> joints;
};

/// Level, from (0.5, 0) to the right, joined to each other alone.
LooseChain addLooseChain(World& world, int count) {
    LooseChain chain;
    for (int i = 0; i < count; ++i) {
        chain.links.push_back(addBody(world, dynamicAt({i + 0.5, 0}), box(0.5, 0.1)));
        if (i > 0) {
            chain.joints.push_back(hinge(world, chain.links[static_cast<std::size_t>(i) - 1], chain.links.back(),
                                         {static_cast<double>(i), 0}));
        }
    }
    return chain;
}

double worstError(const World& world, const LooseChain& chain) {
    double worst = 0;
    for (const JointId joint : chain.joints) { worst = std::max(worst, static_cast<double>(world.jointError(joint))); }
    return worst;
}

TEST(JointedTypes, WhatIsFrozenHoldsTheRest) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        WorldSettings settings = awakeSettings(profile);
        World world = makeWorld(settings);
        const LooseChain chain = addLooseChain(world, 5);
        run(world, 20);  // all fall
        makeType(world, chain.links[2], BodyType::fixed);
        const DVec2 place = world.position(chain.links[2]);
        for (int i = 0; i < 600; ++i) {
            must(world.step(kStep));
            ASSERT_LT(worstError(world, chain), 0.05) << "step " << i;
        }
        EXPECT_EQ(world.position(chain.links[2]), place);
        EXPECT_GT(world.position(chain.links[0]).y, place.y - 3);
        EXPECT_GT(world.position(chain.links[4]).y, place.y - 3);
        makeType(world, chain.links[2], BodyType::dynamic);
        run(world, 60);
        EXPECT_NEAR(world.position(chain.links[2]).y, place.y - 5, 1.5);
        expectAtMost("error", worstError(world, chain), 0.05);
    }
}

/// Asleep or not, and whoever is first: what is fixed lies, and what is free again falls together.
TEST(JointedTypes, AllOfAChainFreezesAndThaws) {
    for (const bool forwards : {true, false}) {
        for (const bool sleeps : {true, false}) {
            WorldSettings settings = awakeSettings();
            settings.sleep = sleeps;
            World world = makeWorld(settings);
            LooseChain chain = addLooseChain(world, 6);
            run(world, 30);
            if (!forwards) { std::reverse(chain.links.begin(), chain.links.end()); }
            std::vector<DVec2> places;
            for (const BodyId link : chain.links) { makeType(world, link, BodyType::fixed); }
            for (const BodyId link : chain.links) { places.push_back(world.position(link)); }
            run(world, 60);
            EXPECT_EQ(world.counters().awakeBodies, 0U);
            for (std::size_t i = 0; i < places.size(); ++i) { EXPECT_EQ(world.position(chain.links[i]), places[i]); }
            for (const BodyId link : chain.links) { makeType(world, link, BodyType::dynamic); }
            run(world, 30);
            for (std::size_t i = 0; i < places.size(); ++i) {
                EXPECT_NEAR(world.position(chain.links[i]).y, places[i].y - 1.25, 1e-3);
            }
            expectAtMost("error", worstError(world, chain), 1e-3);
        }
    }
}

/// What is led takes along what hangs on it; neither side of a joint need be dynamic for a while.
TEST(JointedTypes, JointsRestBetweenWhatIsLed) {
    World world = makeWorld(0);
    const LooseChain chain = addLooseChain(world, 2);
    makeType(world, chain.links[0], BodyType::kinematic);
    must(world.setVelocity(chain.links[0], vec(1, 0), 0));
    run(world, 60);
    EXPECT_NEAR(world.position(chain.links[1]).x, 2.5, 0.01);
    makeType(world, chain.links[1], BodyType::fixed);
    const DVec2 place = world.position(chain.links[1]);
    run(world, 60);
    EXPECT_NEAR(world.position(chain.links[0]).x, 2.5, 1e-3);
    EXPECT_EQ(world.position(chain.links[1]), place);
    EXPECT_EQ(world.jointForce(chain.joints[0]), Vec2{});
    must(world.setVelocity(chain.links[0], {}, 0));
    makeType(world, chain.links[1], BodyType::dynamic);
    run(world, 240);
    expectAtMost("error once it is free", worstError(world, chain), 1e-3);
}

/// Every kind, every order of types of its bodies: all numbers are finite, nothing that is fixed moves, and in the end
/// the joint holds again.
TEST(JointedTypes, OfEveryKindOfJoint) {
    const auto makers = [] {
        using Make = std::function<JointId(World&, BodyId, BodyId)>;
        std::vector<Make> all;
        all.emplace_back([](World& w, BodyId a, BodyId b) { return hinge(w, a, b, {0.5, 0}); });
        const auto add = [&all](auto def, auto&& fill) {
            all.emplace_back([def, fill](World& w, BodyId a, BodyId b) mutable {
                def.base = between(a, b);
                fill(def);
                return must(w.createJoint(def));
            });
        };
        add(DistanceJointDef{}, [](auto& d) { d.anchorB = {1, 0}; });
        add(PrismaticJointDef{}, [](auto& d) { d.limits = TranslationLimits{-1, 1}; });
        add(WheelJointDef{}, [](auto& d) { d.spring = Spring{5, real(0.5)}; });
        add(WeldJointDef{}, [](auto&) {});
        add(WeldJointDef{}, [](auto& d) { d.angularSpring = Spring{5, 0}; });
        add(MotorJointDef{}, [](auto& d) { d.drive.maxForce = 100; });
        add(MouseJointDef{}, [](auto& d) {
            d.target = {1, 0};
            d.maxForce = 1000;
        });
        add(PulleyJointDef{}, [](auto& d) {
            d.groundA = {0, 3};
            d.groundB = {1, 3};
            d.anchorB = {1, 0};
        });
        add(FilterJointDef{}, [](auto&) {});
        return all;
    }();
    constexpr std::array kTypes{BodyType::fixed, BodyType::kinematic, BodyType::dynamic};
    for (std::size_t kind = 0; kind < makers.size(); ++kind) {
        for (const Profile profile : {Profile::accurate, Profile::fast}) {
            WorldSettings settings = awakeSettings(profile);
            World world = makeWorld(settings);
            const std::array bodies{addBody(world, dynamicAt({0, 0}), circle(0.25)),
                                    addBody(world, dynamicAt({1, 0}), circle(0.25))};
            const JointId joint = makers[kind](world, bodies[0], bodies[1]);
            for (int i = 0; i < 36; ++i) {
                const std::size_t which = static_cast<std::size_t>(i) / 3 % 2;
                makeType(world, bodies[which], kTypes[static_cast<std::size_t>(i * 7 + i / 3) % 3]);
                const DVec2 before = world.position(bodies[which]);
                run(world, 5);
                if (world.type(bodies[which]) == BodyType::fixed) { EXPECT_EQ(world.position(bodies[which]), before); }
            }
            for (const BodyId body : bodies) {
                makeType(world, body, BodyType::dynamic);
                must(world.setVelocity(body, {}, 0));
            }
            EXPECT_TRUE(world.isValid(joint));
            run(world, 30);
            for (const BodyId body : bodies) {
                EXPECT_TRUE(std::isfinite(world.position(body).y) && std::isfinite(world.angle(body))) << kind;
                EXPECT_LT(length(velocityOf(world, body)), 60) << kind;
            }
        }
    }
}

/// Gears on a hinge whose wheel is led meanwhile, with which it rests, go on from where they are when it is free again:
/// not a turn is made up for. Either of the hinges may be the first one of the gear.
TEST(JointedTypes, GearsGoOnFromWhereALedWheelIs) {
    for (const bool isFirst : {true, false}) {
        for (const double speed : {2.0, -7.0, 0.3}) {
            SCOPED_TRACE(testing::Message() << "first " << isFirst << ", speed " << speed);
            World world = makeWorld(0);
            const BodyId post = anchorOf(world);
            std::vector<BodyId> wheels;
            std::vector<JointId> hinges;
            for (int i = 0; i < 3; ++i) {
                wheels.push_back(addBody(world, dynamicAt({3.0 * i, 0}), circle(0.5)));
                hinges.push_back(hinge(world, post, wheels.back(), {3.0 * i, 0}));
            }
            std::vector<JointId> gears;
            for (std::size_t i = 1; i < 3; ++i) {
                const Real ratio = real(0.5 * static_cast<double>(i));
                gears.push_back(must(world.createJoint(isFirst ? GearJointDef{{}, hinges[0], hinges[i], ratio}
                                                               : GearJointDef{{}, hinges[i], hinges[0], ratio})));
            }
            makeType(world, wheels[0], BodyType::kinematic);
            must(world.setVelocity(wheels[0], {}, real(speed)));
            run(world, 300);
            must(world.setVelocity(wheels[0], {}, 0));
            run(world, 60);
            std::vector<double> angles;
            for (const BodyId wheel : wheels) { angles.push_back(world.angle(wheel)); }
            EXPECT_NEAR(angles[0], 5 * speed, 1e-3);
            EXPECT_GT(std::fabs(angles[1]), 0.5) << "it took part";
            makeType(world, wheels[0], BodyType::dynamic);
            EXPECT_LE(std::fabs(world.jointAngle(hinges[0])), 1.001 * kPi);
            for (const JointId gear : gears) { EXPECT_LT(static_cast<double>(world.jointAngleError(gear)), 1e-4); }
            run(world, 120);
            for (std::size_t i = 0; i < 3; ++i) { EXPECT_NEAR(world.angle(wheels[i]), angles[i], 1e-3) << i; }
            must(world.setVelocity(wheels[0], {}, real(1)));
            run(world, 30);
            EXPECT_GT(std::fabs(spinOf(world, wheels[2])), 0.1) << "and they mesh";
        }
    }
}

}  // namespace
}  // namespace swept::test

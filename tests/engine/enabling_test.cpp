#include <random>

#include "../support/some_of.h"
#include "joint_support.h"
#include "world_digest.h"

/// Bodies that take no part for a while. The others must not be able to tell a disabled body from one that is not
/// there, nor one that was enabled from one that was made then.

namespace swept::test {
namespace {

WorldSettings sleepySettings(double gravity = kGravity) {
    WorldSettings settings = awakeSettings(gravity);
    settings.sleep = true;
    return settings;
}

void disable(World& world, BodyId body) {
    must(world.setEnabled(body, false));
    EXPECT_FALSE(world.isEnabled(body));
    EXPECT_FALSE(world.isAwake(body));
}
void enable(World& world, BodyId body) {
    must(world.setEnabled(body, true));
    EXPECT_TRUE(world.isEnabled(body));
}

/// How far something falls from rest in so many steps of `kStep`.
double fallOf(int steps) { return 0.5 * kGravity * (steps * kStep) * (steps * kStep); }

TEST(Enabling, WhatIsDisabledStaysAndMeetsNothing) {
    World world = makeWorld();
    addStatic(world, box(5, 1));
    const BodyId ball = addBody(world, dynamicAt({0, 4}, vec(1, 2), 3), circle(0.5));
    const BodyId other = addBody(world, dynamicAt({0, 12}), circle(0.5));
    disable(world, ball);
    run(world, 84);
    EXPECT_EQ(world.position(ball), (DVec2{0, 4}));
    EXPECT_EQ(world.velocity(ball), vec(1, 2));
    EXPECT_NEAR(world.position(other).y, 12 - fallOf(84), 1e-4) << "through it";
    EXPECT_EQ(world.counters().awakeBodies, 1u);
    enable(world, ball);
    EXPECT_TRUE(world.isAwake(ball));
    run(world, 12);
    const double t = 12 * kStep;
    EXPECT_NEAR(world.position(ball).x, t, 1e-5);
    EXPECT_NEAR(world.position(ball).y, 4 + 2 * t - fallOf(12), 1e-5);
    EXPECT_NEAR(world.angle(ball), 3 * t, 1e-5);
}

TEST(Enabling, NoQueryFindsIt) {
    World world = makeWorld();
    const BodyId wall = addStatic(world, box(1, 1));
    const auto boxFinds = [&] {
        int found = 0;
        world.queryBox({vec(-2, -2), vec(2, 2)}, {}, [&found](ShapeId) { return ++found > 0; });
        return found;
    };
    const auto rayHits = [&] { return world.castRay({-5, 0}, vec(10, 0)).hit; };
    const auto shapeHits = [&] { return world.castShape(circle(0.5), {{-5, 0}, {}}, vec(10, 0)).hit; };
    EXPECT_TRUE(rayHits() && shapeHits() && boxFinds() == 1);
    disable(world, wall);
    EXPECT_FALSE(rayHits() || shapeHits() || boxFinds() > 0);
    must(world.addShape(wall, circle(0.5, vec(0, 1))));  // nor what comes to it
    EXPECT_FALSE(rayHits() || shapeHits() || boxFinds() > 0);
    must(world.setPose(wall, {0, 0.5}, 0));
    enable(world, wall);
    EXPECT_TRUE(rayHits() && shapeHits());
    EXPECT_EQ(boxFinds(), 2);
}

/// What lies on a floor asleep, or held, falls once the floor is gone, and lies on it again once it is back.
TEST(Enabling, OfAFloorWakesWhatLiesOnIt) {
    for (const bool sleeps : {true, false}) {
        World world = makeWorld(sleeps ? sleepySettings() : awakeSettings());
        const BodyId floor = addStatic(world, box(5, 1));
        const BodyId crate = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
        const BodyId upper = addBody(world, dynamicAt({0, 2.5}), box(0.5, 0.5));
        run(world, 120);
        EXPECT_EQ(world.isAwake(crate), !sleeps);
        disable(world, floor);
        EXPECT_TRUE(world.isAwake(crate));
        run(world, 6);
        int ends = 0;
        for (const ContactEvent& event : world.contactEvents()) { ends += event.type == ContactEventType::end ? 1 : 0; }
        EXPECT_EQ(ends, 0) << "long ago by now";
        EXPECT_NEAR(world.position(crate).y, 1.5 - fallOf(6), 1e-3);  // in sub-steps, since they touch
        EXPECT_NEAR(world.position(upper).y, 2.5 - fallOf(6), 1e-3);
        must(world.setPose(floor, {0, -1}, 0));
        enable(world, floor);
        run(world, 120);
        EXPECT_NEAR(world.position(crate).y, 0.5, 0.005);
        EXPECT_NEAR(world.position(upper).y, 1.5, 0.005);
    }
}

TEST(Enabling, EndsAndBeginsAreReported) {
    World world = makeWorld();
    const BodyId floor = addStatic(world, box(5, 1));
    const BodyId crate = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
    const auto typesOf = [&world] {
        std::vector<ContactEventType> types;
        for (const ContactEvent& event : world.contactEvents()) { types.push_back(event.type); }
        return types;
    };
    run(world, 2);
    disable(world, crate);
    run(world, 1);
    EXPECT_EQ(typesOf(), std::vector{ContactEventType::end});
    run(world, 1);
    EXPECT_TRUE(typesOf().empty());
    enable(world, crate);
    run(world, 1);
    const std::vector<ContactEventType> types = typesOf();
    EXPECT_EQ(std::count(types.begin(), types.end(), ContactEventType::begin), 1);
    EXPECT_TRUE(world.isValid(floor));
}

/// A joint is off while one of its bodies is disabled: what hung on it falls freely, and swings on once it is back.
TEST(Enabling, JointsAreOffMeanwhile) {
    for (const bool isBob : {false, true}) {
        World world = makeWorld();
        const BodyId hook = anchorOf(world);
        const BodyId bob = addBody(world, dynamicAt({1, 0}), circle(0.1));
        const BodyId tail = addBody(world, dynamicAt({2, 0}), circle(0.1));
        const JointId joint = must(world.createJoint(RevoluteJointDef{between(hook, bob), {0, 0}}));
        const JointId lower = must(world.createJoint(RevoluteJointDef{between(bob, tail), {1, 0}}));
        run(world, 20);
        EXPECT_LT(static_cast<double>(world.jointError(joint)), 1e-4);
        disable(world, isBob ? bob : hook);
        const DVec2 from = world.centerOfMass(tail);
        const DVec2 speed = velocityOf(world, tail);
        run(world, 1);
        EXPECT_EQ(length(world.jointForce(joint)), 0);
        EXPECT_EQ(length(world.jointForce(lower)) > 0, !isBob);
        run(world, 5);
        if (isBob) {
            const DVec2 free = from + 6 * kStep * speed - DVec2{0, fallOf(6)};
            EXPECT_LT(length(world.centerOfMass(tail) - free), 1e-4);
        }
        enable(world, isBob ? bob : hook);
        EXPECT_TRUE(world.isAwake(bob));
        runFor(world, 2);
        EXPECT_LT(static_cast<double>(world.jointError(joint)), 0.01);
        EXPECT_LT(static_cast<double>(world.jointError(lower)), 0.01);
    }
}

/// A gear without its ground lets both wheels turn as they like, and its wheels still collide if they may.
TEST(Enabling, GearsAreOffWithAnyOfTheirBodies) {
    World world = makeWorld(0);
    const BodyId post = anchorOf(world);
    const BodyId otherPost = anchorOf(world);
    const BodyId wheel = addBody(world, dynamicAt({0, 0}, {}, 6), circle(0.5));
    const BodyId pinion = addBody(world, dynamicAt({3, 0}), circle(0.5));
    const JointId first = must(world.createJoint(RevoluteJointDef{between(post, wheel), {0, 0}}));
    const JointId second = must(world.createJoint(RevoluteJointDef{between(otherPost, pinion), {3, 0}}));
    JointDef mayCollide;
    mayCollide.collideConnected = true;
    must(world.createJoint(GearJointDef{mayCollide, first, second, 1}));
    run(world, 30);
    EXPECT_NEAR(spinOf(world, wheel), -spinOf(world, pinion), 1e-3);
    EXPECT_GT(std::fabs(spinOf(world, pinion)), 1);
    disable(world, otherPost);
    run(world, 1);
    must(world.setVelocity(pinion, {}, 0));
    run(world, 30);
    EXPECT_NEAR(spinOf(world, pinion), 0, 1e-6);
    must(world.setVelocity(pinion, vec(-4, 0), 0));
    int touches = 0;
    for (int i = 0; i < 60; ++i) {
        run(world, 1);
        for (const ContactEvent& event : world.contactEvents()) {
            touches += event.type == ContactEventType::begin ? 1 : 0;
        }
    }
    EXPECT_EQ(touches, 1);
}

/// What is welded, or limited, does not unwind what one of its bodies turned meanwhile, and gears mesh anew.
TEST(Enabling, JointsTurnNothingBackByWholeTurns) {
    World world = makeWorld(0);
    const BodyId post = anchorOf(world);
    std::vector<BodyId> wheels;
    std::vector<JointId> joints;
    for (int i = 0; i < 4; ++i) {
        const DVec2 place{4.0 * i, 0};
        wheels.push_back(addBody(world, dynamicAt(place), circle(0.5)));
        RevoluteJointDef hinge{between(post, wheels.back()), place};
        if (i == 1) { hinge.limits = AngleLimits{real(-0.5), real(0.5)}; }
        joints.push_back(i == 0 ? must(world.createJoint(WeldJointDef{between(post, wheels.back()), place}))
                                : must(world.createJoint(hinge)));
    }
    const JointId gear = must(world.createJoint(GearJointDef{{}, joints[2], joints[3], 2}));
    disable(world, post);
    for (const BodyId wheel : wheels) { must(world.setVelocity(wheel, {}, real(2 * kPi * 5.02))); }
    run(world, 60);
    EXPECT_NEAR(world.angle(wheels[0]), 2 * kPi * 5.02, 1e-3);
    for (const BodyId wheel : wheels) { must(world.setVelocity(wheel, {}, 0)); }
    enable(world, post);
    run(world, 60);
    EXPECT_NEAR(world.angle(wheels[0]), 2 * kPi * 5, 1e-3) << "the weld holds it as before, but for five turns";
    for (std::size_t i = 1; i < wheels.size(); ++i) { EXPECT_NEAR(world.angle(wheels[i]), 2 * kPi * 5.02, 1e-3) << i; }
    EXPECT_NEAR(world.jointAngle(joints[1]), 2 * kPi * 0.02, 1e-3);
    EXPECT_LT(static_cast<double>(world.jointAngleError(gear)), 1e-4);
    must(world.setVelocity(wheels[2], {}, real(1)));
    run(world, 30);
    EXPECT_NEAR(spinOf(world, wheels[2]), -2 * spinOf(world, wheels[3]), 1e-3);
    EXPECT_GT(std::fabs(spinOf(world, wheels[3])), 0.1);
}

TEST(Enabling, Refusals) {
    World world = makeWorld();
    const BodyId ball = addBody(world, dynamicAt({0, 4}), circle(0.5));
    EXPECT_EQ(world.setEnabled({}, true).code, StatusCode::staleId);
    EXPECT_FALSE(world.isEnabled({}));
    must(world.setEnabled(ball, true));
    disable(world, ball);
    must(world.setEnabled(ball, false));
    EXPECT_EQ(world.applyForce(ball, vec(1, 0)).code, StatusCode::disabled);
    EXPECT_EQ(world.applyTorque(ball, 1).code, StatusCode::disabled);
    EXPECT_EQ(world.setAwake(ball, true).code, StatusCode::disabled);
    EXPECT_EQ(world.setAwake(ball, false).code, StatusCode::disabled);
    must(world.setVelocity(ball, vec(3, 0), 1));
    must(world.applyImpulse(ball, static_cast<Real>(world.mass(ball)) * vec(1, 0)));
    EXPECT_NEAR(velocityOf(world, ball).x, 4, 1e-6);
    EXPECT_FALSE(world.definition(ball).enabled);
    BodyDef def = world.definition(ball);
    def.enabled = true;  // not by this
    def.gravityScale = 0;
    must(world.redefine(ball, def));
    EXPECT_FALSE(world.isEnabled(ball));
    run(world, 1);
    EXPECT_EQ(world.position(ball), (DVec2{0, 4}));
    enable(world, ball);
    run(world, 6);
    EXPECT_NEAR(world.position(ball).x, 0.4, 1e-5);
    EXPECT_EQ(world.position(ball).y, 4);
    disable(world, ball);
    must(world.destroyBody(ball));
    EXPECT_EQ(world.bodyCount(), 0u);
}

/// What is made disabled may be without mass until it is enabled.
TEST(Enabling, MayBeginLater) {
    World world = makeWorld();
    BodyDef def = dynamicAt({0, 4});
    def.enabled = false;
    const BodyId ball = must(world.createBody(def));
    run(world, 3);
    EXPECT_EQ(world.bodyWithoutMass(), BodyId{});
    enable(world, ball);
    EXPECT_EQ(world.step(kStep).code, StatusCode::missingMass);
    EXPECT_EQ(world.bodyWithoutMass(), ball);
    disable(world, ball);
    must(world.addShape(ball, circle(0.5)));
    run(world, 3);
    EXPECT_EQ(world.position(ball).y, 4);
    enable(world, ball);
    run(world, 6);
    EXPECT_NEAR(world.position(ball).y, 4 - fallOf(6), 1e-5);
}

/// A random scene: a tray, bodies of all types, some of them joined.
struct Scene {
    World world;
    std::vector<BodyId> bodies;
    std::vector<BodyDef> defs;
    std::vector<Polygon> shapes;

    explicit Scene(std::uint32_t seed) : world(makeWorld(sleepySettings())) {
        std::mt19937 random(seed);
        const auto in = [&random](double low, double high) {
            return low + (high - low) * static_cast<double>(random() % 4096) / 4096;
        };
        addStatic(world, box(12, 1), {}, {0, -1});
        addStatic(world, box(1, 12), {}, {-9, 6});
        addStatic(world, box(1, 12), {}, {9, 6});
        for (int i = 0; i < 60; ++i) {
            const double x = -6 + 1.5 * (i % 9) + in(-0.2, 0.2);
            const double along = in(-3, 3);
            const double up = in(-3, 3);
            BodyDef def = dynamicAt({x, 0.8 + 1.3 * (i / 9)}, vec(along, up));
            def.type = i % 20 == 7 ? BodyType::kinematic : i % 20 == 13 ? BodyType::fixed : BodyType::dynamic;
            if (def.type != BodyType::dynamic) { def.velocity = {}; }
            def.bullet = i % 10 == 4;
            const double size = in(0.2, 0.5);
            shapes.push_back(i % 3 == 0 ? circle(size) : i % 3 == 1 ? box(size, 0.4) : capsule(size, 0.2));
            defs.push_back(def);
            bodies.push_back(addBody(world, def, shapes.back()));
        }
    }
    void join(std::size_t a, std::size_t b) {
        must(world.createJoint(RevoluteJointDef{between(bodies[a], bodies[b]), world.position(bodies[a])}));
    }
};

/// Fails where a body of the one world is not, to the bit, where that of the other one is.
void expectSame(const Scene& one, const Scene& other, std::size_t except, const std::string& what) {
    for (std::size_t i = 0; i < one.bodies.size(); ++i) {
        if (i == except) { continue; }
        ASSERT_EQ(one.world.position(one.bodies[i]), other.world.position(other.bodies[i])) << what << ", body " << i;
        ASSERT_EQ(one.world.angle(one.bodies[i]), other.world.angle(other.bodies[i])) << what << ", body " << i;
        ASSERT_EQ(one.world.isAwake(one.bodies[i]), other.world.isAwake(other.bodies[i])) << what << ", body " << i;
    }
}

TEST(Enabling, OthersCannotTellItFromOneThatIsGone) {
    constexpr std::uint32_t kSeeds = 12;
    for (std::uint32_t seed = 0; seed < someOf(kSeeds); ++seed) {
        Scene disabled(seed);
        Scene destroyed(seed);
        const std::size_t who = 3 + 4 * seed;
        for (Scene* scene : {&disabled, &destroyed}) {
            scene->join(who, who + 1);
            scene->join(0, 1);
            run(scene->world, static_cast<int>(20 + 30 * seed));
        }
        disable(disabled.world, disabled.bodies[who]);
        must(destroyed.world.destroyBody(destroyed.bodies[who]));
        for (int step = 0; step < 120; ++step) {
            run(disabled.world, 1);
            run(destroyed.world, 1);
            const std::string what = "seed " + std::to_string(seed) + ", step " + std::to_string(step);
            expectSame(disabled, destroyed, who, what);
            if (HasFatalFailure()) { return; }
        }
        EXPECT_EQ(disabled.world.counters().awakeBodies, destroyed.world.counters().awakeBodies);
    }
}

/// Boxes of what is made anew begin before its mass is known: it is put where it is once more, in both worlds.
void put(World& world, BodyId body, const BodyDef& def) {
    must(world.setPose(body, def.position, def.angle));
    if (def.type != BodyType::fixed) { must(world.setVelocity(body, def.velocity, def.angularVelocity)); }
}

TEST(Enabling, OthersCannotTellItFromOneThatIsMadeThen) {
    constexpr std::uint32_t kSeeds = 40;
    for (std::uint32_t seed = 0; seed < someOf(kSeeds); ++seed) {
        Scene enabled(seed);
        Scene made(seed);
        const std::size_t who = 3 + seed;
        const int steps = static_cast<int>(5 + 11 * (seed % 8));
        run(enabled.world, steps);
        run(made.world, steps);
        BodyDef def = made.defs[who];
        // Among others, or above them all and on its way to them.
        def.position = {-6 + 0.3 * seed, seed % 4 == 0 ? enabled.world.position(enabled.bodies[who]).y : 10};
        if (def.type == BodyType::dynamic) { def.velocity = vec(seed % 2 == 0 ? 4 : -4, -8); }
        disable(enabled.world, enabled.bodies[who]);
        must(made.world.destroyBody(made.bodies[who]));
        run(enabled.world, static_cast<int>(seed % 3));
        run(made.world, static_cast<int>(seed % 3));
        put(enabled.world, enabled.bodies[who], def);
        enable(enabled.world, enabled.bodies[who]);
        put(enabled.world, enabled.bodies[who], def);
        made.bodies[who] = addBody(made.world, def, made.shapes[who]);
        put(made.world, made.bodies[who], def);
        for (int step = 0; step < 90; ++step) {
            run(enabled.world, 1);
            run(made.world, 1);
            const std::string what = "seed " + std::to_string(seed) + ", step " + std::to_string(step);
            expectSame(enabled, made, enabled.bodies.size(), what);
            if (HasFatalFailure()) { return; }
        }
    }
}

/// A snapshot with disabled bodies goes on like the original, when they come back, too.
TEST(Enabling, IsPartOfASnapshot) {
    Scene scene(5);
    scene.join(10, 11);
    run(scene.world, 30);
    for (const std::size_t who : {10U, 20U, 30U}) { disable(scene.world, scene.bodies[who]); }
    World copy = scene.world;
    EXPECT_EQ(copy.stateHash(), scene.world.stateHash());
    for (World* world : {&scene.world, &copy}) {
        run(*world, 20);
        for (const std::size_t who : {30U, 10U, 20U}) { enable(*world, scene.bodies[who]); }
        run(*world, 60);
    }
    EXPECT_EQ(copy.stateHash(), scene.world.stateHash());
    World other = copy;
    disable(other, scene.bodies[40]);
    EXPECT_NE(other.stateHash(), copy.stateHash());
}

}  // namespace
}  // namespace swept::test

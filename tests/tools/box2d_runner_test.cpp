#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <swept/tools/reference/box2d_runner.h>

namespace swept {
namespace {

ShapeDescription disk(double radius) {
    ShapeDescription shape;
    shape.geometry = CircleGeometry{{0, 0}, radius};
    return shape;
}

ShapeDescription box(double halfWidth, double halfHeight) {
    ShapeDescription shape;
    shape.geometry = BoxGeometry{{halfWidth, halfHeight}, {0, 0}, 0};
    return shape;
}

BodyDescription body(SceneBodyType type, DVec2 position, const ShapeDescription& shape) {
    BodyDescription description;
    description.type = type;
    description.position = position;
    description.shapes = {shape};
    return description;
}

std::unique_ptr<Box2dRunner> start(const SceneDescription& scene) {
    std::string error;
    auto runner = makeBox2dRunner(scene, error, {}, SWEPT_PROGRAM);
    EXPECT_NE(runner, nullptr) << error;
    return runner;
}

Frame frameAfter(Box2dRunner& runner, int steps) {
    for (int i = 0; i < steps; ++i) { runner.step(); }
    Frame frame;
    runner.read(frame, true);
    return frame;
}

TEST(Box2dRunner, FallsBySymplecticEuler) {
    SceneDescription scene;
    scene.bodies = {body(SceneBodyType::dynamic, {1, 100}, disk(0.5))};
    scene.bodies[0].velocity = {2, 3};
    scene.settings.dt = 1.0 / 64;
    const auto runner = start(scene);
    constexpr int kSteps = 60;
    const Frame frame = frameAfter(*runner, kSteps);
    EXPECT_EQ(frame.step, kSteps);
    EXPECT_EQ(frame.time, kSteps / 64.0);
    // v_n = v0 + n g h, x_n = x0 + n h v0 + g h² n (n + 1) / 2
    const double h = scene.settings.dt;
    const double fall = -9.81 * h * h * kSteps * (kSteps + 1) / 2;
    EXPECT_NEAR(frame.bodies[0].velocity.y, 3 - 9.81 * h * kSteps, 1e-4);
    EXPECT_NEAR(frame.bodies[0].position.y, 100 + 3 * h * kSteps + fall, 1e-3);
    EXPECT_NEAR(frame.bodies[0].position.x, 1 + 2 * h * kSteps, 1e-4);
    EXPECT_FALSE(runner->aborted());
}

TEST(Box2dRunner, StartsAtTheInitialState) {
    SceneDescription scene;
    scene.gravity = {0, 0};
    scene.bodies = {body(SceneBodyType::fixed, {0, -1}, box(5, 1)), body(SceneBodyType::dynamic, {0, 3}, box(1, 2))};
    scene.bodies[1].angle = 0.5;
    scene.bodies[1].angularVelocity = -2;
    const auto runner = start(scene);
    Frame frame = frameAfter(*runner, 0);
    EXPECT_EQ(frame.step, 0);
    ASSERT_EQ(frame.bodies.size(), 2u);
    EXPECT_EQ(frame.bodies[1].position, (DVec2{0, 3}));
    EXPECT_EQ(frame.bodies[1].angle, 0.5);
    EXPECT_EQ(frame.bodies[1].angularVelocity, -2);
    EXPECT_TRUE(frame.bodies[1].awake);
    EXPECT_FALSE(frame.bodies[0].awake);
}

TEST(Box2dRunner, ReportsEnergyAndMomentumOfTheExactMass) {
    SceneDescription scene;
    scene.gravity = {0, -10};
    scene.bodies = {body(SceneBodyType::dynamic, {0, 5}, box(1, 0.5))};
    scene.bodies[0].velocity = {3, 0};
    scene.bodies[0].angularVelocity = 4;
    const auto runner = start(scene);
    const RunReport report = runner->report();
    const double mass = 2;                                 // 2 m × 1 m at 1 kg/m²
    const double inertia = mass * (2 * 2 + 1 * 1) / 12.0;  // of a rectangle
    EXPECT_NEAR(report.startEnergy, 0.5 * mass * 9 + 0.5 * inertia * 16 + mass * 10 * 5, 1e-9);
    EXPECT_NEAR(report.startMomentum.x, mass * 3, 1e-12);
    EXPECT_NEAR(report.startAngularMomentum, -5 * mass * 3 + inertia * 4, 1e-9);
}

TEST(Box2dRunner, CapsuleHasTheMassOfACapsule) {
    SceneDescription scene;
    scene.gravity = {0, 0};
    ShapeDescription capsule;
    capsule.geometry = CapsuleGeometry{{DVec2{-1, 0}, DVec2{1, 0}}, 0.25};
    scene.bodies = {body(SceneBodyType::dynamic, {0, 0}, capsule)};
    scene.bodies[0].velocity = {1, 0};
    const auto runner = start(scene);
    const double area = 2 * 0.5 + std::acos(-1.0) * 0.25 * 0.25;
    EXPECT_NEAR(runner->report().startMomentum.x, area, 1e-9);
}

TEST(Box2dRunner, BodiesRestOnTheirFloorWithinTheSkin) {
    for (const bool isChain : {false, true}) {
        SceneDescription scene;
        ShapeDescription ground = box(5, 0.5);
        if (isChain) { ground.geometry = ChainGeometry{{{5, 0.5}, {0, 0.5}, {-5, 0.5}}, false}; }
        scene.bodies = {body(SceneBodyType::fixed, {0, -0.5}, ground),
                        body(SceneBodyType::dynamic, {0.3, 1}, box(0.5, 0.5))};
        const auto runner = start(scene);
        const Frame frame = frameAfter(*runner, 120);
        EXPECT_NEAR(frame.bodies[1].position.y, 0.5, 0.021) << "chain: " << isChain;
        ASSERT_FALSE(frame.contacts.empty());
        double impulse = 0;
        for (const ContactFrame& contact : frame.contacts) { impulse += contact.impulse; }
        EXPECT_NEAR(impulse, 9.81 / 60, 0.02) << "the weight of 1 kg over a step";
    }
}

TEST(Box2dRunner, ChainsAreOpenFromBehind) {
    SceneDescription scene;
    ShapeDescription ground;
    ground.geometry = ChainGeometry{{{-5, 0}, {0, 0}, {5, 0}}, false};  // from left to right: solid from below only
    scene.bodies = {body(SceneBodyType::fixed, {0, 0}, ground), body(SceneBodyType::dynamic, {0, 1}, disk(0.25))};
    const auto runner = start(scene);
    EXPECT_LT(frameAfter(*runner, 90).bodies[1].position.y, -1);
}

TEST(Box2dRunner, FiltersWithAllBits) {
    for (const std::uint32_t mask : {0xFFFFFFFFu, ~0x40000000u}) {
        SceneDescription scene;
        scene.bodies = {body(SceneBodyType::fixed, {0, -0.5}, box(5, 0.5)),
                        body(SceneBodyType::dynamic, {0, 1}, disk(0.5))};
        scene.bodies[0].shapes[0].filter.category = 0x40000000u;
        scene.bodies[1].shapes[0].filter.mask = mask;
        const auto runner = start(scene);
        EXPECT_EQ(frameAfter(*runner, 90).bodies[1].position.y > 0, mask == 0xFFFFFFFFu) << mask;
    }
}

TEST(Box2dRunner, JointsHold) {
    SceneDescription scene;
    scene.bodies = {body(SceneBodyType::fixed, {0, 5}, box(0.1, 0.1)), body(SceneBodyType::dynamic, {1, 5}, disk(0.1)),
                    body(SceneBodyType::dynamic, {3, 5}, disk(0.1))};
    JointDescription hinge;
    hinge.bodyA = "body0";
    hinge.bodyB = "body1";
    hinge.joint = RevoluteDescription{{0, 5}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
    JointDescription rod;
    rod.bodyA = "body1";
    rod.bodyB = "body2";
    rod.joint = DistanceDescription{{1, 5}, {3, 5}, {}, {}, {}, {}, {}};
    scene.joints = {hinge, rod};
    const auto runner = start(scene);
    const Frame frame = frameAfter(*runner, 200);
    EXPECT_NEAR(length(frame.bodies[1].position - DVec2{0, 5}), 1, 0.02);
    EXPECT_NEAR(length(frame.bodies[2].position - frame.bodies[1].position), 2, 0.02);
    EXPECT_LT(runner->report().largestJointError, 0.05);
    EXPECT_LT(frame.bodies[2].position.y, 4.9) << "something must have moved";
}

/// Points closer together than Box2D's slop make its chain assert.
SceneDescription sceneThatAborts() {
    SceneDescription scene;
    ShapeDescription ground;
    ground.geometry = ChainGeometry{{{1, 0}, {0.999, 0}, {-1, 0}}, false};
    scene.bodies = {body(SceneBodyType::fixed, {0, 0}, ground), body(SceneBodyType::dynamic, {0, 1}, disk(0.25))};
    return scene;
}

TEST(Box2dRunner, TellsOfAnAbortAndGoesOn) {
    const auto runner = start(sceneThatAborts());
    ASSERT_TRUE(runner->aborted());
    EXPECT_NE(runner->aborted()->find("Box2D aborted while the world was built"), std::string::npos)
        << *runner->aborted();
    EXPECT_NE(runner->aborted()->find("Assertion"), std::string::npos) << *runner->aborted();
    const Frame frame = frameAfter(*runner, 5);
    EXPECT_EQ(frame.step, 0);
    ASSERT_EQ(frame.bodies.size(), 2u);
    EXPECT_EQ(frame.bodies[1].position, (DVec2{0, 1}));
}

TEST(Box2dRunner, SeveralRunSideBySide) {
    SceneDescription scene;
    scene.bodies = {body(SceneBodyType::dynamic, {0, 0}, disk(0.5))};
    const auto first = start(scene);
    const auto aborting = start(sceneThatAborts());
    const auto second = start(scene);
    for (int i = 0; i < 10; ++i) {
        first->step();
        second->step();
    }
    EXPECT_TRUE(aborting->aborted());
    EXPECT_EQ(frameAfter(*first, 0).bodies[0].position, frameAfter(*second, 0).bodies[0].position);
    EXPECT_LT(frameAfter(*first, 0).bodies[0].position.y, 0);
}

TEST(Box2dRunner, RefusesAProgramThatIsNotThere) {
    std::string error;
    EXPECT_EQ(makeBox2dRunner(SceneDescription{}, error, {}, "/does/not/exist"), nullptr);
    EXPECT_NE(error.find("/does/not/exist"), std::string::npos) << error;
}

TEST(Box2dRunner, AProgramThatDoesNotTalkIsAResultToo) {
    std::string error;
    const auto runner = makeBox2dRunner(SceneDescription{}, error, {}, "/bin/true");
    ASSERT_NE(runner, nullptr) << error;
    ASSERT_TRUE(runner->aborted());
    EXPECT_EQ(*runner->aborted(), "Box2D ended with exit code 0 while the world was built");
}

}  // namespace
}  // namespace swept

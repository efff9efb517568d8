#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "../support/random.h"
#include "render_support.h"

// The bodies of a picture: right colours in the right places, for any size, place and pose.

namespace swept::test {
namespace {

using Type = SceneBodyType;

/// One body of each look, two metres apart.
SceneDescription oneOfEach() {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::fixed, {-4, 0}, box(0.5, 0.5)),  makeBody(Type::kinematic, {-2, 0}, box(0.5, 0.5)),
                    makeBody(Type::dynamic, {0, 0}, box(0.5, 0.5)), makeBody(Type::dynamic, {2, 0}, box(0.5, 0.5)),
                    makeBody(Type::dynamic, {4, 0}, box(0.5, 0.5)), makeBody(Type::fixed, {0, 2}, box(0.5, 0.5))};
    scene.bodies[3].awake = false;
    scene.bodies[4].bullet = true;
    scene.bodies[5].shapes[0].sensor = true;
    return scene;
}

TEST(RenderBodies, ColoursTellTypeAndState) {
    const Image image = picture(oneOfEach(), bareOptions());
    const std::array<Color, 5> fills{
        style::bodyStyle(Type::fixed, false, false, 0).fill, style::bodyStyle(Type::kinematic, false, true, 0).fill,
        style::bodyStyle(Type::dynamic, false, true, 0).fill, style::bodyStyle(Type::dynamic, false, false, 1).fill,
        style::bodyStyle(Type::dynamic, true, true, 0).fill};
    for (std::size_t i = 0; i < fills.size(); ++i) {
        const double x = -4 + 2 * static_cast<double>(i);
        EXPECT_PRED2([](Color a, Color b) { return near(a, b); }, pixelAt(image, {x, 0}), fills[i]) << "body " << i;
        EXPECT_PRED2([](Color a, Color b) { return near(a, b); }, pixelAt(image, {x, 0.45}), fills[i]) << "body " << i;
        EXPECT_EQ(pixelAt(image, {x, 0.51}), style::kBackground) << "body " << i;
        for (std::size_t j = 0; j < i; ++j) { EXPECT_FALSE(near(fills[i], fills[j], 12)) << i << " looks like " << j; }
    }
}

TEST(RenderBodies, TheEdgeIsDarkerAndInside) {
    const Image image = picture(oneOfEach(), bareOptions());
    const style::BodyStyle look = style::bodyStyle(Type::dynamic, false, true, 0);
    EXPECT_TRUE(near(pixelAt(image, {0, 0.495}), look.edge)) << pixelAt(image, {0, 0.495});
    EXPECT_TRUE(near(pixelAt(image, {-0.495, 0.1}), look.edge)) << pixelAt(image, {-0.495, 0.1});
    EXPECT_EQ(pixelAt(image, {0, 0.505}), style::kBackground);
    EXPECT_LT(look.edge.green, look.fill.green);
}

TEST(RenderBodies, SensorsAreTranslucentAndDashed) {
    const Image image = picture(oneOfEach(), bareOptions());
    const Color expected = mix(style::kBackground, withAlpha(style::kSensor, 255), 32.0 / 255);
    EXPECT_TRUE(near(pixelAt(image, {0, 2}), expected)) << pixelAt(image, {0, 2});
    int dashes = 0;
    bool inDash = false;
    for (int x = 432; x < 528; ++x) {  // along the lower edge of the sensor
        const bool dark = pixel(image, x, 270 - 150).blue < 120;
        dashes += dark && !inDash ? 1 : 0;
        inDash = dark;
    }
    EXPECT_GE(dashes, 8);
    EXPECT_LE(dashes, 14);
}

/// The pixels that a lone shape covers, drawn without smoothing.
int coveredPixels(const Geometry& geometry, double radius, DVec2 position, double angle) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::dynamic, position, geometry, radius)};
    scene.bodies[0].angle = angle;
    RenderOptions options = bareOptions();
    options.superSampling = 1;
    return countPixels(picture(scene, options), [](Color c) { return c != style::kBackground; });
}

TEST(RenderBodies, ACircleCoversItsArea) {
    for (const double radius : {0.25, 1.0, 2.5}) {
        const double area = std::numbers::pi * radius * radius * 1e4;
        EXPECT_NEAR(coveredPixels(circle(radius), 0, {0.123, -0.07}, 0.4), area, 0.01 * area) << "radius " << radius;
    }
}

TEST(RenderBodies, RoundedShapesCoverTheirArea) {
    constexpr std::uint64_t kSeed = 20260401;
    Random random(kSeed);
    for (int i = 0; i < 12; ++i) {
        const double half = random.range(0.3, 1);
        const double radius = i % 3 == 0 ? 0 : random.range(0.02, 0.8);
        const double angle = random.range(-3, 3);
        const double rounded = std::numbers::pi * radius * radius;
        const double boxArea = 1e4 * (4 * half * 0.5 + 2 * radius * (2 * half + 1) + rounded);
        EXPECT_NEAR(coveredPixels(box(half, 0.5), radius, {0.01 * i, 0}, angle), boxArea, 0.01 * boxArea)
            << "seed " << kSeed << ", box " << i;
        if (radius == 0) { continue; }
        const CapsuleGeometry capsule{{DVec2{-half, 0}, DVec2{half, 0}}, radius};
        const double capsuleArea = 1e4 * (4 * half * radius + rounded);
        EXPECT_NEAR(coveredPixels(capsule, 0, {0, 0.01 * i}, angle), capsuleArea, 0.015 * capsuleArea)
            << "seed " << kSeed << ", capsule " << i;
    }
}

TEST(RenderBodies, PolygonPointsMayComeInAnyOrder) {
    const PolygonGeometry inOrder{{{-1, -1}, {1, -1}, {1.5, 0}, {0, 1.5}, {-1, 1}}};
    const PolygonGeometry shuffled{{{0, 1.5}, {-1, -1}, {1.5, 0}, {-1, 1}, {1, -1}}};
    SceneDescription scene;
    scene.bodies = {makeBody(Type::dynamic, {0, 0}, inOrder, 0.1)};
    const Image expected = picture(scene, bareOptions());
    scene.bodies[0].shapes[0].geometry = shuffled;
    EXPECT_EQ(picture(scene, bareOptions()), expected);
    EXPECT_GT(countColor(expected, style::paletteColor(0)), 40000);
}

TEST(RenderBodies, ACircleShowsItsRotation) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::dynamic, {0, 0}, circle(1))};
    const style::BodyStyle look = style::bodyStyle(Type::dynamic, false, true, 0);
    for (const double angle : {0.0, 0.7, 2.5, -1.6}) {
        scene.bodies[0].angle = angle;
        const Image image = picture(scene, bareOptions());
        const DVec2 along = 0.6 * DVec2{std::cos(angle), std::sin(angle)};
        EXPECT_TRUE(near(pixelAt(image, along), look.edge, 40)) << "angle " << angle << ": " << pixelAt(image, along);
        EXPECT_TRUE(near(pixelAt(image, -along), look.fill)) << "angle " << angle;
    }
}

TEST(RenderBodies, ThinThingsStayVisible) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::fixed, {0, 0}, box(1e-4, 1)), makeBody(Type::dynamic, {1, 0}, circle(1e-5)),
                    makeBody(Type::fixed, {2, 0}, SegmentGeometry{{DVec2{0, -1}, DVec2{0, 1}}})};
    const Image image = picture(scene, bareOptions());
    for (const double x : {0.0, 1.0, 2.0}) {
        int darkest = 255;
        for (int dx = -2; dx <= 2; ++dx) { darkest = std::min<int>(darkest, pixelAt(image, {x + 0.01 * dx, 0}).red); }
        EXPECT_LT(darkest, 210) << "at " << x;
    }
}

TEST(RenderBodies, TheSolidSideOfAChainIsTinted) {
    SceneDescription scene;
    // From right to left: solid below.
    scene.bodies = {makeBody(Type::fixed, {0, 0}, ChainGeometry{{{4, 0}, {0, 0}, {-4, 0}}, false})};
    const Image ground = picture(scene, bareOptions());
    int below = 0;
    for (int x = 200; x < 760; ++x) {
        below += pixel(ground, x, 274) != style::kBackground ? 1 : 0;
        ASSERT_EQ(pixel(ground, x, 266), style::kBackground) << "the open side at x = " << x;
    }
    EXPECT_EQ(below, 560);
    // A counter-clockwise loop: solid inside.
    scene.bodies = {makeBody(Type::fixed, {0, 0}, ChainGeometry{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, true})};
    const Image loop = picture(scene, bareOptions());
    for (const DVec2 side : {DVec2{1, 0}, DVec2{0, 1}, DVec2{-1, 0}, DVec2{0, -1}}) {
        EXPECT_NE(pixelAt(loop, 0.955 * side), style::kBackground);
        EXPECT_EQ(pixelAt(loop, 1.045 * side), style::kBackground);
    }
}

TEST(RenderBodies, TwoRunsGiveTheSameBytes) {
    RenderOptions options;
    options.view = ViewDescription{{0, 0}, 5.4};
    options.contacts = options.velocities = options.ghosts = options.labels = true;
    const SceneDescription scene = oneOfEach();
    Frame frame = initialFrame(scene);
    frame.contacts = {{{0, 0.5}, {0, 1}, 0, 1}};
    frame.impacts = {{2, {0.3, 0.3}, 0.2}};
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, options);
    const Image first = renderer->draw(frame);
    const Image again = renderer->draw(frame);
    const Image other = makeRenderer(scene, options)->draw(frame);
    EXPECT_TRUE(first == again);
    EXPECT_TRUE(first == other);
    frame.bodies[2].position.x += 0.02;
    EXPECT_FALSE(renderer->draw(frame) == first) << "two pixels of motion must show";
}

TEST(RenderBodies, FarFromTheOriginLooksTheSame) {
    const DVec2 away{1e6, -3e6};  // whole lines of the grid; the positions stay exact in double
    SceneDescription scene = oneOfEach();
    scene.bodies.push_back(makeBody(Type::fixed, {0, -2}, ChainGeometry{{{3, 0.25}, {0, 0}, {-3, 0}}, false}));
    RenderOptions options = bareOptions();
    options.grid = options.scaleBar = options.legend = true;
    const Image here = picture(scene, options);
    for (BodyDescription& body : scene.bodies) { body.position += away; }
    options.view->center += away;
    EXPECT_TRUE(picture(scene, options) == here);
    EXPECT_GT(countColor(here, style::kGridFine), 5000);
}

TEST(RenderBodies, HugeShapesAreClipped) {
    SceneDescription scene;
    // Half spaces, up to the size where their corners would overflow if multiplied.
    for (const double half : {1e3, 1e9, 1e15, 1e200}) {
        scene.bodies = {makeBody(Type::fixed, {0, -half}, box(half, half))};
        const Image image = picture(scene, bareOptions());
        const Color fill = style::bodyStyle(Type::fixed, false, false, 0).fill;
        EXPECT_NEAR(countColor(image, fill), 960 * 268.5, 960) << "half extent " << half;
        EXPECT_EQ(pixelAt(image, {0, 0.02}), style::kBackground) << "half extent " << half;
    }
    scene.bodies = {makeBody(Type::fixed, {1e9 + 1, 0}, circle(1e9))};
    const Image image = picture(scene, bareOptions());
    EXPECT_EQ(pixelAt(image, {0.98, -2.6}), style::kBackground);
    EXPECT_TRUE(near(pixelAt(image, {1.05, -2.6}), style::bodyStyle(Type::fixed, false, false, 0).fill));
}

TEST(RenderBodies, PosesThatAreNotFiniteAreLeftOutAndReported) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const SceneDescription scene = oneOfEach();
    RenderOptions options = bareOptions();
    options.contacts = options.velocities = options.ghosts = options.trails = options.labels = true;
    for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, std::numeric_limits<double>::max()}) {
        const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, options);
        Frame frame = initialFrame(scene);
        frame.bodies[2].position = {bad, 0};
        frame.bodies[3].angle = bad;
        frame.bodies[4].velocity = {0, bad};
        frame.contacts = {{{bad, 0}, {0, 1}, 0, 1}, {{0, 0}, {bad, 1}, 0, 1}};
        frame.impacts = {{0, {0, bad}, 0}, {1, {0, 0}, bad}, {77, {0, 0}, 0}, {-1, {0, 0}, 0}};
        renderer->addTrail(frame);
        renderer->addStrobe(frame);
        renderer->addTrail(initialFrame(scene));
        const Image image = renderer->draw(frame, {&frame, "a", "b"});
        EXPECT_GT(countColor(image, style::bodyStyle(Type::kinematic, false, true, 0).fill), 5000) << "others remain";
        EXPECT_EQ(countColor(image, style::kWarning) > 20, !std::isfinite(bad)) << bad;
    }
}

TEST(RenderBodies, AFrameMayHaveFewerOrMoreBodies) {
    const SceneDescription scene = oneOfEach();
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, bareOptions());
    Frame frame = initialFrame(scene);
    frame.bodies.resize(2);
    EXPECT_EQ(pixelAt(renderer->draw(frame), {0, 0}), style::kBackground);
    frame.bodies.resize(20);
    EXPECT_NE(pixelAt(renderer->draw(frame), {-2, 0}), style::kBackground);
}

TEST(RenderBodies, JointsShowUntilTheyAreRemoved) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::fixed, {0, 2}, box(0.2, 0.05)), makeBody(Type::dynamic, {1, 0}, circle(0.2))};
    scene.bodies[0].name = "beam";
    JointDescription joint;
    joint.bodyA = "beam";
    joint.bodyB = "body1";
    RevoluteDescription revolute;
    revolute.anchor = {-1, 0};
    joint.joint = revolute;
    scene.joints = {joint};
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, bareOptions());
    const Frame frame = initialFrame(scene);
    EXPECT_LT(pixelAt(renderer->draw(frame), {0, 0}).red, 200) << "the arm from the body to its pin";
    EXPECT_LT(pixelAt(renderer->draw(frame), {-1.022, 0}).red, 120) << "the pin";
    SceneEvent broken;
    broken.type = SceneEventType::jointBreak;
    broken.joint = 0;
    renderer->removeBrokenJoints(std::span(&broken, 1));
    EXPECT_EQ(pixelAt(renderer->draw(frame), {0, 0}), style::kBackground);
}

/// A joint of each type between bodies at (−1, 0) and (1, 0), but for the gear, which needs two others.
std::vector<JointGeometry> jointsOfEachType() {
    RevoluteDescription revolute;
    revolute.anchor = {0, 1};
    DistanceDescription distance;
    distance.anchorA = {-1, 0};
    distance.anchorB = {1, 0};
    PrismaticDescription prismatic;
    prismatic.anchor = {0, 1};
    prismatic.axis = {1, 0};
    WheelDescription wheel;
    wheel.anchor = {0, 1};
    wheel.axis = {0, 1};
    WeldDescription weld;
    weld.anchor = {0, 1};
    MotorDescription motor;
    motor.linearOffset = DVec2{0, 1};
    motor.maxForce = 1;
    MouseDescription mouse;
    mouse.target = {0, 1};
    mouse.anchor = DVec2{1, 0};
    return {revolute, distance, prismatic, wheel,
            weld,     motor,    mouse,     PulleyDescription{{-1, 1}, {1, 1}, {-1, 0}, {1, 0}, 1, {}}};
}

/// Pixels that differ when the joints of a scene are taken away.
int jointPixels(SceneDescription scene) {
    const Image with = picture(scene, bareOptions());
    scene.joints.clear();
    const Image without = picture(scene, bareOptions());
    int changed = 0;
    for (int y = 0; y < bareOptions().height; ++y) {
        for (int x = 0; x < bareOptions().width; ++x) { changed += pixel(with, x, y) != pixel(without, x, y) ? 1 : 0; }
    }
    return changed;
}

TEST(RenderBodies, EveryTypeOfJointShowsButTheFilter) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::dynamic, {-1, 0}, circle(0.2)), makeBody(Type::dynamic, {1, 0}, circle(0.2))};
    std::set<std::size_t> types;
    JointDescription joint;
    joint.bodyA = "body0";
    joint.bodyB = "body1";
    for (const JointGeometry& geometry : jointsOfEachType()) {
        joint.joint = geometry;
        scene.joints = {joint};
        EXPECT_GT(jointPixels(scene), 40) << "the smallest sign has 8 by 8; type " << geometry.index();
        types.insert(geometry.index());
    }
    EXPECT_EQ(types.size(), std::variant_size_v<JointGeometry> - 2) << "all but gear and filter";
    joint.joint = FilterJointDescription{};
    scene.joints = {joint};
    EXPECT_EQ(jointPixels(scene), 0) << "it holds nothing";
}

TEST(RenderBodies, AGearShowsBetweenItsJoints) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::fixed, {0, -2}, box(1, 0.1)), makeBody(Type::dynamic, {-1, 0}, circle(0.2)),
                    makeBody(Type::dynamic, {1, 0}, circle(0.2))};
    for (const int body : {1, 2}) {
        RevoluteDescription hinge;
        hinge.anchor = scene.bodies[static_cast<std::size_t>(body)].position;
        JointDescription joint;
        joint.bodyA = "body0";
        joint.bodyB = "body" + std::to_string(body);
        joint.joint = hinge;
        scene.joints.push_back(joint);
    }
    const int without = jointPixels(scene);
    JointDescription gear;
    gear.bodyA = "body1";
    gear.bodyB = "body2";
    gear.joint = GearDescription{"joint0", "joint1", 1};
    scene.joints.push_back(gear);
    EXPECT_GT(jointPixels(scene), without + 40);
}

TEST(RenderView, FitsTheBodiesButNotAKilometreOfGround) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::dynamic, {3, 4}, circle(0.5)), makeBody(Type::dynamic, {9, 6}, box(1, 1))};
    const ViewDescription moving = fittedView(scene, 16.0 / 9);
    EXPECT_GT(moving.height, 7.5 * 9 / 16);
    EXPECT_LT(moving.height, 1.3 * 7.5 * 9 / 16 + 1);
    EXPECT_NEAR(moving.center.x, 6.25, 1e-12);
    scene.bodies.push_back(makeBody(Type::fixed, {0, -1}, box(500, 1)));
    const ViewDescription grounded = fittedView(scene, 16.0 / 9);
    EXPECT_LT(grounded.center.y - grounded.height / 2, 0) << "the ground is seen";
    EXPECT_LT(grounded.height, 40);
    scene.bodies.clear();
    EXPECT_GT(fittedView(scene, 1).height, 0);
}

}  // namespace
}  // namespace swept::test

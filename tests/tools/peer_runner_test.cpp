#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <swept/tools/reference/peer_limits.h>
#include <swept/tools/reference/peer_runner.h>

/// Each engine that was found at build time, against closed forms: the adapters, not the engines, are on trial.

namespace swept {
namespace {

constexpr double kGravity = 10;

ShapeDescription boxOf(DVec2 half) {
    ShapeDescription shape;
    shape.geometry = BoxGeometry{half, {0, 0}, 0};
    return shape;
}

BodyDescription& add(SceneDescription& scene, const std::string& name, SceneBodyType type, DVec2 position, DVec2 half) {
    BodyDescription description;
    description.name = name;
    description.type = type;
    description.position = position;
    description.shapes = {boxOf(half)};
    scene.bodies.push_back(description);
    return scene.bodies.back();
}

void join(SceneDescription& scene, const std::string& a, const std::string& b, const JointGeometry& joint) {
    JointDescription description;
    description.bodyA = a;
    description.bodyB = b;
    description.joint = joint;
    scene.joints.push_back(description);
}

SceneDescription emptyPeerScene() {
    SceneDescription scene;
    scene.gravity = {0, -kGravity};
    scene.settings.sleep = false;
    return scene;
}

/// Every engine of this build as `bench accuracy` sets it up.
std::vector<PeerSettings> peers() {
    std::vector<PeerSettings> all{{}};
    PeerSettings settings;
    if (hasPeer(PeerEngine::box2d3)) {
        settings.engine = PeerEngine::box2d3;
        all.push_back(settings);
        settings.subSteps = 16;
        settings.isStiff = 1;
        all.push_back(settings);
    }
    if (hasPeer(PeerEngine::chipmunk)) {
        settings = {};
        settings.engine = PeerEngine::chipmunk;
        all.push_back(settings);
    }
    return all;
}

std::string nameOf(const PeerSettings& peer) {
    return std::string(peerName(peer.engine)) + (peer.isStiff != 0 ? " stiff" : "");
}

std::vector<Frame> run(const SceneDescription& scene, const PeerSettings& peer, int steps) {
    std::string error;
    const auto runner = makePeerRunner(scene, peer, error, SWEPT_PROGRAM);
    std::vector<Frame> frames(static_cast<std::size_t>(steps) + 1);
    if (!runner) {
        ADD_FAILURE() << nameOf(peer) << ": " << error;
        for (Frame& frame : frames) { frame.bodies.resize(scene.bodies.size()); }
        return frames;
    }
    runner->read(frames[0], false);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        runner->step();
        runner->read(frames[i], false);
    }
    EXPECT_FALSE(runner->aborted()) << *runner->aborted();
    EXPECT_GT(runner->stepSeconds(), 0) << nameOf(peer);
    return frames;
}

/// Symplectic Euler falls ahead of the parabola by g t h / 2; Chipmunk moves first and lags as much.
double aheadOfParabola(const PeerSettings& peer, double time, double dt) {
    const double subStep = peer.engine == PeerEngine::box2d3 ? dt / peer.subSteps : dt;
    return (peer.engine == PeerEngine::chipmunk ? -0.5 : 0.5) * kGravity * time * subStep;
}

TEST(PeerRunner, FreeFallIsTheClosedFormOfEachIntegrator) {
    SceneDescription scene = emptyPeerScene();
    scene.settings.dt = 1.0 / 64;
    BodyDescription& body = add(scene, "box", SceneBodyType::dynamic, {1, 20}, {0.5, 0.25});
    body.velocity = {2, 3};
    body.angularVelocity = 5;
    for (const PeerSettings& peer : peers()) {
        const BodyFrame end = run(scene, peer, 64).back().bodies[0];
        EXPECT_NEAR(end.position.x, 3, 1e-5) << nameOf(peer);
        EXPECT_NEAR(end.position.y, 20 + 3 - 0.5 * kGravity - aheadOfParabola(peer, 1, 1.0 / 64), 3e-5) << nameOf(peer);
        EXPECT_NEAR(end.velocity.y, 3 - kGravity, 1e-5) << nameOf(peer);
        EXPECT_NEAR(end.angle, 5, 2e-3) << nameOf(peer);  // unwrapped: most of a turn
    }
}

TEST(PeerRunner, EnergyIsThatOfTheExactMass) {
    SceneDescription scene = emptyPeerScene();
    BodyDescription& body = add(scene, "box", SceneBodyType::dynamic, {1, 2}, {0.5, 0.25});
    body.shapes[0].density = 3;
    body.velocity = {2, 1};
    body.angularVelocity = 4;
    add(scene, "heavy", SceneBodyType::dynamic, {9, 0}, {0.5, 0.5}).mass = 7;
    const double inertia = 1.5 * (1.0 + 0.25) / 12;
    const double energy = 0.5 * 1.5 * 5 + 0.5 * inertia * 16 + 1.5 * kGravity * 2;
    for (const PeerSettings& peer : peers()) {
        std::string error;
        const auto runner = makePeerRunner(scene, peer, error, SWEPT_PROGRAM);
        ASSERT_NE(runner, nullptr) << error;
        EXPECT_NEAR(runner->report().startEnergy, energy, 1e-4) << nameOf(peer);
        EXPECT_NEAR(runner->report().startMomentum.x, 1.5 * 2, 1e-5) << nameOf(peer);
        runner->step();
        EXPECT_NEAR(runner->report().endMomentum.y, 1.5 - 8.5 * kGravity / 60, 1e-4) << nameOf(peer);
    }
}

TEST(PeerRunner, BoxRestsWhereItIsPut) {
    SceneDescription scene = emptyPeerScene();
    add(scene, "ground", SceneBodyType::fixed, {0, -1}, {10, 1});
    add(scene, "box", SceneBodyType::dynamic, {0.25, 0.5}, {0.5, 0.5});
    for (const PeerSettings& peer : peers()) {
        const BodyFrame end = run(scene, peer, 120).back().bodies[1];
        // Box2D 2.4.1 keeps two skins of a centimetre apart; the softest contact here gives way by g / (2π · 30 Hz)².
        EXPECT_NEAR(end.position.y, 0.5, peer.engine == PeerEngine::box2d2 ? 0.02 : 5e-3) << nameOf(peer);
        EXPECT_NEAR(end.position.x, 0.25, 1e-4) << nameOf(peer);
        EXPECT_LT(length(end.velocity), 1e-3) << nameOf(peer);
        EXPECT_NEAR(end.angle, 0, 1e-4) << nameOf(peer);
    }
}

TEST(PeerRunner, FrictionOfAPairIsThatOfItsShapes) {
    constexpr double kAngle = std::numbers::pi / 6;
    constexpr double kFriction = 0.3;
    const DVec2 down{std::cos(kAngle), -std::sin(kAngle)};
    const DVec2 out{std::sin(kAngle), std::cos(kAngle)};
    SceneDescription scene = emptyPeerScene();
    add(scene, "slope", SceneBodyType::fixed, -1.0 * out, {100, 1}).angle = -kAngle;
    add(scene, "block", SceneBodyType::dynamic, 0.5 * out, {0.5, 0.5}).angle = -kAngle;
    for (BodyDescription& body : scene.bodies) { body.shapes[0].friction = kFriction; }
    const double exact = kGravity * (std::sin(kAngle) - kFriction * std::cos(kAngle));
    for (const PeerSettings& peer : peers()) {
        const BodyFrame end = run(scene, peer, 120).back().bodies[1];
        EXPECT_NEAR(dot(end.velocity, down) / 2 / exact, 1, 0.02) << nameOf(peer);
    }
}

/// What mixes by rules of its own is mixed so by those engines that can, and refused by the other.
TEST(PeerRunner, MixingRulesAreThoseOfTheScene) {
    SceneDescription scene = emptyPeerScene();
    ShapeDescription& floor = add(scene, "floor", SceneBodyType::fixed, {0, -1}, {100, 1}).shapes[0];
    floor.friction = 0.1;
    floor.restitution = 1;
    floor.frictionMixing = MixingRule::minimum;
    floor.restitutionMixing = MixingRule::product;
    add(scene, "slider", SceneBodyType::dynamic, {0, 0.5}, {0.5, 0.5}).velocity = {8, 0};
    BodyDescription& ball = add(scene, "ball", SceneBodyType::dynamic, {-20, 5.5}, {0.5, 0.5});
    ball.shapes[0].geometry = CircleGeometry{{0, 0}, 0.5};
    ball.shapes[0].restitution = 0.6;
    for (std::size_t i : {1U, 2U}) { scene.bodies[i].shapes[0].friction = 0.9; }
    for (const PeerSettings& peer : peers()) {
        EXPECT_EQ(peerLacks(peer.engine, scene).empty(), peer.engine != PeerEngine::chipmunk) << nameOf(peer);
        if (peer.engine == PeerEngine::chipmunk) { continue; }
        const std::vector<Frame> frames = run(scene, peer, 120);
        EXPECT_NEAR(frames.back().bodies[1].velocity.x, 8 - 2 * 0.1 * kGravity, 0.05) << nameOf(peer);
        double fastest = 0;  // upwards: it hits the floor at 10 m/s
        for (const Frame& frame : frames) { fastest = std::max(fastest, frame.bodies[2].velocity.y); }
        EXPECT_NEAR(fastest, 0.6 * 10, 0.2) << nameOf(peer);
    }
}

/// Of a ball that rolls out: Box2D 3 slows it down, Box2D leaves that out, Chipmunk is not asked.
TEST(PeerRunner, RollingResistanceIsThatOfItsShapes) {
    constexpr double kResistance = 0.06;
    constexpr double kRadius = 0.5;
    SceneDescription scene = emptyPeerScene();
    add(scene, "ground", SceneBodyType::fixed, {0, -1}, {100, 1});
    BodyDescription& ball = add(scene, "ball", SceneBodyType::dynamic, {0, kRadius}, {0.5, 0.5});
    ball.shapes[0].geometry = CircleGeometry{{0, 0}, kRadius};
    ball.shapes[0].rollingResistance = kResistance;
    ball.velocity = {3, 0};
    ball.angularVelocity = -3 / kRadius;
    for (const PeerSettings& peer : peers()) {
        EXPECT_EQ(peerLacks(peer.engine, scene).empty(), peer.engine != PeerEngine::chipmunk) << nameOf(peer);
        if (peer.engine == PeerEngine::chipmunk) { continue; }
        const double lost = 3 - run(scene, peer, 120).back().bodies[1].velocity.x;
        const double brake = peer.engine == PeerEngine::box2d3 ? kResistance * kGravity / 1.5 : 0;
        EXPECT_NEAR(lost / 2, brake, 0.01) << nameOf(peer);
    }
}

/// Ice, ten metres of rough ground, and ice, along one chain.
TEST(PeerRunner, FrictionOfAChainIsThatOfItsSegments) {
    SceneDescription scene = emptyPeerScene();
    ChainGeometry ground{{{60, 0}, {20, 0}, {10, 0}, {-60, 0}, {-60, -5}, {60, -5}}, true};
    for (const double friction : {0.0, 0.5, 0.0, 0.0, 0.0, 0.0}) {
        ground.surfaces.push_back(SurfaceDescription{.friction = friction});
    }
    add(scene, "ground", SceneBodyType::fixed, {0, 0}, {1, 1}).shapes[0].geometry = ground;
    BodyDescription& body = add(scene, "box", SceneBodyType::dynamic, {5, 0.2}, {0.2, 0.2});
    body.velocity = {12, 0};
    body.shapes[0].friction = 0.5;
    for (const PeerSettings& peer : peers()) {
        EXPECT_EQ(peerLacks(peer.engine, scene), "") << nameOf(peer);
        const std::vector<Frame> frames = run(scene, peer, 105);
        EXPECT_NEAR(frames[15].bodies[1].velocity.x, 12, 0.01) << nameOf(peer);
        EXPECT_GT(frames.back().bodies[1].position.x, 20.5) << nameOf(peer);
        // A step is 0.2 m long; Chipmunk is off by 0.21.
        const double within = peer.engine == PeerEngine::chipmunk ? 0.3 : 0.15;
        EXPECT_NEAR(frames.back().bodies[1].velocity.x, std::sqrt(12 * 12 - 2 * 0.5 * kGravity * 10), within)
            << nameOf(peer);
    }
}

/// A bar between a hinge and a rod: both ends stay where the joints hold them, and what is filtered passes.
TEST(PeerRunner, JointsHoldAndFiltersPass) {
    SceneDescription scene = emptyPeerScene();
    scene.settings.dt = 1.0 / 240;  // Chipmunk takes back a tenth of an error each 1/60 s only
    add(scene, "anchor", SceneBodyType::fixed, {0, 0}, {0.1, 0.1}).shapes[0].filter.mask = 0;
    add(scene, "bar", SceneBodyType::dynamic, {1, 0}, {1, 0.1}).angle = std::numbers::pi;
    add(scene, "bob", SceneBodyType::dynamic, {2, -1}, {0.1, 0.1});
    add(scene, "tip", SceneBodyType::dynamic, {2, 0.2}, {0.1, 0.1});
    for (BodyDescription& body : scene.bodies) { body.shapes[0].filter.group = -1; }
    join(scene, "anchor", "bar", RevoluteDescription{});
    DistanceDescription rod;
    rod.anchorA = {2, 0};
    rod.anchorB = {2, -1};
    join(scene, "bar", "bob", rod);
    WeldDescription weld;
    weld.anchor = {2, 0.2};
    join(scene, "bar", "tip", weld);
    for (const PeerSettings& peer : peers()) {
        for (const Frame& frame : run(scene, peer, 360)) {
            const BodyFrame& bar = frame.bodies[1];
            EXPECT_NEAR(length(bar.position), 1, 0.03) << nameOf(peer);
            const DVec2 end = bar.position + DVec2{-std::cos(bar.angle), -std::sin(bar.angle)};
            EXPECT_NEAR(length(frame.bodies[2].position - end), 1, 0.06) << nameOf(peer);
            EXPECT_NEAR(length(frame.bodies[3].position - end), 0.2, 0.05) << nameOf(peer);
            EXPECT_NEAR(frame.bodies[3].angle - bar.angle, -std::numbers::pi, 0.05) << nameOf(peer);
        }
    }
}

TEST(PeerRunner, WhatIsDisabledTakesNoPart) {
    SceneDescription scene = emptyPeerScene();
    add(scene, "hung", SceneBodyType::dynamic, {0, 5}, {0.5, 0.5}).enabled = false;
    add(scene, "falls", SceneBodyType::dynamic, {0, 7}, {0.5, 0.5});
    for (const PeerSettings& peer : peers()) {
        std::string error;
        if (peer.engine == PeerEngine::chipmunk) {
            EXPECT_EQ(makePeerRunner(scene, peer, error, SWEPT_PROGRAM), nullptr);
            continue;
        }
        const Frame frame = run(scene, peer, 60).back();
        EXPECT_EQ(frame.bodies[0].position, (DVec2{0, 5})) << nameOf(peer);
        EXPECT_FALSE(frame.bodies[0].awake) << nameOf(peer);
        EXPECT_LT(frame.bodies[1].position.y, 3) << nameOf(peer);
    }
}

TEST(PeerRunner, WhatAnEngineLacksIsRefused) {
    SceneDescription scene = emptyPeerScene();
    add(scene, "a", SceneBodyType::dynamic, {0, 0}, {0.5, 0.5});
    add(scene, "b", SceneBodyType::dynamic, {2, 0}, {0.5, 0.5});
    join(scene, "a", "b", PulleyDescription{{0, 3}, {2, 3}, {0, 0}, {2, 0}, 1, {}});
    for (const PeerSettings& peer : peers()) {
        std::string error;
        const auto runner = makePeerRunner(scene, peer, error, SWEPT_PROGRAM);
        EXPECT_EQ(runner != nullptr, peer.engine == PeerEngine::box2d2) << nameOf(peer);
        EXPECT_EQ(error.empty(), peer.engine == PeerEngine::box2d2) << error;
    }
}

}  // namespace
}  // namespace swept

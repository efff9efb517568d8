#include "../scene_builder.h"
#include "builtin_scenes.h"

/// Joints that machines are made of: every kind that the jointed figures and chains do not show.

namespace swept::scenes {
namespace {

using namespace build;

/// Two wheels that turn each other, and a rack that the second one moves.
void addGears(SceneDescription& scene, DVec2 center) {
    const DVec2 second = center + DVec2{1.5, 0};
    const DVec2 rack = second + DVec2{-1, -0.62};
    addDynamic(scene, "drive wheel", center, {circle(1), box({0.9, 0.06})});
    addDynamic(scene, "driven wheel", second, {circle(0.5), box({0.06, 0.45})});
    addDynamic(scene, "rack", rack, {box({1.2, 0.12})});
    RevoluteDescription& drive = hinge(scene, "frame", "drive wheel", center);
    drive.motorSpeed = -0.25;
    drive.maxMotorTorque = 200;
    const std::string driveJoint = lastJoint(scene);
    hinge(scene, "frame", "driven wheel", second);
    const std::string drivenJoint = lastJoint(scene);
    slider(scene, "frame", "rack", rack, {1, 0});
    const std::string rackJoint = lastJoint(scene);
    gear(scene, driveJoint, drivenJoint, 0.5);      // two turns for one, the other way
    gear(scene, drivenJoint, rackJoint, -1 / 0.5);  // what rolls past is radius times angle
    for (const char* const part : {"drive wheel", "driven wheel", "rack"}) {
        for (BodyDescription& body : scene.bodies) {
            if (body.name == part) {
                for (ShapeDescription& shape : body.shapes) { shape.filter.mask = 0; }
            }
        }
    }
}

/// Two buckets on one rope over two wheels; the heavier one sinks.
void addPulley(SceneDescription& scene, DVec2 left, double span, double height) {
    const DVec2 right = left + DVec2{span, 0};
    addDynamic(scene, "light bucket", left, {box({0.4, 0.3})});
    addDynamic(scene, "heavy bucket", right, {withDensity(box({0.4, 0.3}), 1.4)});
    pulley(scene, "light bucket", "heavy bucket", left + DVec2{0, 0.3}, right + DVec2{0, 0.3}, height);
}

/// A board of welded planks that gives way like a spring.
void addBoard(SceneDescription& scene, DVec2 root) {
    std::string before = "frame";
    for (int i = 0; i < 4; ++i) {
        const std::string plank = "board" + std::to_string(i);
        addDynamic(scene, plank, root + DVec2{0.4 + 0.8 * i, 0}, {box({0.4, 0.08})});
        WeldDescription& joint = weld(scene, before, plank, root + DVec2{0.8 * i, 0});
        joint.angularHertz = 15;
        joint.dampingRatio = 0.3;
        before = plank;
    }
    addDynamic(scene, "diver", root + DVec2{2.8, 1.8}, {circle(0.3)});
}

/// A lift that a motor drives up to its limit, with a box on it.
void addLift(SceneDescription& scene, DVec2 bottom) {
    addDynamic(scene, "lift", bottom, {box({0.9, 0.1})});
    PrismaticDescription& joint = slider(scene, "frame", "lift", bottom, {0, 1});
    joint.lower = 0;
    joint.upper = 2.5;
    joint.motorSpeed = 0.6;
    joint.maxMotorForce = 200;
    addDynamic(scene, "cargo", bottom + DVec2{0, 0.4}, {box({0.3, 0.3})});
}

/// A tray held in place by a motor of limited force; a ball falls on it.
void addTray(SceneDescription& scene, DVec2 center) {
    addDynamic(scene, "tray", center,
               {box({0.8, 0.08}), box({0.06, 0.2}, {-0.74, 0.2}), box({0.06, 0.2}, {0.74, 0.2})});
    MotorDescription& joint = motor(scene, "frame", "tray");
    joint.maxForce = 60;
    joint.maxTorque = 60;
    addDynamic(scene, "guest", center + DVec2{0.2, 1.5}, {circle(0.3)});
}

/// A ball on the spring of a pointer, far from where it is drawn to.
void addPointer(SceneDescription& scene, DVec2 from, DVec2 target) {
    addDynamic(scene, "dragged", from, {circle(0.35)});
    MouseDescription& joint = mouse(scene, "frame", "dragged", target);
    joint.anchor = from;
    joint.hertz = 1;
    joint.dampingRatio = 0.2;
    joint.maxForce = 100;
}

/// Two pendulums that swing through each other.
void addGhosts(SceneDescription& scene, DVec2 top) {
    for (const double side : {-1.0, 1.0}) {
        const std::string name = side < 0 ? "left pendulum" : "right pendulum";
        const DVec2 ball = top + DVec2{1.1 * side, -1.1};
        addDynamic(scene, name, ball, {circle(0.3)});
        rod(scene, "frame", name, top + DVec2{0.01 * side, 0}, ball);
    }
    keepApart(scene, "left pendulum", "right pendulum");
}

}  // namespace

SceneDescription machineRoom() {
    SceneDescription scene = build::scene("machine room", {0, 3.4}, 10);
    addFixed(scene, "frame", {0, 0}, {box({9.5, 0.2}, {0, -0.2}), box({9.5, 0.1}, {0, 7.6})});
    addGears(scene, {-6.9, 5.9});
    addBoard(scene, {-9, 2});
    addPulley(scene, {-3.2, 3}, 1.8, 7.4);
    addLift(scene, {0.6, 0.4});
    addTray(scene, {3.2, 2.2});
    addPointer(scene, {5.4, 1}, {6.4, 3.2});
    addGhosts(scene, {4.2, 7.4});
    return scene;
}

SceneDescription car() {
    SceneDescription scene = build::scene("car", {6.6, 3}, 15);
    // From right to left: a run-up, bumps, a ramp and a gap.
    std::vector<DVec2> ground{{19.5, 4}, {19, 0}, {13.5, 0}, {13.5, -1}, {12, -1}, {12, 1.3}, {8, 0}};
    for (int i = 0; i < 8; ++i) { ground.push_back({7.5 - 0.75 * i, i % 2 == 0 ? 0.18 : 0}); }
    for (const DVec2 point : {DVec2{1.5, 0}, DVec2{-7.5, 0}, DVec2{-8, 4}}) { ground.push_back(point); }
    addFixed(scene, "ground", {0, 0}, {chain(ground)});
    const DVec2 start{-5, 0.95};
    addDynamic(scene, "chassis", start,
               {polygon({{-1.3, -0.25}, {1.3, -0.25}, {1.3, 0.05}, {-1.3, 0.2}}),
                polygon({{-0.9, 0.15}, {0.5, 0.1}, {0.1, 0.55}, {-0.7, 0.6}})});
    for (const double side : {-1.0, 1.0}) {
        const std::string name = side < 0 ? "rear wheel" : "front wheel";
        const DVec2 axle = start + DVec2{0.85 * side, -0.5};
        addDynamic(scene, name, axle, {withFriction(circle(0.4), 1.2)});
        WheelDescription& joint = wheel(scene, "chassis", name, axle, {0, 1});
        joint.lower = -0.25;
        joint.upper = 0.2;
        joint.hertz = 3;
        joint.dampingRatio = 0.5;
        joint.motorSpeed = -13;  // clockwise: to the right
        joint.maxMotorTorque = side < 0 ? 12 : 6;
    }
    return scene;
}

}  // namespace swept::scenes

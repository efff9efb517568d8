#include "box2d_approximations.h"

#include <swept/samples/scene_surfaces.h>

#include <algorithm>
#include <variant>

namespace swept {
namespace {

template <class Predicate>
bool anyBody(const SceneDescription& scene, Predicate predicate) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), predicate);
}

template <class Predicate>
bool anyShape(const SceneDescription& scene, Predicate predicate) {
    return anyBody(scene, [&](const BodyDescription& body) {
        return std::any_of(body.shapes.begin(), body.shapes.end(), predicate);
    });
}

bool isCapsule(const ShapeDescription& shape) {
    return std::holds_alternative<CapsuleGeometry>(shape.geometry) ||
           (std::holds_alternative<SegmentGeometry>(shape.geometry) && shape.radius > 0);
}

bool isRounded(const ShapeDescription& shape) { return shape.radius > 0 && !isCapsule(shape); }

bool isSegment(const ShapeDescription& shape) {
    return std::holds_alternative<SegmentGeometry>(shape.geometry) && shape.radius <= 0;
}

bool hasSpringOnRevolute(const SceneDescription& scene) {
    return std::any_of(scene.joints.begin(), scene.joints.end(), [](const JointDescription& joint) {
        const auto* const revolute = std::get_if<RevoluteDescription>(&joint.joint);
        return revolute != nullptr && revolute->hertz.has_value();
    });
}

template <class Kind>
bool hasAny(const SceneDescription& scene) {
    return std::any_of(scene.joints.begin(), scene.joints.end(),
                       [](const JointDescription& joint) { return std::holds_alternative<Kind>(joint.joint); });
}

bool hasSpringOnPrismatic(const SceneDescription& scene) {
    return std::any_of(scene.joints.begin(), scene.joints.end(), [](const JointDescription& joint) {
        const auto* const slide = std::get_if<PrismaticDescription>(&joint.joint);
        const auto* const weld = std::get_if<WeldDescription>(&joint.joint);
        return (slide != nullptr && slide->hertz) || (weld != nullptr && weld->linearHertz);
    });
}

bool hasAimedWheel(const SceneDescription& scene) {
    return std::any_of(scene.joints.begin(), scene.joints.end(), [](const JointDescription& joint) {
        const auto* const wheel = std::get_if<WheelDescription>(&joint.joint);
        return wheel != nullptr && wheel->springTarget.value_or(0) != 0;
    });
}

bool isBreakable(const JointDescription& joint) { return joint.breakForce || joint.breakTorque; }

bool isOfUnsupportedMode(SceneContinuous mode) {
    return mode == SceneContinuous::speedLimit || mode == SceneContinuous::speculative || mode == SceneContinuous::stop;
}

void addWaysOfTheEngine(std::vector<std::string>& sentences) {
    sentences.insert(
        sentences.end(),
        {"All state is in float, world positions too.",
         "Polygons, segments and chains carry a skin of 1 cm, so they rest up to 2 cm apart.",
         "No body moves more than 2 m or turns more than a quarter turn in a step.",
         "Sub-steps, relax passes and profiles are ignored: one step with 8 velocity and 3 position iterations.",
         "Damping is implicit, v / (1 + c dt) a step, not exact.", "Impacts slower than 1 m/s do not bounce.",
         "A free body falls by symplectic Euler, ahead of its parabola by g t dt / 2.",
         "A body that meets something within the step loses the rest of the step.",
         "Bodies of less than 5 mm or with points closer than that may be refused or merged.",
         "Events and impacts within the step are not reported."});
}

void addWaysWithBodies(const SceneDescription& scene, std::vector<std::string>& sentences) {
    const auto hasOwnMode = [](const BodyDescription& body) { return body.continuous.has_value(); };
    if (anyBody(scene, hasOwnMode)) { sentences.push_back("The continuous mode of single bodies is ignored."); }
    if (isOfUnsupportedMode(scene.settings.continuous)) {
        sentences.push_back("The world's continuous mode is replaced by Box2D's own continuous collision.");
    }
    if (scene.settings.maxSpeed) { sentences.push_back("The setting maxSpeed is ignored."); }
    if (anyBody(scene, [](const BodyDescription& body) { return !body.awake; })) {
        sentences.push_back("A body that starts asleep starts without velocity.");
    }
}

void addWaysWithShapes(const SceneDescription& scene, std::vector<std::string>& sentences) {
    if (anyShape(scene, isCapsule)) {
        sentences.push_back("Capsules are two disks and a box with a skin; their contacts may number more than two.");
    }
    if (anyShape(scene, isRounded)) {
        sentences.push_back(
            "Rounded polygons and chains are polygons with a thicker skin: against other polygons their corners are "
            "sharp, and a radius below 1 cm counts as 1 cm.");
    }
    if (anyShape(scene, [](const ShapeDescription& shape) { return anySurface(shape, resistsRolling); })) {
        sentences.push_back("Rolling resistance is left out.");
    }
    if (anyShape(scene, isSegment)) { sentences.push_back("Segments do not collide with segments or chains."); }
    if (anyShape(scene, [](const ShapeDescription& shape) { return shape.sensor; })) {
        sentences.push_back("Sensors of static and kinematic bodies detect dynamic bodies only.");
    }
}

void addWaysWithJoints(const SceneDescription& scene, std::vector<std::string>& sentences) {
    if (!scene.joints.empty()) { sentences.push_back("Joints are kept by iteration, and limits by a position pass."); }
    if (hasSpringOnRevolute(scene)) { sentences.push_back("Springs of revolute joints are left out."); }
    if (hasSpringOnPrismatic(scene)) {
        sentences.push_back("Springs of prismatic joints, and linear ones of welds, are left out.");
    }
    if (hasAimedWheel(scene)) { sentences.push_back("Springs of wheels pull to a translation of 0."); }
    if (hasAny<PulleyDescription>(scene)) { sentences.push_back("The rope of a pulley pushes, too."); }
    if (hasAny<MotorDescription>(scene)) {
        sentences.push_back("Motors drive to a pose only, by 0.3 of the way in a step; the velocities are ignored.");
    }
    if (std::any_of(scene.joints.begin(), scene.joints.end(), isBreakable)) {
        sentences.push_back("Joints break by the reaction of the whole step, judged after it.");
    }
}

}  // namespace

std::vector<std::string> box2dApproximations(const SceneDescription& scene) {
    std::vector<std::string> sentences;
    addWaysOfTheEngine(sentences);
    addWaysWithBodies(scene, sentences);
    addWaysWithShapes(scene, sentences);
    addWaysWithJoints(scene, sentences);
    return sentences;
}

}  // namespace swept

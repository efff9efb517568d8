#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "scene_description.h"

/// Short ways to say what a scene contains. Everything returned by reference may be refined in place; such a reference
/// is good until the next body or joint is added.

namespace swept::build {

/// Numbers that are the same on every machine (splitmix64), for scenes that should look accidental.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    /// In [low, high).
    double range(double low, double high);

private:
    std::uint64_t state_;
};

SceneDescription scene(std::string name, DVec2 viewCenter, double viewHeight);

// Shapes: density 1, friction 0.6, restitution 0, as in the format.
ShapeDescription box(DVec2 half, DVec2 center = {}, double angle = 0);
ShapeDescription circle(double radius, DVec2 center = {});
ShapeDescription capsule(DVec2 p, DVec2 q, double radius);
ShapeDescription segment(DVec2 p, DVec2 q);
ShapeDescription polygon(std::vector<DVec2> points);
/// Collides on the right-hand side of its direction: list ground from right to left, the inside of a bowl clockwise.
ShapeDescription chain(std::vector<DVec2> points, bool loop = false);

// Variations of a shape.
ShapeDescription withDensity(ShapeDescription shape, double density);
ShapeDescription withFriction(ShapeDescription shape, double friction);
ShapeDescription withRestitution(ShapeDescription shape, double restitution);
ShapeDescription rounded(ShapeDescription shape, double radius);

// Bodies. The name may be empty: `body<index>`.
BodyDescription& addFixed(SceneDescription& scene, std::string name, DVec2 position,
                          std::vector<ShapeDescription> shapes);
BodyDescription& addKinematic(SceneDescription& scene, std::string name, DVec2 position,
                              std::vector<ShapeDescription> shapes);
BodyDescription& addDynamic(SceneDescription& scene, std::string name, DVec2 position,
                            std::vector<ShapeDescription> shapes);
/// A body whose only shape is a capsule from p to q (world); its position is the middle.
BodyDescription& addLimb(SceneDescription& scene, std::string name, DVec2 p, DVec2 q, double radius);

// Joints between bodies that exist, by name; anchors in world coordinates.
RevoluteDescription& hinge(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor);
/// Keeps the distance of the anchors.
DistanceDescription& rod(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchorA,
                         DVec2 anchorB);

PrismaticDescription& slider(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor,
                             DVec2 axis);
WheelDescription& wheel(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor, DVec2 axis);
WeldDescription& weld(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor);
MotorDescription& motor(SceneDescription& scene, const std::string& a, const std::string& b);
MouseDescription& mouse(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 target);
/// Couples two revolute or prismatic joints that exist, by name.
GearDescription& gear(SceneDescription& scene, const std::string& jointA, const std::string& jointB, double ratio);
/// Each rope goes straight up from its anchor to a wheel at this height.
PulleyDescription& pulley(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchorA,
                          DVec2 anchorB, double height);
void keepApart(SceneDescription& scene, const std::string& a, const std::string& b);
/// The name of the joint that was added last.
std::string lastJoint(const SceneDescription& scene);

/// The name of the body that was added last.
std::string lastBody(const SceneDescription& scene);

}  // namespace swept::build

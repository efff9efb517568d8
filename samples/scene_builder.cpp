#include "scene_builder.h"

#include <utility>

#include "scene_reader.h"

namespace swept::build {
namespace {

ShapeDescription shapeOf(Geometry geometry) {
    ShapeDescription shape;
    shape.geometry = std::move(geometry);
    return shape;
}

BodyDescription& addBody(SceneDescription& scene, SceneBodyType type, std::string name, DVec2 position,
                         std::vector<ShapeDescription> shapes) {
    BodyDescription& body = scene.bodies.emplace_back();
    body.type = type;
    body.name = std::move(name);
    body.position = position;
    body.shapes = std::move(shapes);
    return body;
}

template <class Members>
Members& addJoint(SceneDescription& scene, const std::string& a, const std::string& b, Members members) {
    JointDescription& joint = scene.joints.emplace_back();
    joint.bodyA = a;
    joint.bodyB = b;
    return joint.joint.emplace<Members>(std::move(members));
}

}  // namespace

double Dice::range(double low, double high) {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return low + (high - low) * (static_cast<double>(z >> 11) * 0x1p-53);
}

SceneDescription scene(std::string name, DVec2 viewCenter, double viewHeight) {
    SceneDescription result;
    result.name = std::move(name);
    result.view = ViewDescription{viewCenter, viewHeight};
    return result;
}

ShapeDescription box(DVec2 half, DVec2 center, double angle) { return shapeOf(BoxGeometry{half, center, angle}); }
ShapeDescription circle(double radius, DVec2 center) { return shapeOf(CircleGeometry{center, radius}); }
ShapeDescription capsule(DVec2 p, DVec2 q, double radius) { return shapeOf(CapsuleGeometry{{p, q}, radius}); }
ShapeDescription segment(DVec2 p, DVec2 q) { return shapeOf(SegmentGeometry{{p, q}}); }
ShapeDescription polygon(std::vector<DVec2> points) { return shapeOf(PolygonGeometry{std::move(points)}); }
ShapeDescription chain(std::vector<DVec2> points, bool loop) { return shapeOf(ChainGeometry{std::move(points), loop}); }

ShapeDescription withDensity(ShapeDescription shape, double density) {
    shape.density = density;
    return shape;
}
ShapeDescription withFriction(ShapeDescription shape, double friction) {
    shape.friction = friction;
    return shape;
}
ShapeDescription withRestitution(ShapeDescription shape, double restitution) {
    shape.restitution = restitution;
    return shape;
}
ShapeDescription rounded(ShapeDescription shape, double radius) {
    shape.radius = radius;
    return shape;
}

BodyDescription& addFixed(SceneDescription& scene, std::string name, DVec2 position,
                          std::vector<ShapeDescription> shapes) {
    return addBody(scene, SceneBodyType::fixed, std::move(name), position, std::move(shapes));
}
BodyDescription& addKinematic(SceneDescription& scene, std::string name, DVec2 position,
                              std::vector<ShapeDescription> shapes) {
    return addBody(scene, SceneBodyType::kinematic, std::move(name), position, std::move(shapes));
}
BodyDescription& addDynamic(SceneDescription& scene, std::string name, DVec2 position,
                            std::vector<ShapeDescription> shapes) {
    return addBody(scene, SceneBodyType::dynamic, std::move(name), position, std::move(shapes));
}
BodyDescription& addLimb(SceneDescription& scene, std::string name, DVec2 p, DVec2 q, double radius) {
    const DVec2 middle = 0.5 * (p + q);
    return addDynamic(scene, std::move(name), middle, {capsule(p - middle, q - middle, radius)});
}

RevoluteDescription& hinge(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor) {
    RevoluteDescription members;
    members.anchor = anchor;
    return addJoint(scene, a, b, members);
}
DistanceDescription& rod(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchorA,
                         DVec2 anchorB) {
    DistanceDescription members;
    members.anchorA = anchorA;
    members.anchorB = anchorB;
    return addJoint(scene, a, b, members);
}

PrismaticDescription& slider(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor,
                             DVec2 axis) {
    PrismaticDescription members;
    members.anchor = anchor;
    members.axis = axis;
    return addJoint(scene, a, b, members);
}
WheelDescription& wheel(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor, DVec2 axis) {
    WheelDescription members;
    members.anchor = anchor;
    members.axis = axis;
    return addJoint(scene, a, b, members);
}
WeldDescription& weld(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchor) {
    WeldDescription members;
    members.anchor = anchor;
    return addJoint(scene, a, b, members);
}
MotorDescription& motor(SceneDescription& scene, const std::string& a, const std::string& b) {
    return addJoint(scene, a, b, MotorDescription{});
}
MouseDescription& mouse(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 target) {
    MouseDescription members;
    members.target = target;
    return addJoint(scene, a, b, members);
}
GearDescription& gear(SceneDescription& scene, const std::string& jointA, const std::string& jointB, double ratio) {
    const auto movedBy = [&scene](const std::string& name) {
        for (std::size_t i = 0; i < scene.joints.size(); ++i) {
            if (jointName(scene, i) == name) { return scene.joints[i].bodyB; }
        }
        return std::string();
    };
    GearDescription members;
    members.jointA = jointA;
    members.jointB = jointB;
    members.ratio = ratio;
    return addJoint(scene, movedBy(jointA), movedBy(jointB), members);
}
PulleyDescription& pulley(SceneDescription& scene, const std::string& a, const std::string& b, DVec2 anchorA,
                          DVec2 anchorB, double height) {
    PulleyDescription members;
    members.groundA = {anchorA.x, height};
    members.groundB = {anchorB.x, height};
    members.anchorA = anchorA;
    members.anchorB = anchorB;
    return addJoint(scene, a, b, members);
}
void keepApart(SceneDescription& scene, const std::string& a, const std::string& b) {
    addJoint(scene, a, b, FilterJointDescription{});
}

std::string lastJoint(const SceneDescription& scene) { return jointName(scene, scene.joints.size() - 1); }
std::string lastBody(const SceneDescription& scene) { return bodyName(scene, scene.bodies.size() - 1); }

}  // namespace swept::build

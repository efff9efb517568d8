#include "chipmunk_world.h"

#include <chipmunk/chipmunk.h>
#include <swept/samples/joint_start.h>
#include <swept/samples/scene_surfaces.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <variant>
#include <vector>

#include "body_mass.h"
#include "joint_ends.h"

namespace swept {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kSecondsToSleep = 0.5;

cpVect toPeer(DVec2 v) { return cpv(v.x, v.y); }
DVec2 fromPeer(cpVect v) { return {v.x, v.y}; }

/// One shape of the scene is one of Chipmunk's, or as many as a chain has edges.
struct ShapeMaker {
    cpBody* body;
    double radius;
    std::vector<cpShape*>& made;

    void operator()(const BoxGeometry& box) const {
        const DVec2 right{box.half.x * std::cos(box.angle), box.half.x * std::sin(box.angle)};
        const DVec2 up{-box.half.y * std::sin(box.angle), box.half.y * std::cos(box.angle)};
        addPolygon(
            {box.center - right - up, box.center + right - up, box.center + right + up, box.center - right + up});
    }
    void operator()(const CircleGeometry& circle) const {
        made.push_back(cpCircleShapeNew(body, circle.radius, toPeer(circle.center)));
    }
    void operator()(const CapsuleGeometry& capsule) const { addSegment(capsule.points, capsule.radius); }
    void operator()(const SegmentGeometry& line) const { addSegment(line.points, radius); }
    void operator()(const PolygonGeometry& geometry) const { addPolygon(geometry.points); }
    void operator()(const ChainGeometry& geometry) const {
        const std::vector<DVec2>& points = geometry.points;
        const std::size_t count = points.size();
        for (std::size_t i = 0; i + (geometry.loop ? 0 : 1) < count; ++i) {
            addSegment({points[i], points[(i + 1) % count]}, radius);
            const bool isFirst = !geometry.loop && i == 0;
            const bool isLast = !geometry.loop && i + 2 == count;
            cpSegmentShapeSetNeighbors(made.back(), toPeer(points[isFirst ? i : (i + count - 1) % count]),
                                       toPeer(points[isLast ? i + 1 : (i + 2) % count]));
        }
    }

private:
    void addSegment(const std::array<DVec2, 2>& points, double thickness) const {
        made.push_back(cpSegmentShapeNew(body, toPeer(points[0]), toPeer(points[1]), thickness));
    }
    void addPolygon(const std::vector<DVec2>& points) const {
        std::vector<cpVect> corners;
        for (const DVec2 point : points) { corners.push_back(toPeer(point)); }
        made.push_back(
            cpPolyShapeNew(body, static_cast<int>(corners.size()), corners.data(), cpTransformIdentity, radius));
    }
};

/// One joint of the scene is one constraint or several.
struct JointMaker {
    cpBody* a;
    cpBody* b;
    std::vector<cpConstraint*>& made;

    void operator()(const RevoluteDescription& revolute) const {
        addPivot(revolute);
        const double start = referenceAngle(revolute);
        if (revolute.lower || revolute.upper) {
            made.push_back(cpRotaryLimitJointNew(a, b, start + revolute.lower.value_or(-kNone),
                                                 start + revolute.upper.value_or(kNone)));
        }
        if (revolute.motorSpeed || revolute.maxMotorTorque) {
            made.push_back(cpSimpleMotorNew(a, b, -revolute.motorSpeed.value_or(0)));  // it counts the other way
            cpConstraintSetMaxForce(made.back(), revolute.maxMotorTorque.value_or(kNone));
        }
    }
    void operator()(const DistanceDescription& distance) const {
        const cpVect anchorA = cpBodyWorldToLocal(a, toPeer(distance.anchorA));
        const cpVect anchorB = cpBodyWorldToLocal(b, toPeer(distance.anchorB));
        if (distance.minLength || distance.maxLength) {
            made.push_back(cpSlideJointNew(a, b, anchorA, anchorB, distance.minLength.value_or(0),
                                           distance.maxLength.value_or(kNone)));
            return;
        }
        made.push_back(cpPinJointNew(a, b, anchorA, anchorB));
        if (distance.length) { cpPinJointSetDist(made.back(), *distance.length); }
    }
    void operator()(const WeldDescription& weld) const {
        addPivot(weld);
        made.push_back(cpGearJointNew(a, b, referenceAngle(weld), 1));
    }
    template <class Other>
    void operator()(const Other&) const {
        std::fputs("a joint", stderr);
        std::abort();
    }

private:
    template <class Members>
    void addPivot(const Members& joint) const {
        made.push_back(cpPivotJointNew2(a, b, cpBodyWorldToLocal(a, toPeer(joint.anchor)),
                                        cpBodyWorldToLocal(b, toPeer(joint.anchorB.value_or(joint.anchor)))));
    }
    template <class Members>
    double referenceAngle(const Members& joint) const {
        return referenceAngleOf(joint, cpBodyGetAngle(b) - cpBodyGetAngle(a));
    }
};

cpBody* makeBody(const BodyDescription& description, const BodyMass& mass) {
    cpBody* const body = description.type == SceneBodyType::fixed       ? cpBodyNewStatic()
                         : description.type == SceneBodyType::kinematic ? cpBodyNewKinematic()
                                                                        : cpBodyNew(mass.mass, mass.inertia);
    if (description.type == SceneBodyType::dynamic) { cpBodySetCenterOfGravity(body, toPeer(mass.center)); }
    cpBodySetAngle(body, description.angle);
    cpBodySetPosition(body, toPeer(description.position));
    return body;
}

/// Pairs multiply, so that each shape has the root.
void setSurface(cpShape* made, const ShapeDescription& shape, std::size_t segment) {
    const FullSurface surface = surfaceAt(shape, segment);
    cpShapeSetFriction(made, std::sqrt(surface.friction));
    cpShapeSetElasticity(made, std::sqrt(surface.restitution));
    cpShapeSetSensor(made, shape.sensor ? cpTrue : cpFalse);
    const auto group = static_cast<cpGroup>(-static_cast<std::int64_t>(shape.filter.group));
    cpShapeSetFilter(made, cpShapeFilterNew(group, shape.filter.category, shape.filter.mask));
}

class ChipmunkWorld final : public PeerWorld {
public:
    ChipmunkWorld(const SceneDescription& scene, const PeerSettings& settings)
        : PeerWorld(scene),
          space_(cpSpaceNew()),
          bodies_(scene.bodies.size()),
          shapes_(scene.bodies.size()),
          joints_(scene.joints.size()),
          ends_(jointEndsOf(scene)) {
        cpSpaceSetGravity(space_, toPeer(scene.gravity));
        cpSpaceSetIterations(space_, settings.solverPasses);
        if (scene.settings.sleep) { cpSpaceSetSleepTimeThreshold(space_, kSecondsToSleep); }
        for (std::size_t i = 0; i < bodies_.size(); ++i) { addBody(i); }
        for (std::size_t i = 0; i < joints_.size(); ++i) { addJoint(i); }
    }
    ~ChipmunkWorld() override {
        for (std::size_t i = 0; i < joints_.size(); ++i) { removeJoint(i); }
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (bodies_[i] != nullptr) { removeBody(i); }
        }
        cpSpaceFree(space_);
    }
    ChipmunkWorld(const ChipmunkWorld&) = delete;
    ChipmunkWorld& operator=(const ChipmunkWorld&) = delete;

    void remove(std::span<const std::uint32_t> bodies) override {
        for (const std::size_t joint : jointsOn(ends_, bodies)) { removeJoint(joint); }
        for (const std::uint32_t body : bodies) { removeBody(body); }
    }
    void add(std::span<const std::uint32_t> bodies) override {
        for (const std::uint32_t body : bodies) { addBody(body); }
        for (const std::size_t joint : jointsOn(ends_, bodies)) { addJoint(joint); }
    }
    void setVelocity(std::uint32_t body, DVec2 velocity) override {
        cpBodySetVelocity(bodies_[body], toPeer(velocity));
    }

private:
    void advance() override { cpSpaceStep(space_, scene().settings.dt); }
    bool isThere(std::size_t body) const override { return bodies_[body] != nullptr; }

    void addBody(std::size_t i) {
        const BodyDescription& description = scene().bodies[i];
        BodyMass mass;
        if (description.type == SceneBodyType::dynamic) {
            mass = massOfBody(description);
            mass.inertia = description.fixedRotation ? kNone : mass.inertia;
        }
        cpBody* const body = cpSpaceAddBody(space_, makeBody(description, mass));
        for (const ShapeDescription& shape : description.shapes) {
            const std::size_t first = shapes_[i].size();
            std::visit(ShapeMaker{body, shape.radius, shapes_[i]}, shape.geometry);
            for (std::size_t k = first; k < shapes_[i].size(); ++k) {
                setSurface(shapes_[i][k], shape, k - first);
                cpSpaceAddShape(space_, shapes_[i][k]);
            }
        }
        if (description.type != SceneBodyType::fixed) {
            cpBodySetVelocity(body, toPeer(description.velocity));
            cpBodySetAngularVelocity(body, description.angularVelocity);
        }
        bodies_[i] = body;
    }

    void removeBody(std::size_t i) {
        for (cpShape* const shape : shapes_[i]) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        shapes_[i].clear();
        cpSpaceRemoveBody(space_, bodies_[i]);
        cpBodyFree(bodies_[i]);
        bodies_[i] = nullptr;
    }

    void addJoint(std::size_t i) {
        const JointDescription& joint = scene().joints[i];
        std::visit(JointMaker{bodies_[ends_[i].a], bodies_[ends_[i].b], joints_[i]}, joint.joint);
        for (cpConstraint* const constraint : joints_[i]) {
            cpConstraintSetCollideBodies(constraint, joint.collideConnected ? cpTrue : cpFalse);
            cpSpaceAddConstraint(space_, constraint);
        }
    }

    void removeJoint(std::size_t i) {
        for (cpConstraint* const constraint : joints_[i]) {
            cpSpaceRemoveConstraint(space_, constraint);
            cpConstraintFree(constraint);
        }
        joints_[i].clear();
    }

    void readBody(std::size_t i, PeerSample& sample) const override {
        const cpBody* const body = bodies_[i];
        const DVec2 velocity = fromPeer(cpBodyGetVelocity(body));
        const double omega = cpBodyGetAngularVelocity(body);
        const bool isAwake = scene().bodies[i].type != SceneBodyType::fixed && cpBodyIsSleeping(body) == cpFalse;
        sample.frame.bodies.push_back(
            {fromPeer(cpBodyGetPosition(body)), cpBodyGetAngle(body), velocity, omega, isAwake});
        if (scene().bodies[i].type == SceneBodyType::dynamic) {
            const double inertia = scene().bodies[i].fixedRotation ? 0 : cpBodyGetMoment(body);
            const cpVect center = cpBodyLocalToWorld(body, cpBodyGetCenterOfGravity(body));
            addMotion({cpBodyGetMass(body), inertia, fromPeer(center), velocity, omega, scene().gravity}, sample);
        }
    }

    cpSpace* space_;
    std::vector<cpBody*> bodies_;                // null while taken away
    std::vector<std::vector<cpShape*>> shapes_;  // by body
    std::vector<std::vector<cpConstraint*>> joints_;
    std::vector<JointEnds> ends_;
};

}  // namespace

std::unique_ptr<PeerWorld> makeChipmunkWorld(const SceneDescription& scene, const PeerSettings& settings) {
    return std::make_unique<ChipmunkWorld>(scene, settings);
}

}  // namespace swept

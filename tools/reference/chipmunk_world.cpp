#include "chipmunk_world.h"

#include <chipmunk/chipmunk.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <swept/samples/scene_reader.h>

#include "../bench/stopwatch.h"
#include "body_mass.h"

namespace swept {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kSecondsToSleep = 0.5;

cpVect toPeer(DVec2 v) { return cpv(v.x, v.y); }
DVec2 fromPeer(cpVect v) { return {v.x, v.y}; }

struct ShapeMaker {
    cpBody* body;
    double radius;

    cpShape* operator()(const BoxGeometry& box) const {
        const DVec2 right{box.half.x * std::cos(box.angle), box.half.x * std::sin(box.angle)};
        const DVec2 up{-box.half.y * std::sin(box.angle), box.half.y * std::cos(box.angle)};
        return polygon(
            {box.center - right - up, box.center + right - up, box.center + right + up, box.center - right + up});
    }
    cpShape* operator()(const CircleGeometry& circle) const {
        return cpCircleShapeNew(body, circle.radius, toPeer(circle.center));
    }
    cpShape* operator()(const CapsuleGeometry& capsule) const { return segment(capsule.points, capsule.radius); }
    cpShape* operator()(const SegmentGeometry& line) const { return segment(line.points, radius); }
    cpShape* operator()(const PolygonGeometry& geometry) const { return polygon(geometry.points); }
    cpShape* operator()(const ChainGeometry&) const {
        std::fputs("a chain", stderr);
        std::abort();
    }

private:
    cpShape* segment(const std::array<DVec2, 2>& points, double thickness) const {
        return cpSegmentShapeNew(body, toPeer(points[0]), toPeer(points[1]), thickness);
    }
    cpShape* polygon(const std::vector<DVec2>& points) const {
        std::vector<cpVect> corners;
        for (const DVec2 point : points) {
            corners.push_back(toPeer(point));
        }
        return cpPolyShapeNew(body, static_cast<int>(corners.size()), corners.data(), cpTransformIdentity, radius);
    }
};

/// One joint of the scene is one constraint or several.
struct JointMaker {
    cpBody* a;
    cpBody* b;
    std::vector<cpConstraint*>& made;

    void operator()(const RevoluteDescription& revolute) const {
        made.push_back(cpPivotJointNew(a, b, toPeer(revolute.anchor)));
        const double start = cpBodyGetAngle(b) - cpBodyGetAngle(a);
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
        if (distance.length) {
            cpPinJointSetDist(made.back(), *distance.length);
        }
    }
    void operator()(const WeldDescription& weld) const {
        made.push_back(cpPivotJointNew(a, b, toPeer(weld.anchor)));
        made.push_back(cpGearJointNew(a, b, cpBodyGetAngle(b) - cpBodyGetAngle(a), 1));
    }
    template <class Other>
    void operator()(const Other&) const {
        std::fputs("a joint", stderr);
        std::abort();
    }
};

cpBody* makeBody(const BodyDescription& description, const BodyMass& mass) {
    cpBody* const body = description.type == SceneBodyType::fixed       ? cpBodyNewStatic()
                         : description.type == SceneBodyType::kinematic ? cpBodyNewKinematic()
                                                                        : cpBodyNew(mass.mass, mass.inertia);
    if (description.type == SceneBodyType::dynamic) {
        cpBodySetCenterOfGravity(body, toPeer(mass.center));
    }
    cpBodySetAngle(body, description.angle);
    cpBodySetPosition(body, toPeer(description.position));
    return body;
}

/// Pairs multiply, so that each shape has the root.
void setSurface(cpShape* made, const ShapeDescription& shape) {
    cpShapeSetFriction(made, std::sqrt(shape.friction));
    cpShapeSetElasticity(made, std::sqrt(shape.restitution));
    cpShapeSetSensor(made, shape.sensor ? cpTrue : cpFalse);
    const auto group = static_cast<cpGroup>(-static_cast<std::int64_t>(shape.filter.group));
    cpShapeSetFilter(made, cpShapeFilterNew(group, shape.filter.category, shape.filter.mask));
}

class ChipmunkWorld final : public PeerWorld {
public:
    ChipmunkWorld(const SceneDescription& scene, const PeerSettings& settings) : scene_(scene), space_(cpSpaceNew()) {
        cpSpaceSetGravity(space_, toPeer(scene.gravity));
        cpSpaceSetIterations(space_, settings.solverPasses);
        if (scene.settings.sleep) {
            cpSpaceSetSleepTimeThreshold(space_, kSecondsToSleep);
        }
        addBodies();
        addJoints();
    }
    ~ChipmunkWorld() override {
        for (cpConstraint* const joint : joints_) {
            cpSpaceRemoveConstraint(space_, joint);
            cpConstraintFree(joint);
        }
        for (cpShape* const shape : shapes_) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        for (cpBody* const body : bodies_) {
            cpSpaceRemoveBody(space_, body);
            cpBodyFree(body);
        }
        cpSpaceFree(space_);
    }
    ChipmunkWorld(const ChipmunkWorld&) = delete;
    ChipmunkWorld& operator=(const ChipmunkWorld&) = delete;

    void step() override {
        const bench::Stopwatch watch;
        cpSpaceStep(space_, scene_.settings.dt);
        seconds_ += watch.seconds();
        ++steps_;
    }

    PeerSample sample() const override {
        PeerSample sample;
        sample.frame.step = steps_;
        sample.frame.time = static_cast<double>(steps_) * scene_.settings.dt;
        sample.stepSeconds = seconds_;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const cpBody* const body = bodies_[i];
            const DVec2 velocity = fromPeer(cpBodyGetVelocity(body));
            const double omega = cpBodyGetAngularVelocity(body);
            const bool isDynamic = scene_.bodies[i].type == SceneBodyType::dynamic;
            const bool isAwake = scene_.bodies[i].type != SceneBodyType::fixed && cpBodyIsSleeping(body) == cpFalse;
            sample.frame.bodies.push_back(
                {fromPeer(cpBodyGetPosition(body)), cpBodyGetAngle(body), velocity, omega, isAwake});
            if (isDynamic) {
                const double inertia = scene_.bodies[i].fixedRotation ? 0 : cpBodyGetMoment(body);
                const cpVect center = cpBodyLocalToWorld(body, cpBodyGetCenterOfGravity(body));
                addMotion({cpBodyGetMass(body), inertia, fromPeer(center), velocity, omega, scene_.gravity}, sample);
            }
        }
        return sample;
    }

private:
    void addBodies() {
        for (const BodyDescription& description : scene_.bodies) {
            BodyMass mass;
            if (description.type == SceneBodyType::dynamic) {
                mass = massOfBody(description);
                mass.inertia = description.fixedRotation ? kNone : mass.inertia;
            }
            cpBody* const body = cpSpaceAddBody(space_, makeBody(description, mass));
            for (const ShapeDescription& shape : description.shapes) {
                cpShape* const made = std::visit(ShapeMaker{body, shape.radius}, shape.geometry);
                setSurface(made, shape);
                shapes_.push_back(cpSpaceAddShape(space_, made));
            }
            if (description.type != SceneBodyType::fixed) {
                cpBodySetVelocity(body, toPeer(description.velocity));
                cpBodySetAngularVelocity(body, description.angularVelocity);
            }
            bodies_.push_back(body);
        }
    }

    void addJoints() {
        std::map<std::string, cpBody*> byName;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            byName[bodyName(scene_, i)] = bodies_[i];
        }
        for (const JointDescription& joint : scene_.joints) {
            std::vector<cpConstraint*> made;
            std::visit(JointMaker{byName.at(joint.bodyA), byName.at(joint.bodyB), made}, joint.joint);
            for (cpConstraint* const constraint : made) {
                cpConstraintSetCollideBodies(constraint, joint.collideConnected ? cpTrue : cpFalse);
                joints_.push_back(cpSpaceAddConstraint(space_, constraint));
            }
        }
    }

    const SceneDescription& scene_;
    cpSpace* space_;
    std::vector<cpBody*> bodies_;
    std::vector<cpShape*> shapes_;
    std::vector<cpConstraint*> joints_;
    std::int64_t steps_ = 0;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PeerWorld> makeChipmunkWorld(const SceneDescription& scene, const PeerSettings& settings) {
    return std::make_unique<ChipmunkWorld>(scene, settings);
}

}  // namespace swept

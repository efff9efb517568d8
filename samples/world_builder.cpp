#include "world_builder.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "../shapes/chain.h"
#include "../shapes/hull.h"
#include "engine_refusal.h"
#include "scene_reader.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr int kIndexBits = 32;

Real real(double x) { return static_cast<Real>(x); }
std::optional<Real> real(const std::optional<double>& x) { return x ? std::optional<Real>(real(*x)) : std::nullopt; }

std::vector<Vec2> realPoints(const std::vector<DVec2>& points) {
    std::vector<Vec2> result;
    for (const DVec2 point : points) { result.push_back(toReal(point)); }
    return result;
}

/// All geometries that are one polygon. A chain is not among them.
struct PolygonMaker {
    Real radius;
    Result<Polygon> operator()(const BoxGeometry& g) const {
        return makeBox(toReal(g.half), toReal(g.center), g.angle, radius);
    }
    Result<Polygon> operator()(const CircleGeometry& g) const { return makeCircle(toReal(g.center), real(g.radius)); }
    Result<Polygon> operator()(const CapsuleGeometry& g) const {
        return makeCapsule(toReal(g.points[0]), toReal(g.points[1]), real(g.radius));
    }
    Result<Polygon> operator()(const SegmentGeometry& g) const {
        return makeSegment(toReal(g.points[0]), toReal(g.points[1]), radius);
    }
    Result<Polygon> operator()(const PolygonGeometry& g) const { return convexHull(realPoints(g.points), radius); }
    Result<Polygon> operator()(const ChainGeometry&) const { return Status{StatusCode::degenerate, "chain"}; }
};

ContinuousMode continuousOf(SceneContinuous mode) {
    switch (mode) {
        case SceneContinuous::off:
            return ContinuousMode::off;
        case SceneContinuous::speedLimit:
            return ContinuousMode::speedLimit;
        case SceneContinuous::speculative:
            return ContinuousMode::speculative;
        case SceneContinuous::stop:
            return ContinuousMode::stop;
        case SceneContinuous::subStep:
            return ContinuousMode::subStep;
    }
    return ContinuousMode::subStep;  // unreachable, but GCC cannot know
}

BroadphaseKind broadphaseOf(SceneBroadphase kind) {
    switch (kind) {
        case SceneBroadphase::automatic:
            return BroadphaseKind::automatic;
        case SceneBroadphase::allPairs:
            return BroadphaseKind::allPairs;
        case SceneBroadphase::sortAndSweep:
            return BroadphaseKind::sortAndSweep;
        case SceneBroadphase::quadtree:
            return BroadphaseKind::quadtree;
        case SceneBroadphase::grid:
            return BroadphaseKind::grid;
        case SceneBroadphase::bvh:
            return BroadphaseKind::bvh;
        case SceneBroadphase::wideBvh:
            return BroadphaseKind::wideBvh;
    }
    return BroadphaseKind::automatic;  // unreachable, but GCC cannot know
}

BodyType typeOf(SceneBodyType type) {
    switch (type) {
        case SceneBodyType::fixed:
            return BodyType::fixed;
        case SceneBodyType::kinematic:
            return BodyType::kinematic;
        case SceneBodyType::dynamic:
            return BodyType::dynamic;
    }
    return BodyType::fixed;  // unreachable, but GCC cannot know
}

WorldSettings settingsOf(const SceneDescription& scene) {
    const SettingsDescription& given = scene.settings;
    WorldSettings settings;
    settings.gravity = toReal(scene.gravity);
    settings.profile = given.profile == SceneProfile::accurate ? Profile::accurate : Profile::fast;
    settings.subSteps = given.subSteps;
    settings.relaxPasses = given.relaxPasses;
    settings.continuous = continuousOf(given.continuous);
    settings.maxImpacts = given.maxImpacts;
    settings.maxSpeed = given.maxSpeed ? real(*given.maxSpeed) : std::numeric_limits<Real>::infinity();
    if (given.toiTolerance) { settings.toiTolerance = real(*given.toiTolerance); }
    settings.maxPenetration = real(given.maxPenetration.value_or(std::numeric_limits<double>::infinity()));
    settings.maxJointError = real(given.maxJointError.value_or(std::numeric_limits<double>::infinity()));
    settings.maxLostTime = given.maxLostTime.value_or(std::numeric_limits<double>::infinity());
    settings.sleep = given.sleep;
    settings.broadphase = broadphaseOf(given.broadphase);
    return settings;
}

BodyDef bodyDefOf(const BodyDescription& given, std::size_t index) {
    BodyDef def;
    def.type = typeOf(given.type);
    def.position = given.position;
    def.angle = given.angle;
    def.velocity = toReal(given.velocity);
    def.angularVelocity = real(given.angularVelocity);
    def.linearDamping = real(given.linearDamping);
    def.angularDamping = real(given.angularDamping);
    def.gravityScale = real(given.gravityScale);
    def.mass = real(given.mass.value_or(0));
    def.inertia = real(given.inertia.value_or(0));
    def.fixedRotation = given.fixedRotation;
    def.bullet = given.bullet;
    def.awake = given.awake;
    def.enabled = given.enabled;
    if (given.continuous) { def.continuous = continuousOf(*given.continuous); }
    def.userData = index;
    return def;
}

ShapeDef shapeDefOf(const ShapeDescription& given, std::size_t body, std::size_t shape) {
    ShapeDef def;
    def.density = real(given.density);
    def.friction = real(given.friction);
    def.restitution = real(given.restitution);
    def.rollingResistance = real(given.rollingResistance);
    def.surfaceSpeed = real(given.surfaceSpeed);
    def.frictionMixing = given.frictionMixing;
    def.restitutionMixing = given.restitutionMixing;
    def.sensor = given.sensor;
    def.filter = {given.filter.category, given.filter.mask, given.filter.group};
    def.userData = (static_cast<std::uint64_t>(body) << kIndexBits) | shape;
    return def;
}

Status addShape(World& world, BodyId body, const ShapeDescription& given, const ShapeDef& def) {
    const Real radius = real(given.radius);
    if (const auto* chain = std::get_if<ChainGeometry>(&given.geometry)) {
        return world.addChain(body, realPoints(chain->points), chain->loop, def, radius, neighboursOf(*chain)).status();
    }
    const Result<Polygon> polygon = std::visit(PolygonMaker{radius}, given.geometry);
    return polygon.ok() ? world.addShape(body, polygon.value(), def).status() : polygon.status();
}

bool buildBody(const SceneDescription& scene, std::size_t i, SceneWorld& built, std::string& error) {
    const std::string pointer = "/bodies/" + std::to_string(i);
    const BodyDescription& given = scene.bodies[i];
    const Result<BodyId> body = built.world.createBody(bodyDefOf(given, i));
    if (!body.ok()) {
        error = refusalText(pointer, hasKey<BodyDescription>(body.status().field), body.status());
        return false;
    }
    built.bodies[i] = body.value();
    for (std::size_t k = 0; k < given.shapes.size(); ++k) {
        const Status status = addShape(built.world, body.value(), given.shapes[k], shapeDefOf(given.shapes[k], i, k));
        if (!status.ok()) {
            error =
                refusalText(pointer + "/shapes/" + std::to_string(k), hasKey<ShapeDescription>(status.field), status);
            error += whatRoundingDid(status);
            return false;
        }
    }
    // Adding shapes wakes: what the scene lays down asleep goes to sleep when it is complete.
    if (!given.awake && given.enabled && given.type == SceneBodyType::dynamic) {
        (void)built.world.setAwake(body.value(), false);
    }
    return true;
}

bool buildBodies(const SceneDescription& scene, SceneWorld& built, std::string& error) {
    built.bodies.resize(scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!buildBody(scene, i, built, error)) { return false; }
    }
    return true;
}

/// Spring of a joint, when it has one.
std::optional<Spring> springOf(const std::optional<double>& hertz, const std::optional<double>& dampingRatio) {
    if (!hertz) { return std::nullopt; }
    return Spring{real(*hertz), real(dampingRatio.value_or(0))};
}

/// Limits of a translation, or of an angle.
template <class Limits>
std::optional<Limits> limitsOf(const std::optional<double>& lower, const std::optional<double>& upper) {
    constexpr Real kUnlimited = std::numeric_limits<Real>::max();
    if (!lower && !upper) { return std::nullopt; }
    return Limits{real(lower).value_or(-kUnlimited), real(upper).value_or(kUnlimited)};
}

template <class Motor>
std::optional<Motor> motorOf(const std::optional<double>& speed, const std::optional<double>& strength) {
    if (!speed && !strength) { return std::nullopt; }
    return Motor{real(speed.value_or(0)), real(strength.value_or(0))};
}

using JointNames = std::map<std::string, JointId, std::less<>>;

struct JointMaker {
    World& world;
    JointDef base;
    const JointNames& joints;

    Result<JointId> operator()(const RevoluteDescription& given) const {
        RevoluteJointDef def;
        def.base = base;
        def.anchor = given.anchor;
        def.limits = limitsOf<AngleLimits>(given.lower, given.upper);
        def.motor = motorOf<AngularMotor>(given.motorSpeed, given.maxMotorTorque);
        def.spring = springOf(given.hertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const DistanceDescription& given) const {
        DistanceJointDef def;
        def.base = base;
        def.anchorA = given.anchorA;
        def.anchorB = given.anchorB;
        def.length = real(given.length);
        if (given.minLength || given.maxLength) {
            def.limits = LengthLimits{real(given.minLength).value_or(0),
                                      real(given.maxLength).value_or(std::numeric_limits<Real>::infinity())};
        }
        def.spring = springOf(given.hertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const PrismaticDescription& given) const {
        PrismaticJointDef def;
        def.base = base;
        def.anchor = given.anchor;
        def.axis = given.axis;
        def.limits = limitsOf<TranslationLimits>(given.lower, given.upper);
        def.motor = motorOf<LinearMotor>(given.motorSpeed, given.maxMotorForce);
        def.spring = springOf(given.hertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const WheelDescription& given) const {
        WheelJointDef def;
        def.base = base;
        def.anchor = given.anchor;
        def.axis = given.axis;
        def.limits = limitsOf<TranslationLimits>(given.lower, given.upper);
        def.motor = motorOf<AngularMotor>(given.motorSpeed, given.maxMotorTorque);
        def.spring = springOf(given.hertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const WeldDescription& given) const {
        WeldJointDef def;
        def.base = base;
        def.anchor = given.anchor;
        def.linearSpring = springOf(given.linearHertz, given.dampingRatio);
        def.angularSpring = springOf(given.angularHertz, given.dampingRatio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const MotorDescription& given) const {
        MotorJointDef def;
        def.base = base;
        if (given.linearOffset) { def.drive.linearOffset = toReal(*given.linearOffset); }
        if (given.linearVelocity) { def.drive.linearVelocity = toReal(*given.linearVelocity); }
        def.drive.angularOffset = real(given.angularOffset);
        def.drive.angularVelocity = real(given.angularVelocity);
        def.drive.maxForce = real(given.maxForce);
        def.drive.maxTorque = real(given.maxTorque);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const MouseDescription& given) const {
        MouseJointDef def;
        def.base = base;
        def.target = given.target;
        def.anchor = given.anchor;
        def.spring = springOf(given.hertz, given.dampingRatio);
        def.maxForce = real(given.maxForce);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const GearDescription& given) const {
        GearJointDef def;
        def.base = base;
        def.jointA = jointNamed(given.jointA);
        def.jointB = jointNamed(given.jointB);
        def.ratio = real(given.ratio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const PulleyDescription& given) const {
        PulleyJointDef def;
        def.base = base;
        def.groundA = given.groundA;
        def.groundB = given.groundB;
        def.anchorA = given.anchorA;
        def.anchorB = given.anchorB;
        def.ratio = real(given.ratio);
        return world.createJoint(def);
    }
    Result<JointId> operator()(const FilterJointDescription&) const {
        FilterJointDef def;
        def.base = base;
        return world.createJoint(def);
    }

    JointId jointNamed(const std::string& name) const {
        const auto found = joints.find(name);
        return found != joints.end() ? found->second : JointId{};
    }
};

using BodyNames = std::map<std::string, BodyId, std::less<>>;

BodyNames namesOfBodies(const SceneDescription& scene, const SceneWorld& built) {
    BodyNames names;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) { names.emplace(bodyName(scene, i), built.bodies[i]); }
    return names;
}

/// Null, and hence refused by `createJoint`, when there is none of that name.
BodyId bodyNamed(const BodyNames& names, const std::string& name) {
    const auto found = names.find(name);
    return found != names.end() ? found->second : BodyId{};
}

Result<JointId> buildJoint(const JointDescription& given, std::size_t index, const BodyNames& bodies,
                           const JointNames& joints, World& world) {
    JointMaker maker{world, {}, joints};
    maker.base.bodyA = bodyNamed(bodies, given.bodyA);
    maker.base.bodyB = bodyNamed(bodies, given.bodyB);
    maker.base.collideConnected = given.collideConnected;
    maker.base.breakForce = real(given.breakForce);
    maker.base.breakTorque = real(given.breakTorque);
    maker.base.userData = index;
    return std::visit(maker, given.joint);
}

/// Gears come last: their joints may stand behind them in the scene.
bool buildJoints(const SceneDescription& scene, std::span<const std::size_t> wanted, SceneWorld& built,
                 std::string& error) {
    const BodyNames bodies = namesOfBodies(scene, built);
    JointNames joints;
    for (const bool gears : {false, true}) {
        for (const std::size_t i : wanted) {
            const JointDescription& given = scene.joints[i];
            if (std::holds_alternative<GearDescription>(given.joint) != gears) { continue; }
            const Result<JointId> joint = buildJoint(given, i, bodies, joints, built.world);
            if (!joint.ok()) {
                error =
                    refusalText("/joints/" + std::to_string(i), hasKey(given, joint.status().field), joint.status());
                return false;
            }
            joints.emplace(jointName(scene, i), joint.value());
            built.joints[i] = joint.value();
        }
    }
    return true;
}

}  // namespace

ShapeOrigin shapeOrigin(std::uint64_t userData) {
    return {static_cast<int>(userData >> kIndexBits), static_cast<int>(userData & 0xFFFFFFFFu)};
}

std::vector<Polygon> polygonsOf(const ShapeDescription& shape) {
    const auto* const chain = std::get_if<ChainGeometry>(&shape.geometry);
    if (chain == nullptr) { return {std::visit(PolygonMaker{real(shape.radius)}, shape.geometry).value()}; }
    const std::vector<Vec2> points = realPoints(chain->points);
    std::vector<Polygon> edges;
    for (int i = 0; i < chainSegmentCount(static_cast<int>(points.size()), chain->loop); ++i) {
        edges.push_back(polygonOf(chainSegment(points, chain->loop, real(shape.radius), i)));
    }
    return edges;
}

bool buildWorld(const SceneDescription& scene, SceneWorld& built, std::string& error) {
    const Status configured = built.world.configure(settingsOf(scene));
    if (!configured.ok()) {
        const bool ofScene = hasKey<SceneDescription>(configured.field);  // gravity
        error = refusalText(ofScene ? "" : "/settings", true, configured);
        return false;
    }
    built.joints.resize(scene.joints.size());
    std::vector<std::size_t> joints(scene.joints.size());
    std::iota(joints.begin(), joints.end(), std::size_t{0});
    return buildBodies(scene, built, error) && buildJoints(scene, joints, built, error);
}

bool rebuildBodies(const SceneDescription& scene, std::span<const std::uint32_t> bodies,
                   std::span<const std::size_t> joints, SceneWorld& built, std::string& error) {
    return std::all_of(bodies.begin(), bodies.end(),
                       [&](std::uint32_t body) { return buildBody(scene, body, built, error); }) &&
           buildJoints(scene, joints, built, error);
}

}  // namespace swept::inline SWEPT_PRECISION

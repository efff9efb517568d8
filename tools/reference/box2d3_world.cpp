#include "box2d3_world.h"

#include <box2d/box2d.h>
#include <swept/samples/scene_surfaces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>
#include <vector>

#include "box2d3_joints.h"
#include "box2d3_numbers.h"
#include "box2d3_tasks.h"
#include "joint_ends.h"

// The names of this engine's functions are those of C, and so apart from those of Box2D 2.4.1 in the same program.

namespace swept {
namespace {

/// Both rules of a surface are its material.
constexpr unsigned kRuleBits = 8;
b2SurfaceMaterial materialOf(const FullSurface& surface) {
    b2SurfaceMaterial material = b2DefaultSurfaceMaterial();
    material.friction = static_cast<float>(surface.friction);
    material.restitution = static_cast<float>(surface.restitution);
    material.rollingResistance = static_cast<float>(surface.rollingResistance);
    material.tangentSpeed = static_cast<float>(surface.surfaceSpeed);
    material.userMaterialId = static_cast<std::uint64_t>(surface.frictionMixing) |
                              (static_cast<std::uint64_t>(surface.restitutionMixing) << kRuleBits);
    return material;
}

std::vector<b2SurfaceMaterial> materialsOf(const ShapeDescription& shape) {
    std::vector<b2SurfaceMaterial> materials;
    for (const FullSurface& surface : surfacesOf(shape)) { materials.push_back(materialOf(surface)); }
    return materials;
}

struct ShapeMaker {
    b2BodyId body;
    b2ShapeDef definition;
    double radius;
    std::vector<b2SurfaceMaterial> materials;  ///< one, or one for each segment of a chain

    void operator()(const BoxGeometry& box) const {
        const b2Polygon polygon =
            b2MakeOffsetRoundedBox(static_cast<float>(box.half.x), static_cast<float>(box.half.y), toPeer(box.center),
                                   toPeer(box.angle), static_cast<float>(radius));
        b2CreatePolygonShape(body, &definition, &polygon);
    }
    void operator()(const CircleGeometry& circle) const {
        const b2Circle disk{toPeer(circle.center), static_cast<float>(circle.radius)};
        b2CreateCircleShape(body, &definition, &disk);
    }
    void operator()(const CapsuleGeometry& capsule) const { addCapsule(capsule.points, capsule.radius); }
    void operator()(const SegmentGeometry& segment) const {
        if (radius > 0) {
            addCapsule(segment.points, radius);
            return;
        }
        const b2Segment line{toPeer(segment.points[0]), toPeer(segment.points[1])};
        b2CreateSegmentShape(body, &definition, &line);
    }
    void operator()(const PolygonGeometry& geometry) const {
        std::array<b2Vec2, B2_MAX_POLYGON_VERTICES> points{};
        for (std::size_t i = 0; i < geometry.points.size(); ++i) { points[i] = toPeer(geometry.points[i]); }
        const b2Hull hull = b2ComputeHull(points.data(), static_cast<int>(geometry.points.size()));
        if (hull.count == 0) { refuse("no hull of a polygon"); }
        const b2Polygon polygon = b2MakePolygon(&hull, static_cast<float>(radius));
        b2CreatePolygonShape(body, &definition, &polygon);
    }
    /// A loop; solid on the left of its direction like ours.
    void operator()(const ChainGeometry& geometry) const {
        std::vector<b2Vec2> points;
        for (const DVec2 point : geometry.points) { points.push_back(toPeer(point)); }
        b2ChainDef chain = b2DefaultChainDef();
        chain.points = points.data();
        chain.count = static_cast<int>(points.size());
        chain.isLoop = true;
        chain.materials = materials.data();
        chain.materialCount = static_cast<int>(materials.size());
        chain.filter = definition.filter;
        b2CreateChain(body, &chain);
    }

private:
    void addCapsule(const std::array<DVec2, 2>& points, double thickness) const {
        const b2Capsule capsule{toPeer(points[0]), toPeer(points[1]), static_cast<float>(thickness)};
        b2CreateCapsuleShape(body, &definition, &capsule);
    }
};

b2BodyDef definitionOf(const BodyDescription& body, const SettingsDescription& settings) {
    b2BodyDef definition = b2DefaultBodyDef();
    definition.type = body.type == SceneBodyType::fixed       ? b2_staticBody
                      : body.type == SceneBodyType::kinematic ? b2_kinematicBody
                                                              : b2_dynamicBody;
    definition.position = toPeerPlace(body.position);
    definition.rotation = toPeer(body.angle);
    definition.linearVelocity = toPeer(body.velocity);
    definition.angularVelocity = static_cast<float>(body.angularVelocity);
    definition.linearDamping = static_cast<float>(body.linearDamping);
    definition.angularDamping = static_cast<float>(body.angularDamping);
    definition.gravityScale = static_cast<float>(body.gravityScale);
    definition.motionLocks.angularZ = body.fixedRotation;
    definition.isBullet = body.bullet;
    definition.isAwake = body.awake;
    definition.isEnabled = body.enabled;
    definition.enableSleep = settings.sleep && body.allowSleep;
    if (settings.sleepSpeed > 0) { definition.sleepThreshold = static_cast<float>(settings.sleepSpeed); }
    return definition;
}

MixingRule frictionRuleOf(std::uint64_t material) {
    return static_cast<MixingRule>(material & ((1U << kRuleBits) - 1U));
}
MixingRule restitutionRuleOf(std::uint64_t material) { return static_cast<MixingRule>(material >> kRuleBits); }

bool hasMixingRules(const SceneDescription& scene) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodyDescription& body) {
        return std::any_of(body.shapes.begin(), body.shapes.end(),
                           [](const ShapeDescription& shape) { return hasMixingRule(shape); });
    });
}

float frictionOf(float a, std::uint64_t materialA, float b, std::uint64_t materialB) {
    return mixed(ruleOfPair(frictionRuleOf(materialA), frictionRuleOf(materialB), kUsualFriction), a, b);
}
float restitutionOf(float a, std::uint64_t materialA, float b, std::uint64_t materialB) {
    return mixed(ruleOfPair(restitutionRuleOf(materialA), restitutionRuleOf(materialB), kUsualRestitution), a, b);
}

b2ShapeDef definitionOf(const ShapeDescription& shape) {
    b2ShapeDef definition = b2DefaultShapeDef();
    definition.density = static_cast<float>(shape.density);
    definition.material = materialOf(surfaceAt(shape, 0));
    definition.isSensor = shape.sensor;
    definition.filter = {shape.filter.category, shape.filter.mask, shape.filter.group};
    return definition;
}

class Box2d3World final : public PeerWorld {
public:
    Box2d3World(const SceneDescription& scene, const PeerSettings& settings)
        : PeerWorld(scene),
          settings_(settings),
          tasks_(settings.threads),
          bodies_(scene.bodies.size(), b2_nullBodyId),
          angles_(scene.bodies.size()),
          ends_(jointEndsOf(scene)) {
        b2WorldDef definition = b2DefaultWorldDef();
        definition.gravity = toPeer(scene.gravity);
        definition.enableSleep = scene.settings.sleep;
        definition.enableContinuous = scene.settings.continuous != SceneContinuous::off;
        definition.contactHertz = settings.isStiff != 0 ? kStiffHertz : definition.contactHertz;
        if (hasMixingRules(scene)) {  // else the engine's own mixing, to the bit
            definition.frictionCallback = frictionOf;
            definition.restitutionCallback = restitutionOf;
        }
        tasks_.addTo(definition);
        world_ = b2CreateWorld(&definition);
        for (std::size_t i = 0; i < bodies_.size(); ++i) { addBody(i); }
        for (std::size_t i = 0; i < ends_.size(); ++i) { addJoint(i); }
    }
    ~Box2d3World() override { b2DestroyWorld(world_); }
    Box2d3World(const Box2d3World&) = delete;
    Box2d3World& operator=(const Box2d3World&) = delete;

    void remove(std::span<const std::uint32_t> bodies) override {
        for (const std::uint32_t body : bodies) {
            b2DestroyBody(bodies_[body]);
            bodies_[body] = b2_nullBodyId;
        }
    }
    void add(std::span<const std::uint32_t> bodies) override {
        for (const std::uint32_t body : bodies) { addBody(body); }
        for (const std::size_t joint : jointsOn(ends_, bodies)) { addJoint(joint); }
    }
    void setVelocity(std::uint32_t body, DVec2 velocity) override {
        b2Body_SetLinearVelocity(bodies_[body], toPeer(velocity));
    }

    PeerStages stages() const override {
        const b2Profile profile = b2World_GetProfile(world_);
        constexpr double kSecondsPerUnit = 1e-3;
        const auto seconds = [](float milliseconds) { return kSecondsPerUnit * static_cast<double>(milliseconds); };
        PeerStages stages;
        stages.pairs = seconds(profile.pairs);
        stages.collide = seconds(profile.collide);
        stages.islands = seconds(profile.solverSetup);
        stages.solve = seconds(profile.constraints);
        stages.continuous = seconds(profile.bullets);
        stages.finish =
            seconds(profile.step) - stages.pairs - stages.collide - stages.islands - stages.solve - stages.continuous;
        return stages;
    }

private:
    void advance() override { b2World_Step(world_, static_cast<float>(scene().settings.dt), settings_.subSteps); }
    void afterStep() override {
        for (std::size_t i = 0; i < bodies_.size(); ++i) { angles_[i] = isThere(i) ? unwrapped(i) : 0; }
    }
    bool isThere(std::size_t body) const override { return B2_IS_NON_NULL(bodies_[body]); }

    void addBody(std::size_t i) {
        const BodyDescription& description = scene().bodies[i];
        const b2BodyDef definition = definitionOf(description, scene().settings);
        const b2BodyId body = b2CreateBody(world_, &definition);
        for (const ShapeDescription& shape : description.shapes) {
            std::visit(ShapeMaker{body, definitionOf(shape), shape.radius, materialsOf(shape)}, shape.geometry);
        }
        if (description.type == SceneBodyType::dynamic) { setMass(body, description); }
        bodies_[i] = body;
        angles_[i] = description.angle;
    }

    void readBody(std::size_t i, PeerSample& sample) const override {
        const b2BodyId body = bodies_[i];
        const DVec2 velocity = fromPeer(b2Body_GetLinearVelocity(body));
        const auto omega = static_cast<double>(b2Body_GetAngularVelocity(body));
        const bool isAwake = b2Body_IsAwake(body) && b2Body_GetType(body) != b2_staticBody;
        sample.frame.bodies.push_back({fromPeer(b2Body_GetPosition(body)), angles_[i], velocity, omega, isAwake});
        if (b2Body_GetType(body) == b2_dynamicBody && scene().bodies[i].enabled) {
            addMotion({static_cast<double>(b2Body_GetMass(body)),
                       static_cast<double>(b2Body_GetRotationalInertia(body)), fromPeer(b2Body_GetWorldCenter(body)),
                       velocity, omega, scene().bodies[i].gravityScale * scene().gravity},
                      sample);
        }
    }

    /// The engine's own mass, but for what the description says otherwise.
    static void setMass(b2BodyId body, const BodyDescription& description) {
        if (!description.mass && !description.inertia) { return; }
        b2MassData data = b2Body_GetMassData(body);
        if (description.mass) {
            data.rotationalInertia *= data.mass > 0 ? static_cast<float>(*description.mass) / data.mass : 0;
            data.mass = static_cast<float>(*description.mass);
        }
        data.rotationalInertia = orElse(description.inertia, data.rotationalInertia);
        b2Body_SetMassData(body, data);
    }

    void addJoint(std::size_t i) {
        addBox2d3Joint(world_, bodies_[ends_[i].a], bodies_[ends_[i].b], scene().joints[i], settings_.isStiff != 0);
    }

    /// The engine knows angles within a turn only; the nearest to where the body was turning.
    double unwrapped(std::size_t i) const {
        constexpr double kTurn = 2 * std::numbers::pi;
        const b2Rot rotation = b2Body_GetRotation(bodies_[i]);
        const double angle = std::atan2(static_cast<double>(rotation.s), static_cast<double>(rotation.c));
        const double expected =
            angles_[i] + static_cast<double>(b2Body_GetAngularVelocity(bodies_[i])) * scene().settings.dt;
        return angle + kTurn * std::round((expected - angle) / kTurn);
    }

    PeerSettings settings_;
    Box2d3Tasks tasks_;
    b2WorldId world_{};
    std::vector<b2BodyId> bodies_;
    std::vector<double> angles_;
    std::vector<JointEnds> ends_;
};

}  // namespace

std::unique_ptr<PeerWorld> makeBox2d3World(const SceneDescription& scene, const PeerSettings& settings) {
    return std::make_unique<Box2d3World>(scene, settings);
}

}  // namespace swept

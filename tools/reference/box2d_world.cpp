#include "box2d_world.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include <swept/samples/scene_reader.h>

#include "body_mass.h"
#include "box2d_joints.h"
#include "box2d_shapes.h"
#include "joint_ends.h"

namespace swept {
namespace {

b2BodyType typeOf(SceneBodyType type) {
    switch (type) {
        case SceneBodyType::fixed:
            return b2_staticBody;
        case SceneBodyType::kinematic:
            return b2_kinematicBody;
        case SceneBodyType::dynamic:
            return b2_dynamicBody;
    }
    return b2_staticBody;  // unreachable, but GCC cannot know
}

b2BodyDef definitionOf(const BodyDescription& body, const SettingsDescription& settings) {
    b2BodyDef definition;
    definition.type = typeOf(body.type);
    definition.position = toBox2d(body.position);
    definition.angle = static_cast<float>(body.angle);
    definition.linearDamping = static_cast<float>(body.linearDamping);
    definition.angularDamping = static_cast<float>(body.angularDamping);
    definition.gravityScale = static_cast<float>(body.gravityScale);
    definition.fixedRotation = body.fixedRotation;
    definition.bullet = body.bullet;
    definition.awake = body.awake;
    definition.enabled = body.enabled;
    definition.allowSleep = settings.sleep && body.allowSleep;
    return definition;
}

void setMass(b2Body& body, const BodyMass& mass) {
    b2MassData massData;
    massData.mass = static_cast<float>(mass.mass);
    massData.center = toBox2d(mass.center);
    massData.I = static_cast<float>(mass.inertia + mass.mass * dot(mass.center, mass.center));
    body.SetMassData(&massData);
}

float trueRadius(b2Fixture& fixture) {
    return reinterpret_cast<const Box2dFixtureNote*>(fixture.GetUserData().pointer)->radius;
}

}  // namespace

struct Box2dWorld::Parts {
    explicit Parts(const SceneDescription& description)
        : scene(description),
          world(toBox2d(description.gravity)),
          bodies(description.bodies.size()),
          masses(description.bodies.size()),
          joints(description.joints.size()),
          ends(jointEndsOf(description)) {}

    void addBody(std::size_t index);
    void addJoints(std::span<const std::size_t> wanted);
    void removeBody(std::size_t index);
    void destroyGearsOn(std::size_t joint);
    void breakJoints();
    void readContacts(PeerSample& sample) const;

    const SceneDescription& scene;
    Box2dFilter filter;
    Box2dSurfaces surfaces;
    std::deque<Box2dFixtureNote> notes;
    b2World world;
    std::vector<b2Body*> bodies;   // null while taken away
    std::vector<BodyMass> masses;  // in double, one for each body
    std::vector<b2Joint*> joints;  // null once broken, or while a body of it is taken away
    std::vector<JointEnds> ends;
    std::int64_t brokenJoints = 0;
    Box2dIterations iterations;
};

void Box2dWorld::Parts::addBody(std::size_t index) {
    const BodyDescription& description = scene.bodies[index];
    const b2BodyDef definition = definitionOf(description, scene.settings);
    b2Body* const body = world.CreateBody(&definition);
    for (const ShapeDescription& shape : description.shapes) { addFixtures(*body, shape, notes); }
    if (description.type == SceneBodyType::dynamic) {
        masses[index] = massOfBody(description);
        setMass(*body, masses[index]);
    }
    // After the mass, which would shift it: the velocity is that of the centre of mass. Setting one wakes the body.
    if (description.awake) {
        body->SetLinearVelocity(toBox2d(description.velocity));
        body->SetAngularVelocity(static_cast<float>(description.angularVelocity));
    }
    bodies[index] = body;
}

void Box2dWorld::Parts::addJoints(std::span<const std::size_t> wanted) {
    std::map<std::string, b2Body*> byName;
    for (std::size_t i = 0; i < bodies.size(); ++i) { byName[bodyName(scene, i)] = bodies[i]; }
    std::map<std::string, b2Joint*> jointByName;
    for (const bool gears : {false, true}) {  // gears come last: they name other joints
        for (const std::size_t i : wanted) {
            if (std::holds_alternative<GearDescription>(scene.joints[i].joint) == gears) {
                joints[i] = addJoint(world, scene.joints[i], byName, jointByName);
                jointByName.emplace(jointName(scene, i), joints[i]);
            }
        }
    }
}

/// With its joints.
void Box2dWorld::Parts::removeBody(std::size_t index) {
    const auto number = static_cast<std::uint32_t>(index);
    for (const std::size_t joint : jointsOn(ends, {&number, 1})) {
        if (joints[joint] != nullptr) {
            destroyGearsOn(joint);
            world.DestroyJoint(joints[joint]);
            joints[joint] = nullptr;
        }
    }
    world.DestroyBody(bodies[index]);
    bodies[index] = nullptr;
}

/// A gear must go before its joints.
void Box2dWorld::Parts::destroyGearsOn(std::size_t joint) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto* const gear = std::get_if<GearDescription>(&scene.joints[i].joint);
        const std::string name = jointName(scene, joint);
        if (joints[i] != nullptr && gear != nullptr && (gear->jointA == name || gear->jointB == name)) {
            world.DestroyJoint(joints[i]);
            joints[i] = nullptr;
        }
    }
}

void Box2dWorld::Parts::breakJoints() {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints[i] == nullptr || !breaks(*joints[i], scene.joints[i], scene.settings.dt)) { continue; }
        destroyGearsOn(i);
        world.DestroyJoint(joints[i]);
        joints[i] = nullptr;
        ++brokenJoints;
    }
}

void Box2dWorld::Parts::readContacts(PeerSample& sample) const {
    for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext()) {
        b2Fixture* const a = const_cast<b2Contact*>(contact)->GetFixtureA();
        b2Fixture* const b = const_cast<b2Contact*>(contact)->GetFixtureB();
        const b2Manifold* const manifold = contact->GetManifold();
        if (!contact->IsTouching() || a->IsSensor() || b->IsSensor()) { continue; }
        b2WorldManifold placed;  // with the true radii: Box2D's skin is no penetration
        placed.Initialize(manifold, a->GetBody()->GetTransform(), trueRadius(*a), b->GetBody()->GetTransform(),
                          trueRadius(*b));
        for (int32 i = 0; i < manifold->pointCount; ++i) {
            const auto separation = static_cast<double>(placed.separations[i]);
            sample.frame.contacts.push_back({fromBox2d(placed.points[i]), fromBox2d(placed.normal), separation,
                                             static_cast<double>(manifold->points[i].normalImpulse)});
            sample.penetration = std::max(sample.penetration, -separation);
        }
    }
}

Box2dWorld::Box2dWorld(const SceneDescription& scene, const Box2dIterations& iterations)
    : PeerWorld(scene), parts_(std::make_unique<Parts>(scene)) {
    parts_->iterations = iterations;
    parts_->world.SetContactFilter(&parts_->filter);
    const auto isSpecial = [](const ShapeDescription& shape) {
        return anySurface(shape, isBelt) || hasMixingRule(shape);
    };
    const bool hasSpecial = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyDescription& body) {
        return std::any_of(body.shapes.begin(), body.shapes.end(), isSpecial);
    });
    if (hasSpecial) { parts_->world.SetContactListener(&parts_->surfaces); }
    parts_->world.SetAllowSleeping(scene.settings.sleep);
    parts_->world.SetContinuousPhysics(scene.settings.continuous != SceneContinuous::off);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) { parts_->addBody(i); }
    std::vector<std::size_t> joints(scene.joints.size());
    std::iota(joints.begin(), joints.end(), std::size_t{0});
    parts_->addJoints(joints);
}

Box2dWorld::~Box2dWorld() = default;

void Box2dWorld::advance() {
    parts_->world.Step(static_cast<float>(parts_->scene.settings.dt), parts_->iterations.velocity,
                       parts_->iterations.position);
}

void Box2dWorld::afterStep() { parts_->breakJoints(); }

void Box2dWorld::remove(std::span<const std::uint32_t> bodies) {
    for (const std::uint32_t body : bodies) { parts_->removeBody(body); }
}

void Box2dWorld::add(std::span<const std::uint32_t> bodies) {
    for (const std::uint32_t body : bodies) { parts_->addBody(body); }
    parts_->addJoints(jointsOn(parts_->ends, bodies));
}

void Box2dWorld::setVelocity(std::uint32_t body, DVec2 velocity) {
    parts_->bodies[body]->SetLinearVelocity(toBox2d(velocity));
}

bool Box2dWorld::isThere(std::size_t body) const { return parts_->bodies[body] != nullptr; }

void Box2dWorld::readBody(std::size_t body, PeerSample& sample) const {
    const b2Body& state = *parts_->bodies[body];
    const BodyDescription& description = scene().bodies[body];
    const BodyMass& mass = parts_->masses[body];
    const DVec2 velocity = fromBox2d(state.GetLinearVelocity());
    const auto omega = static_cast<double>(state.GetAngularVelocity());
    sample.frame.bodies.push_back({fromBox2d(state.GetPosition()), static_cast<double>(state.GetAngle()), velocity,
                                   omega, state.IsAwake() && state.IsEnabled() && state.GetType() != b2_staticBody});
    if (!description.enabled) { return; }
    addMotion({mass.mass, description.fixedRotation ? 0 : mass.inertia, fromBox2d(state.GetWorldCenter()), velocity,
               omega, description.gravityScale * scene().gravity},
              sample);
}

void Box2dWorld::readRest(PeerSample& sample) const {
    sample.brokenJoints = parts_->brokenJoints;
    parts_->readContacts(sample);
    for (b2Joint* const joint : parts_->joints) {
        if (joint != nullptr) { sample.jointError = std::max(sample.jointError, jointErrorOf(*joint)); }
    }
}

}  // namespace swept

#pragma once

#include <swept/samples/scene_description.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../support/random.h"

namespace swept::test {

/// Valid scenes in which every member of the format takes other values than its default now and then; numbers have all
/// their digits and magnitudes from 2⁻²⁰ to 2²⁰.
class SceneMaker {
public:
    explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

    SceneDescription make() {
        SceneDescription scene;
        if (often()) { scene.name = "scene \"" + std::to_string(random_.integer(0, 99)) + "\"\n\xc3\xa4\\/"; }
        if (often()) { scene.gravity = vector(); }
        if (often()) { scene.view = ViewDescription{vector(), positive()}; }
        scene.settings = settings();
        const int count = random_.integer(2, 6);
        for (int i = 0; i < count; ++i) { scene.bodies.push_back(body(i)); }
        const int joints = random_.integer(0, 3);
        for (int i = 0; i < joints; ++i) { scene.joints.push_back(joint(scene, i)); }
        addGear(scene);
        if (often()) { scene.settings.sleepSpeed = positive(); }
        return scene;
    }

private:
    bool often() { return random_.chance(0.5); }
    double positive() { return std::ldexp(random_.range(0.5, 1), random_.integer(-20, 20)); }
    double number() { return random_.sign() * positive(); }
    DVec2 vector() { return {number(), number()}; }
    template <class T>
    std::optional<T> maybe(T value) {
        return often() ? std::optional<T>(value) : std::nullopt;
    }

    SceneContinuous continuous() {
        return static_cast<SceneContinuous>(random_.integer(0, static_cast<int>(SceneContinuous::subStep)));
    }

    SettingsDescription settings() {
        SettingsDescription s;
        if (often()) { s.dt = positive(); }
        if (often()) { s.profile = SceneProfile::fast; }
        if (often()) { s.subSteps = random_.integer(1, 1024); }
        if (often()) { s.relaxPasses = random_.integer(0, 9); }
        if (often()) { s.continuous = continuous(); }
        if (often()) { s.maxImpacts = random_.integer(1, 1000); }
        s.maxSpeed = maybe(positive());
        s.sleep = often();
        if (often()) {
            s.broadphase = static_cast<SceneBroadphase>(random_.integer(0, static_cast<int>(SceneBroadphase::wideBvh)));
        }
        s.toiTolerance = maybe(positive());
        s.maxPenetration = maybe(positive());
        s.maxJointError = maybe(positive());
        s.maxLostTime = maybe(positive());
        return s;
    }

    SurfaceDescription surface() {
        SurfaceDescription s;
        s.friction = maybe(positive());
        s.restitution = maybe(random_.uniform());
        s.rollingResistance = maybe(positive());
        s.surfaceSpeed = maybe(number());
        s.frictionMixing = maybe(mixing());
        s.restitutionMixing = maybe(mixing());
        return s;
    }

    ChainGeometry chain() {
        ChainGeometry chain{{vector(), vector(), vector(), vector()}, often()};
        if (often()) {
            for (int i = 0; i < (chain.loop ? 4 : 3); ++i) { chain.surfaces.push_back(surface()); }
        }
        if (chain.loop) { return chain; }
        chain.before = maybe(vector());
        chain.after = maybe(vector());
        return chain;
    }

    Geometry geometry(bool chainAllowed) {
        switch (random_.integer(0, chainAllowed ? 5 : 4)) {
            case 0:
                return BoxGeometry{{positive(), positive()}, vector(), number()};
            case 1:
                return CircleGeometry{vector(), positive()};
            case 2:
                return CapsuleGeometry{{vector(), vector()}, positive()};
            case 3:
                return SegmentGeometry{{vector(), vector()}};
            case 4:
                return PolygonGeometry{triangle()};
            default:
                return chain();
        }
    }

    // Large enough beside its distance from the origin to be no line.
    std::vector<DVec2> triangle() {
        const double size = positive();
        const DVec2 a{size * random_.range(-1, 0), size * random_.range(-1, 0)};
        return {a, a + DVec2{size, 0}, a + DVec2{random_.range(0, size), size}};
    }

    MixingRule mixing() { return static_cast<MixingRule>(random_.integer(0, 5)); }

    ShapeDescription shape(bool chainAllowed) {
        ShapeDescription s;
        s.geometry = geometry(chainAllowed);
        const bool ownRadius =
            std::holds_alternative<CircleGeometry>(s.geometry) || std::holds_alternative<CapsuleGeometry>(s.geometry);
        if (!ownRadius && often()) { s.radius = positive(); }
        if (often()) { s.density = positive(); }
        if (often()) { s.friction = positive(); }
        if (often()) { s.restitution = random_.uniform(); }
        if (random_.chance(0.3)) { s.rollingResistance = positive(); }
        if (random_.chance(0.3)) { s.surfaceSpeed = number(); }
        if (often()) { s.frictionMixing = mixing(); }
        if (often()) { s.restitutionMixing = mixing(); }
        s.sensor = random_.chance(0.2);
        if (often()) { s.filter.category = static_cast<std::uint32_t>(random_.bits()); }
        if (often()) { s.filter.mask = static_cast<std::uint32_t>(random_.bits()); }
        if (often()) { s.filter.group = static_cast<std::int32_t>(static_cast<std::uint32_t>(random_.bits())); }
        return s;
    }

    BodyDescription body(int index) {
        BodyDescription b;
        // The first two are a dynamic body and another one, so that joints find partners.
        b.type = index == 0 ? SceneBodyType::dynamic : static_cast<SceneBodyType>(random_.integer(0, 2));
        const bool isDynamic = b.type == SceneBodyType::dynamic;
        if (often()) { b.name = "body, no. " + std::to_string(index); }
        if (often()) { b.position = vector(); }
        if (often()) { b.angle = number(); }
        if (often()) { b.fixedRotation = isDynamic; }
        if (b.type != SceneBodyType::fixed) {
            if (often()) { b.velocity = vector(); }
            if (often() && !b.fixedRotation) { b.angularVelocity = number(); }
        }
        b.bullet = random_.chance(0.3);
        if (often()) { b.linearDamping = positive(); }
        if (often()) { b.angularDamping = positive(); }
        if (often()) { b.gravityScale = number(); }
        b.awake = often();
        b.enabled = often();
        b.allowSleep = often();
        if (often()) { b.continuous = continuous(); }
        if (isDynamic) {
            b.mass = maybe(positive());
            b.inertia = maybe(positive());
            ShapeDescription solid;
            solid.geometry = CircleGeometry{vector(), positive()};
            b.shapes.push_back(solid);
        }
        const int more = random_.integer(0, 3);
        for (int i = 0; i < more; ++i) { b.shapes.push_back(shape(!isDynamic)); }
        return b;
    }

    RevoluteDescription revolute() {
        RevoluteDescription r;
        fillGrip(r);
        r.lower = maybe(-positive());
        r.upper = maybe(positive());
        r.maxMotorTorque = maybe(positive());
        if (r.maxMotorTorque) { r.motorSpeed = maybe(number()); }
        r.hertz = maybe(positive());
        if (r.hertz) { r.dampingRatio = maybe(positive()); }
        if (r.hertz) { r.springTarget = maybe(number()); }
        return r;
    }

    DistanceDescription distance() {
        DistanceDescription d;
        d.anchorA = vector();
        d.anchorB = vector();
        const double length = positive();
        d.length = maybe(length);
        d.minLength = maybe(length * random_.uniform());
        d.maxLength = maybe(length / random_.range(0.1, 1));
        d.hertz = maybe(positive());
        if (d.hertz) { d.dampingRatio = maybe(positive()); }
        return d;
    }

    /// Where a joint takes hold of its bodies.
    template <class Members>
    void fillGrip(Members& m) {
        m.anchor = vector();
        m.anchorB = maybe(vector());
        m.referenceAngle = maybe(number());
    }

    /// Members that prismatic and wheel joints have in common.
    template <class Members>
    void fillSlide(Members& m, std::optional<double>& strength) {
        fillGrip(m);
        m.axis = vector();
        m.lower = maybe(-positive());
        m.upper = maybe(positive());
        strength = maybe(positive());
        if (strength) { m.motorSpeed = maybe(number()); }
        m.hertz = maybe(positive());
        if (m.hertz) { m.dampingRatio = maybe(positive()); }
        if (m.hertz) { m.springTarget = maybe(number()); }
    }

    MotorDescription motor() {
        MotorDescription m;
        m.referenceAngle = maybe(number());
        m.maxForce = positive();
        m.maxTorque = positive();
        if (often()) {
            m.linearOffset = vector();
        } else {
            m.linearVelocity = vector();
        }
        if (often()) {
            m.angularOffset = number();
        } else {
            m.angularVelocity = number();
        }
        return m;
    }

    MouseDescription mouse() {
        MouseDescription m;
        m.target = vector();
        if (often()) { m.anchor = vector(); }
        m.hertz = maybe(positive());
        if (m.hertz) { m.dampingRatio = maybe(positive()); }
        m.maxForce = maybe(positive());
        return m;
    }

    PulleyDescription pulley() {
        PulleyDescription m;
        m.groundA = vector();
        m.groundB = vector();
        m.anchorA = vector();
        m.anchorB = vector();
        m.ratio = positive();
        m.length = maybe(positive());
        return m;
    }

    // Gears need two other joints, and come last.
    JointGeometry geometryOfJoint() {
        switch (random_.integer(0, 8)) {
            case 0:
                return revolute();
            case 1:
                return distance();
            case 2: {
                PrismaticDescription m;
                fillSlide(m, m.maxMotorForce);
                return m;
            }
            case 3: {
                WheelDescription m;
                fillSlide(m, m.maxMotorTorque);
                return m;
            }
            case 4: {
                WeldDescription m;
                fillGrip(m);
                m.linearHertz = maybe(positive());
                m.angularHertz = maybe(positive());
                if (m.linearHertz || m.angularHertz) { m.dampingRatio = maybe(positive()); }
                return m;
            }
            case 5:
                return motor();
            case 6:
                return mouse();
            case 7:
                return pulley();
            default:
                return FilterJointDescription{};
        }
    }

    JointDescription joint(const SceneDescription& scene, int index) {
        JointDescription j;
        if (often()) { j.name = "joint, no. " + std::to_string(index); }
        const std::string first = nameOf(scene.bodies, 0, "body");
        const int other = random_.integer(1, static_cast<int>(scene.bodies.size()) - 1);
        j.bodyA = first;
        j.bodyB = nameOf(scene.bodies, static_cast<std::size_t>(other), "body");
        if (often()) { std::swap(j.bodyA, j.bodyB); }
        j.collideConnected = often();
        j.breakForce = maybe(positive());
        j.breakTorque = maybe(positive());
        j.joint = geometryOfJoint();
        if (std::holds_alternative<FilterJointDescription>(j.joint)) {
            j.collideConnected = false;
            j.breakForce = j.breakTorque = std::nullopt;
        }
        if (std::holds_alternative<MouseDescription>(j.joint) && j.bodyB != first) {
            std::swap(j.bodyA, j.bodyB);  // the first body is dynamic
        }
        return j;
    }

    /// Couples the first two joints that a gear can couple, if there are two.
    void addGear(SceneDescription& scene) {
        std::vector<std::size_t> fit;
        for (std::size_t i = 0; i < scene.joints.size(); ++i) {
            const JointGeometry& geometry = scene.joints[i].joint;
            const bool slidesOrTurns = std::holds_alternative<RevoluteDescription>(geometry) ||
                                       std::holds_alternative<PrismaticDescription>(geometry);
            if (slidesOrTurns && (fit.empty() || scene.joints[fit[0]].bodyB != scene.joints[i].bodyB)) {
                fit.push_back(i);
            }
        }
        if (fit.size() < 2) { return; }
        const bool moves = std::any_of(fit.begin(), fit.begin() + 2, [&](std::size_t i) {
            const auto isMoved = [&](std::size_t body) {
                return nameOf(scene.bodies, body, "body") == scene.joints[i].bodyB;
            };
            std::size_t body = 0;
            while (!isMoved(body)) { ++body; }
            return scene.bodies[body].type == SceneBodyType::dynamic;
        });
        if (moves) {
            JointDescription gear;
            gear.bodyA = scene.joints[fit[0]].bodyB;
            gear.bodyB = scene.joints[fit[1]].bodyB;
            gear.breakTorque = maybe(positive());
            gear.joint =
                GearDescription{nameOf(scene.joints, fit[0], "joint"), nameOf(scene.joints, fit[1], "joint"), number()};
            scene.joints.push_back(gear);
        }
    }
    template <class Named>
    static std::string nameOf(const std::vector<Named>& elements, std::size_t i, const char* prefix) {
        return elements[i].name.empty() ? prefix + std::to_string(i) : elements[i].name;
    }

    Random random_;
};

}  // namespace swept::test

#pragma once

#include <array>
#include <set>
#include <vector>

#include "wild_input.h"
#include "world_digest.h"

/// A world under random calls of everything that it offers, most of them nonsense.

namespace swept::test {

inline constexpr int kJointTypes = static_cast<int>(JointType::filter) + 1;
using JointTally = std::array<int, kJointTypes>;  // by type

/// Checks after each call that a refusal changed nothing.
class Vandal : private WildInput {
public:
    Vandal(std::uint64_t seed, Sizes sizes) : WildInput(seed, sizes), world_(makeWorld()) {
        // Ids of another world: some of them name nothing here, others the wrong thing, as far as anyone can tell.
        for (std::uint32_t i = 0; i < 8; ++i) {
            known_.bodies.push_back({i * 5, 1 + i % 3});
            known_.shapes.push_back({i * 5, 1 + i % 3});
            known_.joints.push_back({i, 1 + i % 3});
        }
        known_.bodies.push_back({});
        known_.shapes.push_back({});
        known_.joints.push_back({});
        digest_ = digestOf(world_, known_);
    }

    void act() {
        const int choice = random().integer(0, 29);
        if (choice < 4) { return note(makeBody()); }
        if (choice < 8) { return note(makeShape()); }
        if (choice < 9) { return note(makeChain()); }
        if (choice < 12) { return note(makeJoint()); }
        if (choice < 13) { return note(changeJoint()); }
        if (choice < 16) { return note(pushBody()); }
        if (choice < 20) { return note(destroySomething()); }
        if (choice < 21) { return note(random().chance(0.5) ? changeSettings() : redefine()); }
        if (choice < 23) { return ask(); }
        if (choice < 24) { return note(world_.step(wild())); }
        removeMassless();
        note(world_.step(kStep));
        broken_ += static_cast<int>(world_.jointBreaks().size());
    }

    World& world() { return world_; }
    const KnownIds& known() const { return known_; }
    int calls() const { return calls_; }
    int refusals() const { return refusals_; }
    int steps() const { return steps_; }
    const std::array<int, kStatusCodeCount>& codes() const { return codes_; }
    const JointTally& joined() const { return joined_; }
    int broken() const { return broken_; }

    /// Whether all states and reactions are numbers; how far a joint is torn apart may be out of the range of float.
    bool allFinite() const {
        for (const BodyId id : known_.bodies) {
            const bool good = isFinite(world_.position(id)) && isFinite(world_.velocity(id)) &&
                              isFinite(world_.angularVelocity(id)) && std::isfinite(world_.angle(id));
            if (!good) { return false; }
        }
        for (const JointId id : known_.joints) {
            const bool good = isFinite(world_.jointForce(id)) && std::isfinite(world_.jointTorque(id)) &&
                              !std::isnan(world_.jointError(id)) && std::isfinite(world_.jointAngle(id));
            if (!good) { return false; }
        }
        return true;
    }
    std::uint32_t livingBodies() const {
        std::set<std::uint32_t> slots;  // an invented id may be that of a body made later
        for (const BodyId id : known_.bodies) {
            if (world_.isValid(id)) { slots.insert(id.index); }
        }
        return static_cast<std::uint32_t>(slots.size());
    }

private:
    // --- calls
    BodyDef bodyDef() {
        BodyDef def;
        def.type = static_cast<BodyType>(random().integer(0, random().chance(0.05) ? 200 : 2));
        def.position = place();
        def.angle = number();
        if (def.type != BodyType::fixed || random().chance(0.1)) {
            def.velocity = vector();
            def.angularVelocity = realNumber();
        }
        if (random().chance(0.1)) { def.linearDamping = realNumber(); }
        if (random().chance(0.1)) { def.angularDamping = realNumber(); }
        if (random().chance(0.1)) { def.gravityScale = realNumber(); }
        if (random().chance(0.3)) { def.mass = realPositive(); }
        if (random().chance(0.1)) { def.inertia = realPositive(); }
        def.fixedRotation = random().chance(0.1);
        def.awake = random().chance(0.9);
        def.enabled = random().chance(0.95);
        def.allowSleep = random().chance(0.9);
        if (random().chance(0.2)) { def.continuous = static_cast<ContinuousMode>(random().integer(0, 5)); }
        return def;
    }
    Status makeBody() {
        const Result<BodyId> id = world_.createBody(bodyDef());
        if (!id.ok()) { return id.status(); }
        known_.bodies.push_back(id.value());
        if (random().chance(0.8)) { (void)world_.addShape(id.value(), good()); }
        return id.status();
    }

    template <class Id>
    static Status remember(const Result<Id>& id, std::vector<Id>& ids) {
        if (id.ok()) { ids.push_back(id.value()); }
        return id.status();
    }
    Status makeShape() { return remember(world_.addShape(any(known_.bodies), polygon(), surface()), known_.shapes); }
    Status makeChain() {
        std::vector<Vec2> points;
        const int count = random().integer(0, 6);
        for (int i = 0; i < count; ++i) { points.push_back(vector()); }
        const Real radius = random().chance(0.7) ? Real(0) : realPositive();
        return remember(world_.addChain(any(known_.bodies), points, random().chance(0.3), surface(), radius),
                        known_.shapes);
    }
    BodyId mostlyAlive() {
        BodyId id = any(known_.bodies);
        for (int tries = 0; tries < 4 && !world_.isValid(id); ++tries) { id = any(known_.bodies); }
        return id;
    }
    JointDef anyBodies() {
        JointDef def{.bodyA = mostlyAlive(), .bodyB = mostlyAlive()};
        def.collideConnected = random().chance(0.3);
        if (random().chance(0.2)) { def.breakForce = realPositive(); }
        if (random().chance(0.2)) { def.breakTorque = realPositive(); }
        return def;
    }
    template <class Def>
    Status join(const Def& def) {
        const Result<JointId> id = world_.createJoint(def);
        if (id.ok()) { ++joined_[static_cast<std::size_t>(world_.type(id.value()))]; }
        return remember(id, known_.joints);
    }
    /// Where its bodies need not be.
    template <class Def>
    Def apart(Def def) {
        def.anchorB = seldom([&] { return place(); });
        def.referenceAngle = seldom([&] { return number(); });
        return def;
    }
    /// Random ids hardly ever name two joints that a gear can couple: without two of them, one is made.
    Status makeGear() {
        std::vector<JointId> fit;
        for (const JointId id : known_.joints) {
            const JointType type = world_.type(id);
            if (world_.isValid(id) && (type == JointType::revolute || type == JointType::prismatic)) {
                fit.push_back(id);
            }
        }
        if (fit.size() < 2) {
            return join(apart(RevoluteJointDef{anyBodies(), place(), angleLimits(), angularMotor(), spring()}));
        }
        return join(GearJointDef{{}, any(fit), any(fit), realNumber()});
    }
    Status makeJoint() {
        switch (static_cast<JointType>(random().integer(0, kJointTypes - 1))) {
            case JointType::revolute:
                return join(apart(RevoluteJointDef{anyBodies(), place(), angleLimits(), angularMotor(), spring()}));
            case JointType::distance:
                return join(DistanceJointDef{anyBodies(), place(), place(), seldom([&] { return realPositive(); }),
                                             lengthLimits(), spring()});
            case JointType::prismatic:
                return join(apart(
                    PrismaticJointDef{anyBodies(), place(), place(), translationLimits(), linearMotor(), spring()}));
            case JointType::wheel:
                return join(
                    apart(WheelJointDef{anyBodies(), place(), place(), translationLimits(), angularMotor(), spring()}));
            case JointType::weld:
                return join(apart(WeldJointDef{anyBodies(), place(), spring(), spring()}));
            case JointType::motor:
                return join(MotorJointDef{anyBodies(), drive(), seldom([&] { return number(); })});
            case JointType::mouse:
                return join(MouseJointDef{anyBodies(), place(), seldom([&] { return place(); }), spring(),
                                          seldom([&] { return realPositive(); })});
            case JointType::gear:
                return makeGear();
            case JointType::pulley:
                return join(PulleyJointDef{anyBodies(), place(), place(), place(), place(), realPositive(),
                                           seldom([&] { return realPositive(); })});
            case JointType::filter:
                return join(FilterJointDef{anyBodies()});
        }
        return Status::success();
    }
    Status changeJoint() {
        const JointId joint = any(known_.joints);
        switch (random().integer(0, 13)) {
            case 0:
                return world_.setAngularMotor(joint, angularMotor());
            case 1:
                return world_.setLinearMotor(joint, linearMotor());
            case 2:
                return world_.setAngleLimits(joint, angleLimits());
            case 3:
                return world_.setTranslationLimits(joint, translationLimits());
            case 4:
                return world_.setLengthLimits(joint, lengthLimits());
            case 5:
                return world_.setLength(joint, realPositive());
            case 6:
                return world_.setSpring(joint, spring());
            case 7:
                return world_.setWeldSprings(joint, spring(), spring());
            case 8:
                return world_.setTarget(joint, place());
            case 9:
                return world_.setDrive(joint, drive());
            case 10:
            case 11:
            case 12:
                return redefineJoint(joint);
            default:
                return world_.setBreakLimits(joint, seldom([&] { return realPositive(); }),
                                             seldom([&] { return realPositive(); }));
        }
    }
    /// Mostly of its kind, with some parts that may be nonsense.
    Status redefineJoint(JointId joint) {
        AnyJointDef other = world_.definition(random().chance(0.9) ? joint : any(known_.joints));
        std::visit(
            [this](auto& def) {
                def.base.collideConnected = random().chance(0.5);
                if (random().chance(0.3)) { def.base.breakForce = realPositive(); }
                if constexpr (requires { def.spring; }) { def.spring = spring(); }
                if constexpr (requires { def.target; }) { def.target = place(); }
                if constexpr (requires { def.maxForce; }) { def.maxForce = realPositive(); }
                if constexpr (requires { def.ratio; }) { def.ratio = realNumber(); }
                if constexpr (requires { def.drive; }) { def.drive = drive(); }
                if constexpr (requires { def.length; }) { def.length = realPositive(); }
            },
            other);
        return world_.redefine(joint, other);
    }
    Status pushBody() {
        const BodyId body = mostlyAlive();
        switch (random().integer(0, 6)) {
            case 0:
                return world_.setPose(body, place(), number());
            case 1:
                return world_.setVelocity(body, vector(), realNumber());
            case 2:
                return world_.applyForce(body, vector(), place());
            case 3:
                return world_.applyTorque(body, realNumber());
            case 4:
                return world_.applyImpulse(body, vector(), place());
            case 5:
                return world_.setEnabled(body, random().chance(0.5));
            default:
                return world_.setAwake(body, random().chance(0.5));
        }
    }
    Status destroySomething() {
        // Not too crowded: most of the time goes into calls, not into steps.
        if (world_.bodyCount() > 10 || random().chance(0.2)) { return world_.destroyBody(any(known_.bodies)); }
        if (random().chance(0.5)) { return world_.destroyShape(any(known_.shapes)); }
        return world_.destroyJoint(any(known_.joints));
    }
    Status changeSettings() { return world_.configure(settings()); }
    Status redefine() {
        if (random().chance(0.5)) { return world_.redefine(mostlyAlive(), bodyDef()); }
        if (random().chance(0.3)) { return world_.reshape(any(known_.shapes), polygon()); }
        if (random().chance(0.5)) { return changeSurface(any(known_.shapes)); }
        return world_.redefine(any(known_.shapes), surface());
    }
    Status changeSurface(ShapeId shape) {
        const auto count = static_cast<int>(world_.segmentCount(shape));
        if (random().chance(0.5)) {
            const int segment = random().integer(0, count);
            return world_.setSurface(shape, static_cast<std::uint32_t>(segment), surfaceOf(surface()));
        }
        std::vector<Surface> surfaces;
        for (int i = random().chance(0.9) ? 0 : 1; i < count; ++i) { surfaces.push_back(surfaceOf(surface())); }
        return world_.setSurfaces(shape, surfaces);
    }
    void ask() {
        (void)world_.castRay(place(), vector());
        (void)world_.castShape(polygon(), {place(), rotationFromAngle(random().range(-4, 4))}, vector());
        world_.queryBox({vector(), vector()}, {}, [](ShapeId) { return true; });
        world_.overlapShape(polygon(), {place(), {}}, {}, [](ShapeId) { return true; });
        const JointId joint = any(known_.joints);
        (void)world_.jointAngle(joint);
        (void)world_.bodyOf(any(known_.shapes));
        ASSERT_EQ(digestOf(world_, known_), digest_) << "a question changed the world";
        ++calls_;
    }
    /// A body without mass makes the world refuse all steps: seen often enough, but not all the time.
    void removeMassless() {
        if (random().chance(0.1)) { return; }
        for (const BodyId id : known_.bodies) {
            if (world_.type(id) == BodyType::dynamic && !(world_.mass(id) > 0)) { (void)world_.destroyBody(id); }
        }
        digest_ = digestOf(world_, known_);
    }

    void note(Status status) {
        ++calls_;
        const std::uint64_t now = digestOf(world_, known_);
        ++codes_[static_cast<std::size_t>(status.code)];
        if (!status.ok()) {
            ++refusals_;
            ASSERT_STRNE(status.field, "") << describe(status.code);
            ASSERT_EQ(now, digest_) << "refused, yet changed: " << status.field << ' ' << describe(status.code);
        }
        forget();
        digest_ = digestOf(world_, known_);
    }
    /// Old names are kept, but not all of them for ever.
    void forget() {
        const auto trim = [](auto& ids, auto alive) {
            if (ids.size() < 80) { return; }
            std::size_t dead = 0;
            std::erase_if(ids, [&](auto id) { return !alive(id) && dead++ % 2 == 0; });
        };
        trim(known_.bodies, [this](BodyId id) { return world_.isValid(id); });
        trim(known_.shapes, [this](ShapeId id) { return world_.isValid(id); });
        trim(known_.joints, [this](JointId id) { return world_.isValid(id); });
        steps_ += world_.counters().awakeBodies > 0 ? 1 : 0;
    }

    World world_;
    KnownIds known_;
    std::uint64_t digest_ = 0;
    int calls_ = 0;
    int refusals_ = 0;
    int steps_ = 0;
    std::array<int, kStatusCodeCount> codes_{};
    JointTally joined_{};
    int broken_ = 0;
};

}  // namespace swept::test

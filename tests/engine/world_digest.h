#pragma once

#include <cstdint>
#include <vector>

#include <swept/engine/world.h>
#include <swept/shapes/bit_cast.h>

/// Everything that can be seen of a world, as one number: two worlds that differ in a bit anywhere differ in it.

namespace swept::test {

/// All ids that a test ever got, whether their things still exist or not.
struct KnownIds {
    std::vector<BodyId> bodies;
    std::vector<ShapeId> shapes;
    std::vector<JointId> joints;
};

class Digest {
public:
    void add(std::uint64_t word) { sum_ = std::rotl(sum_ ^ (word * 0x9E3779B97F4A7C15U), 23) * 0xBF58476D1CE4E5B9U; }
    void add(double number) { add(bitCast<std::uint64_t>(number)); }
    void add(DVec2 v) {
        add(v.x);
        add(v.y);
    }
    void add(Vec2 v) { add(toDouble(v)); }
    void add(BodyId id) { add((std::uint64_t{id.index} << 32U) | id.generation); }
    void add(ShapeId id) { add((std::uint64_t{id.index} << 32U) | id.generation); }
    std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = 0;
};

inline void addBody(Digest& digest, const World& world, BodyId id) {
    digest.add(std::uint64_t{world.isValid(id)});
    if (!world.isValid(id)) { return; }
    digest.add(static_cast<std::uint64_t>(world.type(id)));
    digest.add(world.position(id));
    digest.add(world.centerOfMass(id));
    digest.add(world.angle(id));
    digest.add(world.velocity(id));
    digest.add(static_cast<double>(world.angularVelocity(id)));
    digest.add(std::uint64_t{world.isAwake(id)});
    digest.add(std::uint64_t{world.isEnabled(id)});
    digest.add(world.mass(id));
    digest.add(world.inertia(id));
    digest.add(world.userData(id));
}

inline void addSurface(Digest& digest, const Surface& surface) {
    digest.add(static_cast<double>(surface.friction));
    digest.add(static_cast<double>(surface.restitution));
    digest.add(static_cast<double>(surface.rollingResistance));
    digest.add(static_cast<double>(surface.surfaceSpeed));
    digest.add(static_cast<std::uint64_t>(surface.frictionMixing));
    digest.add(static_cast<std::uint64_t>(surface.restitutionMixing));
    digest.add(surface.material);
}

inline void addSettings(Digest& digest, const WorldSettings& settings) {
    digest.add(settings.gravity);
    digest.add(static_cast<std::uint64_t>(settings.subSteps.value_or(0)) << 32U);
    digest.add(static_cast<std::uint64_t>(settings.relaxPasses.value_or(-1)));
    digest.add(static_cast<std::uint64_t>(settings.maxImpacts));
    digest.add(static_cast<double>(settings.maxSpeed));
    digest.add(static_cast<double>(settings.toiTolerance.value_or(0)));
    digest.add(static_cast<double>(settings.maxPenetration));
    digest.add(static_cast<double>(settings.maxJointError));
    digest.add(settings.maxLostTime);
    digest.add(static_cast<std::uint64_t>(settings.profile));
    digest.add(static_cast<std::uint64_t>(settings.continuous));
    digest.add(static_cast<std::uint64_t>(settings.broadphase));
    digest.add(std::uint64_t{settings.sleep});
    digest.add(static_cast<double>(settings.sleepSpeed));
}

inline std::uint64_t digestOf(const World& world, const KnownIds& known) {
    Digest digest;
    for (const BodyId id : known.bodies) { addBody(digest, world, id); }
    for (const ShapeId id : known.shapes) {
        digest.add(std::uint64_t{world.isValid(id)});
        digest.add(world.bodyOf(id));
        digest.add(world.userData(id));
        for (std::uint32_t i = 0; i < world.segmentCount(id); ++i) { addSurface(digest, world.surface(id, i)); }
    }
    for (const JointId id : known.joints) {
        digest.add(std::uint64_t{world.isValid(id)});
        digest.add(world.jointForce(id));
        digest.add(static_cast<double>(world.jointTorque(id)));
        digest.add(static_cast<double>(world.jointError(id)));
        digest.add(static_cast<double>(world.jointAngleError(id)));
        digest.add(static_cast<double>(world.jointTranslation(id)));
    }
    world.visitContacts([&digest](const ContactView& contact) {
        digest.add(contact.shapeA);
        digest.add(contact.shapeB);
        digest.add(std::uint64_t{contact.segmentA} << 32U | contact.segmentB);
        digest.add(contact.point);
        digest.add(contact.normal);
        digest.add(static_cast<double>(contact.separation));
        digest.add(static_cast<double>(contact.impulse));
    });
    for (const ContactEvent& event : world.contactEvents()) {
        digest.add(static_cast<std::uint64_t>(event.type));
        digest.add(event.shapeA);
        digest.add(event.shapeB);
        digest.add(std::uint64_t{event.segmentA} << 32U | event.segmentB);
        digest.add(event.fraction);
    }
    digest.add(std::uint64_t{world.bodyCount()} << 32U | world.jointCount());
    digest.add(world.counters().contacts);
    digest.add(world.counters().wokeUp);
    digest.add(world.counters().proxiesMoved);
    addSettings(digest, world.settings());
    return digest.sum();
}

}  // namespace swept::test

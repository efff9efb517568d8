#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <swept/engine/world.h>

/// Small builders and measures shared by the suites that run whole worlds.

namespace swept::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRate = 60;  ///< steps a second, unless a test says otherwise
inline constexpr double kStep = 1 / kRate;
inline constexpr double kGravity = 10;  ///< m/s², downwards: exact in both precisions
inline constexpr bool kIsDouble = std::is_same_v<Real, double>;

inline Real real(double x) { return static_cast<Real>(x); }
inline Vec2 vec(double x, double y) { return {real(x), real(y)}; }
inline DVec2 turned(DVec2 v, double angle) {
    return {v.x * std::cos(angle) - v.y * std::sin(angle), v.x * std::sin(angle) + v.y * std::cos(angle)};
}

/// The value of a result that must not be refused.
template <class T>
T must(const Result<T>& result) {
    EXPECT_TRUE(result.ok()) << result.status().field << ' ' << describe(result.status().code);
    return result.value();
}
inline void must(const Status& status) { EXPECT_TRUE(status.ok()) << status.field << ' ' << describe(status.code); }

/// Fails when a measured number exceeds its limit; keeps it for `--gtest_output=json:FILE`.
inline void expectAtMost(const std::string& what, double measured, double limit) {
    EXPECT_LE(measured, limit) << what;
    testing::Test::RecordProperty(what, testing::PrintToString(measured) + " of " + testing::PrintToString(limit));
}

inline constexpr Profile kProfiles[] = {Profile::fast, Profile::accurate};
inline std::string profileName(Profile profile) { return profile == Profile::fast ? "fast" : "accurate"; }

/// Accuracy is measured without sleep, which hides creep.
inline WorldSettings awakeSettings(double gravity = kGravity) {
    WorldSettings settings;
    settings.gravity = vec(0, -gravity);
    settings.sleep = false;
    return settings;
}

inline WorldSettings awakeSettings(Profile profile, double gravity = kGravity) {
    WorldSettings settings = awakeSettings(gravity);
    settings.profile = profile;
    return settings;
}

inline World makeWorld(const WorldSettings& settings) {
    World world;
    must(world.configure(settings));
    return world;
}
inline World makeWorld(double gravity = kGravity) { return makeWorld(awakeSettings(gravity)); }
inline World makeWorld(Profile profile, double gravity = kGravity) {
    return makeWorld(awakeSettings(profile, gravity));
}

inline ShapeDef material(double friction, double restitution = 0, double density = 1) {
    ShapeDef def;
    def.friction = real(friction);
    def.restitution = real(restitution);
    def.density = real(density);
    return def;
}

inline BodyDef bodyAt(BodyType type, DVec2 position, double angle = 0) {
    BodyDef def;
    def.type = type;
    def.position = position;
    def.angle = angle;
    return def;
}
inline BodyDef dynamicAt(DVec2 position, Vec2 velocity = {}, double spin = 0) {
    BodyDef def = bodyAt(BodyType::dynamic, position);
    def.velocity = velocity;
    def.angularVelocity = real(spin);
    return def;
}

inline BodyId addBody(World& world, const BodyDef& def, const Polygon& polygon, const ShapeDef& shape = {}) {
    const BodyId body = must(world.createBody(def));
    must(world.addShape(body, polygon, shape));
    return body;
}
inline BodyId addStatic(World& world, const Polygon& polygon, const ShapeDef& shape = {}, DVec2 position = {},
                        double angle = 0) {
    return addBody(world, bodyAt(BodyType::fixed, position, angle), polygon, shape);
}

inline Polygon circle(double radius, Vec2 center = {}) { return must(makeCircle(center, real(radius))); }
inline Polygon box(double halfX, double halfY) { return must(makeBox(vec(halfX, halfY))); }
inline Polygon segment(double x0, double y0, double x1, double y1) {
    return must(makeSegment(vec(x0, y0), vec(x1, y1)));
}
inline Polygon capsule(double halfLength, double radius) {
    return must(makeCapsule(vec(-halfLength, 0), vec(halfLength, 0), real(radius)));
}

inline void run(World& world, int steps, double dt = kStep) {
    for (int i = 0; i < steps; ++i) { must(world.step(dt)); }
}
inline void runFor(World& world, double seconds, double dt = kStep) {
    run(world, static_cast<int>(std::lround(seconds / dt)), dt);
}

inline DVec2 velocityOf(const World& world, BodyId body) { return toDouble(world.velocity(body)); }
inline double spinOf(const World& world, BodyId body) { return static_cast<double>(world.angularVelocity(body)); }

/// Joules.
inline double kineticEnergy(const World& world, BodyId body) {
    const DVec2 v = velocityOf(world, body);
    const double spin = spinOf(world, body);
    return 0.5 * (world.mass(body) * dot(v, v) + world.inertia(body) * spin * spin);
}
/// Joules, potential energy measured from y = 0.
inline double energyOf(const World& world, std::span<const BodyId> bodies, double gravity) {
    double sum = 0;
    for (const BodyId body : bodies) {
        sum += kineticEnergy(world, body) + world.mass(body) * gravity * world.centerOfMass(body).y;
    }
    return sum;
}
inline DVec2 momentumOf(const World& world, std::span<const BodyId> bodies) {
    DVec2 sum;
    for (const BodyId body : bodies) { sum += world.mass(body) * velocityOf(world, body); }
    return sum;
}
/// About the origin of the world.
inline double angularMomentumOf(const World& world, std::span<const BodyId> bodies) {
    double sum = 0;
    for (const BodyId body : bodies) {
        sum += world.mass(body) * cross(world.centerOfMass(body), velocityOf(world, body)) +
               world.inertia(body) * spinOf(world, body);
    }
    return sum;
}

/// Depth of the deepest contact point there is, metres; 0 when nothing overlaps.
inline double deepestOverlap(const World& world) {
    double deepest = 0;
    world.visitContacts(
        [&](const ContactView& contact) { deepest = std::max(deepest, -static_cast<double>(contact.separation)); });
    return deepest;
}

}  // namespace swept::test

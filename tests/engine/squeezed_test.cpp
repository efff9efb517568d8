#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <swept/shapes/hull.h>

#include "../support/random.h"
#include "../support/some_of.h"
#include "joint_support.h"

/// What something kinematic, or far heavier, presses to other ground gets out of its way no faster than some times its
/// speed, and through no ground. It may go into what presses it: that does not yield either.

namespace swept::test {
namespace {

/// A wall, solid on the right of its way.
struct RoomWall {
    DVec2 place;
    DVec2 normal;
};

struct SqueezeScene {
    World world;
    std::vector<BodyId> bodies;
    std::vector<RoomWall> walls;
    BodyId pusher{};
    bool isHeavy;      ///< it is dynamic
    Vec2 velocity{};   ///< of the pusher
    double spin = 0;   ///< rad/s
    double speed = 0;  ///< of its fastest point, m/s
    int steps = 0;     ///< that it pushes

    SqueezeScene(Profile profile, bool isPusherHeavy, double gravity)
        : world(makeWorld(profile, gravity)), isHeavy(isPusherHeavy) {}

    void addWall(DVec2 place, double angle, double friction) {
        const DVec2 normal = turned({0, 1}, angle);
        addStatic(world, box(20, 1), material(friction), place - normal, angle);
        walls.push_back({place, normal});
    }
    void addPusher(DVec2 place, double angle, DVec2 halves, const ShapeDef& shape) {
        BodyDef def = bodyAt(isHeavy ? BodyType::dynamic : BodyType::kinematic, place, angle);
        def.velocity = velocity;
        def.angularVelocity = real(spin);
        pusher = addBody(world, def, box(halves.x, halves.y), shape);
        speed = static_cast<double>(length(velocity)) + std::fabs(spin) * length(halves);
    }
    bool isThrough(BodyId body) const {
        const DVec2 place = world.centerOfMass(body);
        return std::any_of(walls.begin(), walls.end(), [&](const RoomWall& wall) {
            const DVec2 way = place - wall.place;
            return dot(way, wall.normal) < -2 && std::fabs(cross(way, wall.normal)) < 19;
        });
    }
    void step(int i) {
        const bool pushes = i < steps;
        if (!isHeavy) { must(world.setVelocity(pusher, pushes ? velocity : Vec2{}, pushes ? real(spin) : Real(0))); }
        run(world, 1);
    }
};

Polygon someShape(Random& random, double size) {
    const int kind = random.integer(0, 3);
    const double flat = random.range(0.3, 1);
    const double round = size * random.range(0.3, 0.6);
    const int corners = random.integer(3, 6);
    const double first = random.range(0, 2 * kPi);
    std::vector<Vec2> points;
    for (int i = 0; i < corners; ++i) {
        const DVec2 point = turned({size, 0}, first + 2 * kPi * (i + random.range(-0.2, 0.2)) / corners);
        points.push_back(toReal(point));
    }
    if (kind == 0) { return circle(size); }
    if (kind == 1) { return box(size, flat * size); }
    return kind == 2 ? capsule(size - round, round) : must(convexHull(points));
}

void addSome(SqueezeScene& scene, Random& random, DVec2 place, double size, const ShapeDef& shape) {
    BodyDef def = dynamicAt(place);
    def.angle = random.range(-3, 3);
    scene.bodies.push_back(addBody(scene.world, def, someShape(random, size), shape));
}

ShapeDef someMaterial(Random& random) {
    const bool isSlippery = random.integer(0, 3) == 0;
    const double friction = random.range(0, 0.9);
    const bool bounces = random.integer(0, 2) == 0;
    const double restitution = random.range(0, 0.5);
    return material(isSlippery ? 0 : friction, bounces ? restitution : 0);
}

/// One to three shapes in a corner of two walls.
SqueezeScene cornerOf(Profile profile, bool isHeavy, std::uint64_t seed) {
    Random random(seed);
    SqueezeScene scene(profile, isHeavy, 0);
    ShapeDef shape = someMaterial(random);
    const double corner = random.range(0.6, 2.8);
    scene.addWall({}, 0.5 * (kPi - corner), static_cast<double>(shape.friction));
    scene.addWall({}, 0.5 * (corner - kPi), static_cast<double>(shape.friction));
    const int count = random.integer(1, 3);
    const double lowest = 0.6 / std::sin(0.5 * corner) + 0.2;
    for (int i = 0; i < count; ++i) {
        shape.density = real(random.range(0.5, 5));
        const double size = random.range(0.1, 0.5);
        addSome(scene, random, {random.range(-0.1, 0.1), lowest + 1.1 * i}, size, shape);
    }
    const double way = random.range(-0.15, 0.15) * corner;
    const double speed = random.range(1, 10);
    scene.velocity = toReal(turned({0, -speed}, way));
    scene.spin = random.chance(0.5) ? random.range(-2, 2) : 0.0;
    const double width = random.range(0.3, 1.5);
    shape.density = real(isHeavy ? std::exp2(random.integer(17, 23)) : 1);
    const double angle = random.range(-1, 1);
    scene.addPusher(turned({0, 0.3}, way) + DVec2{0, lowest + 1.1 * count + 1.5}, angle, {width, 0.5}, shape);
    scene.steps = 90;
    return scene;
}

/// One or two cones of a kilogram between a car and the ground, beside another wall if the car can be stopped.
SqueezeScene coneOf(Profile profile, bool isHeavy, std::uint64_t seed) {
    Random random(seed);
    SqueezeScene scene(profile, isHeavy, 0);
    ShapeDef shape = someMaterial(random);
    scene.addWall({}, 0, static_cast<double>(shape.friction));
    if (isHeavy) { scene.addWall({-2.5, 0}, -0.5 * kPi, static_cast<double>(shape.friction)); }
    const double size = random.range(0.12, 0.3);
    const int count = random.integer(1, 2);
    shape.density = real(1 / (3 * size * size));
    for (int i = 0; i < count; ++i) {
        addSome(scene, random, {random.range(-0.8, 0.8), 1.5 * size + 0.05 + 0.9 * i}, size, shape);
    }
    const double way = random.range(-0.5, 0.5);
    const double speed = random.range(1, 15);
    scene.velocity = toReal(turned({0, -speed}, way));
    scene.spin = random.chance(0.5) ? random.range(-2, 2) : 0.0;
    shape.density = real(isHeavy ? std::exp2(random.integer(13, 23)) : 1);
    const double angle = random.range(-0.6, 0.6);
    scene.addPusher(turned({0, 2}, way) + DVec2{0, 2}, angle, {2, 0.9}, shape);
    scene.steps = static_cast<int>(kRate * 4 / speed) + 20;
    return scene;
}

/// A plate comes down on up to five shapes that lie on the ground, with others of them tied to each other.
SqueezeScene pressOf(Profile profile, bool /*isHeavy*/, std::uint64_t seed) {
    Random random(seed);
    SqueezeScene scene(profile, false, kGravity);
    ShapeDef shape = someMaterial(random);
    scene.addWall({}, 0, static_cast<double>(shape.friction));
    const int count = random.integer(1, 5);
    for (int i = 0; i < count; ++i) {
        shape.density = real(random.range(0.5, 5));
        const double size = random.range(0.15, 0.4);
        addSome(scene, random, {random.range(-0.3, 0.3), 0.6 + 0.8 * i}, size, shape);
        if (i % 2 == 0) { continue; }
        must(scene.world.createJoint(
            RevoluteJointDef{.base = between(scene.bodies[scene.bodies.size() - 2], scene.bodies.back()),
                             .anchor = {0, 0.2 + 0.8 * i}}));
    }
    const double speed = random.range(0.5, 6);
    const double aside = random.chance(0.5) ? random.range(-speed, speed) : 0.0;
    scene.velocity = vec(aside, -speed);
    const double angle = random.chance(0.5) ? random.range(-0.2, 0.2) : 0.0;
    const double high = 1.6 + 0.8 * count + speed;
    scene.addPusher({-0.5 * static_cast<double>(scene.velocity.x), high}, angle, {2, 0.5}, shape);
    scene.steps = static_cast<int>(kRate * high / speed);
    return scene;
}

using MakeSqueeze = SqueezeScene (*)(Profile, bool, std::uint64_t);

/// Wherever it gets stuck, however it is freed: nobody is faster than eight times what presses.
/// @param times  that, and more: a heavy car that hits its corner turns faster than it went, and what was thrown out
///               on torn hinges gets as much again as these close
/// @param fall   m/s, likewise
void expectNoneFlungAway(const std::string& name, MakeSqueeze make, bool isHeavy, double times, double fall = 0) {
    for (const Profile profile : kProfiles) {
        double most = 0;
        for (std::uint64_t seed = 0; seed < someOf(120U); ++seed) {
            SqueezeScene scene = make(profile, isHeavy, seed);
            const double fastest = times * scene.speed + fall;
            const std::string what = name + ", " + profileName(profile) + ", seed " + std::to_string(seed);
            for (int i = 0; i < scene.steps + 30; ++i) {
                scene.step(i);
                for (const BodyId body : scene.bodies) {
                    const double speed = length(velocityOf(scene.world, body));
                    most = std::max(most, speed / scene.speed);
                    ASSERT_LE(speed, fastest) << what << ", step " << i;
                    ASSERT_FALSE(scene.isThrough(body)) << what << ", step " << i;
                }
            }
        }
        testing::Test::RecordProperty(name + ", " + profileName(profile), testing::PrintToString(most));
    }
}

TEST(Squeezed, InCorners) { expectNoneFlungAway("corner", cornerOf, false, 10); }
TEST(Squeezed, InCornersByWhatIsHeavy) { expectNoneFlungAway("corner, heavy", cornerOf, true, 16); }
TEST(Squeezed, BetweenACarAndTheGround) { expectNoneFlungAway("cone", coneOf, false, 10); }
TEST(Squeezed, BetweenAHeavyCarAndTwoWalls) { expectNoneFlungAway("cone, heavy", coneOf, true, 16); }
TEST(Squeezed, UnderAPress) { expectNoneFlungAway("press", pressOf, false, 20, 12); }

/// A ceiling that comes down at 1 mm/s onto a box as high as the room below it.
struct SlowCeiling {
    World world;
    BodyId pressed;

    SlowCeiling(Profile profile, double friction, double belt) : world(makeWorld(profile)) {
        ShapeDef floor = material(friction);
        floor.surfaceSpeed = real(belt);
        addStatic(world, box(100, 0.5), floor, {0, -0.5});
        BodyDef def = bodyAt(BodyType::kinematic, {0, 1.5});
        def.velocity = vec(0, -0.001);
        addBody(world, def, box(100, 0.5), material(0));
        pressed = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.501), material(friction));
    }
};

/// What presses it is slow, and what leads it is not: it goes as fast as the belt below it. (At 3 m/s.)
TEST(Squeezed, GoesAlongWithABelt) {
    for (const Profile profile : kProfiles) {
        SlowCeiling scene(profile, 5, 20);
        run(scene.world, 20);
        EXPECT_NEAR(velocityOf(scene.world, scene.pressed).x, 20, 0.2) << profileName(profile);
    }
}

/// Nor is it left behind by the kinematic body that draws it by a rod. (By 4.9 m in a second.)
TEST(Squeezed, GoesAlongWithWhatDrawsIt) {
    for (const Profile profile : kProfiles) {
        SlowCeiling scene(profile, 0, 0);
        BodyDef def = bodyAt(BodyType::kinematic, {1, 0.5});
        def.velocity = vec(10, 0);
        const BodyId hook = must(scene.world.createBody(def));
        must(scene.world.createJoint(
            DistanceJointDef{.base = between(hook, scene.pressed), .anchorA = {1, 0.5}, .anchorB = {0, 0.5}}));
        run(scene.world, 60);
        const double apart = scene.world.position(hook).x - scene.world.position(scene.pressed).x;
        EXPECT_NEAR(apart, 1, 0.02) << profileName(profile);
    }
}

/// What a motor turns is as fast as that wants, however slow the ground that presses it to a wall. (A quarter.)
TEST(Squeezed, TurnsWithItsMotor) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        BodyDef def = bodyAt(BodyType::kinematic, {0, -0.5});
        def.velocity = vec(-0.2, 0);
        addBody(world, def, box(30, 0.5), material(0));
        addStatic(world, box(0.5, 2), material(0), {-0.79, 0.3});
        const BodyId wheel = addBody(world, dynamicAt({0, 0.3}), circle(0.3), material(0));
        WheelJointDef joint;
        joint.base = between(anchorOf(world), wheel);
        joint.anchor = {0, 0.3};
        joint.motor = AngularMotor{.speed = real(200), .maxTorque = real(20)};
        must(world.createJoint(joint));
        run(world, 60);
        EXPECT_NEAR(spinOf(world, wheel), 200, 2) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test

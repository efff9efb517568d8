#include <array>

#include <swept/shapes/distance.h>

#include "../support/random.h"
#include "world_support.h"

/// Bodies that bounce off each other in flight do so at their time, on their parabolas.

namespace swept::test {
namespace {

constexpr double kClashRadius = 0.2;

/// Two equal disks that meet within the first step, by the closed form.
struct Disks {
    std::array<DVec2, 2> place{};
    std::array<DVec2, 2> velocity{};
    double restitution = 1;

    explicit Disks(Random& random) {
        const double aim = random.range(0, 2 * kPi);
        const double speed = random.range(20, 100);
        const DVec2 along{std::cos(aim), std::sin(aim)};
        const double gap = random.range(0.005, 0.08);
        const double aside = random.range(-0.9, 0.9) * 2 * kClashRadius;
        const double ahead = std::sqrt((2 * kClashRadius + gap) * (2 * kClashRadius + gap) - aside * aside);
        place[1] = ahead * along + aside * DVec2{-along.y, along.x};
        velocity[1] = {random.range(-5, 5), random.range(-5, 5)};
        velocity[0] = velocity[1] + speed * along;
        restitution = random.range(0.2, 1);
    }

    /// Seconds; both fall alike.
    double timeOfImpact() const {
        const DVec2 d = place[1] - place[0];
        const DVec2 v = velocity[1] - velocity[0];
        const double b = dot(d, v);
        return (-b - std::sqrt(b * b - dot(v, v) * (dot(d, d) - 4 * kClashRadius * kClashRadius))) / dot(v, v);
    }

    /// State a step later.
    Disks after() const {
        Disks later = *this;
        const DVec2 g{0, -kGravity};
        const double t = timeOfImpact();
        const double rest = kStep - t;
        const DVec2 d = place[1] - place[0] + t * (velocity[1] - velocity[0]);
        const DVec2 normal = (1 / length(d)) * d;
        const double change = 0.5 * (1 + restitution) * dot(velocity[0] - velocity[1], normal);
        for (std::size_t i = 0; i < 2; ++i) {
            const DVec2 gain = (i == 0 ? -change : change) * normal;
            later.velocity[i] = velocity[i] + gain + kStep * g;
            later.place[i] = place[i] + kStep * velocity[i] + rest * gain + (0.5 * kStep * kStep) * g;
        }
        return later;
    }
};

TEST(Clash, DisksBounceAtTheirTime) {
    Random random(1);
    double way = 0;
    double speed = 0;
    double time = 0;
    for (int i = 0; i < 200; ++i) {
        const Disks disks(random);
        World world = makeWorld();
        std::array<BodyId, 2> bodies{};
        for (std::size_t k = 0; k < 2; ++k) {
            bodies[k] = addBody(world, dynamicAt(disks.place[k], toReal(disks.velocity[k])), circle(kClashRadius),
                                material(0, disks.restitution));
        }
        must(world.step(kStep));
        ASSERT_EQ(world.counters().clashes, 1U) << i;
        ASSERT_EQ(world.counters().bodySubSteps, 0U) << i;
        const Disks expected = disks.after();
        for (std::size_t k = 0; k < 2; ++k) {
            way = std::max(way, length(world.centerOfMass(bodies[k]) - expected.place[k]));
            speed = std::max(speed, length(velocityOf(world, bodies[k]) - expected.velocity[k]));
        }
        int hits = 0;
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type != ContactEventType::hit) { continue; }
            ++hits;
            time = std::max(time, std::abs(event.fraction * kStep - disks.timeOfImpact()));
        }
        EXPECT_EQ(hits, 1) << i;
    }
    expectAtMost("place, m", way, 1e-4);
    expectAtMost("velocity, m/s", speed, 5e-3);
    expectAtMost("time, s", time, 1e-6);
}

struct Pair {
    World world = makeWorld(0);
    std::vector<BodyId> bodies;
    std::array<Polygon, 2> shapes;

    /// Side by side, a gap of one to five centimetres between them, on their way to each other, turning.
    Pair(Random& random, double friction, double restitution) {
        const std::array<Polygon, 4> kinds{circle(kClashRadius), box(0.2, 0.2), box(0.5, 0.05), capsule(0.2, 0.1)};
        for (Polygon& shape : shapes) { shape = kinds[static_cast<std::size_t>(random.integer(0, 3))]; }
        const double speed = random.range(20, 100);
        const double gap = random.range(0.01, 0.05);
        std::array<double, 2> angles{};
        for (double& angle : angles) { angle = random.range(0, 2 * kPi); }
        double half = 1;
        for (int i = 0; i < 20; ++i) { half -= 0.5 * (gapAt(half, angles) - gap); }
        for (std::size_t i = 0; i < 2; ++i) {
            const double side = i == 0 ? 1 : -1;
            BodyDef def = dynamicAt({-half * side, 0}, vec(side * speed, random.range(-10, 10)), random.range(-30, 30));
            def.angle = angles[i];
            bodies.push_back(addBody(world, def, shapes[i], material(friction, restitution)));
        }
    }

    double gapAt(double half, const std::array<double, 2>& angles) const {
        const WorldTransform left{{-half, 0}, rotationFromAngle(angles[0])};
        const WorldTransform right{{half, 0}, rotationFromAngle(angles[1])};
        return static_cast<double>(distance(shapes[0], shapes[1], relativeTransform(left, right)).distance);
    }
    double energy() const { return energyOf(world, bodies, 0); }
    /// Metres.
    double overlap() const {
        const auto pose = [&](BodyId body) {
            return WorldTransform{world.position(body), rotationFromAngle(world.angle(body))};
        };
        const Transform bInA = relativeTransform(pose(bodies[0]), pose(bodies[1]));
        return -static_cast<double>(distance(shapes[0], shapes[1], bInA).distance);
    }
};

/// Whatever their shape: no momentum is made, no energy, and none overlap that did not before.
TEST(Clash, PairsKeepWhatIsToBeKept) {
    int clashes = 0;
    for (const double restitution : {0.3, 1.0}) {
        for (const double friction : {0.0, 0.5}) {
            Random random(7);
            double momentum = 0;
            double turn = 0;
            double gain = 0;
            double loss = 0;
            double overlap = -1;
            for (int i = 0; i < 300; ++i) {
                Pair pair(random, friction, restitution);
                const double energy = pair.energy();
                const DVec2 before = momentumOf(pair.world, pair.bodies);
                const double turnBefore = angularMomentumOf(pair.world, pair.bodies);
                const double scale = std::sqrt(2 * energy * pair.world.mass(pair.bodies[0]));
                must(pair.world.step(kStep));
                if (pair.world.counters().clashes == 0) { continue; }
                ++clashes;
                ASSERT_TRUE(pair.world.lostTime().empty());
                overlap = std::max(overlap, pair.overlap());
                momentum = std::max(momentum, length(momentumOf(pair.world, pair.bodies) - before) / scale);
                turn = std::max(turn, std::abs(angularMomentumOf(pair.world, pair.bodies) - turnBefore) / scale);
                gain = std::max(gain, pair.energy() / energy - 1);
                loss = std::max(loss, 1 - pair.energy() / energy);
            }
            const std::string name = "e " + std::to_string(restitution) + " mu " + std::to_string(friction) + ": ";
            expectAtMost(name + "momentum", momentum, 1e-5);
            // As an arm: bodies that sank are set apart along the normal, by a slop or two of the thinnest one.
            expectAtMost(name + "angular momentum, m", turn, 3 * 0.1 / 1024);
            expectAtMost(name + "energy gained", gain, 1e-5);
            expectAtMost(name + "overlap, m", overlap, 0.0);
            if (restitution == 1 && friction == 0) {
                expectAtMost(name + "energy lost", loss, 1e-5);
            } else {
                EXPECT_GT(loss, 0.01) << name;
            }
        }
    }
    EXPECT_GT(clashes, 1000) << "too few to prove anything";
}

/// A ball between two plates that close on it bounces ever faster: more than a clash may take. The solver does it then,
/// from the start of the step, and nothing is told twice.
TEST(Clash, WhatBouncesTooOftenIsForTheSolver) {
    World world = makeWorld(0);
    const ShapeDef surface = material(0, 0.9);
    ShapeDef heavy = surface;
    heavy.density = 1000;
    std::vector<BodyId> bodies{addBody(world, dynamicAt({-0.18, 0}, vec(40, 0)), box(0.1, 1), heavy),
                               addBody(world, dynamicAt({0, 0}, vec(1, 0)), circle(0.05), surface),
                               addBody(world, dynamicAt({0.18, 0}, vec(-40, 0)), box(0.1, 1), heavy)};
    const DVec2 before = momentumOf(world, bodies);
    const double energy = energyOf(world, bodies, 0);
    must(world.step(kStep));
    EXPECT_EQ(world.counters().clashes, 0U);
    EXPECT_GT(world.counters().bodySubSteps, 0U);
    std::vector<double> hits;
    for (const ContactEvent& event : world.contactEvents()) {
        if (event.type == ContactEventType::hit) { hits.push_back(event.fraction); }
    }
    EXPECT_LE(hits.size(), 2U * 16U) << "one a contact and part of the step";
    run(world, 60);
    expectAtMost("momentum", length(momentumOf(world, bodies) - before) / (40 * world.mass(bodies[0])), 1e-5);
    EXPECT_LE(energyOf(world, bodies, 0), energy * (1 + 1e-6));
}

/// Bullets that ride on each other stay where they are once the impacts are used up, and a kinematic plate that comes
/// meanwhile takes them along.
TEST(Clash, ThatGivesUpLetsNoPlateThrough) {
    Random random(7);
    int lost = 0;
    for (int trial = 0; trial < 200; ++trial) {
        WorldSettings settings = awakeSettings(0);
        settings.maxImpacts = 1;
        World world = makeWorld(settings);
        BodyDef def;
        def.type = BodyType::kinematic;
        def.position = {random.range(0.3, 1.1), 0};
        def.velocity = vec(-random.range(10, 70), 0);
        const BodyId plate = addBody(world, def, box(0.05, 20), material(0.6));
        std::array<BodyId, 2> bullets{};
        for (std::size_t i = 0; i < 2; ++i) {
            const double x = random.range(-0.3, -0.25);
            const double along = random.range(0, 10);
            const double across = random.range(0, 6);
            def = dynamicAt({x, 0.215 * static_cast<double>(i)}, vec(along, i == 0 ? across : -across));
            def.angularVelocity = real(random.range(-100, 100));
            def.bullet = true;
            bullets.at(i) = addBody(world, def, trial % 2 == 0 ? box(0.1, 0.1) : circle(0.1), material(0.6));
        }
        for (int step = 0; step < 8; ++step) {
            run(world, 1);
            lost += static_cast<int>(world.lostTime().size());
            for (const BodyId bullet : bullets) {
                ASSERT_LT(world.position(bullet).x, world.position(plate).x) << "trial " << trial << ", step " << step;
            }
        }
    }
    EXPECT_GT(lost, 500) << "too few gave up to prove anything";
}

}  // namespace
}  // namespace swept::test

#include <cmath>
#include <vector>

#include "world_support.h"

/// What a bullet strikes goes on from there as it would have, but for the blow.

namespace swept::test {
namespace {

BodyId shoot(World& world, DVec2 from, Vec2 velocity, double density) {
    BodyDef def = dynamicAt(from, velocity);
    def.bullet = true;
    def.gravityScale = 0;
    return addBody(world, def, circle(0.1), material(0, 0, density));
}

/// What forces and damping do to a body until the end of the step is part of its motion already: a bullet of next to no
/// mass changes nothing of it.
TEST(BulletStrikes, OfAFeatherChangeNothing) {
    struct Case {
        const char* name;
        double damping, force, torque;
        bool onGround;
    };
    for (const Case& one : {Case{"pushed", 0, 3, 0, false}, Case{"damped", 20, 60, 0, false},
                            Case{"much damped", 100, 300, 0, false}, Case{"turned", 0, 0, 6, false},
                            Case{"damped and turned", 5, 0, 6, false}, Case{"pushed on ground", 0, 12, 0, true}}) {
        for (const double late : {0.1, 0.5, 0.9}) {
            World world = makeWorld(one.onGround ? kGravity : 0);
            addStatic(world, box(50, 1), material(0), {0, -1});
            BodyDef def = dynamicAt({0, one.onGround ? 1.0 : 5.0}, vec(1, 0), 0.5 * one.torque);
            def.linearDamping = def.angularDamping = real(one.damping);
            const BodyId body = addBody(world, def, box(1, 1), material(0));
            World alone = world;
            run(world, 5);
            run(alone, 5);
            const double top = world.position(body).y + 1.1 + (one.torque != 0 ? 1 : 0);
            shoot(world, {world.position(body).x, top + 10 * late}, vec(0, -600), 1e-7);
            for (World* const each : {&world, &alone}) {
                const double mass = each->mass(body);
                must(each->applyForce(body, vec(one.force * mass, 0)));
                must(each->applyTorque(body, real(one.torque * each->inertia(body))));
                run(*each, 1);
            }
            const std::string what = std::string(one.name) + ", struck at about " + std::to_string(late);
            EXPECT_NEAR(world.velocity(body).x, alone.velocity(body).x, 2e-5) << what;
            // On ground it flies for the rest of the step, and is caught in the next one.
            EXPECT_NEAR(world.velocity(body).y, alone.velocity(body).y, one.onGround ? kGravity * kStep : 2e-5) << what;
            EXPECT_NEAR(world.angularVelocity(body), alone.angularVelocity(body), 2e-5) << what;
            // Where it is within the step is told by a parabola, which damping is not.
            EXPECT_NEAR(world.position(body).x, alone.position(body).x, 2e-3) << what;
            EXPECT_GT(world.counters().impacts, alone.counters().impacts) << what << ": not struck";
        }
    }
}

/// Above ground that it has contact points with, but does not press, gravity and damping count as they do in flight.
TEST(BulletStrikes, AboveGroundCountNothingTwice) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const double damping : {0.0, 10.0}) {
            for (const double speed : {2.0, 4.0}) {
                for (const double late : {0.1, 0.5, 0.9}) {
                    WorldSettings settings = awakeSettings(profile);
                    World world = makeWorld(settings);
                    addStatic(world, box(50, 1), material(0), {0, -1});
                    BodyDef def = dynamicAt({0, 0.52}, vec(0, speed), 0);
                    def.linearDamping = def.angularDamping = real(damping);
                    const BodyId body = addBody(world, def, box(0.5, 0.5), material(0));
                    World alone = world;
                    shoot(world, {-0.6 - 600 * kStep * late, 0.52 + speed * kStep * late}, vec(600, 0), 0.01);
                    run(world, 1);
                    run(alone, 1);
                    const std::string what = "damping " + std::to_string(damping) + ", " + std::to_string(speed) +
                                             " m/s, struck at about " + std::to_string(late);
                    ASSERT_EQ(alone.counters().solvedBodies, 1U) << what;
                    EXPECT_GT(world.velocity(body).x, 0.1) << what << ": not struck";
                    EXPECT_NEAR(world.velocity(body).y, alone.velocity(body).y, 2e-5) << what;
                }
            }
        }
    }
}

/// However long it rested, and however little of the step is left: the momentum stays.
TEST(BulletStrikes, MoveWhatRestedLong) {
    for (const int rested : {1, 20, 70, 300}) {
        World world = makeWorld([] {
            WorldSettings settings = awakeSettings();
            settings.sleep = true;
            return settings;
        }());
        addStatic(world, box(50, 0.5), material(0), {0, -0.5});
        const BodyId lower = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0));
        run(world, rested);
        const BodyId upper = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5), material(0));
        run(world, 20);
        const BodyId shot = shoot(world, {-3.9, 0.5}, vec(200, 0), 0.16);  // there at 0.99 of the step
        const auto momentum = [&] {
            double sum = 0;
            for (const BodyId body : {lower, upper, shot}) { sum += world.mass(body) * velocityOf(world, body).x; }
            return sum;
        };
        const double before = momentum();
        run(world, 30);
        EXPECT_NEAR(momentum(), before, 1e-3 * before) << "rested " << rested;
        EXPECT_GT(velocityOf(world, lower).x, 0.5) << "rested " << rested;
    }
}

/// What lies in a sensor, asleep or not, is told to leave it once, and to be in it no second time.
TEST(BulletStrikes, OfWhatLiesInASensorEndItOnce) {
    for (const int rested : {5, 40, 300}) {
        World world = makeWorld([] {
            WorldSettings settings = awakeSettings();
            settings.sleep = true;
            return settings;
        }());
        const BodyId ground = addStatic(world, box(200, 0.5), material(0.3), {0, -0.5});
        ShapeDef sensor;
        sensor.sensor = true;
        must(world.addShape(ground, must(makeBox(vec(2, 2), vec(0, 2))), sensor));
        const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.3));
        int begins = 0;
        int ends = 0;
        const auto step = [&](int steps) {
            for (int i = 0; i < steps; ++i) {
                run(world, 1);
                for (const ContactEvent& event : world.contactEvents()) {
                    const bool isOurs = event.bodyA == body || event.bodyB == body;
                    begins += isOurs && event.type == ContactEventType::sensorBegin ? 1 : 0;
                    ends += isOurs && event.type == ContactEventType::sensorEnd ? 1 : 0;
                }
            }
        };
        step(rested);
        EXPECT_EQ(begins, 1);
        shoot(world, {-6, 0.6}, vec(300, 0), 60);
        step(60);
        EXPECT_GT(world.position(body).x, 3) << "rested " << rested;
        EXPECT_EQ(begins, 1) << "rested " << rested;
        EXPECT_EQ(ends, 1) << "rested " << rested;
    }
}

/// A bat that is led turns so fast that a ball on it has no end of impacts in a step: the bat takes it along, a bullet
/// as any other.
TEST(BulletStrikes, OfALedBatEndBeforeIt) {
    for (const bool bullet : {false, true}) {
        for (const double spin : {10.0, 20.0, 40.0}) {
            for (int phase = 0; phase < 20; ++phase) {
                World world = makeWorld(0);
                const BodyId bat = must(world.createBody(bodyAt(BodyType::kinematic, {0, 0}, -0.5)));
                must(world.addShape(bat, must(makeCapsule({}, vec(1.5, 0), real(0.01)))));
                BodyDef def = dynamicAt(turned({0.6 + 0.04 * phase, 0.12}, -0.5));
                def.bullet = bullet;
                const BodyId ball = addBody(world, def, circle(0.1));
                double angle = -0.5;
                for (int i = 0; i < 60; ++i) {
                    angle = std::min(0.5, angle + spin * kStep);
                    must(world.driveTo(bat, {0, 0}, angle, kStep));
                    run(world, 1);
                }
                EXPECT_GT(turned(world.position(ball), -angle).y, 0)
                    << spin << " rad/s, phase " << phase << (bullet ? ", bullet" : "");
            }
        }
    }
}

/// Billiards: a smooth ball sends another one along the line of their centres as they meet, however slowly, and
/// wherever in the step.
TEST(BulletStrikes, OfSlowBallsGoAlongTheLineOfCentres) {
    const double radius = 0.0286;
    for (const double speed : {0.05, 0.2, 0.5, 0.9, 2.0, 8.0}) {
        for (const double aside : {0.3, 0.8, 0.95}) {  // of both radii
            for (int late = 0; late < 8; ++late) {
                World world = makeWorld(0);
                const double from = -0.1 - speed * kStep * late / 8;
                const auto ball = [&](DVec2 at, Vec2 velocity) {
                    BodyDef def = dynamicAt(at, velocity);
                    def.bullet = true;
                    return addBody(world, def, circle(radius), material(0, 1));
                };
                const BodyId struck = ball({0, 0}, {});
                ball({from, -2 * radius * aside}, vec(speed, 0));
                runFor(world, 0.5 + 0.2 / speed);
                const Vec2 velocity = world.velocity(struck);
                const std::string what =
                    std::to_string(speed) + " m/s, " + std::to_string(aside) + " of the radii aside";
                const double most = speed * std::sqrt(1 - aside * aside);
                EXPECT_NEAR(length(velocity), most, 0.01 * speed) << what;
                EXPECT_NEAR(std::atan2(velocity.y, velocity.x), std::asin(aside), 0.005) << what;
            }
        }
    }
}

/// Of bullets in a row each tells, by its contact, the impulse of all blows of the step: what changed its momentum.
/// (Where they were solved as one clash, it was nothing.)
TEST(BulletStrikes, TellTheirImpulses) {
    for (const Profile profile : kProfiles) {
        for (const double restitution : {0.0, 0.5}) {
            World world = makeWorld(profile, 0);
            std::vector<BodyId> row;
            const DVec2 starts[] = {{0, 60}, {0.42, 0}, {1.6, -30}};  // x and its speed
            for (const DVec2 start : starts) {
                BodyDef def = dynamicAt({start.x, 0}, vec(start.y, 0));
                def.bullet = true;
                row.push_back(addBody(world, def, circle(0.2), material(0, restitution)));
            }
            int blows = 0;
            for (int i = 0; i < 4; ++i) {
                const double before = velocityOf(world, row[0]).x;
                run(world, 1);
                const double change = world.mass(row[0]) * std::abs(velocityOf(world, row[0]).x - before);
                double told = 0;
                world.visitContacts(row[0], [&](const ContactView& contact) { told += contact.impulse; });
                blows += change > 0.1 ? 1 : 0;
                EXPECT_NEAR(told, change, 1e-4) << profileName(profile) << ", e " << restitution << ", step " << i;
            }
            EXPECT_GE(blows, 1) << profileName(profile) << ", e " << restitution;
        }
    }
}

}  // namespace
}  // namespace swept::test

#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Bullets meet dynamic bodies at the time and place where both really are.

namespace swept::test {
namespace {

BodyDef bulletAt(DVec2 position, Vec2 velocity) {
    BodyDef def = dynamicAt(position, velocity);
    def.bullet = true;
    return def;
}

TEST(Bullets, NeverPassEachOtherHeadOn) {
    for (const bool bothAreBullets : {false, true}) {
        for (const double restitution : {0.0, 1.0}) {
            for (const double speed : {60.0, 600.0}) {
                for (int i = 0; i < 100; ++i) {
                    World world = makeWorld(0);
                    BodyDef right = dynamicAt({3 + i * speed * kStep / 100, 0}, vec(-speed, 0));
                    right.bullet = bothAreBullets;
                    const std::array bodies{
                        addBody(world, bulletAt({-3, 0}, vec(speed, 0)), circle(0.1), material(0, restitution)),
                        addBody(world, right, circle(0.1), material(0, restitution))};
                    runFor(world, 0.5);
                    const std::string name =
                        "e " + std::to_string(restitution) + ", " + std::to_string(speed) + " m/s, " + std::to_string(i);
                    EXPECT_LT(world.position(bodies[0]).x, world.position(bodies[1]).x) << name;
                    const double before = world.mass(bodies[0]) * speed * speed;
                    EXPECT_NEAR(energyOf(world, bodies, 0) / before, restitution, 1e-5) << name;
                    EXPECT_LE(length(momentumOf(world, bodies)), 1e-5 * world.mass(bodies[0]) * speed) << name;
                }
            }
        }
    }
}

struct Shot {
    bool met = false;     ///< there was an impact
    bool passed = false;  ///< it got to the other side of the plank, within the plank's length
    double lost = 0;      ///< s
};

/// A bullet, and a plank that is free to move, and maybe comes towards it. Off its centre the plank begins to turn, and what
/// slides off its end may well be behind it later: only of the first hit is clear on which side it must be.
Shot shootAtPlank(double speed, double plankSpeed, double restitution, double aim, std::uint64_t seed) {
    World world = makeWorld(0);
    Random random(seed);
    BodyDef def = dynamicAt({}, vec(-plankSpeed, 0));
    def.angle = random.range(-0.3, 0.3);
    const BodyId plank = addBody(world, def, box(0.025, 1), material(1, restitution));
    const double x = -1 - random.uniform() * speed * kStep;
    const BodyId bullet = addBody(world, bulletAt({x, aim * random.range(-1, 1)}, vec(speed, 0)), circle(0.05),
                                  material(1, restitution));
    Shot shot;
    for (int i = 0; i < 4; ++i) {
        must(world.step(kStep));
        for (const LostTimeEntry& entry : world.lostTime()) { shot.lost += entry.seconds; }
        for (const ContactEvent& event : world.contactEvents()) { shot.met = shot.met || event.type == ContactEventType::hit; }
        const DVec2 offset = turned(world.position(bullet) - world.position(plank), -world.angle(plank));
        shot.passed = shot.passed || (offset.x > 0 && std::abs(offset.y) < 1);
    }
    return shot;
}

TEST(Bullets, NeverPassAPlank) {
    for (const double approach : {0.0, 0.5}) {
        for (const double restitution : {0.0, 1.0}) {
            for (const double speed : {30.0, 100.0, 300.0, 3000.0}) {
                double lost = 0;
                for (std::uint64_t seed = 0; seed < 200; ++seed) {
                    const std::string name = std::to_string(speed) + " m/s, plank at " + std::to_string(approach * speed) +
                                             ", e " + std::to_string(restitution) + ", seed " + std::to_string(seed);
                    EXPECT_TRUE(shootAtPlank(speed, approach * speed, restitution, 0.7, seed).met) << name;
                    const Shot centred = shootAtPlank(speed, approach * speed, restitution, 0, seed);
                    EXPECT_TRUE(centred.met) << name;
                    EXPECT_FALSE(centred.passed) << name;
                    lost += centred.lost;
                }
                if (restitution > 0) { EXPECT_EQ(lost, 0) << speed; }
            }
        }
    }
}

/// Two bullets for one plate: the one that arrives first, whatever their order, finds it at rest.
TEST(Bullets, HitInOrderOfTime) {
    std::array<double, 2> speeds{};
    for (const bool nearFirst : {false, true}) {
        World world = makeWorld(0);
        const BodyId plate = addBody(world, dynamicAt({0, 0}), box(0.05, 1), material(0, 0));
        std::array<BodyId, 2> bullets{};
        for (const bool isNear : {nearFirst, !nearFirst}) {
            const double x = isNear ? -0.5 : 1.5;
            bullets[isNear ? 0 : 1] =
                addBody(world, bulletAt({x, 0}, vec(isNear ? 300 : -300, 0)), circle(0.05), material(0, 0));
        }
        must(world.step(kStep));
        std::vector<double> fractions;
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type == ContactEventType::hit) { fractions.push_back(event.fraction); }
        }
        ASSERT_GE(fractions.size(), 2U);
        // 0.4 m at 300 m/s.
        EXPECT_NEAR(fractions[0], 0.4 / 300 / kStep, 1e-3);
        EXPECT_GT(fractions[1], fractions[0]);
        speeds[nearFirst ? 1 : 0] = velocityOf(world, plate).x;
    }
    EXPECT_NEAR(speeds[0], speeds[1], 1e-4 * 300);
}

TEST(Bullets, AStackTakesTheBlow) {
    for (const double speed : {30.0, 300.0}) {
        WorldSettings settings = awakeSettings();
        settings.sleep = true;
        World world = makeWorld(settings);
        addStatic(world, segment(-20, 0, 50, 0), material(0.5));
        std::vector<BodyId> boxes;
        for (int i = 0; i < 4; ++i) { boxes.push_back(addBody(world, dynamicAt({0, 0.25 + 0.5 * i}), box(0.25, 0.25))); }
        runFor(world, 3);
        const BodyId bullet = addBody(world, bulletAt({-1.5, 0.8}, vec(speed, 0)), circle(0.05), material(0.3, 0, 4));
        double front = -10;
        for (int i = 0; i < 12; ++i) {
            must(world.step(kStep));
            front = std::max(front, world.position(bullet).x - world.position(boxes[1]).x);
        }
        EXPECT_LT(front, 0) << speed << " m/s: behind the box";
        EXPECT_GT(velocityOf(world, boxes[1]).x, 0.01) << speed;
    }
}

TEST(Bullets, WhoIsNoBulletPaysNothing) {
    World world = makeWorld(0);
    for (int i = 0; i < 20; ++i) { addBody(world, dynamicAt({i * 1.0, 0}, vec(0.5, 0)), circle(0.2)); }
    run(world, 10);
    EXPECT_EQ(world.counters().sweeps, 0U);
    EXPECT_EQ(world.counters().toiCalls, 0U);
}

}  // namespace
}  // namespace swept::test

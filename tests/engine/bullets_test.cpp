#include <array>
#include <cmath>

#include "../support/random.h"
#include "thrown_crowd.h"
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
                    const std::string name = "e " + std::to_string(restitution) + ", " + std::to_string(speed) +
                                             " m/s, " + std::to_string(i);
                    EXPECT_LT(world.position(bodies[0]).x, world.position(bodies[1]).x) << name;
                    const double before = world.mass(bodies[0]) * speed * speed;
                    EXPECT_NEAR(energyOf(world, bodies, 0) / before, restitution, 1e-5) << name;
                    EXPECT_LE(length(momentumOf(world, bodies)), 1e-5 * world.mass(bodies[0]) * speed) << name;
                }
            }
        }
    }
}

/// Where a body is, at a time.
struct Place {
    double fraction = 0;  ///< of the step
    DVec2 center{};
    double angle = 0;
};

/// The way of a body through the last step, from impact to impact. @pre no gravity; the centre of mass is the origin
class Way {
public:
    Way(const World& world, BodyId body, const Place& start) : places_{start} {
        for (const ImpactPose& pose : world.impactPoses()) {
            if (pose.body == body) { places_.push_back({pose.fraction, pose.position, pose.angle}); }
        }
        places_.push_back({1, world.position(body), world.angle(body)});
    }

    const std::vector<Place>& places() const { return places_; }
    Place at(double fraction) const {
        const auto isLater = [](double time, const Place& place) { return time < place.fraction; };
        const auto next = std::upper_bound(places_.begin() + 1, places_.end() - 1, fraction, isLater);
        const Place& from = *(next - 1);
        const double length = next->fraction - from.fraction;
        const double t = length > 0 ? (fraction - from.fraction) / length : 1;
        return {fraction, from.center + t * (next->center - from.center), from.angle + t * (next->angle - from.angle)};
    }

private:
    std::vector<Place> places_;
};

constexpr double kPlankHalf = 1;

/// Whether the bullet got from one side of the plank's middle line to the other between its ends, and stayed there, in
/// the last step. @pre both went straight from impact to impact
bool crosses(const Way& bullet, const Way& plank) {
    std::vector<double> moments;
    for (const Way* way : {&bullet, &plank}) {
        for (const Place& place : way->places()) { moments.push_back(place.fraction); }
    }
    std::sort(moments.begin(), moments.end());
    constexpr int kSamples = 64;  // of each part between two impacts: the plank turns far less than half a turn in one
    const auto offsetAt = [&](double time) {
        const Place place = plank.at(time);
        return turned(bullet.at(time).center - place.center, -place.angle);
    };
    DVec2 before = offsetAt(0);
    bool isThrough = false;
    for (std::size_t i = 0; i + 1 < moments.size(); ++i) {
        for (int k = 1; k <= kSamples; ++k) {
            const DVec2 now = offsetAt(moments[i] + (moments[i + 1] - moments[i]) * k / kSamples);
            if (before.x * now.x < 0) {
                const double t = before.x / (before.x - now.x);
                if (std::abs(before.y + t * (now.y - before.y)) < kPlankHalf) { isThrough = !isThrough; }
            }
            before = now;
        }
    }
    return isThrough;
}

struct Shot {
    bool met = false;      ///< there was an impact
    bool behind = false;   ///< it was on the other side of the plank, within the plank's length
    bool crossed = false;  ///< it got there through the plank, not round an end
    double lost = 0;       ///< s
};

/// What is shot, how fast it turns at most, and the surface of it and of the plank.
struct Ammunition {
    Polygon polygon;
    double spin = 0;
    double friction = 1;
    double restitution = 0;
};

/// A bullet, and a plank that is free to move, and maybe comes towards it. Off its centre the plank begins to turn, and
/// the bullet may get round its end.
Shot shootAtPlank(const Ammunition& what, double speed, double plankSpeed, double aim, std::uint64_t seed,
                  int steps = 4) {
    World world = makeWorld(0);
    Random random(seed);
    const ShapeDef surface = material(what.friction, what.restitution);
    BodyDef def = dynamicAt({}, vec(-plankSpeed, 0));
    def.angle = random.range(-0.3, 0.3);
    const BodyId plank = addBody(world, def, box(0.025, kPlankHalf), surface);
    const double x = -1 - random.uniform() * speed * kStep;
    BodyDef shotDef = bulletAt({x, aim * random.range(-1, 1)}, vec(speed, 0));
    if (what.spin > 0) {
        shotDef.angularVelocity = real(random.range(-what.spin, what.spin));
        shotDef.angle = random.range(0, 2 * kPi);
    }
    const BodyId bullet = addBody(world, shotDef, what.polygon, surface);
    Shot shot;
    for (int i = 0; i < steps; ++i) {
        const Place bulletStart{0, world.position(bullet), world.angle(bullet)};
        const Place plankStart{0, world.position(plank), world.angle(plank)};
        must(world.step(kStep));
        for (const LostTimeEntry& entry : world.lostTime()) { shot.lost += entry.seconds; }
        for (const ContactEvent& event : world.contactEvents()) {
            shot.met = shot.met || event.type == ContactEventType::hit;
        }
        const DVec2 offset = turned(world.position(bullet) - world.position(plank), -world.angle(plank));
        shot.behind = shot.behind || (offset.x > 0 && std::abs(offset.y) < kPlankHalf);
        shot.crossed = shot.crossed || crosses(Way(world, bullet, bulletStart), Way(world, plank, plankStart));
    }
    return shot;
}

TEST(Bullets, NeverPassAPlank) {
    std::array<int, 2> behind{};
    for (const double approach : {0.0, 0.5}) {
        for (const double restitution : {0.0, 1.0}) {
            for (const double speed : {30.0, 100.0, 300.0, 3000.0}) {
                double lost = 0;
                const Ammunition ball{.polygon = circle(0.05), .restitution = restitution};
                for (std::uint64_t seed = 0; seed < 200; ++seed) {
                    const std::string name = std::to_string(speed) + " m/s, plank at " +
                                             std::to_string(approach * speed) + ", e " + std::to_string(restitution) +
                                             ", seed " + std::to_string(seed);
                    const Shot aside = shootAtPlank(ball, speed, approach * speed, 0.7, seed);
                    EXPECT_TRUE(aside.met) << name;
                    EXPECT_FALSE(aside.crossed) << name << ", aside";
                    behind[restitution > 0 ? 1 : 0] += aside.behind ? 1 : 0;
                    const Shot centred = shootAtPlank(ball, speed, approach * speed, 0, seed);
                    EXPECT_TRUE(centred.met) << name;
                    EXPECT_FALSE(centred.behind) << name;
                    lost += centred.lost + aside.lost;
                }
                EXPECT_EQ(lost, 0) << speed << " e " << restitution;
            }
        }
    }
    for (const int some : behind) {
        EXPECT_GT(some, 10) << "some get round an end: those prove that going round is told from passing";
    }
    RecordProperty("round an end, e 0", behind[0]);
    RecordProperty("round an end, e 1", behind[1]);
}

/// Whatever it is, and however it turns: it bounces, slides, rides and tips on the plank, and stays on its side.
TEST(Bullets, OfAllShapesNeverPassAPlank) {
    int met = 0;
    int shots = 0;
    double lost = 0;
    for (const Polygon& polygon : {circle(0.05), box(0.05, 0.05), box(0.1, 0.01), capsule(0.08, 0.02)}) {
        for (const double friction : {0.0, 0.3, 1.0}) {
            for (const double restitution : {0.0, 0.3}) {
                const Ammunition what{polygon, 50, friction, restitution};
                for (const double speed : {30.0, 100.0, 300.0, 3000.0}) {
                    for (std::uint64_t seed = 0; seed < 24; ++seed) {
                        const double plankSpeed = seed % 2 == 0 ? 0 : 0.5 * speed;
                        const Shot shot = shootAtPlank(what, speed, plankSpeed, 0.7, seed, 6);
                        EXPECT_FALSE(shot.crossed)
                            << polygon.count << " vertices, mu " << friction << ", e " << restitution << ", " << speed
                            << " m/s, plank at " << plankSpeed << ", seed " << seed;
                        met += shot.met ? 1 : 0;
                        lost += shot.lost;
                        ++shots;
                    }
                }
            }
        }
    }
    EXPECT_GT(met, 0.99 * shots);
    expectAtMost("lost time, of each shot", lost / shots, 1e-4);
}

/// Bodies that are thrown about in a closed chamber, every fourth a bullet: who is caught between another one and a
/// wall stays inside, however thin the wall.
TEST(Bullets, PressNobodyThroughAWall) {
    constexpr double kHalf = 10;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        World world = makeWorld(seed % 2 == 0 ? 0 : kGravity);
        const BodyId chamber = must(world.createBody({}));
        for (const double side : {-kHalf, kHalf}) {
            const bool isThin = seed % 3 != 0;
            const auto wall = [&](double x, double y) {
                return must(makeBox(vec(x, y), x < y ? vec(side, 0) : vec(0, side)));
            };
            must(world.addShape(chamber, isThin ? segment(side, -kHalf, side, kHalf) : wall(0.05, kHalf)));
            must(world.addShape(chamber, isThin ? segment(-kHalf, side, kHalf, side) : wall(kHalf, 0.05)));
        }
        Random random(seed);
        const std::vector<BodyId> bodies = throwCrowd(world, random, 30, [&](int i, BodyDef& def, ShapeDef& surface) {
            def.bullet = i % 4 == 0;
            surface.restitution = i % 2 == 0 ? Real(0) : real(random.range(0, 1));
        });
        for (int step = 0; step < 120; ++step) {
            run(world, 1);
            ASSERT_TRUE(areInside(world, bodies, kHalf)) << "seed " << seed << ", step " << step;
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
        for (int i = 0; i < 4; ++i) {
            boxes.push_back(addBody(world, dynamicAt({0, 0.25 + 0.5 * i}), box(0.25, 0.25)));
        }
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

/// Cost grows with what their paths come near, not with the pairs that there are.
TEST(Bullets, LookAtNothingFarFromTheirPaths) {
    for (const double speed : {0.5, 30.0, 300.0}) {
        World world = makeWorld(0);
        Random random(11);
        constexpr int kSide = 16;
        for (int i = 0; i < kSide * kSide; ++i) {
            const DVec2 place{6.0 * (i % kSide), 6.0 * (i / kSide)};
            const double angle = random.range(-3, 3);
            addBody(world, bulletAt(place, vec(speed * std::cos(angle), speed * std::sin(angle))), circle(0.1));
            addBody(world, dynamicAt(place + DVec2{3, 3}), box(0.2, 0.2));
        }
        std::uint64_t calls = 0;
        for (int step = 0; step < 10; ++step) {
            run(world, 1);
            calls += world.counters().toiCalls;
        }
        EXPECT_LT(calls, 10U * kSide * kSide) << speed << " m/s: less than one search for a bullet and step";
        if (speed < 1) { EXPECT_EQ(calls, 0U); }
    }
}

/// What the solver moves slowly looks for nobody: a pile of bullets costs what any pile does.
TEST(Bullets, InAPileAreNotSwept) {
    World world = makeWorld();
    addStatic(world, segment(-20, 0, 20, 0));
    for (int i = 0; i < 40; ++i) {
        addBody(world, bulletAt({i % 8 * 0.52 - 2, 0.3 + 0.55 * (i / 8)}, {}), box(0.25, 0.25));
    }
    runFor(world, 0.5);
    EXPECT_EQ(world.counters().sweeps, 0U);
}

/// Shoots at a plank, a bullet, that stands on a box: who flies is a bullet, too, or is not. @param rest  seconds for
/// both to come to rest, and then to sleep
void shootAtAPlankAtRest(double rest, double speed, bool isBullet, double offset) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    addStatic(world, segment(-20, 0, 50, 0), material(0.5));
    addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5));
    const BodyId plank = addBody(world, bulletAt({0, 1.5}, {}), box(0.02, 0.5));
    runFor(world, rest);
    EXPECT_EQ(world.isAwake(plank), rest < 1);
    BodyDef def = dynamicAt({-1 - speed * kStep * offset, 1.6}, vec(speed, 0));
    def.bullet = isBullet;
    const BodyId ball = addBody(world, def, circle(0.03), material(0, 0, 0.1));
    for (int step = 0; step < 6; ++step) {
        must(world.step(kStep));
        const Vec2 across = rotate(rotationFromAngle(world.angle(plank)), {1, 0});
        ASSERT_LT(dot(world.position(ball) - world.position(plank), toDouble(across)), 0) << "step " << step;
    }
    EXPECT_GT(world.velocity(plank).x, 0);
}

/// But what flies finds it, whether it is a bullet itself or not.
TEST(Bullets, AtRestAreMetByWhatFlies) {
    for (const double rest : {0.05, 0.2, 3.0}) {
        for (const double speed : {30.0, 300.0}) {
            for (const bool isBullet : {false, true}) {
                for (int i = 0; i < 40; ++i) {
                    SCOPED_TRACE(std::to_string(rest) + " s, " + std::to_string(speed) + " m/s, " +
                                 (isBullet ? "a bullet, " : "no bullet, ") + std::to_string(i));
                    ASSERT_NO_FATAL_FAILURE(shootAtAPlankAtRest(rest, speed, isBullet, i / 40.0));
                }
            }
        }
    }
}

/// What becomes a partner late has to be found as well: the bullet comes to it by way of a wall.
TEST(Bullets, MeetWhatABounceSendsThemTo) {
    World world = makeWorld(0);
    addStatic(world, box(0.1, 5), material(0, 1), {2, 0});
    const BodyId far = addBody(world, dynamicAt({-2, 0}), box(0.01, 1), material(0, 1));
    const BodyId bullet = addBody(world, bulletAt({1, 0}, vec(300, 0)), circle(0.1), material(0, 1));
    run(world, 1);  // 5 m: 0.8 to the wall, 2.8 to the plank, and on
    EXPECT_GT(world.position(bullet).x, world.position(far).x);
    EXPECT_LT(velocityOf(world, far).x, -1);
}

/// What was fast, is put elsewhere and to sleep there begins anew where it is, though no step looked at it since.
TEST(Bullets, WakeWhatWasPutToSleepElsewhere) {
    World world = makeWorld(0);
    addStatic(world, box(50, 0.1), {}, {0, 25});
    const BodyId pooled = addBody(world, dynamicAt({0, 0}, vec(0, -300)), circle(0.2));
    run(world, 3);
    must(world.setPose(pooled, {0, 50}, 0));
    must(world.setAwake(pooled, false));
    addBody(world, bulletAt({-3, 50}, vec(300, 0)), circle(0.1));
    run(world, 1);
    ASSERT_TRUE(world.isAwake(pooled));
    EXPECT_GT(world.velocity(pooled).x, 10);
    EXPECT_NEAR(world.position(pooled).y, 50, 1e-3);
    EXPECT_TRUE(world.lostTime().empty());
}

}  // namespace
}  // namespace swept::test

#include "../support/random.h"
#include "world_support.h"

/// What resists rolling, against closed forms: a disk that rolls has 3/2 of its mass, and the torque c·r·N acts like a
/// force c·N at its centre.

namespace swept::test {
namespace {

constexpr double kRollRadius = 0.5;
constexpr double kInertiaShare = 1.5;  // of a disk that rolls

ShapeDef rough(double resistance, double friction = 1, double restitution = 0) {
    ShapeDef def = material(friction, restitution);
    def.rollingResistance = real(resistance);
    return def;
}

World rollingWorld(Profile profile, bool sleep = false) {
    WorldSettings settings = awakeSettings(profile);
    settings.sleep = sleep;
    return makeWorld(settings);
}

BodyId addRolling(World& world, DVec2 position, double speed, const ShapeDef& surface, double radius = kRollRadius) {
    return addBody(world, dynamicAt(position, vec(speed, 0), -speed / radius), circle(radius), surface);
}

/// On level ground after two seconds.
struct Rolled {
    double lost = 0;  ///< of the speed, m/s
    double slip = 0;  ///< m/s
    double way = 0;   ///< metres
};

Rolled roll(Profile profile, const ShapeDef& ground, const ShapeDef& ball, double speed) {
    World world = rollingWorld(profile);
    addStatic(world, box(1000, 1), ground, {0, -1});
    const BodyId body = addRolling(world, {0, kRollRadius}, speed, ball);
    runFor(world, 2);
    const double now = velocityOf(world, body).x;
    return {std::abs(speed) - std::abs(now), spinOf(world, body) * kRollRadius + now, std::abs(world.position(body).x)};
}

/// Whichever of both surfaces is rough, and where it may bounce, too. What is fast turns by radians in a step, and
/// loses a trace without that.
TEST(Rolling, SlowsDownABall) {
    const double resistance = 0.06;
    const double brake = resistance * kGravity / kInertiaShare;
    struct Case {
        double ofGround;
        double ofBall;
        double restitution;
        double speed;
    };
    const Case cases[] = {{0, resistance, 0, 3},    {resistance, 0, 0, -3}, {resistance, 0.5 * resistance, 0, 3.5},
                          {0, resistance, 0.5, -4}, {0, resistance, 0, 40}, {resistance, 0, 0, 150}};
    for (const Profile profile : kProfiles) {
        for (const Case& c : cases) {
            const Rolled rolled = roll(profile, rough(c.ofGround), rough(c.ofBall, 1, c.restitution), c.speed);
            const Rolled smooth = roll(profile, rough(0), rough(0, 1, c.restitution), c.speed);
            const double speed = std::abs(c.speed);
            const std::string name = profileName(profile) + ", " + std::to_string(c.speed) + " m/s, ";
            expectAtMost(name + "lost", std::abs(rolled.lost - smooth.lost - 2 * brake),
                         2e-3 * brake + (kIsDouble ? 0 : 1e-4 * speed));
            expectAtMost(name + "smooth", std::abs(smooth.lost), 1.5e-4 * speed);
            expectAtMost(name + "slip", std::abs(rolled.slip), 5e-4 * speed);
            expectAtMost(name + "way", std::abs(rolled.way / (2 * speed - 2 * brake) - 1), 1e-3);
        }
    }
}

/// Over the seams of a chain, and of boxes side by side, as on level ground.
TEST(Rolling, SlowsDownOverSeams) {
    const double brake = 0.06 * kGravity / kInertiaShare;
    for (const Profile profile : kProfiles) {
        for (const bool isChain : {true, false}) {
            World world = rollingWorld(profile);
            if (isChain) {
                std::vector<Vec2> points;
                for (int i = 0; i <= 80; ++i) { points.push_back(vec(20 - 0.5 * i, 0)); }
                must(world.addChain(must(world.createBody({})), points, false, rough(0)));
            } else {
                for (int i = 0; i < 40; ++i) { addStatic(world, box(0.5, 0.5), rough(0), {-20.0 + i, -0.5}); }
            }
            const BodyId ball = addRolling(world, {0.1, kRollRadius}, 3, rough(0.06));
            runFor(world, 2);
            const std::string name = profileName(profile) + ", " + (isChain ? "chain, " : "boxes, ");
            expectAtMost(name + "lost", std::abs((3 - velocityOf(world, ball).x) / (2 * brake) - 1), 0.01);
        }
    }
}

/// It stops where the work of the torque has taken its energy, and sleeps.
TEST(Rolling, StopsABall) {
    const double resistance = 0.1;
    const double brake = resistance * kGravity / kInertiaShare;
    for (const Profile profile : kProfiles) {
        for (const bool sleeps : {true, false}) {
            World world = rollingWorld(profile, sleeps);
            addStatic(world, box(50, 1), rough(0), {0, -1});
            const BodyId ball = addRolling(world, {0, kRollRadius}, 2, rough(resistance));
            runFor(world, 2 / brake + 2);
            EXPECT_EQ(world.isAwake(ball), !sleeps);
            expectAtMost(profileName(profile) + ", speed", length(velocityOf(world, ball)), sleeps ? 0 : 1e-6);
            expectAtMost(profileName(profile) + ", spin", std::abs(spinOf(world, ball)), sleeps ? 0 : 1e-6);
            const DVec2 place = world.position(ball);
            expectAtMost(profileName(profile) + ", way", std::abs(place.x / (2 * 2 / (2 * brake)) - 1), 5e-3);
            runFor(world, 10);
            expectAtMost(profileName(profile) + ", creeps", length(world.position(ball) - place), sleeps ? 0 : 1e-6);
        }
    }
}

BodyId onSlope(World& world, double tilt, const ShapeDef& surface, const Polygon& polygon = circle(kRollRadius)) {
    addStatic(world, box(200, 1), material(1), turned({0, -1}, tilt), tilt);
    BodyDef def = dynamicAt(turned({0, kRollRadius}, tilt));
    def.angle = tilt;
    return addBody(world, def, polygon, surface);
}

double subStepOf(Profile profile) { return kStep / (profile == Profile::fast ? 4 : 16); }

/// On slopes up to the tangent c it stays, asleep or not; on steeper ones it rolls as fast as the rest of its weight
/// lets it.
TEST(Rolling, HoldsABallOnASlope) {
    const double tilt = std::atan(0.2);
    for (const Profile profile : kProfiles) {
        for (const double ratio : {1.02, 0.98, 0.5}) {
            World world = rollingWorld(profile);
            const BodyId ball = onSlope(world, tilt, rough(0.2 * ratio));
            const DVec2 start = world.position(ball);
            runFor(world, 3);
            const DVec2 moved = world.position(ball) - start;
            const double speed = dot(velocityOf(world, ball), turned({-1, 0}, tilt));
            const std::string name = profileName(profile) + ", " + std::to_string(ratio) + ": ";
            if (ratio > 1) {
                expectAtMost(name + "speed", length(velocityOf(world, ball)), 1e-6);
                expectAtMost(name + "moved", length(moved), 1e-3);
                EXPECT_EQ(world.counters().settledBodies, 1u) << "held in balance";
                runFor(world, 20);
                expectAtMost(name + "creeps", length(world.position(ball) - start - moved), 1e-5);
            } else {
                const double pull = kGravity * (std::sin(tilt) - 0.2 * ratio * std::cos(tilt)) / kInertiaShare;
                // As it starts its contact carries nothing yet: for less than half of a sub-step it rolls freely.
                const double free = kGravity * std::sin(tilt) / kInertiaShare * subStepOf(profile);
                expectAtMost(name + "speed", std::abs(speed - pull * 3), ratio > 0.9 ? free / 2 : 2e-3 * pull * 3);
            }
        }
    }
}

/// Asleep, held in balance or neither, woken, changed, at steps of other lengths: nothing makes it start.
TEST(Rolling, IsNotStartedByWaking) {
    const double tilt = std::atan(0.1);
    for (const Profile profile : kProfiles) {
        for (const bool sleeps : {true, false}) {
            World world = rollingWorld(profile, sleeps);
            const BodyId ball = onSlope(world, tilt, rough(0.12));
            runFor(world, 5);
            EXPECT_EQ(world.isAwake(ball), !sleeps);
            const DVec2 place = world.position(ball);
            for (int i = 0; i < 20; ++i) {
                must(world.setAwake(ball, true));
                run(world, 7);
                ShapeDef def = rough(0.12, i % 2 == 0 ? 0.8 : 1);
                world.visitShapes(ball, [&](ShapeId shape) { must(world.redefine(shape, def)); });
                run(world, 7, i % 3 == 0 ? kStep / 2 : kStep);
            }
            runFor(world, 3);
            EXPECT_EQ(world.isAwake(ball), !sleeps);
            expectAtMost(profileName(profile) + ", moved", length(world.position(ball) - place), 1e-9);
        }
    }
}

/// It is held until it is made smooth; made rough, it stops.
TEST(Rolling, ChangesAtOnce) {
    const double tilt = std::atan(0.1);
    for (const Profile profile : kProfiles) {
        World world = rollingWorld(profile, true);
        const BodyId ball = onSlope(world, tilt, rough(0.2));
        ShapeId shape;
        world.visitShapes(ball, [&](ShapeId id) { shape = id; });
        runFor(world, 3);
        EXPECT_FALSE(world.isAwake(ball));
        must(world.redefine(shape, rough(0)));
        EXPECT_TRUE(world.isAwake(ball));
        EXPECT_EQ(world.definition(shape).rollingResistance, 0);
        runFor(world, 1);
        const double free = kGravity * std::sin(tilt) / kInertiaShare;
        expectAtMost(profileName(profile) + ", free", std::abs(length(velocityOf(world, ball)) / free - 1), 3e-3);
        must(world.redefine(shape, rough(0.2)));
        run(world, 12);
        const double brake = kGravity * (0.2 * std::cos(tilt) - std::sin(tilt)) / kInertiaShare;
        expectAtMost(profileName(profile) + ", braked",
                     std::abs((free - length(velocityOf(world, ball))) / (brake * 0.2) - 1), 0.02);
        runFor(world, 4);
        EXPECT_FALSE(world.isAwake(ball));
    }
}

/// In the air it turns as if there were none, to the bit.
TEST(Rolling, DoesNothingInTheAir) {
    World rolls = makeWorld();
    World smooth = makeWorld();
    const BodyId a = addBody(rolls, dynamicAt({0, 100}, vec(3, 1), 7), circle(kRollRadius), rough(1));
    const BodyId b = addBody(smooth, dynamicAt({0, 100}, vec(3, 1), 7), circle(kRollRadius), rough(0));
    runFor(rolls, 2);
    runFor(smooth, 2);
    EXPECT_EQ(spinOf(rolls, a), 7);
    EXPECT_EQ(rolls.position(a), smooth.position(b));
}

/// Sharp shapes have no radius to roll on; where two points touch, they hold the turn themselves.
TEST(Rolling, DoesNothingToBoxes) {
    for (const Profile profile : kProfiles) {
        World rolls = rollingWorld(profile);
        World smooth = rollingWorld(profile);
        for (World* const world : {&rolls, &smooth}) {
            const ShapeDef surface = rough(world == &rolls ? 1 : 0, 0.5);
            addStatic(*world, box(50, 1), surface, {0, -1});
            for (int i = 0; i < 6; ++i) {
                addBody(*world, dynamicAt({1.7 * i, 1.0 + i}, vec(3, 0), 2), box(0.5, 0.3), surface);
            }
        }
        runFor(rolls, 3);
        runFor(smooth, 3);
        EXPECT_EQ(rolls.stateHash(), smooth.stateHash());
    }
}

/// A pebble on a boulder rolls off where it is too steep for its own radius, however large the boulder is.
TEST(Rolling, TakesTheSmallerOfTwoCircles) {
    const double pebble = 0.1;
    const double boulder = 10;
    for (const Profile profile : kProfiles) {
        for (const double ratio : {0.95, 1.1}) {
            World world = rollingWorld(profile);
            addStatic(world, circle(boulder), rough(0.1), {0, -boulder});
            const double turn = std::atan(0.1 * ratio);
            const DVec2 place = turned({0, boulder + pebble}, -turn) - DVec2{0, boulder};
            const BodyId ball = addBody(world, dynamicAt(place), circle(pebble), rough(0.05));
            runFor(world, 3);
            const double moved = length(world.position(ball) - place);
            if (ratio < 1) {
                expectAtMost(profileName(profile) + ", stays", moved, 1e-3);  // it sinks in
            } else {
                EXPECT_GT(moved, 0.2);
            }
        }
    }
}

/// A capsule on end falls over where it leans by more than its torque holds: c·r of its centre beside its foot.
TEST(Rolling, HoldsWhatStandsOnItsRound) {
    for (const Profile profile : kProfiles) {
        for (const double ratio : {0.9, 1.1}) {
            World world = rollingWorld(profile);
            addStatic(world, box(50, 1), rough(0.5), {0, -1});
            // Its centre is 0.4 above that of its foot, of radius 0.2.
            BodyDef def = dynamicAt({0, 0});
            def.angle = std::asin(0.5 * 0.2 * ratio / 0.4);
            def.position = {0, 0.2 + 0.4 * std::cos(def.angle)};
            const Polygon pin = must(makeCapsule(vec(0, -0.4), vec(0, 0.4), real(0.2)));
            const BodyId body = addBody(world, def, pin, rough(0));
            runFor(world, 3);
            const double turn = std::abs(world.angle(body) - def.angle);
            if (ratio < 1) {
                expectAtMost(profileName(profile) + ", stands", turn, 1e-4);
            } else {
                EXPECT_GT(turn, 1);
            }
        }
    }
}

/// What would be solved all at once is iterated, and resists: a heavy ball on a light plank that friction holds.
TEST(Rolling, SlowsDownAHeavyBallOnALightPlank) {
    for (const Profile profile : kProfiles) {
        World world = rollingWorld(profile);
        addStatic(world, box(50, 1), material(4), {0, -1});
        addBody(world, dynamicAt({0, 0.1}), box(10, 0.1), material(4, 0, 0.2));
        ShapeDef heavy = rough(0.1);
        heavy.density = 10;
        const BodyId ball = addRolling(world, {-5, 0.2 + kRollRadius}, 3, heavy);
        runFor(world, 2);
        EXPECT_EQ(world.counters().directBodies, 0u);
        const double brake = 0.1 * kGravity / kInertiaShare;
        expectAtMost(profileName(profile) + ", lost", std::abs((3 - velocityOf(world, ball).x) / (2 * brake) - 1),
                     0.01);
    }
}

/// A belt turns a disk where it lies, which resists that, and so is carried along at last without turning.
TEST(Rolling, IsCarriedByABelt) {
    for (const Profile profile : kProfiles) {
        World world = rollingWorld(profile);
        ShapeDef belt = rough(0);
        belt.surfaceSpeed = 2;
        addStatic(world, box(100, 1), belt, {0, -1});
        const BodyId disk = addBody(world, dynamicAt({0, kRollRadius}), circle(kRollRadius), rough(0.1));
        runFor(world, 6);
        expectAtMost(profileName(profile) + ", speed", std::abs(velocityOf(world, disk).x / 2 - 1), 1e-3);
        expectAtMost(profileName(profile) + ", spin", std::abs(spinOf(world, disk)), 1e-3);
    }
}

/// Fifty disks of several sizes, poured into a tray: they lose energy, come to rest and sleep.
TEST(Rolling, LetsAHeapComeToRest) {
    for (const Profile profile : kProfiles) {
        for (const double resistance : {0.02, 0.3, 3.0}) {
            World world = rollingWorld(profile, true);
            addStatic(world, box(6, 1), rough(0), {0, -1});
            addStatic(world, box(1, 4), rough(0), {-7, 3});
            addStatic(world, box(1, 4), rough(0), {7, 3});
            Random random(11);
            std::vector<BodyId> disks;
            for (int i = 0; i < 50; ++i) {
                const double radius = random.range(0.2, 0.4);
                const DVec2 place{-4 + 0.9 * (i % 10) + random.range(0, 0.05), 0.6 + 0.9 * (i / 10)};
                disks.push_back(addBody(world, dynamicAt(place), circle(radius), rough(resistance, 0.5)));
            }
            double energy = energyOf(world, disks, kGravity);
            const double start = energy;
            double gained = 0;
            for (int i = 0; i < 90; ++i) {
                run(world, 10);
                const double now = energyOf(world, disks, kGravity);
                gained = std::max(gained, now - energy);
                energy = now;
            }
            const std::string name = profileName(profile) + ", " + std::to_string(resistance) + ": ";
            expectAtMost(name + "gained", gained / start, 1e-3);
            expectAtMost(name + "overlap", deepestOverlap(world), 5e-3);
            for (const BodyId disk : disks) { EXPECT_FALSE(world.isAwake(disk)) << name; }
        }
    }
}

TEST(Rolling, RefusesBadValues) {
    World world = makeWorld();
    const BodyId ground = must(world.createBody({}));
    const ShapeId shape = must(world.addShape(ground, box(1, 1)));
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -0.1};
    for (const double resistance : bad) {
        const StatusCode code = resistance < 0 ? StatusCode::negative : StatusCode::notFinite;
        for (const Status& status : {world.addShape(ground, circle(1), rough(resistance)).status(),
                                     world.redefine(shape, rough(resistance))}) {
            EXPECT_EQ(status.code, code);
            EXPECT_STREQ(status.field, "rollingResistance");
        }
    }
    EXPECT_EQ(world.definition(shape).rollingResistance, 0);
}

}  // namespace
}  // namespace swept::test

#include "world_support.h"

/// Surfaces that run along the outline of a shape, against closed forms.

namespace swept::test {
namespace {

ShapeDef belt(double speed, double friction = 0.5) {
    ShapeDef def = material(friction);
    def.surfaceSpeed = real(speed);
    return def;
}

World beltWorld(Profile profile, bool sleep = false) {
    WorldSettings settings = awakeSettings(profile);
    settings.sleep = sleep;
    return makeWorld(settings);
}

std::string beltCase(Profile profile, double speed) {
    return (profile == Profile::fast ? "fast, " : "accurate, ") + std::to_string(speed) + " m/s: ";
}

/// It is dragged along at μg until it is as fast as the belt.
TEST(Belts, CarryABox) {
    for (const Profile profile : kProfiles) {
        for (const double speed : {2.0, -3.0}) {
            World world = beltWorld(profile);
            addStatic(world, box(50, 1), belt(speed), {0, -1});
            const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
            runFor(world, 2);
            const double dragged = speed * speed / (2 * 0.5 * kGravity);
            const double way = std::abs(speed) * 2 - dragged;
            expectAtMost(beltCase(profile, speed) + "speed", std::abs(velocityOf(world, body).x / speed - 1), 1e-4);
            expectAtMost(beltCase(profile, speed) + "way", std::abs(std::abs(world.position(body).x) / way - 1), 5e-3);
            expectAtMost(beltCase(profile, speed) + "height", std::abs(world.position(body).y - 0.5), 1e-3);
        }
    }
}

/// Masses ten to one are solved all at once in profile `accurate`: both methods know belts.
TEST(Belts, CarryATower) {
    for (const Profile profile : kProfiles) {
        World world = beltWorld(profile);
        addStatic(world, box(50, 1), belt(4, 0.3), {0, -1});
        std::vector<BodyId> tower;
        for (int i = 0; i < 3; ++i) {
            const ShapeDef surface = material(i == 0 ? 0.3 : 3, 0, i == 2 ? 10 : 1);
            tower.push_back(addBody(world, dynamicAt({0, 0.5 + i}), box(1, 0.5), surface));
        }
        runFor(world, 0.5);
        for (const BodyId body : tower) {
            expectAtMost(beltCase(profile, 4) + "dragged",
                         std::abs(velocityOf(world, body).x / (0.3 * kGravity * 0.5) - 1), 0.02);
        }
        runFor(world, 2);
        for (const BodyId body : tower) {
            expectAtMost(beltCase(profile, 4) + "carried", std::abs(velocityOf(world, body).x / 4 - 1), 1e-3);
        }
    }
}

/// Up a slope that friction holds it on; down one that is too steep for that, whatever the belt does.
TEST(Belts, RunUpASlope) {
    const double tilt = kPi / 6;
    for (const Profile profile : kProfiles) {
        for (const bool holds : {true, false}) {
            const double friction = (holds ? 1.5 : 0.5) * std::tan(tilt);
            World world = beltWorld(profile);
            addStatic(world, box(200, 1), belt(2, friction), turned({0, -1}, tilt), tilt);
            BodyDef def = dynamicAt(turned({0, 0.5}, tilt));
            def.angle = tilt;
            const BodyId body = addBody(world, def, box(0.5, 0.5), material(friction));
            runFor(world, 2);
            const double speed = dot(velocityOf(world, body), turned({1, 0}, tilt));
            const double sliding = -kGravity * (std::sin(tilt) - friction * std::cos(tilt)) * 2;
            const double expected = holds ? 2 : sliding;
            expectAtMost(beltCase(profile, 2) + (holds ? "up" : "down"), std::abs(speed / expected - 1), 3e-3);
        }
    }
}

/// The impulse that makes it roll on the belt moves it by a third of that speed, and turns it by the rest.
TEST(Belts, SetADiskTurning) {
    for (const Profile profile : kProfiles) {
        World world = beltWorld(profile);
        addStatic(world, box(50, 1), belt(3), {0, -1});
        const BodyId disk = addBody(world, dynamicAt({0, 0.5}), circle(0.5), material(0.5));
        runFor(world, 2);
        expectAtMost(beltCase(profile, 3) + "speed", std::abs(velocityOf(world, disk).x / 1 - 1), 5e-3);
        expectAtMost(beltCase(profile, 3) + "turn", std::abs(spinOf(world, disk) * 0.5 / 2 - 1), 5e-3);
    }
}

/// A body with a track: its outline runs to the left where it stands. On a belt both add up, as on a platform.
TEST(Belts, DriveTheirOwnBody) {
    for (const Profile profile : kProfiles) {
        for (const double ground : {0.0, 1.5}) {
            for (const double platform : {0.0, 0.5}) {
                World world = beltWorld(profile);
                BodyDef def = bodyAt(BodyType::kinematic, {0, -1});
                def.velocity = vec(platform, 0);
                addBody(world, def, box(50, 1), belt(ground));
                const BodyId tracked = addBody(world, dynamicAt({0, 0.5}), box(1, 0.5), belt(2));
                runFor(world, 2);
                const double speed = 2 + ground + platform;
                expectAtMost(beltCase(profile, speed) + "speed", std::abs(velocityOf(world, tracked).x / speed - 1),
                             1e-3);
            }
        }
    }
}

/// What drives on a body that can move pushes that back: on ice both part with the speed of the track, and no momentum;
/// on rough ground a heavy one stays. (Taken for what contacts must not give, it was taken back.)
TEST(Belts, DriveOnWhatCanMove) {
    for (const Profile profile : kProfiles) {
        for (const bool isIce : {true, false}) {
            World world = beltWorld(profile);
            addStatic(world, box(100, 1), material(isIce ? 0 : 1), {0, -1});
            const BodyId cart = addBody(world, dynamicAt({0, 0.5}), box(8, 0.5), material(0.5, 0, isIce ? 0.25 : 4));
            const BodyId tank = addBody(world, dynamicAt({-4, 1.3}), box(0.6, 0.3), belt(1));
            runFor(world, 2);
            const double slip = velocityOf(world, tank).x - velocityOf(world, cart).x;
            const double momentum =
                world.mass(tank) * velocityOf(world, tank).x + world.mass(cart) * velocityOf(world, cart).x;
            const std::string name = beltCase(profile, 1) + (isIce ? "ice, " : "rough, ");
            expectAtMost(name + "speed", std::abs(slip - 1), 1e-3);
            if (isIce) {
                // The ice pushes along the face that touches, the cart's or its own; the cart leans by a trace.
                expectAtMost(name + "momentum", std::abs(momentum) / world.mass(tank), 2e-3);
            } else {
                expectAtMost(name + "cart", std::abs(velocityOf(world, cart).x), 1e-4);
            }
        }
    }
}

/// A belt without friction is none: what lies on it sleeps.
TEST(Belts, DoNothingWithoutFriction) {
    World world = beltWorld(Profile::fast, true);
    addStatic(world, box(50, 1), belt(2, 0), {0, -1});
    const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
    runFor(world, 3);
    EXPECT_FALSE(world.isAwake(body));
    EXPECT_EQ(world.position(body).x, 0);
}

/// Round the whole outline: under a ceiling it is carried to the left; ground of a chain runs against its direction.
TEST(Belts, RunRoundTheOutline) {
    World world = makeWorld(-kGravity);
    addStatic(world, box(50, 1), belt(2), {0, 1});
    const BodyId hung = addBody(world, dynamicAt({0, -0.5}), box(0.5, 0.5), material(0.5));
    runFor(world, 1);
    expectAtMost("under a ceiling", std::abs(velocityOf(world, hung).x / -2 - 1), 1e-3);

    World terrain = makeWorld();
    const std::vector<Vec2> points{vec(50, 0), vec(2, 0), vec(-3, 0), vec(-50, 0)};
    must(terrain.addChain(must(terrain.createBody({})), points, false, belt(2)));
    const BodyId body = addBody(terrain, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
    runFor(terrain, 2);
    expectAtMost("on a chain", std::abs(velocityOf(terrain, body).x / 2 - 1), 1e-3);
}

/// What hits a belt at its time of impact is thrown along: as fast as friction can, no faster than the belt.
TEST(Belts, ThrowWhatHitsThem) {
    for (const Profile profile : kProfiles) {
        for (const double speed : {5.0, 1000.0}) {
            World world = beltWorld(profile);
            addStatic(world, box(50, 0.01), belt(speed, 0.2));
            BodyDef def = dynamicAt({0, 3}, vec(0, -300));
            def.fixedRotation = true;
            def.gravityScale = 0;
            const BodyId shot = addBody(world, def, circle(0.05), material(0.2, 1));
            run(world, 1);
            const double expected = std::min(speed, 0.2 * (300 + 300));
            expectAtMost(beltCase(profile, speed) + "along", std::abs(velocityOf(world, shot).x / expected - 1), 1e-4);
            expectAtMost(beltCase(profile, speed) + "back", std::abs(velocityOf(world, shot).y / 300 - 1), 1e-4);
        }
    }
}

/// A bullet and the track that it hits push each other apart; nothing else acts.
TEST(Belts, ThrowBullets) {
    World world = makeWorld(0);
    const BodyId track = addBody(world, dynamicAt({0, 0}), box(5, 0.1), belt(4, 0.2));
    BodyDef def = dynamicAt({0, 3}, vec(0, -300));
    def.bullet = true;
    def.fixedRotation = true;
    const BodyId bullet = addBody(world, def, circle(0.05), material(0.2, 1));
    const double thrown = world.mass(bullet) * 300;
    run(world, 3);
    EXPECT_GT(velocityOf(world, bullet).y, 0);
    EXPECT_GT(velocityOf(world, bullet).x, 1);
    EXPECT_LT(velocityOf(world, track).x, 0);
    const DVec2 momentum =
        world.mass(bullet) * velocityOf(world, bullet) + world.mass(track) * velocityOf(world, track);
    expectAtMost("momentum along", std::abs(momentum.x) / thrown, 1e-5);
    expectAtMost("momentum across", std::abs(momentum.y / thrown + 1), 1e-5);
}

/// Held by a wall, the box stays where it is, and the wall takes what friction drags.
TEST(Belts, SlipUnderWhatIsHeld) {
    for (const Profile profile : kProfiles) {
        World world = beltWorld(profile, true);
        addStatic(world, box(50, 1), belt(2), {0, -1});
        addStatic(world, box(0.5, 2), material(0), {1, 0});
        const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
        runFor(world, 10);
        EXPECT_TRUE(world.isAwake(body)) << "what a belt drags at stays awake";
        expectAtMost(beltCase(profile, 2) + "moved", length(world.position(body) - DVec2{0, 0.5}), 2e-3);
        double pushed = 0;
        world.visitContacts(body, [&](const ContactView& contact) {
            if (std::abs(contact.normal.x) > 0.5) { pushed += static_cast<double>(contact.impulse); }
        });
        const double dragged = 0.5 * world.mass(body) * kGravity * kStep;
        expectAtMost(beltCase(profile, 2) + "wall", std::abs(pushed / dragged - 1), 0.02);
    }
}

/// What lay still, asleep or held in balance, is carried off.
TEST(Belts, StartAndStop) {
    for (const Profile profile : kProfiles) {
        for (const bool sleeps : {true, false}) {
            World world = beltWorld(profile, sleeps);
            const BodyId ground = must(world.createBody(bodyAt(BodyType::fixed, {0, -1})));
            const ShapeId shape = must(world.addShape(ground, box(50, 1), belt(2)));
            const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
            runFor(world, 3);
            EXPECT_TRUE(world.isAwake(body));
            must(world.redefine(shape, belt(0)));
            runFor(world, 3);
            EXPECT_EQ(world.isAwake(body), !sleeps);
            expectAtMost(beltCase(profile, 0) + "speed", length(velocityOf(world, body)), 0);
            must(world.redefine(shape, belt(-1)));
            EXPECT_TRUE(world.isAwake(body)) << "a belt that starts wakes what lies on it";
            EXPECT_EQ(world.definition(shape).surfaceSpeed, Real(-1));
            runFor(world, 1);
            expectAtMost(beltCase(profile, -1) + "speed", std::abs(velocityOf(world, body).x / -1 - 1), 1e-3);
        }
    }
}

/// One segment of a chain starts under what lay still, asleep or held in balance; who lies on another lies on.
TEST(Belts, OfOneSegmentStartAndStop) {
    for (const Profile profile : kProfiles) {
        for (const bool sleeps : {true, false}) {
            World world = beltWorld(profile, sleeps);
            const std::vector<Vec2> points{vec(50, 0), vec(0, 0), vec(-50, 0)};
            const ShapeId chain = must(world.addChain(must(world.createBody({})), points, false, material(0.5)));
            const BodyId body = addBody(world, dynamicAt({20, 0.5}), box(0.5, 0.5), material(0.5));
            const BodyId other = addBody(world, dynamicAt({-20, 0.5}), box(0.5, 0.5), material(0.5));
            runFor(world, 3);
            EXPECT_EQ(world.isAwake(body), !sleeps);
            const DVec2 lay = world.position(other);
            must(world.setSurface(chain, 0, surfaceOf(belt(2))));
            EXPECT_TRUE(world.isAwake(body)) << "a belt that starts wakes what lies on it";
            runFor(world, 1);
            expectAtMost(beltCase(profile, 2) + "speed", std::abs(velocityOf(world, body).x / 2 - 1), 1e-3);
            EXPECT_EQ(world.position(other), lay) << beltCase(profile, 2);
            must(world.setSurface(chain, 0, surfaceOf(belt(0))));
            runFor(world, 3);
            EXPECT_EQ(world.isAwake(body), !sleeps);
            expectAtMost(beltCase(profile, 0) + "speed", length(velocityOf(world, body)), 0);
        }
    }
}

/// However slow: no body is too slow to be awake on it, nor in balance with it.
TEST(Belts, RunSlowly) {
    for (const Profile profile : kProfiles) {
        World world = beltWorld(profile, true);
        addStatic(world, box(50, 1), belt(1e-3), {0, -1});
        const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
        runFor(world, 20);
        expectAtMost(beltCase(profile, 1e-3) + "way", std::abs(world.position(body).x / 0.02 - 1), 0.02);
    }
}

TEST(Belts, RefuseBadSpeeds) {
    World world = makeWorld();
    const BodyId ground = must(world.createBody({}));
    for (const double speed : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const Result<ShapeId> shape = world.addShape(ground, box(1, 1), belt(speed));
        EXPECT_EQ(shape.status().code, StatusCode::notFinite);
        EXPECT_STREQ(shape.status().field, "surfaceSpeed");
    }
}

}  // namespace
}  // namespace swept::test

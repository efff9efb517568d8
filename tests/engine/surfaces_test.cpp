#include <array>

#include "world_digest.h"
#include "world_support.h"

/// Surfaces of single segments along one chain, against closed forms; who wakes when they change; what is refused.

namespace swept::test {
namespace {

Surface roughSurface(double friction) {
    Surface surface;
    surface.friction = real(friction);
    return surface;
}
Surface bouncy(double restitution) {
    Surface surface;
    surface.restitution = real(restitution);
    return surface;
}

/// Level ground from x = 60 to −60, whose middle segment is from 20 to 10.
struct Strip {
    const char* name;
    bool isLoop;
    double radius;
    std::array<Surface, 3> surfaces;

    ShapeId addTo(World& world, BodyId body) const {
        const double y = -radius;
        std::vector<Vec2> points{vec(60, y), vec(20, y), vec(10, y), vec(-60, y)};
        std::vector<Surface> all(surfaces.begin(), surfaces.end());
        if (isLoop) {
            points.insert(points.end(), {vec(-60, -5), vec(60, -5)});
            all.resize(6);
        }
        return must(world.addChain(body, {.points = points, .loop = isLoop, .radius = real(radius), .surfaces = all}));
    }
};
std::vector<Strip> strips(const std::array<Surface, 3>& surfaces) {
    return {{"open", false, 0, surfaces}, {"loop", true, 0, surfaces}, {"thick", false, 0.1, surfaces}};
}

std::string stripName(Profile profile, const Strip& strip) { return profileName(profile) + ", " + strip.name; }

/// On ice it keeps its speed; ten metres of roughSurface ground take μg from it all the way.
TEST(Surfaces, SlowABoxWhereTheyAreRough) {
    for (const Profile profile : kProfiles) {
        for (const Strip& strip : strips({roughSurface(0), roughSurface(0.5), roughSurface(0)})) {
            for (const double way : {1.0, -1.0}) {
                World world = makeWorld(profile);
                (void)strip.addTo(world, must(world.createBody({})));
                const double start = way > 0 ? 5 : 25;
                const BodyId body =
                    addBody(world, dynamicAt({start, 0.2}, vec(12 * way, 0)), box(0.2, 0.2), material(0.5));
                runFor(world, 0.25);
                const std::string name = stripName(profile, strip) + (way > 0 ? ", right" : ", left");
                expectAtMost(name + ", before", std::abs(velocityOf(world, body).x * way / 12 - 1), 1e-4);
                runFor(world, 1.5);
                EXPECT_GT((world.position(body).x - (way > 0 ? 20 : 10)) * way, 0.5) << name;
                const double left = std::sqrt(12 * 12 - 2 * 0.5 * kGravity * 10);
                expectAtMost(name + ", behind", std::abs(velocityOf(world, body).x * way / left - 1), 5e-3);
                const double now = velocityOf(world, body).x;
                runFor(world, 0.25);
                expectAtMost(name + ", on ice", std::abs(velocityOf(world, body).x / now - 1), 1e-4);
            }
        }
    }
}

/// On one that lasts, it comes to rest.
TEST(Surfaces, StopABoxWhereTheyAreRough) {
    for (const Profile profile : kProfiles) {
        for (const Strip& strip : strips({roughSurface(0), roughSurface(0.5), roughSurface(0)})) {
            World world = makeWorld(profile);
            (void)strip.addTo(world, must(world.createBody({})));
            const BodyId body = addBody(world, dynamicAt({8, 0.2}, vec(8, 0)), box(0.2, 0.2), material(0.5));
            runFor(world, 3);
            const double stop = 10 + 8 * 8 / (2 * 0.5 * kGravity);
            expectAtMost(stripName(profile, strip) + ", way", std::abs(world.position(body).x - stop), 0.05);
            expectAtMost(stripName(profile, strip) + ", speed", length(velocityOf(world, body)), 1e-6);
        }
    }
}

/// A belt of one segment carries, and leaves what it carried to the ice behind it.
TEST(Surfaces, CarryWhereTheyAreABelt) {
    Surface belt = roughSurface(0.5);
    belt.surfaceSpeed = 3;
    for (const Profile profile : kProfiles) {
        for (const Strip& strip : strips({roughSurface(0), belt, roughSurface(0)})) {
            World world = makeWorld(profile);
            (void)strip.addTo(world, must(world.createBody({})));
            const BodyId body = addBody(world, dynamicAt({12, 0.2}), box(0.2, 0.2), material(0.5));
            const BodyId aside = addBody(world, dynamicAt({5, 0.2}), box(0.2, 0.2), material(0.5));
            runFor(world, 1);
            expectAtMost(stripName(profile, strip) + ", carried", std::abs(velocityOf(world, body).x / 3 - 1), 1e-3);
            runFor(world, 4);
            EXPECT_GT(world.position(body).x, 21) << stripName(profile, strip);
            expectAtMost(stripName(profile, strip) + ", behind", std::abs(velocityOf(world, body).x / 3 - 1), 2e-3);
            expectAtMost(stripName(profile, strip) + ", aside", std::abs(velocityOf(world, aside).x), 1e-6);
        }
    }
}

/// Balls fall on each, slowly and so fast that they are swept.
TEST(Surfaces, BounceAsEachSegmentDoes) {
    constexpr std::array kPlaces{40.0, 15.0, -20.0};
    constexpr std::array kBounces{0.25, 1.0, 0.5};
    for (const Profile profile : kProfiles) {
        for (const Strip& strip : strips({bouncy(kBounces[0]), bouncy(kBounces[1]), bouncy(kBounces[2])})) {
            for (const double speed : {8.0, 900.0}) {
                World world = makeWorld(profile, 0);
                (void)strip.addTo(world, must(world.createBody({})));
                std::vector<BodyId> balls;
                for (const double x : kPlaces) {
                    balls.push_back(addBody(world, dynamicAt({x, 4}, vec(0, -speed)), circle(0.1), material(0)));
                }
                run(world, speed > 100 ? 2 : 40);
                for (std::size_t i = 0; i < balls.size(); ++i) {
                    const double back = velocityOf(world, balls[i]).y / (speed * kBounces[i]);
                    expectAtMost(stripName(profile, strip) + ", " + std::to_string(speed) + ", " + std::to_string(i),
                                 std::abs(back - 1), 1e-3);
                }
            }
        }
    }
}

/// A disc that rolls is slowed by two thirds of c·g.
TEST(Surfaces, ResistRollingWhereTheyDo) {
    Surface grass = roughSurface(1);
    grass.rollingResistance = real(0.06);
    for (const Profile profile : kProfiles) {
        for (const Strip& strip : strips({roughSurface(1), grass, roughSurface(1)})) {
            World world = makeWorld(profile);
            (void)strip.addTo(world, must(world.createBody({})));
            const BodyId ball = addBody(world, dynamicAt({6, 0.5}, vec(5, 0), -10), circle(0.5), material(1));
            runFor(world, 0.5);
            expectAtMost(stripName(profile, strip) + ", before", std::abs(velocityOf(world, ball).x / 5 - 1), 1e-3);
            runFor(world, 3.5);
            EXPECT_GT(world.position(ball).x, 20.5) << stripName(profile, strip);
            const double left = std::sqrt(5 * 5 - 2 * (2.0 / 3) * 0.06 * kGravity * 10);
            expectAtMost(stripName(profile, strip) + ", behind", std::abs(velocityOf(world, ball).x / left - 1), 5e-3);
        }
    }
}

/// Ice whose rule is `minimum`, in the middle of ground that mixes as usual.
TEST(Surfaces, MixByTheirOwnRules) {
    Surface ice = roughSurface(0.04);
    ice.frictionMixing = MixingRule::minimum;
    for (const Profile profile : kProfiles) {
        for (const Strip& strip : strips({roughSurface(0.04), ice, roughSurface(0.04)})) {
            World world = makeWorld(profile);
            (void)strip.addTo(world, must(world.createBody({})));
            const BodyId onIce = addBody(world, dynamicAt({12, 0.2}, vec(4, 0)), box(0.2, 0.2), material(1));
            const BodyId beside = addBody(world, dynamicAt({-9, 0.2}, vec(4, 0)), box(0.2, 0.2), material(1));
            runFor(world, 1);
            const auto brake = [&](BodyId body) { return (4 - velocityOf(world, body).x) / kGravity; };
            expectAtMost(stripName(profile, strip) + ", ice", std::abs(brake(onIce) / 0.04 - 1), 5e-3);
            expectAtMost(stripName(profile, strip) + ", beside", std::abs(brake(beside) / 0.2 - 1), 5e-3);
        }
    }
}

/// Two boxes asleep on a slope of 30° that their friction holds, on two of the segments of one chain.
struct SurfaceOnSlope {
    World world;
    ShapeId slope;
    std::array<BodyId, 2> boxes;

    SurfaceOnSlope() {
        WorldSettings settings = awakeSettings();
        settings.sleep = true;
        world = makeWorld(settings);
        const BodyId ground = must(world.createBody(bodyAt(BodyType::fixed, {}, -kPi / 6)));
        const std::array points{vec(90, 0), vec(0, 0), vec(-10, 0), vec(-90, 0)};
        slope = must(world.addChain(ground, points, false, material(1)));
        for (std::size_t i = 0; i < 2; ++i) {
            const double place = i == 0 ? 20 : -30;
            BodyDef def = dynamicAt(turned({place, 0.5}, -kPi / 6));
            def.angle = -kPi / 6;
            boxes[i] = addBody(world, def, box(0.5, 0.5), material(1));
        }
        runFor(world, 4);
        EXPECT_FALSE(world.isAwake(boxes[0]) || world.isAwake(boxes[1]));
    }
    double slidIn(BodyId body, double seconds) {
        const DVec2 before = world.position(body);
        runFor(world, seconds);
        return length(world.position(body) - before);
    }
};

TEST(Surfaces, WakeWhatTouchesThemAndNobodyElse) {
    SurfaceOnSlope s;
    Surface first = s.world.surface(s.slope, 0);
    first.material = 7;
    must(s.world.setSurface(s.slope, 0, first));
    must(s.world.setSurface(s.slope, 1, roughSurface(0.1)));
    EXPECT_FALSE(s.world.isAwake(s.boxes[0]) || s.world.isAwake(s.boxes[1])) << "nothing that acts is another there";
    first.friction = real(0.04);
    must(s.world.setSurface(s.slope, 0, first));
    EXPECT_TRUE(s.world.isAwake(s.boxes[0]));
    EXPECT_FALSE(s.world.isAwake(s.boxes[1]));
    const double way = 0.5 * kGravity * (std::sin(kPi / 6) - 0.2 * std::cos(kPi / 6));
    expectAtMost("way", std::abs(s.slidIn(s.boxes[0], 1) / way - 1), 0.02);
    for (const ContactEvent& event : s.world.contactEvents()) {
        ADD_FAILURE() << "contacts go on";
        (void)event;
    }
    EXPECT_FALSE(s.world.isAwake(s.boxes[1]));
    must(s.world.setSurfaces(s.slope, std::array{first, first, first}));
    EXPECT_TRUE(s.world.isAwake(s.boxes[1]));
    expectAtMost("way of the other", std::abs(s.slidIn(s.boxes[1], 1) / way - 1), 0.02);
}

/// Neither has a world that never had any forgotten what bounces, rolls and runs, nor does it remember too long.
TEST(Surfaces, MayBounceFromNowOn) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        const BodyId ground = must(world.createBody({}));
        const std::array points{vec(9, 0), vec(0, 0), vec(-9, 0)};
        const ShapeId chain = must(world.addChain(ground, points, false, material(0)));
        const BodyId ball = addBody(world, dynamicAt({-3, 2}, vec(0, -6)), circle(0.5), material(0));
        must(world.setSurface(chain, 1, bouncy(1)));
        runFor(world, 1);
        expectAtMost(profileName(profile) + ", bounced", std::abs(velocityOf(world, ball).y / 6 - 1), 1e-3);
        must(world.setSurface(chain, 1, bouncy(0)));
        must(world.setVelocity(ball, vec(0, -6), 0));
        runFor(world, 2);
        expectAtMost(profileName(profile) + ", stopped", std::abs(velocityOf(world, ball).y), 1e-3);
    }
}

TEST(Surfaces, AreReadBack) {
    World world = makeWorld();
    const BodyId ground = must(world.createBody({}));
    const std::array points{vec(3, 0), vec(2, 0), vec(1, 0), vec(0, 0)};
    std::array surfaces{roughSurface(0.1), bouncy(0.5), roughSurface(0.3)};
    surfaces[2].material = 1234567890123456789U;
    ShapeDef def = material(0.9);
    def.userData = 5;
    const ShapeId chain = must(world.addChain(ground, {.points = points, .shape = def, .surfaces = surfaces}));
    const auto expectSurfaces = [&](const char* when) {
        for (std::uint32_t i = 0; i < 3; ++i) { EXPECT_EQ(world.surface(chain, i), surfaces[i]) << when << ' ' << i; }
    };
    EXPECT_EQ(world.segmentCount(chain), 3U);
    expectSurfaces("made");
    EXPECT_EQ(world.surface(chain, 3), Surface{});
    EXPECT_EQ(world.definition(chain).userData, 5U);
    EXPECT_EQ(surfaceOf(world.definition(chain)), surfaces[0]);
    // What does not name another surface leaves them.
    def = world.definition(chain);
    def.filter.category = 4;
    def.userData = 6;
    must(world.redefine(chain, def));
    expectSurfaces("refiltered");
    EXPECT_EQ(world.userData(chain), 6U);
    surfaces[1].surfaceSpeed = -2;
    must(world.setSurface(chain, 1, surfaces[1]));
    expectSurfaces("one set");
    std::swap(surfaces[0], surfaces[2]);
    must(world.setSurfaces(chain, surfaces));
    expectSurfaces("all set");
    EXPECT_EQ(world.definition(chain).filter.category, 4U);
    const World copy = world;
    World loaded;
    must(loaded.load(world.save()));
    // Another one is that of all.
    def = world.definition(chain);
    def.friction = real(0.7);
    must(world.redefine(chain, def));
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(world.surface(chain, i), surfaceOf(def)) << i;
        EXPECT_EQ(copy.surface(chain, i), surfaces[i]) << i;
        EXPECT_EQ(loaded.surface(chain, i), surfaces[i]) << i;
    }
    // Other shapes have one.
    const ShapeId block = must(world.addShape(ground, box(1, 1), material(0.4)));
    EXPECT_EQ(world.segmentCount(block), 1U);
    EXPECT_EQ(world.surface(block), roughSurface(0.4));
    must(world.setSurface(block, 0, roughSurface(0.2)));
    EXPECT_EQ(world.definition(block).friction, real(0.2));
    must(world.setSurfaces(block, std::array{roughSurface(0.5)}));
    EXPECT_EQ(world.surface(block).friction, real(0.5));
    must(world.destroyShape(chain));
    EXPECT_EQ(world.segmentCount(chain), 0U);
    EXPECT_EQ(world.surface(chain), Surface{});
    EXPECT_EQ(world.surface(block).friction, real(0.5));
}

/// What slides from ice to roughSurface ground goes on with the same bits in a copy, and in what was saved.
TEST(Surfaces, AreCopiedAndSaved) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        const Strip strip = strips({roughSurface(0), roughSurface(0.5), roughSurface(0.1)}).front();
        (void)strip.addTo(world, must(world.createBody({})));
        (void)addBody(world, dynamicAt({5, 0.2}, vec(12, 0)), box(0.2, 0.2), material(0.5));
        (void)addBody(world, dynamicAt({30, 0.5}, vec(-6, 0)), circle(0.5), material(0.5));
        run(world, 20);
        World copy = world;
        World loaded;
        must(loaded.load(world.save()));
        for (World* const each : {&world, &copy, &loaded}) { runFor(*each, 2); }
        EXPECT_EQ(copy.stateHash(), world.stateHash());
        EXPECT_EQ(loaded.stateHash(), world.stateHash());
    }
}

Surface changed(Surface surface, void (*change)(Surface&)) {
    change(surface);
    return surface;
}

/// Nothing of them is taken, not even what is good of several.
TEST(Surfaces, ThatAreNoneAreRefused) {
    constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
    SurfaceOnSlope s;
    World& world = s.world;
    const BodyId ground = world.bodyOf(s.slope);
    const ShapeId gone = must(world.addShape(ground, box(1, 1)));
    must(world.destroyShape(gone));
    run(world, 1);
    const KnownIds known{{ground, s.boxes[0], s.boxes[1]}, {s.slope, gone}, {}};
    const std::uint64_t before = digestOf(world, known);
    const auto expectRefused = [&](const Status& status, StatusCode code, const char* field) {
        EXPECT_EQ(status.code, code) << field << ' ' << describe(status.code);
        EXPECT_STREQ(status.field, field);
        EXPECT_EQ(digestOf(world, known), before) << field;
    };
    struct Fault {
        Surface surface;
        StatusCode code;
        const char* field;
    };
    const Surface good = roughSurface(0.3);
    const std::vector<Fault> faults{
        {changed(good, [](Surface& f) { f.friction = -1; }), StatusCode::negative, "friction"},
        {changed(good, [](Surface& f) { f.friction = kNan; }), StatusCode::notFinite, "friction"},
        {changed(good, [](Surface& f) { f.restitution = 2; }), StatusCode::outOfRange, "restitution"},
        {changed(good, [](Surface& f) { f.rollingResistance = -1; }), StatusCode::negative, "rollingResistance"},
        {changed(good, [](Surface& f) { f.surfaceSpeed = kNan; }), StatusCode::notFinite, "surfaceSpeed"},
        {changed(good, [](Surface& f) { f.frictionMixing = static_cast<MixingRule>(6); }), StatusCode::outOfRange,
         "frictionMixing"},
        {changed(good, [](Surface& f) { f.restitutionMixing = static_cast<MixingRule>(99); }), StatusCode::outOfRange,
         "restitutionMixing"},
    };
    const std::array points{vec(3, 9), vec(2, 9), vec(1, 9)};
    const auto added = [&](std::span<const Surface> surfaces) {
        return world.addChain(ground, {.points = points, .surfaces = surfaces}).status();
    };
    for (const Fault& fault : faults) {
        expectRefused(world.setSurface(s.slope, 1, fault.surface), fault.code, fault.field);
        expectRefused(world.setSurfaces(s.slope, std::array{good, good, fault.surface}), fault.code, fault.field);
        expectRefused(added(std::array{good, fault.surface}), fault.code, fault.field);
    }
    for (const std::size_t count : {1U, 3U}) {
        expectRefused(added(std::vector(count, good)), StatusCode::outOfRange, "surfaces");
    }
    for (const std::size_t count : {0U, 2U, 4U}) {
        expectRefused(world.setSurfaces(s.slope, std::vector(count, good)), StatusCode::outOfRange, "surfaces");
    }
    expectRefused(world.setSurface(s.slope, 3, good), StatusCode::outOfRange, "segment");
    expectRefused(world.setSurface(s.slope, 0xFFFFFFFFU, good), StatusCode::outOfRange, "segment");
    expectRefused(world.setSurface(gone, 0, good), StatusCode::staleId, "shape");
    expectRefused(world.setSurfaces({}, std::array{good}), StatusCode::staleId, "shape");
    const ShapeId inner{s.slope.index + 1, s.slope.generation};  // which no id names
    expectRefused(world.setSurface(inner, 0, good), StatusCode::staleId, "shape");
    EXPECT_EQ(world.segmentCount(inner), 0U);
    EXPECT_FALSE(world.isAwake(s.boxes[0]) || world.isAwake(s.boxes[1]));
}

/// On a body that moves itself, and while it takes no part.
TEST(Surfaces, OfALiftChangeWhileItIsAway) {
    World world = makeWorld();
    const BodyId lift = must(world.createBody(bodyAt(BodyType::kinematic, {0, 0})));
    const std::array points{vec(50, 0), vec(0, 0), vec(-50, 0)};
    const ShapeId chain = must(world.addChain(lift, points, false, material(0)));
    const BodyId body = addBody(world, dynamicAt({5, 0.5}, vec(2, 0)), box(0.5, 0.5), material(0.5));
    run(world, 10);
    must(world.setEnabled(lift, false));
    must(world.setSurface(chain, 0, roughSurface(0.5)));
    must(world.setEnabled(lift, true));
    runFor(world, 0.25);
    EXPECT_LT(velocityOf(world, body).x, 1.2);
    EXPECT_EQ(world.surface(chain, 1).friction, 0);
}

}  // namespace
}  // namespace swept::test

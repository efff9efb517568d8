#include <array>
#include <set>
#include <type_traits>
#include <utility>

#include "filtered_crowd.h"

/// What a contact filter forbids never touches; what it allows does as without one.

namespace swept::test {
namespace {

static_assert(noexcept(std::declval<const ContactFilter&>().mayTouch({}, {})), "a step has no way to give up");
static_assert(std::is_abstract_v<ContactFilter>);

constexpr std::array kModes{ContinuousMode::off, ContinuousMode::speedLimit, ContinuousMode::speculative,
                            ContinuousMode::stop, ContinuousMode::subStep};

ShapeDef ofKind(std::uint64_t kind) {
    ShapeDef def = material(0.5);
    def.userData = kind;
    return def;
}

ShapeId shapeOf(const World& world, BodyId body) {
    ShapeId only{};
    world.visitShapes(body, [&only](ShapeId id) { only = id; });
    return only;
}

/// A filter that says what it is told to.
struct Switch final : ContactFilter {
    bool allows = true;
    bool mayTouch(const FilteredShape&, const FilteredShape&) const noexcept override { return allows; }
};

/// Of no kind in common; and remembers what it was asked. For one thread.
struct Asked final : ContactFilter {
    mutable std::vector<std::pair<FilteredShape, FilteredShape>> pairs;
    bool mayTouch(const FilteredShape& a, const FilteredShape& b) const noexcept override {
        pairs.push_back({a, b});
        return a.userData == b.userData;
    }
};

/// Each ball falls through the platform of another kind, and lands on the one of its own: more kinds than a mask has
/// bits.
TEST(ContactFilter, TellsFortyKindsByUserData) {
    constexpr int kKinds = 40;
    const SameKind filter;
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        WorldSettings settings = awakeSettings(profile);
        World world = makeWorld(settings);
        world.setContactFilter(&filter);
        std::vector<BodyId> balls;
        for (int i = 0; i < kKinds; ++i) {
            const auto kind = static_cast<std::uint64_t>(i);
            addStatic(world, box(1, 0.1), ofKind((kind + 1) % kKinds), {3.0 * i, 3});
            addStatic(world, box(1, 0.1), ofKind(kind), {3.0 * i, 0});
            balls.push_back(addBody(world, dynamicAt({3.0 * i, 4}), circle(0.5), ofKind(kind)));
        }
        std::size_t begins = 0;
        for (int i = 0; i < 180; ++i) {
            run(world, 1);
            for (const ContactEvent& event : world.contactEvents()) {
                begins += event.type == ContactEventType::begin ? 1 : 0;
                EXPECT_EQ(event.userDataA, event.userDataB);
            }
        }
        EXPECT_EQ(begins, kKinds);
        for (const BodyId ball : balls) { EXPECT_NEAR(world.position(ball).y, 0.6, 0.01); }
    }
}

/// Whatever is swept, and against whatever.
TEST(ContactFilter, HoldsInEveryMode) {
    const SameKind filter;
    for (const ContinuousMode mode : kModes) {
        for (const BodyType type : {BodyType::fixed, BodyType::kinematic, BodyType::dynamic}) {
            for (const double speed : {2.0, 300.0}) {
                WorldSettings settings = awakeSettings(0);
                settings.continuous = mode;
                World world = makeWorld(settings);
                world.setContactFilter(&filter);
                const BodyId wall = addBody(world, bodyAt(type, {2, 0}), box(0.2, 1), ofKind(1));
                BodyDef def = dynamicAt({0, 0}, vec(speed, 0));
                def.bullet = true;
                const BodyId ball = addBody(world, def, circle(0.2), ofKind(2));
                for (int i = 0; i < 180; ++i) {
                    run(world, 1);
                    ASSERT_TRUE(world.contactEvents().empty());
                    world.visitContacts([](const ContactView&) { ADD_FAILURE(); });
                }
                if (mode != ContinuousMode::speedLimit) { EXPECT_NEAR(velocityOf(world, ball).x, speed, 1e-4 * speed); }
                EXPECT_EQ(world.position(wall).x, 2);
                EXPECT_GT(world.position(ball).x, 4);
            }
        }
    }
}

TEST(ContactFilter, LetsBulletsHitWhatItAllows) {
    const SameKind filter;
    for (const bool isSame : {false, true}) {
        World world = makeWorld(awakeSettings(0));
        world.setContactFilter(&filter);
        addBody(world, dynamicAt({2, 0}), box(0.2, 1), ofKind(1));
        BodyDef def = dynamicAt({0, 0}, vec(600, 0));
        def.bullet = true;
        const BodyId bullet = addBody(world, def, circle(0.2), ofKind(isSame ? 1 : 2));
        run(world, 1);
        EXPECT_EQ(world.position(bullet).x < 9, isSame);
        EXPECT_EQ(world.contactEvents().empty(), !isSame);
    }
}

/// Slow ones and such as pass it within a step.
TEST(ContactFilter, SensorsDoNotSeeWhatItForbids) {
    const SameKind filter;
    for (const double speed : {1.0, 240.0}) {
        for (const bool isSame : {false, true}) {
            World world = makeWorld(awakeSettings(0));
            world.setContactFilter(&filter);
            ShapeDef gate = ofKind(1);
            gate.sensor = true;
            const BodyId sensor = addStatic(world, box(0.5, 1), gate);
            addBody(world, dynamicAt({-2, 0}, vec(speed, 0)), circle(0.1), ofKind(isSame ? 1 : 2));
            std::size_t events = 0;
            std::size_t overlaps = 0;
            for (int i = 0; i < 300; ++i) {
                run(world, 1);
                events += world.contactEvents().size();
                world.visitOverlaps(shapeOf(world, sensor), [&overlaps](ShapeId) { ++overlaps; });
            }
            EXPECT_EQ(events, isSame ? 2U : 0U);
            EXPECT_EQ(overlaps > 0, isSame && speed < 2);
        }
    }
}

/// Bullets, bounces in flight, piles: those of different kinds are not there for each other.
TEST(ContactFilter, CrowdsPassThroughEachOther) {
    const SameKind filter;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        FilteredCrowd crowd(seed, filter);
        std::size_t begins = 0;
        for (int i = 0; i < 240; ++i) {
            run(crowd.world, 1);
            for (const ContactEvent& event : crowd.world.contactEvents()) {
                ASSERT_TRUE(crowd.areAlike(event.shapeA, event.shapeB)) << "seed " << seed << " step " << i;
                begins += event.type == ContactEventType::begin || event.type == ContactEventType::hit ? 1 : 0;
            }
            crowd.world.visitContacts([&](const ContactView& view) {
                EXPECT_TRUE(crowd.areAlike(view.shapeA, view.shapeB)) << "seed " << seed << " step " << i;
            });
            ASSERT_FALSE(testing::Test::HasFailure());
        }
        EXPECT_GT(begins, 200U);
        EXPECT_TRUE(areInside(crowd.world, crowd.bodies, 9));
    }
}

/// Of a world of one kind, the bits are those without a filter.
TEST(ContactFilter, ThatAllowsAllChangesNothing) {
    const Switch filter;
    FilteredCrowd with(3, filter);
    FilteredCrowd without(3, filter);
    without.world.setContactFilter(nullptr);
    run(with.world, 120);
    run(without.world, 120);
    EXPECT_EQ(with.world.stateHash(), without.world.stateHash());
}

TEST(ContactFilter, IsToldOfBothInOrderOfTheirIds) {
    World world = makeWorld();
    Asked filter;
    world.setContactFilter(&filter);
    BodyDef ballDef = dynamicAt({0, 0.4}, vec(0, -100));
    ballDef.userData = 7;
    const BodyId ball = addBody(world, ballDef, circle(0.5), ofKind(1));
    const BodyId ground = must(world.createBody({}));
    const std::array line{vec(9, 0), vec(3, 0), vec(0, -0.1), vec(-3, 0), vec(-9, 0)};
    const ShapeId chain = must(world.addChain(ground, line, false, ofKind(2)));
    run(world, 3);
    ASSERT_FALSE(filter.pairs.empty());
    for (const auto& [a, b] : filter.pairs) {
        EXPECT_EQ(a.shape, shapeOf(world, ball));
        EXPECT_EQ(a.body, ball);
        EXPECT_EQ(a.userData, 1U);
        EXPECT_EQ(a.bodyUserData, 7U);
        EXPECT_EQ(b.shape, chain);
        EXPECT_EQ(b.body, ground);
        EXPECT_EQ(b.userData, 2U);
        EXPECT_EQ(b.bodyUserData, 0U);
    }
}

/// It can only forbid: of what is forbidden already nobody asks it; nor do queries.
TEST(ContactFilter, IsNotAskedWhereThereIsNothingToDecide) {
    World world = makeWorld(0);
    Asked filter;
    world.setContactFilter(&filter);
    ShapeDef ghost = ofKind(0);
    ghost.filter.group = -1;
    const BodyId wall = addStatic(world, box(1, 1), ghost);
    addBody(world, dynamicAt({0.5, 0}, vec(500, 0)), circle(0.5), ghost);
    const BodyId one = addBody(world, dynamicAt({0, 20}), circle(0.5), ofKind(0));
    const BodyId other = addBody(world, dynamicAt({0.5, 20}), circle(0.5), ofKind(0));
    must(world.createJoint(FilterJointDef{{.bodyA = one, .bodyB = other}}));
    run(world, 5);
    EXPECT_TRUE(filter.pairs.empty());
    EXPECT_EQ(world.position(one).x, 0);
    EXPECT_EQ(world.castRay({-5, 0}, vec(10, 0)).body, wall);
    int found = 0;
    world.overlapShape(circle(1), {{0, 20}, {}}, {}, [&found](ShapeId) { return ++found > 0; });
    EXPECT_EQ(found, 2);
    EXPECT_TRUE(filter.pairs.empty());
}

TEST(ContactFilter, SnapshotsHaveIt) {
    const SameKind filter;
    FilteredCrowd crowd(5, filter);
    run(crowd.world, 60);
    World before = crowd.world;
    run(crowd.world, 60);
    const std::uint64_t hash = crowd.world.stateHash();
    run(before, 60);
    EXPECT_EQ(before.stateHash(), hash);
    FilteredCrowd other(5, filter);
    other.world.setContactFilter(nullptr);
    run(other.world, 120);
    EXPECT_NE(other.world.stateHash(), hash);
}

/// A box that sleeps on a platform.
struct OnPlatform {
    World world;
    BodyId platform;
    BodyId crate;
    explicit OnPlatform(const ContactFilter* filter) {
        WorldSettings settings = awakeSettings();
        settings.sleep = true;
        world = makeWorld(settings);
        world.setContactFilter(filter);
        platform = addStatic(world, box(3, 0.5), ofKind(1));
        crate = addBody(world, dynamicAt({0, 1}), box(0.5, 0.5), ofKind(1));
        runFor(world, 4);
        EXPECT_FALSE(world.isAwake(crate));
    }
    bool isHeld() const { return std::abs(world.position(crate).y - 1) < 0.01; }
    std::size_t begins() const { return countOf(ContactEventType::begin); }
    std::size_t ends() const { return countOf(ContactEventType::end); }

private:
    std::size_t countOf(ContactEventType type) const {
        const auto events = world.contactEvents();
        return static_cast<std::size_t>(
            std::count_if(events.begin(), events.end(), [type](const ContactEvent& e) { return e.type == type; }));
    }
};

TEST(ContactFilter, SetAgainAsksAboutAll) {
    Switch filter;
    OnPlatform scene(&filter);
    filter.allows = false;
    scene.world.setContactFilter(&filter);
    EXPECT_TRUE(scene.world.isAwake(scene.crate));
    scene.world.visitContacts([](const ContactView&) { ADD_FAILURE(); });
    run(scene.world, 1);
    EXPECT_EQ(scene.ends(), 1U);
    runFor(scene.world, 0.2);
    EXPECT_NEAR(scene.world.position(scene.crate).y, 1 - 0.5 * kGravity * 13.0 * 13.0 / 3600, 1e-3);
    filter.allows = true;  // half way in
    scene.world.setContactFilter(&filter);
    run(scene.world, 1);
    EXPECT_EQ(scene.begins(), 1U);
    runFor(scene.world, 2);
    EXPECT_GT(scene.world.position(scene.crate).y, 0.9);
}

TEST(ContactFilter, SetAgainKeepsWhatItStillAllows) {
    Switch filter;
    OnPlatform scene(&filter);
    scene.world.setContactFilter(&filter);
    EXPECT_TRUE(scene.world.isAwake(scene.crate));
    for (int i = 0; i < 60; ++i) {
        run(scene.world, 1);
        EXPECT_TRUE(scene.world.contactEvents().empty());
    }
    EXPECT_TRUE(scene.isHeld());
    scene.world.setContactFilter(nullptr);  // all may touch
    run(scene.world, 1);
    EXPECT_TRUE(scene.world.contactEvents().empty());
    EXPECT_TRUE(scene.isHeld());
}

TEST(ContactFilter, IsSetOnAWorldThatSleepsAndIsHeld) {
    const SameKind filter;
    for (const bool sleep : {false, true}) {
        OnPlatform scene(nullptr);
        WorldSettings settings = scene.world.settings();
        settings.sleep = sleep;
        must(scene.world.configure(settings));
        runFor(scene.world, 2);
        ShapeDef other = scene.world.definition(shapeOf(scene.world, scene.platform));
        other.userData = 2;
        must(scene.world.redefine(shapeOf(scene.world, scene.platform), other));
        runFor(scene.world, 1);
        EXPECT_TRUE(scene.isHeld());  // nobody asks
        scene.world.setContactFilter(&filter);
        runFor(scene.world, 0.5);
        EXPECT_LT(scene.world.position(scene.crate).y, 0);
    }
}

TEST(ContactFilter, AnotherUserDataOfAShapeIsAskedAbout) {
    const SameKind filter;
    OnPlatform scene(&filter);
    const ShapeId shape = shapeOf(scene.world, scene.platform);
    must(scene.world.redefine(shape, ofKind(1)));
    EXPECT_FALSE(scene.world.isAwake(scene.crate));  // it is as it was
    must(scene.world.redefine(shape, ofKind(2)));
    EXPECT_TRUE(scene.world.isAwake(scene.crate));
    runFor(scene.world, 0.2);
    EXPECT_LT(scene.world.position(scene.crate).y, 0.9);
    must(scene.world.redefine(shape, ofKind(1)));
    run(scene.world, 1);
    EXPECT_EQ(scene.begins(), 1U);
}

/// Allows what belongs to bodies of one kind.
struct SameBodies final : ContactFilter {
    bool mayTouch(const FilteredShape& a, const FilteredShape& b) const noexcept override {
        return a.bodyUserData == b.bodyUserData;
    }
};

TEST(ContactFilter, AnotherUserDataOfABodyIsAskedAbout) {
    const SameBodies filter;
    OnPlatform scene(&filter);
    for (const BodyId body : {scene.platform, scene.crate}) {
        BodyDef def = scene.world.definition(body);
        def.userData = 5;
        const double before = scene.world.position(scene.crate).y;
        must(scene.world.redefine(body, def));
        EXPECT_TRUE(scene.world.isAwake(scene.crate));
        run(scene.world, 1);
        EXPECT_EQ(body == scene.platform ? scene.ends() : scene.begins(), 1U);
        runFor(scene.world, 0.1);
        EXPECT_EQ(scene.world.position(scene.crate).y < before - 1e-3, body == scene.platform);
    }
}

TEST(ContactFilter, KeepsAContactThatItWasNotAskedAboutAnew) {
    Switch filter;
    OnPlatform scene(&filter);
    filter.allows = false;
    must(scene.world.setAwake(scene.crate, true));
    runFor(scene.world, 1);
    EXPECT_TRUE(scene.isHeld());
    must(scene.world.setPose(scene.crate, {0, 2}, 0));  // the two part
    runFor(scene.world, 1);
    EXPECT_LT(scene.world.position(scene.crate).y, 0);
}

TEST(ContactFilter, OfWhatIsDisabledMeanwhile) {
    Switch filter;
    OnPlatform scene(&filter);
    must(scene.world.setEnabled(scene.crate, false));
    filter.allows = false;
    scene.world.setContactFilter(&filter);
    run(scene.world, 2);
    must(scene.world.setEnabled(scene.crate, true));
    runFor(scene.world, 0.5);
    EXPECT_LT(scene.world.position(scene.crate).y, 0);
}

}  // namespace
}  // namespace swept::test

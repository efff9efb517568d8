#include <functional>
#include <utility>

#include <swept/engine/state/number_range.h>

#include "world_digest.h"
#include "world_support.h"

/// What a pair makes of the friction and restitution of its two shapes, and that worlds go by it.

namespace swept::test {
namespace {

struct Rule {
    MixingRule rule;
    const char* name;
    std::function<double(double, double)> of;
};

/// In the order of precedence; `usual`, which means another one of each property, is left out.
const std::vector<Rule>& ownRules() {
    static const std::vector<Rule> kRules{
        {MixingRule::geometricMean, "geometric mean", [](double a, double b) { return std::pow(a * b, 0.5); }},
        {MixingRule::average, "average", [](double a, double b) { return 0.5 * a + 0.5 * b; }},
        {MixingRule::minimum, "minimum", [](double a, double b) { return a < b ? a : b; }},
        {MixingRule::product, "product", [](double a, double b) { return a * b; }},
        {MixingRule::maximum, "maximum", [](double a, double b) { return a < b ? b : a; }},
    };
    return kRules;
}

ShapeDef ruled(double friction, double restitution, MixingRule rule) {
    ShapeDef def = material(friction, restitution);
    def.frictionMixing = rule;
    def.restitutionMixing = rule;
    return def;
}

/// `usual`, then the others.
MixingRule ruleAt(std::size_t place) { return place == 0 ? MixingRule::usual : ownRules()[place - 1].rule; }

TEST(MixingRules, OfAllPairsTheLaterOneHolds) {
    const std::pair<double, double> numbers[] = {{0.09, 0.64}, {1, 0.25}, {0, 0.5}, {0.5, 0.5}, {0, 0}, {1, 1}};
    int checked = 0;
    for (std::size_t i = 0; i <= ownRules().size(); ++i) {
        for (std::size_t k = 0; k <= ownRules().size(); ++k) {
            const std::size_t later = std::max(i, k);
            const Rule& friction = later == 0 ? ownRules().front() : ownRules()[later - 1];
            const Rule& restitution = later == 0 ? ownRules().back() : ownRules()[later - 1];
            for (const auto& [first, second] : numbers) {
                const ShapeDef a = ruled(first, first, ruleAt(i));
                const ShapeDef b = ruled(second, second, ruleAt(k));
                const std::string name = std::to_string(i) + " and " + std::to_string(k);
                EXPECT_NEAR(mixedFriction(a, b), friction.of(first, second), 1e-6) << name << ": " << friction.name;
                EXPECT_NEAR(mixedRestitution(a, b), restitution.of(first, second), 1e-6)
                    << name << ": " << restitution.name;
                EXPECT_EQ(mixedFriction(a, b), mixedFriction(b, a)) << name;
                EXPECT_EQ(mixedRestitution(a, b), mixedRestitution(b, a)) << name;
                ++checked;
            }
        }
    }
    EXPECT_EQ(checked, 36 * 6);
}

/// A shape may ask for one of both only.
TEST(MixingRules, OfFrictionAndRestitutionAreApart) {
    ShapeDef slippery = material(0.25, 0.25);
    slippery.frictionMixing = MixingRule::minimum;
    ShapeDef dull = material(1, 1);
    dull.restitutionMixing = MixingRule::product;
    EXPECT_EQ(mixedFriction(slippery, dull), Real(0.25));
    EXPECT_EQ(mixedRestitution(slippery, dull), Real(0.25));
    EXPECT_EQ(mixedFriction(material(0.25), dull), Real(0.5));
    EXPECT_EQ(mixedRestitution(slippery, material(0, 0.5)), Real(0.5));
}

TEST(MixingRules, KeepTheLargestFrictionFinite) {
    for (const Rule& rule : ownRules()) {
        const ShapeDef rough = ruled(kLargestNumber, 1, rule.rule);
        EXPECT_TRUE(std::isfinite(mixedFriction(rough, rough))) << rule.name;
        EXPECT_GE(mixedFriction(rough, rough), rough.friction * Real(0.999)) << rule.name;
    }
}

/// A box of μ 0.8 on ground of 0.1; one of the two has the rule, the other the usual one. It slows down by μg.
TEST(MixingRules, SlowASlider) {
    constexpr double kSpeed = 12;
    for (const Profile profile : kProfiles) {
        for (const Rule& rule : ownRules()) {
            for (const bool isOfGround : {true, false}) {
                World world = makeWorld(profile);
                addStatic(world, box(100, 1), ruled(0.1, 0, isOfGround ? rule.rule : MixingRule::usual), {0, -1});
                const BodyId body = addBody(world, dynamicAt({0, 0.5}, vec(kSpeed, 0)), box(0.5, 0.5),
                                            ruled(0.8, 0, isOfGround ? MixingRule::usual : rule.rule));
                runFor(world, 1);
                const double slowed = rule.of(0.1, 0.8) * kGravity;
                const std::string name = std::string(profile == Profile::fast ? "fast, " : "accurate, ") + rule.name +
                                         (isOfGround ? " of the ground" : " of the box");
                expectAtMost(name, std::abs((kSpeed - velocityOf(world, body).x) / slowed - 1), 2e-3);
            }
        }
    }
}

/// A ball of restitution 0.9 falls 5 m on ground of 0.4, and rises e² times as far.
TEST(MixingRules, BounceABall) {
    for (const Profile profile : kProfiles) {
        for (const Rule& rule : ownRules()) {
            World world = makeWorld(profile);
            addStatic(world, box(10, 1), ruled(0.5, 0.4, rule.rule), {0, -1});
            const BodyId ball = addBody(world, dynamicAt({0, 5.5}), circle(0.5), material(0.5, 0.9));
            double height = 0;
            for (int i = 0; i < 75; ++i) {  // it lands after a second; from then on its energy tells how far it rises
                run(world, 1);
                const double up = velocityOf(world, ball).y;
                if (up > 0 && height == 0) { height = world.position(ball).y - 0.5 + up * up / (2 * kGravity); }
            }
            const double e = rule.of(0.4, 0.9);
            const std::string name = std::string(profile == Profile::fast ? "fast, " : "accurate, ") + rule.name;
            expectAtMost(name, std::abs(height / (e * e * 5) - 1), 1e-3);
        }
    }
}

/// What hits a thin wall within a step, and a bullet that hits what can move, ask the shapes themselves.
TEST(MixingRules, ReflectWhatIsSwept) {
    for (const Profile profile : kProfiles) {
        for (const bool isBullet : {true, false}) {
            for (const Rule& rule : ownRules()) {
                WorldSettings settings = awakeSettings(profile, 0);
                World world = makeWorld(settings);
                ShapeDef heavy = ruled(0, 0.5, rule.rule);
                heavy.density = real(1e6);
                addBody(world, bodyAt(isBullet ? BodyType::dynamic : BodyType::fixed, {0, 0}), box(50, 0.01), heavy);
                BodyDef def = dynamicAt({0, 3}, vec(0, -300));
                def.bullet = isBullet;
                const BodyId shot = addBody(world, def, circle(0.05), material(0, 0.8));
                run(world, 2);
                const double e = rule.of(0.5, 0.8);
                const std::string name = std::string(isBullet ? "bullet, " : "swept, ") + rule.name;
                expectAtMost(name, std::abs(velocityOf(world, shot).y / (300 * e) - 1), 1e-3);
            }
        }
    }
}

/// A box asleep on a slope of 30°, held by friction 1, of which the ground has 0.25 only.
struct OnSlope {
    World world;
    ShapeId ground;
    BodyId body;

    OnSlope() {
        WorldSettings settings = awakeSettings();
        settings.sleep = true;
        world = makeWorld(settings);
        const BodyId slope = must(world.createBody(bodyAt(BodyType::fixed, {}, -kPi / 6)));
        ground = must(world.addShape(slope, box(200, 1), ruled(0.25, 0, MixingRule::maximum)));
        BodyDef def = dynamicAt(turned({0, 1.5}, -kPi / 6));
        def.angle = -kPi / 6;
        body = addBody(world, def, box(0.5, 0.5), material(1));
        runFor(world, 4);
        EXPECT_FALSE(world.isAwake(body));
        EXPECT_LT(length(world.position(body) - turned({0, 1.5}, -kPi / 6)), 1e-3);
    }
    double slidIn(double seconds) {
        const DVec2 before = world.position(body);
        runFor(world, seconds);
        return length(world.position(body) - before);
    }
};

TEST(MixingRules, MayBeRedefinedInContact) {
    OnSlope slope;
    ShapeDef def = slope.world.definition(slope.ground);
    EXPECT_EQ(def.frictionMixing, MixingRule::maximum);
    def.frictionMixing = MixingRule::minimum;
    must(slope.world.redefine(slope.ground, def));
    EXPECT_EQ(slope.world.definition(slope.ground).frictionMixing, MixingRule::minimum);
    EXPECT_TRUE(slope.world.isAwake(slope.body));
    World copy = slope.world;
    const double way = 0.5 * kGravity * (std::sin(kPi / 6) - 0.25 * std::cos(kPi / 6));
    expectAtMost("way", std::abs(slope.slidIn(1) / way - 1), 0.02);
    for (const ContactEvent& event : slope.world.contactEvents()) { EXPECT_NE(event.type, ContactEventType::begin); }
    runFor(copy, 1);
    EXPECT_EQ(copy.stateHash(), slope.world.stateHash()) << "a copy has the same rules";
}

/// The ball lies still, and is thrown down: what it touches already gives it back.
TEST(MixingRules, OfRestitutionMayBeRedefinedInContact) {
    for (const bool bounces : {false, true}) {
        World world = makeWorld();
        const BodyId floor = must(world.createBody(bodyAt(BodyType::fixed, {0, -1})));
        const ShapeId ground = must(world.addShape(floor, box(10, 1), ruled(0.5, 1, MixingRule::minimum)));
        const BodyId ball = addBody(world, dynamicAt({0, 0.5}), circle(0.5), material(0.5, 0));
        runFor(world, 1);
        EXPECT_NEAR(world.position(ball).y, 0.5, 1e-3);
        if (bounces) {
            ShapeDef def = world.definition(ground);
            def.restitutionMixing = MixingRule::usual;
            must(world.redefine(ground, def));
        }
        must(world.setVelocity(ball, vec(0, -5), 0));
        run(world, 2);
        expectAtMost(bounces ? "back" : "none",
                     std::abs(velocityOf(world, ball).y - (bounces ? 5 - kGravity * kStep : 0)), bounces ? 0.2 : 1e-3);
    }
}

TEST(MixingRules, ThatAreNoneAreRefused) {
    for (const int number : {6, 255}) {
        for (const bool isOfFriction : {true, false}) {
            OnSlope slope;
            World& world = slope.world;
            KnownIds known{{slope.body, world.bodyOf(slope.ground)}, {slope.ground}, {}};
            const std::uint64_t before = digestOf(world, known);
            const ShapeDef good = world.definition(slope.ground);
            ShapeDef bad = good;
            (isOfFriction ? bad.frictionMixing : bad.restitutionMixing) = static_cast<MixingRule>(number);
            const std::vector<Vec2> points{vec(1, 0), vec(-1, 0)};
            const BodyId floor = world.bodyOf(slope.ground);
            for (const Status& status :
                 {world.addShape(floor, box(1, 1), bad).status(), world.addChain(floor, points, false, bad).status(),
                  world.redefine(slope.ground, bad)}) {
                EXPECT_EQ(status.code, StatusCode::outOfRange);
                EXPECT_STREQ(status.field, isOfFriction ? "frictionMixing" : "restitutionMixing");
            }
            EXPECT_EQ(world.definition(slope.ground).frictionMixing, good.frictionMixing);
            EXPECT_EQ(world.definition(slope.ground).restitutionMixing, good.restitutionMixing);
            EXPECT_EQ(digestOf(world, known), before);
            EXPECT_EQ(slope.slidIn(1), 0);
        }
    }
}

}  // namespace
}  // namespace swept::test

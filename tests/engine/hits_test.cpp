#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <swept/shapes/hull.h>

#include "../support/random.h"
#include "world_support.h"

/// Which meetings are blows: what comes down fast, also at another point of a pair that touches already, and what
/// bounces; but nothing that rests, rolls, slides or is pressed.

namespace swept::test {
namespace {

/// Of the last step.
std::vector<ContactEvent> hitsOf(const World& world) {
    std::vector<ContactEvent> hits;
    for (const ContactEvent& event : world.contactEvents()) {
        if (event.type == ContactEventType::hit) { hits.push_back(event); }
    }
    return hits;
}

/// @return hits of the steps after `settling` of them
template <class Act>
int hitsAfter(World& world, int settling, int steps, const Act& act) {
    int hits = 0;
    for (int step = 0; step < settling + steps; ++step) {
        act(step);
        must(world.step(kStep));
        if (step >= settling) { hits += static_cast<int>(hitsOf(world).size()); }
    }
    return hits;
}
int hitsAfter(World& world, int settling, int steps) {
    return hitsAfter(world, settling, steps, [](int) {});
}

class Hits : public testing::TestWithParam<Profile> {};

struct Crate {
    double halfX = 0;
    double halfY = 0;
    BodyId body{};
    double spin = 0;      ///< before the step, rad/s
    double mostLost = 0;  ///< of it, in a step
    double slap = 0;      ///< with what its corner came down, m/s
    double fastest = 0;   ///< hit that was told
    int hits = 0;
};

/// Stands on its right lower corner, and leans beyond its balance.
void addLeaning(World& world, Crate& crate, double x) {
    const double angle = -(std::atan2(crate.halfX, crate.halfY) + 0.05);
    const double y = crate.halfX * std::fabs(std::sin(angle)) + crate.halfY * std::cos(angle);
    crate.body = addBody(world, bodyAt(BodyType::dynamic, {x, y}, angle), box(crate.halfX, crate.halfY), material(0.9));
}

/// The step in which it loses most of its spin is that in which the other corner slaps down.
void follow(const World& world, Crate& crate) {
    const double spin = std::fabs(spinOf(world, crate.body));
    if (crate.spin - spin > crate.mostLost) {
        crate.mostLost = crate.spin - spin;
        crate.slap = crate.spin * 2 * crate.halfY;
    }
    crate.spin = spin;
    for (const ContactEvent& hit : hitsOf(world)) {
        if (hit.bodyB != crate.body) { continue; }
        ++crate.hits;
        crate.fastest = std::max(crate.fastest, static_cast<double>(hit.approachSpeed));
        EXPECT_GT(hit.approachSpeed, kGravity * kStep);
        EXPECT_GT(hit.impulse, 0);
        EXPECT_NEAR(hit.point.y, 0, 0.1 * crate.halfY);
    }
}

void expectSlapsTold(Profile profile, std::vector<Crate> crates) {
    World world = makeWorld(profile);
    addStatic(world, box(200, 1), {}, {0, -1});
    for (std::size_t i = 0; i < crates.size(); ++i) { addLeaning(world, crates[i], 10.0 * static_cast<double>(i)); }
    for (int step = 0; step < 300; ++step) {
        must(world.step(kStep));
        for (Crate& crate : crates) { follow(world, crate); }
    }
    EXPECT_EQ(hitsAfter(world, 0, 60), 0) << profileName(profile) << ", when they lie";
    for (const Crate& crate : crates) {
        const std::string name = profileName(profile) + ", half " + testing::PrintToString(crate.halfX) + " x " +
                                 testing::PrintToString(crate.halfY);
        EXPECT_GT(crate.slap, 1) << name;
        EXPECT_NEAR(crate.fastest / crate.slap, 1, 0.1) << name;
        EXPECT_LE(crate.hits, 6) << name << ": it may rock, onto the other edge and back";
    }
}

/// Its edge rests on the floor all the time.
TEST_P(Hits, TellOfACrateThatTipsOverWhenItSlapsDown) {
    for (const auto& [halfX, halfY] : {std::pair{0.5, 0.5}, {0.5, 1.0}, {1.0, 0.5}, {0.25, 1.0}, {2.0, 2.0}}) {
        expectSlapsTold(GetParam(), {{.halfX = halfX, .halfY = halfY}});
    }
}

/// Many in one solve stand in blocks.
TEST_P(Hits, TellOfManyCratesThatTipOver) {
    std::vector<Crate> crates;
    for (int i = 0; i < 20; ++i) { crates.push_back({.halfX = 0.25 + 0.05 * (i % 4), .halfY = 0.5 + 0.1 * (i % 3)}); }
    expectSlapsTold(GetParam(), crates);
}

/// Each corner of a hexagon that is rolled on slaps down, with the speed that the turn about the last one gives it.
TEST_P(Hits, TellEachCornerOfAHexagonThatIsRolled) {
    constexpr double kSpin = 4;
    constexpr double kEdge = 0.5;
    World world = makeWorld(GetParam());
    addStatic(world, box(100, 1), material(0.9), {0, -1});
    std::vector<Vec2> corners;
    for (int i = 0; i < 6; ++i) {
        const DVec2 corner = turned({kEdge, 0}, i * kPi / 3);
        corners.push_back(vec(corner.x, corner.y));
    }
    const BodyId hexagon =
        addBody(world, dynamicAt({0, kEdge * std::cos(kPi / 6)}), must(convexHull(corners)), material(0.9));
    int hits = 0;
    for (int step = 0; step < 300; ++step) {
        must(world.setVelocity(hexagon, vec(kSpin * kEdge, velocityOf(world, hexagon).y), real(-kSpin)));
        must(world.step(kStep));
        for (const ContactEvent& hit : hitsOf(world)) {
            ++hits;
            EXPECT_LT(hit.approachSpeed, 2 * kSpin * kEdge);
        }
    }
    const double corner = -world.angle(hexagon) / (kPi / 3);
    EXPECT_GT(corner, 15);
    EXPECT_GT(hits, 0.7 * corner) << profileName(GetParam());
    EXPECT_LT(hits, 1.5 * corner) << profileName(GetParam());
}

/// Without friction and gravity each change of velocity is a bounce, and the hits of the step tell by which impulses.
/// @return changes that they do not explain
int untoldChanges(Profile profile, const Polygon& polygon, double speed, double spin, bool bullets, int& hits) {
    World world = makeWorld(profile, 0);
    const ShapeDef elastic = material(0, 1);
    for (const double side : {-11.0, 11.0}) {
        addStatic(world, box(12, 1), elastic, {0, side});
        addStatic(world, box(1, 12), elastic, {side, 0});
    }
    Random random(3);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 100; ++i) {
        const double x = random.range(-speed, speed);
        const double y = random.range(-speed, speed);
        BodyDef def = dynamicAt({-9.0 + 2 * (i % 10), -9.0 + 2 * (i / 10)}, vec(x, y), random.range(-spin, spin));
        def.bullet = bullets;
        bodies.push_back(addBody(world, def, polygon, elastic));
    }
    int untold = 0;
    for (int step = 0; step < 600; ++step) {
        std::map<BodyId, DVec2> expected;
        for (const BodyId body : bodies) { expected[body] = velocityOf(world, body); }
        must(world.step(kStep));
        for (const ContactEvent& hit : hitsOf(world)) {
            ++hits;
            const DVec2 impulse = static_cast<double>(hit.impulse) * toDouble(hit.normal);
            if (expected.contains(hit.bodyA)) {
                expected[hit.bodyA] = expected[hit.bodyA] - (1 / world.mass(hit.bodyA)) * impulse;
            }
            if (expected.contains(hit.bodyB)) { expected[hit.bodyB] += (1 / world.mass(hit.bodyB)) * impulse; }
        }
        for (const BodyId body : bodies) {
            untold += length(velocityOf(world, body) - expected[body]) > 0.01 * speed ? 1 : 0;
        }
    }
    return untold;
}

TEST_P(Hits, ExplainTheBouncesOfAnElasticGas) {
    for (const bool bullets : {true, false}) {
        int hits = 0;
        EXPECT_EQ(untoldChanges(GetParam(), box(0.4, 0.4), 2, 3, bullets, hits), 0)
            << profileName(GetParam()) << ", boxes" << (bullets ? ", bullets" : "");
        EXPECT_EQ(untoldChanges(GetParam(), circle(0.4), 2, 0, bullets, hits), 0)
            << profileName(GetParam()) << ", circles" << (bullets ? ", bullets" : "");
        EXPECT_GT(hits, 1000);
    }
}

TEST_P(Hits, AreNoneOfATowerOnceItStands) {
    for (const double restitution : {0.0, 0.3}) {
        World world = makeWorld(GetParam());
        addStatic(world, box(50, 1), material(0.6, restitution), {0, -1});
        for (int i = 0; i < 10; ++i) {
            const DVec2 place{0.02 * (i % 3), 0.55 + 1.05 * i};
            addBody(world, dynamicAt(place), box(0.5, 0.5), material(0.6, restitution));
        }
        EXPECT_EQ(hitsAfter(world, 180, 300), 0) << profileName(GetParam());
    }
}

TEST_P(Hits, AreNoneOfAHeapOnceItLies) {
    World world = makeWorld(GetParam());
    addStatic(world, box(50, 1), {}, {0, -1});
    addStatic(world, box(1, 20), {}, {-6, 20});
    addStatic(world, box(1, 20), {}, {6, 20});
    for (int i = 0; i < 100; ++i) {
        const DVec2 place{-4.5 + i % 10, 1 + 1.1 * (i / 10)};
        addBody(world, bodyAt(BodyType::dynamic, place, 0.3 * (i % 7)),
                i % 3 == 0 ? circle(0.4) : box(0.3 + 0.05 * (i % 5), 0.4));
    }
    EXPECT_EQ(hitsAfter(world, 700, 300), 0) << profileName(GetParam());
}

/// Over the seams of a floor.
TEST_P(Hits, AreNoneOfWhatRollsOrSlides) {
    for (const bool rolls : {true, false}) {
        World world = makeWorld(GetParam());
        for (int i = 0; i < 60; ++i) { addStatic(world, box(0.5, 0.5), material(rolls ? 0.6 : 0.1), {i - 30.0, -0.5}); }
        const Polygon polygon = rolls ? circle(0.5) : box(0.7, 0.5);
        const BodyId body =
            addBody(world, dynamicAt({-25, 0.5}, vec(6, 0), rolls ? -12 : 0), polygon, material(rolls ? 0.6 : 0.1));
        EXPECT_EQ(hitsAfter(world, 1, 240), 0) << profileName(GetParam()) << (rolls ? ", rolls" : ", slides");
        EXPECT_GT(world.position(body).x, -10);
    }
}

/// Without gravity any speed of what meets is a blow, but not what a force makes of what it presses.
TEST_P(Hits, AreNoneOfWhatIsPressedWithoutGravity) {
    for (const double restitution : {0.0, 0.5}) {
        for (const bool isBox : {true, false}) {
            World world = makeWorld(GetParam(), 0);
            addStatic(world, box(1, 10), material(0.5, restitution), {6, 0});
            const BodyId body =
                addBody(world, dynamicAt({4, 0}), isBox ? box(0.5, 0.5) : circle(0.5), material(0.5, restitution));
            const auto push = [&](int step) { must(world.applyForce(body, vec(10, step % 50 < 25 ? 3 : -3))); };
            EXPECT_EQ(hitsAfter(world, 300, 300, push), 0)
                << profileName(GetParam()) << (isBox ? ", box, " : ", ball, ") << restitution;
        }
    }
}

/// Whichever of its segments share the impulse. (Each of them told a hit of its own.)
TEST_P(Hits, OfAChainAreOneForAnImpact) {
    World world = makeWorld(GetParam());
    const BodyId level = must(world.createBody({}));
    const std::array<Vec2, 4> points{vec(5, 0), vec(0.3, 0), vec(-0.3, 0), vec(-5, 0)};
    must(world.addChain(level, points, false));
    const BodyId crate = addBody(world, dynamicAt({0, 3}), box(0.5, 0.5));
    std::vector<ContactEvent> hits;
    double before = 0;
    while (hits.empty() && world.position(crate).y > 0.4) {
        before = -world.mass(crate) * velocityOf(world, crate).y;
        must(world.step(kStep));
        hits = hitsOf(world);
    }
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_NEAR(hits[0].impulse, before, 0.1 * before);
    EXPECT_NEAR(hits[0].approachSpeed * world.mass(crate), before, 0.03 * before);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Hits, testing::Values(Profile::accurate, Profile::fast),
                         [](const auto& profile) { return profileName(profile.param); });

}  // namespace
}  // namespace swept::test

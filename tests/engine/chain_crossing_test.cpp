#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "world_support.h"

/// Chains let through what is behind them when it gets to them, however fast, and nothing that comes from their front:
/// a body that got behind a segment and through it within a step was held half way, for some steps or for ever.

namespace swept::test {
namespace {

enum class Thing { ball, box, plank, cart, pair };
constexpr Thing kThings[] = {Thing::ball, Thing::box, Thing::plank, Thing::cart, Thing::pair};
constexpr Profile kProfiles[] = {Profile::fast, Profile::accurate};

/// A chain whose front is above: y of it by x.
struct Curve {
    std::string name;
    double (*height)(double x);
    double piece;
};
const Curve kLine{"line", [](double) { return 0.0; }, 0.1};
const Curve kValley{"valley", [](double x) { return 0.05 * x * x; }, 0.1};
const Curve kHill{"hill", [](double x) { return -0.05 * x * x; }, 0.1};
const Curve kNotch{"notch", [](double x) { return std::fabs(x); }, 10};
const Curve kRoof{"roof", [](double x) { return -std::fabs(x); }, 10};
const Curve* const kCurves[] = {&kLine, &kValley, &kHill, &kNotch, &kRoof};

std::vector<Vec2> pointsOf(const Curve& curve) {
    constexpr double kEnd = 10;
    const auto pieces = static_cast<int>(std::lround(2 * kEnd / curve.piece));
    std::vector<Vec2> points;
    for (int i = 0; i <= pieces; ++i) {
        const double x = kEnd - curve.piece * i;
        points.push_back(vec(x, curve.height(x)));
    }
    return points;
}

struct Shot {
    World world;
    std::vector<BodyId> bodies;
    DVec2 way;  ///< unit

    /// @param before  metres before the middle of the chain
    Shot(Profile profile, const Curve& curve, Thing thing, double speed, double angle, bool fromBack, double before)
        : world(makeWorld(profile)), way{-std::sin(angle), fromBack ? std::cos(angle) : -std::cos(angle)} {
        WorldSettings settings = awakeSettings();
        settings.profile = profile;
        settings.gravity = {};
        must(world.configure(settings));
        must(world.addChain(must(world.createBody({})), pointsOf(curve), false, material(0)));
        const DVec2 start{0.05 - before * way.x, -before * way.y};
        put(thing, start, vec(speed * way.x, speed * way.y));
    }

    double farthest() const { return along(false); }
    double nearest() const { return along(true); }
    double slowest() const {
        double least = 1e9;
        for (const BodyId body : bodies) {
            const Vec2 velocity = world.velocity(body);
            least = std::min(least, velocity.x * way.x + velocity.y * way.y);
        }
        return least;
    }

private:
    void put(Thing thing, DVec2 at, Vec2 velocity) {
        const auto add = [&](DVec2 place, double turn, const Polygon& shape, ShapeDef def) {
            BodyDef body = dynamicAt(place, velocity);
            body.angle = turn;
            bodies.push_back(addBody(world, body, shape, def));
        };
        const auto hinge = [&](DVec2 anchor, BodyId other) {
            must(world.createJoint(RevoluteJointDef{.base = {.bodyA = bodies[0], .bodyB = other}, .anchor = anchor}));
        };
        switch (thing) {
            case Thing::ball:
                add(at, 0, circle(0.2), material(0));
                break;
            case Thing::box:
                add(at, 0.3, must(makeBox(vec(0.2, 0.2))), material(0));
                break;
            case Thing::plank:
                add(at, 0.3, must(makeBox(vec(0.5, 0.05))), material(0));
                break;
            case Thing::cart: {
                ShapeDef hull = material(0);
                hull.filter.mask = 0;
                add(at, 0, must(makeBox(vec(0.5, 0.1))), hull);
                for (const double x : {-0.4, 0.4}) {
                    const DVec2 wheel{at.x + x, at.y - 0.25};
                    add(wheel, 0, circle(0.2), material(0));
                    hinge(wheel, bodies.back());
                }
                break;
            }
            case Thing::pair:
                add(at, 0.2, must(makeBox(vec(0.3, 0.1))), material(0));
                add({at.x + 0.5, at.y + 0.1}, 0.2, must(makeBox(vec(0.2, 0.1))), material(0));
                hinge({at.x + 0.25, at.y + 0.05}, bodies.back());
                break;
        }
    }
    double along(bool isLast) const {
        double result = isLast ? 1e9 : -1e9;
        for (const BodyId body : bodies) {
            const DVec2 center = world.centerOfMass(body);
            const double there = center.x * way.x + center.y * way.y;
            result = isLast ? std::min(result, there) : std::max(result, there);
        }
        return result;
    }
};

/// Whether what flies straight through the middle is behind the chain before, and in front after it.
bool isThrough(const Curve& curve, DVec2 way) {
    for (double t = 1.3; t < 2.5; t += 0.1) {
        const double after = way.y * t - curve.height(0.05 + way.x * t);
        const double before = -way.y * t - curve.height(0.05 - way.x * t);
        if (!(before < -0.02) || !(after > 0.02)) { return false; }
    }
    return true;
}

std::string crossingCase(Profile profile, const Curve& curve, Thing thing, double speed, double angle, double offset) {
    return profileName(profile) + ", " + curve.name + ", thing " + std::to_string(static_cast<int>(thing)) + ", " +
           std::to_string(speed) + " m/s, angle " + std::to_string(angle) + ", offset " + std::to_string(offset);
}

class ChainCrossing : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Speeds, ChainCrossing, testing::Values(5.0, 13.0, 40.0, 100.0));

TEST_P(ChainCrossing, OfWhatComesFromBehindTakesNothingFromIt) {
    const double speed = GetParam();
    for (const Profile profile : kProfiles) {
        for (const Curve* curve : kCurves) {
            for (const Thing thing : kThings) {
                for (const double angle : {0.0, 0.4, -0.6, -0.9, 1.2}) {
                    for (const double offset : {0.0, 0.037, 0.171, 0.31}) {
                        Shot shot(profile, *curve, thing, speed, angle, true, 2.5 + offset);
                        if (!isThrough(*curve, shot.way)) { continue; }
                        const std::string name = crossingCase(profile, *curve, thing, speed, angle, offset);
                        double lost = 0;
                        for (int i = 0; i < 120 && shot.nearest() < 1.4; ++i) {
                            must(shot.world.step(kStep));
                            for (const LostTimeEntry& entry : shot.world.lostTime()) { lost += entry.seconds; }
                        }
                        EXPECT_GE(shot.nearest(), 1.4) << name;
                        EXPECT_EQ(lost, 0) << name;
                        EXPECT_GT(shot.slowest(), 0.999 * speed) << name;
                    }
                }
            }
        }
    }
}

/// A plank that got into the side beyond the corner has no points there: the next step did not know of it, and held it.
TEST_P(ChainCrossing, ThroughAnInnerCornerTakesNothing) {
    const double speed = GetParam();
    for (const Profile profile : kProfiles) {
        for (const double slope : {0.14, 0.27, 0.58, 1.0}) {  // of both sides of a valley
            for (int turn = 0; turn < 12; ++turn) {
                for (const double x : {-0.5, -0.25, 0.0, 0.25}) {
                    World world = makeWorld(profile, 0);
                    const std::array<Vec2, 3> valley{vec(20, 20 * slope), vec(0, 0), vec(-20, 20 * slope)};
                    must(world.addChain(must(world.createBody({})), valley, false));
                    BodyDef def = dynamicAt({x, -2}, vec(0.1 * speed, speed));
                    def.angle = turn * kPi / 12 + 0.01;
                    const BodyId plank = addBody(world, def, box(0.5, 0.1));
                    const std::string name = profileName(profile) + ", slope " + std::to_string(slope) + ", turn " +
                                             std::to_string(turn) + ", from " + std::to_string(x);
                    double lost = 0;
                    for (int i = 0; i < static_cast<int>(8 / speed * kRate) + 2; ++i) {
                        must(world.step(kStep));
                        for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
                    }
                    EXPECT_EQ(lost, 0) << name;
                    EXPECT_GT(world.position(plank).y, 3) << name;
                }
            }
        }
    }
}

TEST_P(ChainCrossing, FromTheFrontThereIsNone) {
    const double speed = GetParam();
    for (const Profile profile : kProfiles) {
        for (const Curve* curve : kCurves) {
            for (const Thing thing : kThings) {
                for (const double angle : {0.0, 0.4, -0.6, -0.9, 1.2, 1.5}) {
                    for (const double offset : {0.0, 0.037, 0.171, 0.31}) {
                        Shot shot(profile, *curve, thing, speed, angle, false, 2.5 + offset);
                        const DVec2 start = shot.world.centerOfMass(shot.bodies[0]);
                        if (start.y - curve->height(start.x) < 0.9) { continue; }
                        for (int i = 0; i < 60; ++i) {
                            must(shot.world.step(kStep));
                            for (const BodyId body : shot.bodies) {
                                if (thing == Thing::cart && body == shot.bodies[0]) {
                                    continue;
                                }  // collides with nothing
                                const DVec2 center = shot.world.centerOfMass(body);
                                if (std::fabs(center.x) > 9) { continue; }  // round its end
                                ASSERT_GT(center.y, curve->height(center.x))
                                    << crossingCase(profile, *curve, thing, speed, angle, offset) << ", step " << i;
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Through a platform, off a ceiling close above it within the same step, and down onto it: it is in front by then.
TEST_P(ChainCrossing, IsOverForWhatComesBackFromACeiling) {
    constexpr double kBall = 0.05;
    for (const Profile profile : kProfiles) {
        for (int i = 0; i < 40; ++i) {
            Shot shot(profile, kLine, Thing::ball, 0, 0, true, 30);
            World& world = shot.world;
            const BodyId ceiling = must(world.createBody(bodyAt(BodyType::fixed, {0, 1})));
            ShapeDef bouncy = material(0);
            bouncy.restitution = 1;
            must(world.addShape(ceiling, must(makeBox(vec(5, 0.5))), bouncy));
            const DVec2 start{0.03, -1 - 0.05 * i};
            const BodyId ball = addBody(world, dynamicAt(start, vec(0, GetParam())), circle(kBall), bouncy);
            bool wasThrough = false;
            for (int step = 0; step < 120; ++step) {
                must(world.step(kStep));
                const double y = world.position(ball).y;
                wasThrough = wasThrough || y > kBall;
                if (wasThrough) { ASSERT_GT(y, 0) << profileName(profile) << ", " << i << ", step " << step; }
            }
            EXPECT_TRUE(wasThrough) << profileName(profile) << ", " << i;
        }
    }
}

/// Planks that come through both sides of a corner at once: between the two is no contact that knew of it, and one in
/// ten hung there for ever.
TEST(ChainCrossingOfACorner, HoldsNoPlank) {
    for (const Profile profile : kProfiles) {
        for (const double half : {0.2, kPi / 4}) {
            for (const double speed : {5.0, 13.0, 40.0, 100.0}) {
                for (const double tilt : {0.3, 0.9}) {
                    for (const double offset : {-0.3, 0.0, 0.1, 0.25, 0.37}) {
                        World world = makeWorld(profile, 0);
                        const double x = 10 * std::sin(half);
                        const double y = 10 * std::cos(half);
                        const std::vector<Vec2> points{vec(x, y), vec(0, 0), vec(-x, y)};
                        must(world.addChain(must(world.createBody({})), points, false, material(0)));
                        BodyDef def = dynamicAt({offset, -2.6}, vec(0, speed));
                        def.angle = tilt;
                        const BodyId plank = addBody(world, def, box(0.5, 0.05), material(0));
                        double lost = 0;
                        for (int i = 0; i < 150 && world.position(plank).y < 8; ++i) {
                            must(world.step(kStep));
                            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
                        }
                        const std::string name = profileName(profile) + ", half angle " + std::to_string(half) + ", " +
                                                 std::to_string(speed) + " m/s, tilt " + std::to_string(tilt) +
                                                 ", offset " + std::to_string(offset);
                        EXPECT_GE(world.position(plank).y, 8) << name;
                        EXPECT_EQ(lost, 0) << name;
                    }
                }
            }
        }
    }
}

/// A floor, and a wall that stands on its end, one chain: who comes through the wall from behind lands on the floor, in
/// front of which he is. It fell through, since it was in the chain: 2504 of 7500 balls, boxes, planks, carts, pairs.
TEST(ChainCrossingOfADoor, IsNoneOfTheFloor) {
    for (const Profile profile : kProfiles) {
        for (const bool isRound : {false, true}) {
            for (const bool isBall : {true, false}) {
                for (const double speed : {2.0, 13.0, 40.0}) {
                    for (const double angle : {0.0, -0.7}) {
                        for (const double above : {0.05, 0.1, 0.25, 0.6}) {
                            World world = makeWorld(profile);
                            std::vector<Vec2> points{vec(40, 0)};
                            constexpr double kFillet = 0.3;
                            for (double turn = 0; turn < 1.6; turn += isRound ? kPi / 16 : 2) {
                                const double size = isRound ? kFillet : 0;
                                points.push_back(vec(size - size * std::sin(turn), size - size * std::cos(turn)));
                            }
                            points.push_back(vec(0, 5));
                            must(world.addChain(must(world.createBody({})), points, false, material(0.3)));
                            addStatic(world, box(20, 1), material(0.3), {isRound ? kFillet - 20 : -20, -1});
                            constexpr double kHalf = 0.2;
                            const double start = (isRound ? 0.2 : 0) + kHalf + above + std::tan(-angle);
                            const Polygon shape = isBall ? circle(kHalf) : box(kHalf, kHalf);
                            const Vec2 velocity = vec(speed * std::cos(angle), speed * std::sin(angle));
                            const BodyId body = addBody(world, dynamicAt({-1, start}, velocity), shape, material(0.3));
                            run(world, 120);
                            const DVec2 place = world.position(body);
                            if (place.x > 39) { continue; }  // it left at the other end
                            EXPECT_GT(place.y, 0) << profileName(profile) << ", " << isRound << isBall << ", " << speed
                                                  << " m/s, " << angle << ", " << above;
                        }
                    }
                }
            }
        }
    }
}

/// A ball that is half in a chain as a step ends.
struct HalfThrough {
    World world;
    BodyId ground;
    ShapeId chain;
    BodyId ball;
    double top = 0;  ///< of the ball

    explicit HalfThrough(Profile profile, double speed) : world(makeWorld(profile, 0)) {
        ground = must(world.createBody({}));
        chain = must(world.addChain(ground, std::vector{vec(5, 0), vec(-5, 0)}, false));
        constexpr double kBall = 0.2;
        ball = addBody(world, dynamicAt({0, 0.1 - 3 * speed * kStep}, vec(0, speed)), circle(kBall));
        run(world, 3);
        top = world.position(ball).y + kBall;
        EXPECT_NEAR(top, kBall + 0.1, 0.01);
    }
};

/// What is built in its place, or where the chain is put, is no chain that the ball is in, and stands in its way.
TEST(ChainCrossingEnds, WithTheChainAndWhereItIs) {
    for (const Profile profile : kProfiles) {
        for (const double speed : {20.0, 100.0}) {
            HalfThrough built(profile, speed);
            const double wall = built.top + 0.0005;
            must(built.world.destroyShape(built.chain));
            must(built.world.addChain(built.ground, std::vector{vec(-5, wall), vec(5, wall)}, false));
            run(built.world, 5);
            EXPECT_LT(built.world.position(built.ball).y, wall) << profileName(profile) << ", " << speed << " m/s";
            HalfThrough moved(profile, speed);
            must(moved.world.setPose(moved.ground, {0, wall}, kPi));
            run(moved.world, 5);
            EXPECT_LT(moved.world.position(moved.ball).y, wall) << profileName(profile) << ", " << speed << " m/s";
        }
    }
}

/// As from a ceiling, but of what looks for others on its way: bullets, and balls that touch and bounce.
TEST(ChainCrossingOfBullets, IsOverForWhatComesBack) {
    constexpr double kBall = 0.05;
    for (const Profile profile : kProfiles) {
        for (const bool areTwo : {false, true}) {
            for (const double speed : {5.0, 10.0, 30.0}) {
                for (int i = 0; i < 24; ++i) {
                    Shot shot(profile, kLine, Thing::ball, 0, 0, true, 30);
                    World& world = shot.world;
                    ShapeDef bouncy = material(0, 1);
                    addStatic(world, box(5, 0.5), bouncy, {0, areTwo ? 0.63 : 0.61});
                    std::vector<BodyId> balls;
                    for (int k = 0; k < (areTwo ? 2 : 1); ++k) {
                        const DVec2 start{0.03 + 0.10005 * k, -1 - speed * kStep * i / 24};
                        BodyDef def = dynamicAt(start, vec(0, speed));
                        def.bullet = !areTwo;
                        balls.push_back(addBody(world, def, circle(kBall), bouncy));
                    }
                    for (int step = 0; step < 30; ++step) {
                        must(world.step(kStep));
                        for (const BodyId ball : balls) {
                            const bool isBack = world.position(ball).y < 0 && world.velocity(ball).y < 0;
                            ASSERT_FALSE(isBack) << profileName(profile) << ", " << areTwo << ", " << speed << " m/s, "
                                                 << i << ", step " << step;
                        }
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test

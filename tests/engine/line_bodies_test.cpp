#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../support/random.h"
#include "../support/some_of.h"
#include "world_support.h"

/// Dynamic segments without a radius, against what has no thickness either, or hardly any: whatever sinks in by half of
/// a peg is on its other side, and pushed out there. So they have a skin (line_skin.h), and are swept however slow they
/// are. (Of the first ones below hundreds went through; of planks of 1 mm hardly any did.)

namespace swept::test {
namespace {

class LineBodies : public testing::TestWithParam<Profile> {};

/// Sees a line pass through a peg: it is above in one step and below in the next, and never ended before the peg.
class PegWatch {
public:
    PegWatch(BodyId line, DVec2 peg, double first, double last) : line_(line), peg_(peg), first_(first), last_(last) {}

    /// After every step. @return whether it passed
    bool passed(const World& world, DVec2 peg) {
        peg_ = peg;
        const bool wasOver = isOver_;
        const DVec2 offset = turned(peg_ - world.position(line_), -world.angle(line_));
        isOver_ = offset.x > first_ && offset.x < last_;
        const bool wasAbove = isAbove_;
        isAbove_ = offset.y < 0;
        return wasOver && isOver_ && wasAbove && !isAbove_;
    }
    bool passed(const World& world) { return passed(world, peg_); }

private:
    BodyId line_;
    DVec2 peg_;
    double first_;
    double last_;
    bool isOver_ = false;
    bool isAbove_ = false;
};

Polygon pegOf(Random& random, double half) { return random.chance(0.5) ? circle(half) : box(half, half); }
double thinHalf(Random& random) { return std::pow(10, random.range(-3, -1.5)); }

BodyDef lineAt(DVec2 position) {
    BodyDef def = dynamicAt(position);
    def.mass = 1;
    def.inertia = real(0.1);
    return def;
}

TEST_P(LineBodies, ThatSwingAreStoppedByPegs) {
    int stopped = 0;
    for (std::uint64_t seed = 0; seed < someOf(600U); ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam(), 0);
        const double half = thinHalf(random);
        addStatic(world, pegOf(random, half), material(0));
        const DVec2 pivot{-random.range(0.2, 0.95), 0};
        const BodyId post = must(world.createBody({.position = pivot}));
        BodyDef def = lineAt(pivot);
        def.angle = random.range(0.3, 2);
        def.angularVelocity = -real(random.range(2, 40));
        const BodyId line = addBody(world, def, segment(0, 0, 1, 0));
        must(world.createJoint(RevoluteJointDef{.base = {.bodyA = post, .bodyB = line}, .anchor = pivot}));
        PegWatch watch(line, {}, 0.02, 0.98);
        for (int i = 0; i < 60 && spinOf(world, line) <= 0; ++i) {
            run(world, 1);
            ASSERT_FALSE(watch.passed(world)) << profileName(GetParam()) << ", seed " << seed << ", step " << i;
        }
        stopped += spinOf(world, line) > 0 || world.angle(line) > -0.5 ? 1 : 0;
    }
    EXPECT_GT(stopped, someOf(590));
}

TEST_P(LineBodies, ThatABoxPressesLieOnTheirPegs) {
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam());
        const double half = thinHalf(random);
        const std::array<DVec2, 2> pegs{DVec2{-0.4, 0}, {0.4, 0}};
        for (const DVec2 peg : pegs) { addStatic(world, pegOf(random, half), material(0.6), peg); }
        const BodyId line = addBody(world, lineAt({0, 1.1 * half + 0.001}), segment(-0.5, 0, 0.5, 0));
        const double size = random.range(0.05, 0.3);
        const double x = random.range(-0.2, 0.2);
        BodyDef def = dynamicAt({x, size + random.range(0.02, 2)}, vec(0, -std::pow(10, random.range(-1, 1.5))));
        def.angle = random.range(-1, 1);
        addBody(world, def, box(size, size), material(0.6, 0, std::pow(10, random.range(0, 3))));
        std::array<PegWatch, 2> watches{PegWatch(line, pegs[0], -0.48, 0.48), PegWatch(line, pegs[1], -0.48, 0.48)};
        bool isThrough = false;
        for (int i = 0; i < 120; ++i) {
            run(world, 1);
            for (PegWatch& watch : watches) { isThrough = watch.passed(world) || isThrough; }
        }
        EXPECT_FALSE(isThrough) << profileName(GetParam()) << ", seed " << seed << ", pegs of " << 2 * half;
    }
}

/// The peg comes from below, and lifts what lies on two others.
TEST_P(LineBodies, AreLiftedByAPeg) {
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam());
        const double half = thinHalf(random);
        for (const double x : {-0.4, 0.4}) { addStatic(world, pegOf(random, half), material(0.6), {x, 0}); }
        const BodyId line = addBody(world, lineAt({0, 1.1 * half + 0.001}), segment(-0.5, 0, 0.5, 0));
        const double x = random.range(-0.1, 0.1);
        const BodyId peg = addBody(world, bodyAt(BodyType::kinematic, {x, -0.5}), pegOf(random, half), material(0.6));
        run(world, static_cast<int>(random.range(1, 30)));
        must(world.setVelocity(peg, vec(0, std::pow(10, random.range(-1, 1.5))), real(0)));
        PegWatch watch(line, {}, -0.48, 0.48);
        for (int i = 0; i < 60; ++i) {
            run(world, 1);
            EXPECT_FALSE(watch.passed(world, world.position(peg)))
                << profileName(GetParam()) << ", seed " << seed << ", step " << i;
        }
    }
}

/// A room of 4 m whose walls have no thickness either, or of one chain, with round pegs, lines, boxes and joints.
class LineRoom {
public:
    LineRoom(Profile profile, std::uint64_t seed) : random_(seed) {
        world = makeWorld(profile, random_.chance(0.6) ? kGravity : 0);
        surface_ = material(random_.range(0, 1), random_.chance(0.3) ? random_.range(0, 1) : 0);
        addWalls();
        const int lines = random_.integer(1, 4);
        for (int i = 0; i < lines; ++i) { addLine(); }
        for (int i = random_.integer(0, 3); i > 0; --i) { addBox(); }
        for (int i = random_.integer(0, 3); i > 0; --i) { addJoint(); }
    }

    /// How far the farthest point of a line, or middle of a box, is outside, metres.
    double outside() const {
        double farthest = -kHalf;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            for (const double end : {-1.0, 0.0, 1.0}) {
                const DVec2 arm = turned({end * halves_[i], 0}, world.angle(bodies_[i]));
                const DVec2 point = world.position(bodies_[i]) + arm;
                farthest = std::max({farthest, std::abs(point.x) - kHalf, std::abs(point.y) - kHalf});
            }
        }
        return farthest;
    }

    World world;

private:
    static constexpr double kHalf = 2;

    void addWalls() {
        const BodyId room = must(world.createBody({}));
        const std::array<Vec2, 4> corners{vec(-kHalf, kHalf), vec(kHalf, kHalf), vec(kHalf, -kHalf),
                                          vec(-kHalf, -kHalf)};
        if (random_.chance(0.5)) {
            must(world.addChain(room, corners, true, surface_));
        } else {
            for (std::size_t i = 0; i < 4; ++i) {
                must(world.addShape(room, must(makeSegment(corners[i], corners[(i + 1) % 4])), surface_));
            }
        }
        for (int i = random_.integer(0, 6); i > 0; --i) {
            const Vec2 center = place(1.5);
            must(world.addShape(room, must(makeCircle(center, real(std::pow(10, random_.range(-2.5, -0.5))))),
                                surface_));
        }
    }

    Vec2 place(double most) {
        const double x = random_.range(-most, most);
        return vec(x, random_.range(-most, most));
    }

    BodyDef thrown() {
        BodyDef def = dynamicAt(toDouble(place(1.2)));
        def.angle = random_.range(-kPi, kPi);
        const double speed = std::pow(10, random_.range(-1, 1.8));
        def.velocity = toReal(turned({speed, 0}, random_.range(-kPi, kPi)));
        const double most = std::pow(10, random_.range(-1, 1.5));
        def.angularVelocity = real(random_.range(-most, most));
        return def;
    }

    void addLine() {
        BodyDef def = thrown();
        const double half = random_.range(0.1, 0.5);
        const double mass = std::pow(10, random_.range(-1, 2));
        def.mass = real(mass);
        def.inertia = real(mass * half * half / 3);
        bodies_.push_back(addBody(world, def, segment(-half, 0, half, 0), surface_));
        halves_.push_back(half);
    }

    void addBox() {
        const BodyDef def = thrown();
        const double half = random_.range(0.05, 0.3);
        ShapeDef heavy = surface_;
        heavy.density = real(std::pow(10, random_.range(-1, 2)));
        bodies_.push_back(addBody(world, def, box(half, half * random_.range(0.3, 1)), heavy));
        halves_.push_back(0);
    }

    void addJoint() {
        const BodyId a = bodies_[static_cast<std::size_t>(random_.integer(0, static_cast<int>(bodies_.size()) - 1))];
        const BodyId b = bodies_[static_cast<std::size_t>(random_.integer(0, static_cast<int>(bodies_.size()) - 1))];
        if (a == b) { return; }
        const JointDef base{.bodyA = a, .bodyB = b};
        if (random_.chance(0.5)) {
            must(world.createJoint(RevoluteJointDef{.base = base, .anchor = world.position(a)}));
        } else {
            must(world.createJoint(
                DistanceJointDef{.base = base, .anchorA = world.position(a), .anchorB = world.position(b)}));
        }
    }

    Random random_;
    ShapeDef surface_;
    std::vector<BodyId> bodies_;
    std::vector<double> halves_;  ///< of lines
};

/// (Of 300 rooms without joints whose walls are segments, or boxes, lines left 96, each of those of segments.)
TEST_P(LineBodies, StayInRoomsWithWallsOfNoThickness) {
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        LineRoom room(GetParam(), seed);
        for (int i = 0; i < 240; ++i) {
            run(room.world, 1);
            ASSERT_LT(room.outside(), 0.01) << profileName(GetParam()) << ", seed " << seed << ", step " << i;
        }
    }
}

/// It has a skin only as long as contacts move it, and only there; what it is made of and weighs is what was given.
TEST(LineBody, IsTheSegmentThatWasGiven) {
    World world = makeWorld(Profile::accurate);
    addStatic(world, segment(-10, 0, 10, 0));
    const BodyId line = addBody(world, lineAt({0, 0.5}), segment(-0.5, 0, 0.5, 0));
    const auto radius = [&world, line] {
        Real found = -1;
        world.visitShapes(line, [&](ShapeId shape) {
            world.visitPolygons(shape, [&](const Polygon& polygon) { found = polygon.radius; });
        });
        return found;
    };
    EXPECT_EQ(world.mass(line), 1);
    EXPECT_EQ(radius(), 0);
    runFor(world, 1);
    EXPECT_GT(world.position(line).y, 0);
    EXPECT_NEAR(world.position(line).y, 1.0 / 4096, 0.5 / 4096);

    ShapeId shape;
    world.visitShapes(line, [&](ShapeId id) { shape = id; });
    const auto top = [&world] { return world.castRay({0, 1}, vec(0, -1)).point.y; };
    const double height = world.position(line).y;
    EXPECT_NEAR(top(), height + 1.0 / 4096, 1e-6);
    ShapeDef seeing = world.definition(shape);
    seeing.sensor = true;
    must(world.redefine(shape, seeing));
    QueryFilter all;
    all.sensors = true;
    EXPECT_NEAR(world.castRay({0, 1}, vec(0, -1), all).point.y, height, 1e-6);
    seeing.sensor = false;
    must(world.redefine(shape, seeing));
    EXPECT_NEAR(top(), height + 1.0 / 4096, 1e-6);

    BodyDef def = world.definition(line);
    def.type = BodyType::fixed;
    must(world.redefine(line, def));
    EXPECT_EQ(radius(), 0);
    EXPECT_NEAR(top(), height, 1e-6);
    def.type = BodyType::dynamic;
    def.mass = 0;
    must(world.redefine(line, def));
    EXPECT_EQ(world.bodyWithoutMass(), line) << "a segment has no area";
}

INSTANTIATE_TEST_SUITE_P(InProfile, LineBodies, testing::ValuesIn(kProfiles),
                         [](const auto& given) { return profileName(given.param); });

}  // namespace
}  // namespace swept::test

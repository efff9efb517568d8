#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "../support/random.h"
#include "../support/some_of.h"
#include "joint_support.h"

/// Jointed bodies that collide with each other though their joints hold them where they overlap: neither can win, and
/// nothing may come of it. And chains on springs, whose energy solvers may not multiply either.

namespace swept::test {
namespace {

/// Of what a joint leaves free, in metres or radians.
struct Free {
    double least;
    double most;
};

template <class Def>
void tieInPlace(World& world, const JointDef& base, DVec2 anchor, double angle, const std::optional<Spring>& spring,
                const std::optional<Free>& free) {
    Def def;
    if constexpr (requires { def.limits; }) {
        if (free) { def.limits = {real(free->least), real(free->most)}; }
    }
    if constexpr (requires { def.spring; }) { def.spring = spring; }
    if constexpr (requires { def.linearSpring; }) { def.linearSpring = spring; }
    def.base = base;
    def.anchor = anchor;
    if constexpr (requires { def.axis; }) { def.axis = {std::cos(angle), std::sin(angle)}; }
    must(world.createJoint(def));
}

enum class Ties : std::uint8_t { overlapping, sprung, limited };

void tieSomehow(World& world, BodyId a, BodyId b, Ties ties, Random& random) {
    JointDef base = between(a, b);
    base.collideConnected = ties != Ties::sprung && random.chance(0.5);
    std::optional<Spring> spring;
    if (ties == Ties::sprung && random.chance(0.6)) { spring = Spring{real(random.range(1, 30)), 0}; }
    std::optional<Free> free;
    if (ties == Ties::limited && random.chance(0.5)) {
        const double least = random.range(-0.5, 0);
        free = Free{least, random.range(0, 0.5)};
    }
    const DVec2 middle = 0.5 * (world.position(a) + world.position(b));
    const double aside = random.range(-0.2, 0.2);
    const DVec2 anchor = middle + DVec2{aside, random.range(-0.2, 0.2)};
    const double angle = random.range(0, 2 * kPi);
    switch (random.integer(0, 4)) {
        case 0:
            return tieInPlace<RevoluteJointDef>(world, base, anchor, angle, spring, free);
        case 1:
            return tieInPlace<PrismaticJointDef>(world, base, anchor, angle, spring, free);
        case 2:
            return tieInPlace<WheelJointDef>(world, base, anchor, angle, spring, free);
        case 3:
            return tieInPlace<WeldJointDef>(world, base, anchor, angle, spring, free);
        default:
            break;
    }
    DistanceJointDef rod;
    rod.base = base;
    rod.anchorA = world.position(a) + DVec2{aside, 0.1};
    rod.anchorB = world.position(b) + DVec2{0.1, aside};
    rod.spring = spring;
    if (free) {
        const double length = swept::length(rod.anchorB - rod.anchorA);
        rod.limits = LengthLimits{real(0.7 * length), real(1.3 * length)};
    }
    must(world.createJoint(rod));
}

/// Up to six boxes and disks, half of which overlap their neighbours.
std::vector<BodyId> addChain(World& world, double massRatio, Ties ties, Random& random) {
    std::vector<BodyId> bodies;
    DVec2 place{-2, random.range(3, 8)};
    const int count = random.integer(2, 6);
    for (int i = 0; i < count; ++i) {
        BodyDef def = dynamicAt(place);
        def.angle = random.range(-1, 1);
        ShapeDef surface;
        surface.density = real(std::pow(massRatio, random.uniform()));
        surface.friction = real(random.uniform());
        const double width = random.range(0.1, 0.4);
        const double height = random.range(0.1, 0.4);
        const Polygon shape = random.chance(0.7) ? box(width, height) : circle(width);
        bodies.push_back(addBody(world, def, shape, surface));
        if (i > 0) { tieSomehow(world, bodies[bodies.size() - 2], bodies.back(), ties, random); }
        place.x += random.range(0.5, 0.9);
        place.y += random.range(-0.3, 0.3);
    }
    return bodies;
}

/// Twelve metres between its walls.
void addRoom(World& world) {
    const ShapeDef surface = material(0.6);
    addStatic(world, box(8, 1), surface, {0, -1});
    addStatic(world, box(8, 1), surface, {0, 21});
    addStatic(world, box(1, 12), surface, {-7, 10});
    addStatic(world, box(1, 12), surface, {7, 10});
}

/// Largest energy within ten seconds, as a part of that at the start.
double growthOf(const WorldSettings& settings, double massRatio, Ties ties, std::uint64_t seed) {
    Random random(seed);
    World world = makeWorld(settings);
    addRoom(world);
    const std::vector<BodyId> bodies = addChain(world, massRatio, ties, random);
    const double start = energyOf(world, bodies, kGravity);
    double most = 0;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        most = std::max(most, energyOf(world, bodies, kGravity));
    }
    return most / start;
}

/// An overlap that joints hardly let go was a spring as stiff as a thousand times the masses: of 120 such chains eight
/// were flung about, with up to 2380 times the energy of their fall. (What begins with an overlap is pushed apart
/// first: hence the tenth.)
TEST(JointOverlaps, OfNeighboursThatCollideMakeNoEnergy) {
    for (std::uint64_t seed = 0; seed < someOf(120U); ++seed) {
        const double growth = growthOf(awakeSettings(), seed % 2 == 0 ? 10 : 100, Ties::overlapping, seed);
        expectAtMost("seed " + std::to_string(seed), growth, 1.1);
    }
}

/// Where a limit holds them overlapping, what it carries and what the contact carries fed each other, a thousandfold in
/// a step. (Of the first 400 such chains 193 had 2.7 times its energy then in float, 362 in double 6.5 times.)
TEST(JointOverlaps, OfNeighboursWithLimitsMakeNoEnergy) {
    std::vector<std::uint64_t> seeds{193, 362};
    for (std::uint64_t seed = 0; seed < someOf(80U); ++seed) { seeds.push_back(seed); }
    for (const std::uint64_t seed : seeds) {
        const double growth = growthOf(awakeSettings(), seed % 2 == 0 ? 10 : 100, Ties::limited, seed);
        expectAtMost("seed " + std::to_string(seed), growth, 1.1);
    }
}

/// Without gravity nothing has any energy, and what rounding leaves of a push is many times as much. (With a slack rope
/// to the post it stayed where it was for ever in double, and 2 cm deep in float.)
TEST(JointOverlaps, ComeApartWithoutGravity) {
    for (const bool isRoped : {false, true}) {
        World world = makeWorld(0);
        const BodyId post = addStatic(world, box(1, 1));
        const BodyId crate = addBody(world, dynamicAt({1.4, 0}), box(0.5, 0.5));
        if (isRoped) {
            DistanceJointDef rope;
            rope.base = between(post, crate);
            rope.base.collideConnected = true;
            rope.limits = LengthLimits{0, 9};
            must(world.createJoint(rope));
        }
        runFor(world, 3);
        EXPECT_NEAR(world.position(crate).x, 1.5, 1e-3) << (isRoped ? "roped" : "free");
    }
}

/// Springs switched the guard over energy off. (Of these chains one then had 39 times the energy of its fall; of 2000
/// random ones with limits as well 9 had more than a tenth too much.)
TEST(JointSprings, ChainsThatFallOnThemMakeNoEnergy) {
    WorldSettings settings = awakeSettings(Profile::fast);
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        expectAtMost("seed " + std::to_string(seed), growthOf(settings, 10, Ties::sprung, seed), 1.1);
    }
}

}  // namespace
}  // namespace swept::test

#include <array>
#include <sstream>
#include <vector>

#include "../support/random.h"
#include "world_support.h"

/// Collide and slide: cast, go as far as that, take from the rest of the way what leads into the normal, cast again.
/// What was slid along is then free, so that nobody hangs on a seam of the ground; and nobody gets through it.

namespace swept::test {
namespace {

constexpr int kMostCasts = 4;
constexpr DVec2 kFarOff{1e5, -2e5};

double along(Vec2 way, Vec2 normal) { return dot(toDouble(way), toDouble(normal)); }

/// As games do it, in the precision of the world.
Vec2 withoutPartInto(Vec2 way, Vec2 normal) { return way - std::min(dot(way, normal), Real(0)) * normal; }

bool isStoppedAtOnce(const CastHit& hit) { return hit.hit && hit.fraction <= 0; }

/// One of the forms of characters, about as wide as that.
Polygon anyCharacter(Random& random, double width) {
    const int kind = random.integer(0, 4);
    const double half = width / 2;
    const double angle = random.range(0, 3);
    switch (kind) {
        case 0:
            return circle(half);
        case 1:
            return must(makeCapsule(vec(0, -half), vec(0, half), real(half)));
        case 2:
            return box(half, width);
        case 3:
            return must(makeBox(vec(half, width), {}, angle));
        default:
            return must(makeBox(vec(0.8 * half, 1.2 * half), {}, angle, real(0.2 * half)));
    }
}

/// Smallest width: of what overlaps by up to an eighth of it casts are free.
double widthOf(const Polygon& polygon) {
    if (polygon.count < 3) { return 2 * static_cast<double>(polygon.radius); }
    const double first = length(toDouble(polygon.vertices[1] - polygon.vertices[0]));
    const double second = length(toDouble(polygon.vertices[2] - polygon.vertices[1]));
    return std::min(first, second) + 2 * static_cast<double>(polygon.radius);
}

struct Walker {
    Polygon polygon;
    DVec2 place;
    bool contradicts = false;  ///< a cast was stopped at once by what its way does not lead into
    bool isInside = false;     ///< it had to be taken out of something
    bool stands = false;       ///< met something to stand on

    void slide(const World& world, Vec2 way) {
        stands = false;
        for (int i = 0; i < kMostCasts && way != Vec2{}; ++i) {
            const CastHit hit = world.castShape(polygon, {place, {}}, way);
            if (!hit.hit) {
                place = place + toDouble(way);
                return;
            }
            place = place + static_cast<double>(hit.fraction) * toDouble(way) + toDouble(hit.wayOut);
            if (hit.normal == Vec2{}) {
                isInside = true;
                return;
            }
            contradicts = contradicts || (hit.fraction <= 0 && along(way, hit.normal) >= 0);
            stands = stands || hit.normal.y > real(0.5);
            way = withoutPartInto((1 - hit.fraction) * way, hit.normal);
        }
    }
};

enum class HillKind { chain, segments, tiles };
constexpr std::array kHillKinds{HillKind::chain, HillKind::segments, HillKind::tiles};

constexpr int kHalfCount = 60;  ///< of the vertices of hills, on each side of the origin

/// Vertices from right to left, below y = 0.
std::vector<Vec2> anyHills(Random& random, double size) {
    const double spacing = size * std::exp(random.range(-1.4, 1.8));
    const double turn = random.range(0.2, 0.6);  // rad per vertex
    const double steepest = random.range(0.05, 1.6);
    const double start = random.range(0, 6);
    const double height = steepest * spacing / turn;
    std::vector<Vec2> points;
    for (int i = kHalfCount; i >= -kHalfCount; --i) {
        points.push_back(vec(i * spacing, (std::sin(i * turn + start) - 1) * height));
    }
    return points;
}

void addHills(World& world, HillKind kind, const std::vector<Vec2>& points, DVec2 origin) {
    const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, origin)));
    if (kind == HillKind::chain) {
        must(world.addChain(body, points, false));
        return;
    }
    Real floor = 0;
    for (const Vec2 point : points) { floor = std::min(floor, point.y); }
    floor -= points[0].x;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec2 right = points[i];
        const Vec2 left = points[i + 1];
        const std::array<Vec2, 4> tile{{{left.x, floor}, {right.x, floor}, right, left}};
        must(world.addShape(body, kind == HillKind::tiles ? must(makePolygon(tile)) : must(makeSegment(right, left))));
    }
}

/// It walks to the right, falls, and slides. @return whether it came across
bool comesAcross(const World& world, Walker& walker, double speed, double fallPerStep, double end) {
    constexpr int kPatience = 30;
    double fall = 0;
    for (int still = 0, step = 0; still < kPatience && step < 20'000; ++step) {
        if (walker.place.x >= end) { return true; }
        const double before = walker.place.x;
        fall += fallPerStep;
        walker.slide(world, vec(speed * kStep, -fall * kStep));
        if (walker.stands) { fall = 0; }
        still = walker.place.x - before < 0.02 * speed * kStep ? still + 1 : 0;
    }
    return false;
}

/// Sizes in metres, speeds in sizes a second.
TEST(CastsThatSlide, NobodyHangsOnHills) {
    for (const double size : {0.05, 0.4, 20.0}) {
        for (const HillKind kind : kHillKinds) {
            for (std::uint64_t seed = 0; seed < 24; ++seed) {
                Random random(seed);
                const std::vector<Vec2> hills = anyHills(random, size);
                const double spacing = static_cast<double>(hills[0].x - hills[1].x);
                const DVec2 origin = random.chance(0.3) ? kFarOff : DVec2{};
                const double speed = size * std::array{2.5, 7.5, 20.0}[seed % 3];
                World world = makeWorld();
                addHills(world, kind, hills, origin);
                const DVec2 start = origin + DVec2{-20 * spacing, 2 * size};
                Walker walker{anyCharacter(random, size), start};
                std::ostringstream which;
                which << "seed " << seed << ", size " << size << ", kind " << static_cast<int>(kind);
                EXPECT_TRUE(comesAcross(world, walker, speed, size * 0.4, origin.x + 20 * spacing))
                    << which.str() << ": hangs at " << walker.place.x - origin.x;
                EXPECT_FALSE(walker.contradicts) << which.str();
                EXPECT_FALSE(walker.isInside) << which.str();
            }
        }
    }
}

/// Something fixed, of one convex shape. @return its size
double addAnyShape(World& world, Random& random, double size, DVec2 origin) {
    const double other = size * (random.chance(0.5) ? 1 : 4);
    const Polygon polygon = random.chance(0.3) ? segment(-other, 0, other, other / 3) : anyCharacter(random, other);
    const double angle = random.chance(0.5) ? random.range(-3, 3) : 0;
    addBody(world, bodyAt(BodyType::fixed, origin, angle), polygon);
    return other;
}

/// From somewhere outside to as deep as that beyond where it is met.
bool sinkIn(const World& world, const Polygon& polygon, Random& random, double reach, double depth, DVec2& place) {
    const DVec2 from = turned({reach, 0}, random.range(0, 2 * kPi));
    place = place + from;
    const Vec2 way = toReal(turned({-1, random.range(-0.15, 0.15)}, std::atan2(from.y, from.x)));
    const CastHit hit = world.castShape(polygon, {place, {}}, real(reach) * way);
    place = place + static_cast<double>(hit.fraction * real(reach)) * toDouble(way) - depth * toDouble(hit.normal);
    return hit.hit;
}

/// From any depth that contacts hold, with any way: along what stopped it, to either side, as far as one likes.
TEST(CastsThatSlide, WhatTheyAreStoppedByIsFreeAlongItsNormal) {
    int stopped = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Random random(seed);
        const double size = std::exp(random.range(-3, 3));
        const DVec2 origin = random.chance(0.3) ? kFarOff : DVec2{};
        World world = makeWorld();
        const double other = addAnyShape(world, random, size, origin);
        const Polygon polygon = anyCharacter(random, size);
        const double depth = random.chance(0.5) ? random.range(-0.002, 0.09) : std::pow(10, random.range(-7, -1));
        DVec2 place = origin;
        if (!sinkIn(world, polygon, random, 4 * (size + other), depth * size, place)) { continue; }
        const double angle = random.range(0, 2 * kPi);
        const double distance = size * std::pow(10, random.range(-4, 1));
        const Vec2 way = toReal(turned({distance, 0}, angle));
        const CastHit hit = world.castShape(polygon, {place, {}}, way);
        if (!isStoppedAtOnce(hit) || hit.normal == Vec2{}) { continue; }
        EXPECT_LT(along(way, hit.normal), 0) << "seed " << seed;
        const Vec2 rest = withoutPartInto(way, hit.normal);
        // Of what hardly has a part along it, roundings remain.
        if (length(toDouble(rest)) < 0.5 * distance) { continue; }
        ++stopped;
        for (const double factor : {1.0, 1e-3, 100.0, -1.0}) {
            EXPECT_FALSE(isStoppedAtOnce(world.castShape(polygon, {place, {}}, real(factor) * rest)))
                << "seed " << seed << ", times " << factor;
        }
    }
    EXPECT_GT(stopped, 5000);
}

/// Lifted off the floor it would be half in the ceiling.
TEST(CastsThatSlide, PressedBetweenTwoTheyAreFreeAlongBoth) {
    World world = makeWorld();
    addStatic(world, box(9, 1), {}, {0, -1});
    addStatic(world, box(9, 1), {}, {0, 1.34});
    for (const double x : {5.0, -5.0}) {
        EXPECT_FALSE(world.castShape(box(0.2, 0.2), {{0, 0.17}, {}}, vec(x, 0)).hit) << x;
    }
    for (const double y : {0.1, -0.1}) {
        const CastHit hit = world.castShape(box(0.2, 0.2), {{0, 0.17}, {}}, vec(0.1, y));
        EXPECT_TRUE(isStoppedAtOnce(hit)) << y;
        EXPECT_LT(length(toDouble(hit.normal) - DVec2{0, y > 0 ? -1.0 : 1.0}), 1e-5) << y;
    }
}

/// A circle on the corners of two boxes with a gap between them, and a way along the normal of one.
TEST(CastsThatSlide, BetweenTwoCornersTheyAreFreeAlongBoth) {
    int ways = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Random random(seed);
        const double gap = random.range(0.5, 0.99);
        const std::array<DVec2, 2> corners{{{-gap / 2, 0}, {gap / 2, random.range(-0.2, 0.2)}}};
        const DVec2 place{random.range(-0.05, 0.05), random.range(0.2, 0.5)};
        const std::array<DVec2, 2> out{place - corners[0], place - corners[1]};
        const std::array<double, 2> depths{0.5 - length(out[0]), 0.5 - length(out[1])};
        if (!(std::min(depths[0], depths[1]) > 0 && std::max(depths[0], depths[1]) < 0.12)) { continue; }
        const std::size_t side = random.chance(0.5) ? 1 : 0;
        const Vec2 normal = toReal(1 / length(out[side]) * out[side]);
        const Vec2 any = toReal(turned({1, 0}, random.range(0, 2 * kPi)));
        const Vec2 way = any - dot(any, normal) * normal;
        if (dot(toDouble(way), out[1 - side]) < 0) { continue; }
        World world = makeWorld();
        addStatic(world, box(1, 1), {}, corners[0] + DVec2{-1, -1});
        addStatic(world, box(1, 1), {}, corners[1] + DVec2{1, -1});
        EXPECT_FALSE(world.castShape(circle(0.5), {place, {}}, way).hit) << "seed " << seed;
        ++ways;
    }
    EXPECT_GT(ways, 500);
}

/// Into the ground by ways of any length.
TEST(CastsThatSlide, HoweverShortAWayIntoTheGroundItIsStopped) {
    World world = makeWorld();
    addStatic(world, box(9, 1), {}, {0, -1});
    addStatic(world, segment(9, 0, 20, 0));
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const Polygon polygon = anyCharacter(random, 0.4);
        const DVec2 place{random.chance(0.5) ? 12.0 : 3.0, 0};
        const double height = -static_cast<double>(boundsOf(polygon, {}).lower.y);
        const double depth = std::pow(10, random.range(-6, -1.4));
        const double slope = std::pow(10, random.range(-3, 3));
        const double distance = std::pow(10, random.range(-6, 1)) / (1 + slope);
        const Vec2 way = vec(random.sign() * distance, -slope * distance);
        const CastHit hit = world.castShape(polygon, {place + DVec2{0, height - depth}, {}}, way);
        EXPECT_TRUE(isStoppedAtOnce(hit)) << "seed " << seed;
        EXPECT_LT(length(toDouble(hit.normal) - DVec2{0, 1}), 1e-5) << "seed " << seed;
    }
}

/// Corners of a chamber, counter-clockwise, with acute niches.
std::vector<Vec2> anyChamber(Random& random, double size) {
    const int count = random.integer(8, 27);
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
        points.push_back(toReal(turned({size * random.range(3, 8), 0}, 2 * kPi * i / count)));
    }
    return points;
}

bool isWithin(const std::vector<Vec2>& chamber, DVec2 place) {
    bool isOdd = false;
    for (std::size_t i = 0; i < chamber.size(); ++i) {
        const DVec2 a = toDouble(chamber[i]);
        const DVec2 b = toDouble(chamber[(i + 1) % chamber.size()]);
        if ((a.y > place.y) == (b.y > place.y)) { continue; }
        isOdd = isOdd != (place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y));
    }
    return isOdd;
}

void addChamber(World& world, const std::vector<Vec2>& corners, bool isChain) {
    const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, {})));
    const std::vector<Vec2> clockwise(corners.rbegin(), corners.rend());
    if (isChain) { must(world.addChain(body, clockwise, true)); }
    for (std::size_t i = 0; i < corners.size() && !isChain; ++i) {
        must(world.addShape(body, must(makeSegment(corners[i], corners[(i + 1) % corners.size()]))));
    }
}

/// Ways of any length, most of them again and again.
TEST(CastsThatSlide, NobodyGetsThroughOrDeeperThanContactsHold) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const double size = std::exp(random.range(-3, 3));
        const std::vector<Vec2> chamber = anyChamber(random, size);
        World world = makeWorld();
        addChamber(world, chamber, seed % 3 > 0);
        Walker walker{anyCharacter(random, 0.5 * size), {}};
        const double deepest = widthOf(walker.polygon) / 8;
        Vec2 way;
        for (int step = 0; step < 1000; ++step) {
            if (step == 0 || random.chance(0.1)) {
                const double distance = size * std::pow(10, random.range(-5, 1));
                way = toReal(turned({distance, 0}, random.range(0, 2 * kPi)));
            }
            walker.slide(world, way);
            ASSERT_TRUE(isWithin(chamber, walker.place)) << "seed " << seed << ", step " << step;
            const NearestShape nearest = world.nearest(walker.polygon, {walker.place, {}}, 0);
            ASSERT_TRUE(!nearest.found || static_cast<double>(nearest.distance) > -deepest)
                << "seed " << seed << ", step " << step << ": " << nearest.distance;
        }
        EXPECT_FALSE(walker.contradicts) << "seed " << seed;
    }
}

}  // namespace
}  // namespace swept::test

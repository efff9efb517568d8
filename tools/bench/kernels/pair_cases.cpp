#include "pair_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <swept/shapes/distance.h>

#include "shapes_of_case.h"

namespace swept::bench {
namespace {

enum class ShapeKind { circle, capsule, box, polygon };

/// Portable: the distributions of the standard library differ from one to the next.
class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}
    double range(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11U), -53);
    }
    int integer(int low, int high) {
        return low + static_cast<int>(bits_() % static_cast<std::uint64_t>(high - low + 1));
    }

private:
    std::mt19937_64 bits_;
};

double asFloat(double x) { return static_cast<double>(static_cast<float>(x)); }
DVec2 asFloat(DVec2 v) { return {asFloat(v.x), asFloat(v.y)}; }

constexpr double kTurn = 2 * std::numbers::pi;

/// Corners on a circle, at random angles that are no closer than a third of the even spacing.
CoreShape makePolygonShape(Random& random, int count, double size) {
    CoreShape shape;
    shape.count = count;
    for (int i = 0; i < count; ++i) {
        const double angle = kTurn * (i + random.range(-1, 1) / 3) / count;
        shape.vertices[static_cast<std::size_t>(i)] = {size * std::cos(angle), size * std::sin(angle)};
    }
    return shape;
}

CoreShape makeBoxShape(Random& random, double size) {
    const double x = size * random.range(0.3, 1);
    const double y = size * random.range(0.3, 1);
    CoreShape shape;
    shape.count = 4;
    shape.vertices = {DVec2{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    return shape;
}

CoreShape makeShape(Random& random, ShapeKind kind, int polygonCount) {
    const double size = 0.2 * std::pow(10.0, random.range(0, 1));
    CoreShape shape;
    switch (kind) {
        case ShapeKind::circle:
            shape.count = 1;
            shape.radius = asFloat(size);
            break;
        case ShapeKind::capsule:
            shape.count = 2;
            shape.vertices[0] = {-size, 0};
            shape.vertices[1] = {size, 0};
            shape.radius = asFloat(size * random.range(0.1, 0.5));
            break;
        case ShapeKind::box:
            shape = makeBoxShape(random, size);
            break;
        case ShapeKind::polygon:
            shape = makePolygonShape(random, polygonCount, size);
            break;
    }
    const DVec2 center{size * random.range(-0.1, 0.1), size * random.range(-0.1, 0.1)};
    for (int i = 0; i < shape.count; ++i) {
        DVec2& v = shape.vertices[static_cast<std::size_t>(i)];
        v = asFloat(v + center);
    }
    return shape;
}

ShapeKind anyKind(Random& random) { return static_cast<ShapeKind>(random.integer(0, 3)); }

PairCase makeShapes(Random& random, PairKind kind) {
    PairCase pair;
    const auto set = [&](ShapeKind a, ShapeKind b, int least) {
        pair.a = makeShape(random, a, random.integer(least, 8));
        pair.b = makeShape(random, b, random.integer(least, 8));
    };
    switch (kind) {
        case PairKind::mixed: {
            const ShapeKind a = anyKind(random);
            set(a, anyKind(random), 3);
            break;
        }
        case PairKind::circles:
            set(ShapeKind::circle, ShapeKind::circle, 3);
            break;
        case PairKind::boxes:
            set(ShapeKind::box, ShapeKind::box, 3);
            break;
        case PairKind::capsulePolygon:
            set(ShapeKind::capsule, ShapeKind::polygon, 3);
            break;
        case PairKind::octagons:
            set(ShapeKind::polygon, ShapeKind::polygon, 8);
            break;
    }
    return pair;
}

double reachOf(const CoreShape& shape) {
    double reach = shape.radius;
    for (int i = 0; i < shape.count; ++i) {
        reach = std::max(reach, length(shape.vertices[static_cast<std::size_t>(i)]));
    }
    return reach;
}

CorePose poseOf(DVec2 translation, double angle) {
    return {asFloat(translation), asFloat(std::cos(angle)), asFloat(std::sin(angle))};
}

bool areApart(const PairCase& pair) {
    const Polygon a = polygonOf(pair.a);
    const Polygon b = polygonOf(pair.b);
    return std::all_of(pair.poses.begin(), pair.poses.end(),
                       [&](const CorePose& pose) { return distance(a, b, transformOf(pose)).distance > 0.01; });
}

}  // namespace

std::string_view nameOf(PairKind kind) {
    switch (kind) {
        case PairKind::mixed:
            return "mixed";
        case PairKind::circles:
            return "circle-circle";
        case PairKind::boxes:
            return "box-box";
        case PairKind::capsulePolygon:
            return "capsule-polygon";
        case PairKind::octagons:
            return "8gon-8gon";
    }
    return "";  // unreachable, but GCC cannot know
}

std::vector<PairCase> makePairs(PairKind kind, int count) {
    Random random(1);
    std::vector<PairCase> pairs;
    while (static_cast<int>(pairs.size()) < count) {
        PairCase pair = makeShapes(random, kind);
        const double size = reachOf(pair.a) + reachOf(pair.b);
        const double angle = random.range(0, kTurn);
        const double bearing = random.range(0, kTurn);
        const DVec2 place = size * random.range(0.4, 2) * DVec2{std::cos(bearing), std::sin(bearing)};
        const DVec2 move = size * DVec2{random.range(-0.01, 0.01), random.range(-0.01, 0.01)};
        pair.poses[0] = poseOf(place, angle);
        pair.poses[1] = poseOf(place + move, angle + random.range(-0.02, 0.02));
        if (areApart(pair)) { pairs.push_back(pair); }
    }
    return pairs;
}

}  // namespace swept::bench

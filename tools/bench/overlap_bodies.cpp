#include "overlap_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <swept/shapes/hull.h>

#include "bench_random.h"

namespace swept::bench {
namespace {

Real real(double value) { return static_cast<Real>(value); }

Polygon roundShape(BenchRandom& random) {
    const Real radius = real(random.in(0.2, 0.6));
    if (random.in(0, 1) < 0.5) { return makeCircle({}, radius).value(); }
    return makeBox({radius, radius * real(random.in(0.8, 1))}, {}, 0, radius / 2).value();
}

Polygon boxShape(BenchRandom& random) {
    return makeBox({real(random.in(0.3, 0.7)), real(random.in(0.3, 0.7))}).value();
}

/// Points about a circle: triangles more often than octagons, some of them flat.
Polygon polygonShape(BenchRandom& random) {
    for (;;) {
        std::vector<Vec2> points;
        const int count = 3 + static_cast<int>(random.in(0, 6));
        for (int i = 0; i < count; ++i) {
            const double angle = random.in(0, 6.283185307179586);
            points.push_back({real(0.6 * std::cos(angle)), real(0.6 * std::sin(angle))});
        }
        const Result<Polygon> hull = convexHull(points);
        if (hull.ok() && extentOf(hull.value()) > Real(0.1)) { return hull.value(); }
    }
}

Polygon barShape(BenchRandom& random) {
    const double half = random.in(0.5, 2);
    return makeBox({real(half), real(half / random.in(8, 30))}).value();
}

/// Boxes along a bow: a hollow body, as chairs, hooks and letters are.
std::vector<Polygon> bow(BenchRandom& random) {
    const int count = 4 + static_cast<int>(random.in(0, 5));
    const double span = random.in(2, 4.5);  // radians
    const double radius = random.in(0.8, 1.5);
    std::vector<Polygon> shapes;
    for (int i = 0; i < count; ++i) {
        const double angle = span * (i + 0.5) / count;
        const Vec2 at{real(radius * std::cos(angle)), real(radius * std::sin(angle))};
        const double half = 0.55 * radius * span / count;
        shapes.push_back(makeBox({real(random.in(0.1, 0.2)), real(half)}, at, angle).value());
    }
    return shapes;
}

std::vector<Polygon> shapesOf(OverlapFamily family, BenchRandom& random) {
    switch (family) {
        case OverlapFamily::round:
            return {roundShape(random)};
        case OverlapFamily::polygons:
            return {polygonShape(random)};
        case OverlapFamily::boxes:
            return {boxShape(random)};
        case OverlapFamily::bars:
            return {barShape(random)};
        case OverlapFamily::compounds:
            return bow(random);
    }
    return {};  // unreachable, but GCC cannot know
}

/// Of corners of the shapes' own rectangles: there are too many vertices for one hull of ours.
Obb obbOfAll(const std::vector<Obb>& obbs) {
    Obb best;
    double bestArea = std::numeric_limits<double>::infinity();
    constexpr int kDirections = 16;
    for (int i = 0; i < kDirections; ++i) {
        const Rotation turn = rotationFromAngle(3.141592653589793 / 2 * i / kDirections);
        Aabb bounds{{1e9F, 1e9F}, {-1e9F, -1e9F}};
        for (const Obb& obb : obbs) {
            for (const Vec2 corner :
                 {obb.half, Vec2{-obb.half.x, obb.half.y}, Vec2{obb.half.x, -obb.half.y}, -obb.half}) {
                const Vec2 p = unrotate(turn, apply(obb.pose, corner));
                bounds = {min(bounds.lower, p), max(bounds.upper, p)};
            }
        }
        const Vec2 half = Real(0.5) * (bounds.upper - bounds.lower);
        const double area = static_cast<double>(half.x) * static_cast<double>(half.y);
        if (area < bestArea) {
            bestArea = area;
            best = {{rotate(turn, Real(0.5) * (bounds.upper + bounds.lower)), turn}, half};
        }
    }
    return best;
}

Circle circleOfAll(const std::vector<Circle>& circles, const Obb& obb) {
    Circle all{obb.pose.translation, 0};
    for (const Circle& circle : circles) {
        all.radius = std::max(all.radius, length(circle.center - all.center) + circle.radius);
    }
    return all;
}

BoundedBody bounded(std::vector<Polygon> shapes) {
    BoundedBody body;
    body.shapes = std::move(shapes);
    for (const Polygon& shape : body.shapes) {
        body.circles.push_back(boundingCircle(shape));
        body.obbs.push_back(smallestObb(shape, shape.radius));
    }
    const bool isOne = body.shapes.size() == 1;
    body.obb = isOne ? body.obbs.front() : obbOfAll(body.obbs);
    body.circle = isOne ? body.circles.front() : circleOfAll(body.circles, body.obb);
    return body;
}

void place(BoundedBody& body, DVec2 position, double angle) {
    body.pose = {position, rotationFromAngle(angle)};
    body.boxes.clear();
    for (const Polygon& shape : body.shapes) { body.boxes.push_back(boundsOf(shape, body.pose)); }
    body.box = body.boxes.front();
    for (const Aabb& box : body.boxes) { body.box = hullOf(body.box, box); }
}

double marginOf(const BoundedBody& body) { return static_cast<double>(extentOf(body.shapes.front())) / 8; }

}  // namespace

const char* nameOf(OverlapFamily family) {
    switch (family) {
        case OverlapFamily::round:
            return "round";
        case OverlapFamily::polygons:
            return "polygons";
        case OverlapFamily::boxes:
            return "boxes";
        case OverlapFamily::bars:
            return "bars";
        case OverlapFamily::compounds:
            return "compounds";
    }
    return "";  // unreachable, but GCC cannot know
}

Obb smallestObb(const Polygon& hull, Real radius) {
    Obb best{{hull.vertices[0], {}}, {radius, radius}};
    double bestArea = std::numeric_limits<double>::infinity();
    for (int i = 0; i < hull.count && hull.count > 1; ++i) {
        const Vec2 normal = hull.normals[static_cast<std::size_t>(i)];
        const Rotation turn{normal.x, normal.y};
        Vec2 lower = unrotate(turn, hull.vertices[0]);
        Vec2 upper = lower;
        for (const Vec2 vertex : hull.points()) {
            lower = min(lower, unrotate(turn, vertex));
            upper = max(upper, unrotate(turn, vertex));
        }
        const Vec2 half = Real(0.5) * (upper - lower) + Vec2{radius, radius};
        const double area = static_cast<double>(half.x) * static_cast<double>(half.y);
        if (area < bestArea) {
            bestArea = area;
            best = {{rotate(turn, Real(0.5) * (lower + upper)), turn}, half};
        }
    }
    return best;
}

std::vector<BodyPair> makeBodyPairs(OverlapFamily family, int count, std::uint64_t seed) {
    BenchRandom random(seed);
    std::vector<BodyPair> pairs;
    for (int i = 0; i < count; ++i) {
        BodyPair pair{bounded(shapesOf(family, random)), bounded(shapesOf(family, random))};
        place(pair.a, {random.in(-100, 100), random.in(-100, 100)}, random.in(0, 6.283));
        const double angle = random.in(0, 6.283);
        place(pair.b, {}, angle);
        const double margin = marginOf(pair.a) + marginOf(pair.b);
        const DVec2 lower = toDouble(pair.a.box.lower) - toDouble(pair.b.box.upper) - DVec2{margin, margin};
        const DVec2 upper = toDouble(pair.a.box.upper) - toDouble(pair.b.box.lower) + DVec2{margin, margin};
        place(pair.b, {random.in(lower.x, upper.x), random.in(lower.y, upper.y)}, angle);
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

}  // namespace swept::bench

#include "ray_cast.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rescaling.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// All in double: the products of f32 coordinates are then exact, and a long ray keeps its end.
struct Ray {
    DVec2 origin;
    DVec2 direction;
};

struct Entry {
    bool hit = false;
    double fraction = 0;
    Vec2 normal;
};

DVec2 vertexOf(const Polygon& polygon, int i) { return toDouble(polygon.vertices[static_cast<std::size_t>(i)]); }
DVec2 edgeOf(const Polygon& polygon, int i) { return vertexOf(polygon, polygon.next(i)) - vertexOf(polygon, i); }
Vec2 normalOf(const Polygon& polygon, int i) { return polygon.normals[static_cast<std::size_t>(i)]; }

/// Within the radius. Beside the edge in the words of `clipToEdges`: what that takes for outside must be so here.
bool isNearEdge(const Polygon& polygon, int i, DVec2 point) {
    const double radius = static_cast<double>(polygon.radius);
    const DVec2 edge = edgeOf(polygon, i);
    const DVec2 offset = point - vertexOf(polygon, i);
    const double along = dot(offset, edge);
    if (along <= 0) { return dot(offset, offset) <= radius * radius; }
    if (along >= dot(edge, edge)) {
        const DVec2 fromEnd = point - vertexOf(polygon, polygon.next(i));
        return dot(fromEnd, fromEnd) <= radius * radius;
    }
    return std::fabs(cross(offset, edge)) <= radius * length(edge);
}

bool contains(const Polygon& polygon, DVec2 point) {
    const double limit = static_cast<double>(polygon.radius) * static_cast<double>(polygon.radius);
    if (polygon.count == 1) {
        const DVec2 offset = point - vertexOf(polygon, 0);
        return dot(offset, offset) <= limit;
    }
    bool insideCore = polygon.count > 2;
    for (int i = 0; i < polygon.count; ++i) {
        if (isNearEdge(polygon, i, point)) { return true; }
        insideCore = insideCore && cross(edgeOf(polygon, i), point - vertexOf(polygon, i)) >= 0;
    }
    return insideCore;
}

/// Ray from outside against the disk about vertex i. Starts at the fraction `from`, near the disk, so that the roots
/// keep their digits when the ray comes from far away.
Entry enterDisk(const Polygon& polygon, int i, const Ray& ray, double from) {
    const double radius = static_cast<double>(polygon.radius);
    const DVec2 offset = (ray.origin - vertexOf(polygon, i)) + from * ray.direction;
    const double speed = dot(ray.direction, ray.direction);
    const double approach = -dot(offset, ray.direction);
    const double area = cross(offset, ray.direction);
    const double discriminant = radius * radius * speed - area * area;
    if (approach <= 0 || discriminant < 0) { return {}; }
    const double distance = length(offset);
    const double outside = std::fmax((distance - radius) * (distance + radius), 0.0);
    const double beyond = outside / (approach + std::sqrt(discriminant));  // the smaller root, without cancellation
    const DVec2 radial = offset + beyond * ray.direction;
    const Vec2 normal = toReal((1 / length(radial)) * radial);
    return {true, from + beyond, normal};
}

/// Ray from outside against a bare segment, from either side.
Entry enterSegment(const Polygon& segment, const Ray& ray) {
    const DVec2 toStart = vertexOf(segment, 0) - ray.origin;
    const DVec2 toEnd = vertexOf(segment, 1) - ray.origin;
    const DVec2 edge = edgeOf(segment, 0);
    const double rate = cross(ray.direction, edge);
    const double startSide = cross(ray.direction, toStart);
    const double endSide = cross(ray.direction, toEnd);
    if (startSide == 0 && endSide == 0) {  // end on
        const double nearest = std::fmin(dot(toStart, ray.direction), dot(toEnd, ray.direction));
        const double speed = dot(ray.direction, ray.direction);
        return {nearest >= 0, nearest / speed, -normalized(toReal((1 / std::sqrt(speed)) * ray.direction)).unit};
    }
    if ((startSide > 0 && endSide > 0) || (startSide < 0 && endSide < 0) || rate == 0) { return {}; }
    const double fraction = cross(toStart, edge) / rate;
    return {fraction >= 0, fraction, normalOf(segment, rate < 0 ? 0 : 1)};
}

/// Vertex nearest to a point.
int nearestVertex(const Polygon& polygon, DVec2 point) {
    int nearest = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < polygon.count; ++i) {
        const DVec2 offset = point - vertexOf(polygon, i);
        if (dot(offset, offset) < smallest) {
            smallest = dot(offset, offset);
            nearest = i;
        }
    }
    return nearest;
}

/// Part of the ray inside all half-planes of the edges, each moved outwards by the radius.
struct Clip {
    bool empty = false;
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    int edge = -1;  ///< by which the ray enters; −1 if it starts inside
};

Clip clipToEdges(const Polygon& polygon, const Ray& ray) {
    const double radius = static_cast<double>(polygon.radius);
    Clip clip;
    for (int i = 0; i < polygon.count; ++i) {
        const DVec2 edge = edgeOf(polygon, i);
        const double beyond = cross(ray.origin - vertexOf(polygon, i), edge) - radius * length(edge);
        const double rate = cross(ray.direction, edge);  // both in units of the edge's length
        if (rate == 0) {
            clip.empty = clip.empty || beyond > 0;
        } else if (rate < 0) {
            const double fraction = beyond / -rate;
            if (beyond > 0 && fraction >= clip.enter) {
                clip.enter = fraction;
                clip.edge = i;
            }
        } else {
            clip.leave = std::fmin(clip.leave, -beyond / rate);
        }
    }
    clip.empty = clip.empty || clip.enter > clip.leave;
    return clip;
}

/// In units of the edge squared: where beside it the ray is at a fraction, from its first vertex on.
double alongAt(const Polygon& polygon, int i, const Ray& ray, double fraction) {
    return dot((ray.origin - vertexOf(polygon, i)) + fraction * ray.direction, edgeOf(polygon, i));
}

/// Fraction at which the ray gets into the moved half-plane of an edge; negative if it starts there, or never does.
double entranceOf(const Polygon& polygon, int i, const Ray& ray) {
    const DVec2 edge = edgeOf(polygon, i);
    const double rate = cross(ray.direction, edge);
    if (!(rate < 0)) { return -1; }
    const double radius = static_cast<double>(polygon.radius);
    return (cross(ray.origin - vertexOf(polygon, i), edge) - radius * length(edge)) / -rate;
}

/// Ray that enters the moved half-planes beyond an end of an edge: it is in the sharp corner there, and leaves it
/// through the arc of that vertex or not at all. It gets past the other side of the corner before that, on the near
/// side of the vertex. Only rounding tells otherwise: the two edges are parallel but for that, either may seem to be
/// entered last, and it is the other one through which the ray goes, or one farther on.
Entry enterCorner(const Polygon& polygon, const Ray& ray, const Clip& clip, bool isAtEnd) {
    int edge = clip.edge;
    double fraction = clip.enter;
    for (int i = 2; i < polygon.count; ++i) {  // by one of the others at least it leaves
        const int beside = isAtEnd ? polygon.next(edge) : polygon.previous(edge);
        const double entrance = entranceOf(polygon, beside, ray);
        if (!(entrance >= 0)) { break; }
        const double along = alongAt(polygon, beside, ray, entrance);
        const double size = dot(edgeOf(polygon, beside), edgeOf(polygon, beside));
        const double past = isAtEnd ? along : size - along;  // the vertex
        if (past < 0) { break; }
        if (past <= size) { return {true, entrance, normalOf(polygon, beside)}; }
        edge = beside;
        fraction = entrance;
    }
    return enterDisk(polygon, isAtEnd ? polygon.next(edge) : edge, ray, fraction);
}

/// Ray from outside against two or more vertices. The moved half-planes meet in sharp corners.
Entry enterOutline(const Polygon& polygon, const Ray& ray) {
    const Clip clip = clipToEdges(polygon, ray);
    if (clip.empty) { return {}; }
    if (clip.edge < 0) { return enterDisk(polygon, nearestVertex(polygon, ray.origin), ray, 0); }
    if (polygon.radius > 0) {
        const double along = alongAt(polygon, clip.edge, ray, clip.enter);
        const DVec2 edge = edgeOf(polygon, clip.edge);
        if (along < 0) { return enterCorner(polygon, ray, clip, false); }
        if (along > dot(edge, edge)) { return enterCorner(polygon, ray, clip, true); }
    }
    return {true, clip.enter, normalOf(polygon, clip.edge)};
}

Entry enter(const Polygon& polygon, const Ray& ray) {
    if (polygon.count == 1) { return enterDisk(polygon, 0, ray, 0); }
    return polygon.count == 2 && polygon.radius == 0 ? enterSegment(polygon, ray) : enterOutline(polygon, ray);
}

/// Largest coordinate or radius.
double largestOf(const Polygon& polygon, Vec2 point) {
    const double ofPoint = std::max(largestOf(point), static_cast<double>(polygon.radius));
    return std::max(ofPoint, largestOf(polygon.points()));
}

Polygon rescaled(const Polygon& polygon, int exponent) {
    Polygon copy = polygon;
    for (Vec2& v : copy.vertices) { v = rescaled(v, exponent); }
    copy.radius = std::ldexp(polygon.radius, exponent);
    return copy;
}

RayCastHit cast(const Polygon& polygon, Vec2 origin, Vec2 direction, Real maxFraction);

/// Shape and origin are scaled by one power of two, and the direction by another one.
RayCastHit castRescaled(const Polygon& polygon, Vec2 origin, Vec2 direction, Real maxFraction) {
    const int scale = exponentOf(largestOf(polygon, origin));
    const int speed = exponentOf(largestOf(direction));
    const Real everywhere = std::numeric_limits<Real>::infinity();
    RayCastHit hit = cast(rescaled(polygon, -scale), rescaled(origin, -scale), rescaled(direction, -speed), everywhere);
    hit.fraction = std::ldexp(hit.fraction, scale - speed);
    if (!hit.hit || hit.fraction > maxFraction) { return {}; }
    hit.point = hit.normal == Vec2{} ? origin : rescaled(hit.point, scale);
    return hit;
}

RayCastHit cast(const Polygon& polygon, Vec2 origin, Vec2 direction, Real maxFraction) {
    const Ray ray{toDouble(origin), toDouble(direction)};
    if (contains(polygon, ray.origin)) { return {.hit = true, .fraction = 0, .normal = {}, .point = origin}; }
    if (direction == Vec2{}) { return {}; }
    const Entry entry = enter(polygon, ray);
    if (!entry.hit || entry.fraction > static_cast<double>(maxFraction)) { return {}; }
    return {.hit = true,
            .fraction = static_cast<Real>(entry.fraction),
            .normal = entry.normal,
            .point = toReal(ray.origin + entry.fraction * ray.direction)};
}

}  // namespace

RayCastHit rayCast(const Polygon& polygon, Vec2 origin, Vec2 direction, Real maxFraction) {
    if (kProductsMayOverflow && !(productsFit(largestOf(polygon, origin)) && productsFit(largestOf(direction)))) {
        return castRescaled(polygon, origin, direction, maxFraction);
    }
    return cast(polygon, origin, direction, maxFraction);
}

bool containsPoint(const Polygon& polygon, Vec2 point) {
    if (kProductsMayOverflow && !productsFit(largestOf(polygon, point))) {
        const int scale = exponentOf(largestOf(polygon, point));
        return contains(rescaled(polygon, -scale), toDouble(rescaled(point, -scale)));
    }
    return contains(polygon, toDouble(point));
}

}  // namespace swept::inline SWEPT_PRECISION

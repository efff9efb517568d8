#include "box2d_shapes.h"

#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

namespace swept {
namespace {

/// Makes the fixtures of one shape, one call for each geometry.
class FixtureMaker {
public:
    FixtureMaker(b2Body& body, const ShapeDescription& shape, std::deque<Box2dFixtureNote>& notes)
        : body_(body), shape_(shape), notes_(notes) {}

    void operator()(const BoxGeometry& box) const {
        b2PolygonShape polygon;
        polygon.SetAsBox(static_cast<float>(box.half.x), static_cast<float>(box.half.y), toBox2d(box.center),
                         static_cast<float>(box.angle));
        addPolygon(polygon, shape_.radius);
    }

    void operator()(const CircleGeometry& circle) const { addCircle(circle.center, circle.radius); }
    void operator()(const CapsuleGeometry& capsule) const { addCapsule(capsule.points, capsule.radius); }

    void operator()(const SegmentGeometry& segment) const {
        if (shape_.radius > 0) {
            addCapsule(segment.points, shape_.radius);
            return;
        }
        b2EdgeShape edge;
        edge.SetTwoSided(toBox2d(segment.points[0]), toBox2d(segment.points[1]));
        add(edge, 0);
    }

    void operator()(const PolygonGeometry& geometry) const {
        std::vector<b2Vec2> points;
        for (const DVec2 point : geometry.points) { points.push_back(toBox2d(point)); }
        b2PolygonShape polygon;
        polygon.Set(points.data(), static_cast<int32>(points.size()));
        addPolygon(polygon, shape_.radius);
    }

    // Both engines collide on the right-hand side of the chain's direction.
    void operator()(const ChainGeometry& geometry) const {
        std::vector<b2Vec2> points;
        for (const DVec2 point : geometry.points) { points.push_back(toBox2d(point)); }
        const auto count = static_cast<int32>(points.size());
        b2ChainShape chain;
        if (geometry.loop) {
            chain.CreateLoop(points.data(), count);
        } else {  // an open end goes on straight
            const std::size_t last = points.size() - 1;
            chain.CreateChain(points.data(), count,
                              geometry.before ? toBox2d(*geometry.before) : 2.0f * points[0] - points[1],
                              geometry.after ? toBox2d(*geometry.after) : 2.0f * points[last] - points[last - 1]);
        }
        chain.m_radius = std::max(static_cast<float>(shape_.radius), b2_polygonRadius);
        if (ownSurfaces(shape_) == nullptr) { return add(chain, shape_.radius); }
        for (int32 i = 0; i < chain.GetChildCount(); ++i) {
            b2EdgeShape edge;
            chain.GetChildEdge(&edge, i);
            add(edge, shape_.radius, static_cast<std::size_t>(i));
        }
    }

private:
    void addPolygon(b2PolygonShape& polygon, double radius) const {
        polygon.m_radius = std::max(static_cast<float>(radius), b2_polygonRadius);
        add(polygon, radius);
    }

    void addCircle(DVec2 center, double radius) const {
        b2CircleShape circle;
        circle.m_p = toBox2d(center);
        circle.m_radius = static_cast<float>(radius);
        add(circle, radius);
    }

    /// A disk at either end, and between them a box whose skin ends where the disks do.
    void addCapsule(const std::array<DVec2, 2>& points, double radius) const {
        addCircle(points[0], radius);
        addCircle(points[1], radius);
        const DVec2 along = points[1] - points[0];
        const double skin = std::min(static_cast<double>(b2_polygonRadius), radius / 2);
        const DVec2 side = ((radius - skin) / length(along)) * DVec2{-along.y, along.x};
        const b2Vec2 corners[4] = {toBox2d(points[0] - side), toBox2d(points[1] - side), toBox2d(points[1] + side),
                                   toBox2d(points[0] + side)};
        b2PolygonShape polygon;
        polygon.Set(corners, 4);
        polygon.m_radius = static_cast<float>(skin);
        add(polygon, skin);
    }

    void add(const b2Shape& geometry, double trueRadius, std::size_t segment = 0) const {
        const FullSurface surface = surfaceAt(shape_, segment);
        notes_.push_back({&shape_, shape_.sensor, static_cast<float>(trueRadius), surface});
        b2FixtureDef definition;
        definition.shape = &geometry;
        definition.friction = static_cast<float>(surface.friction);
        definition.restitution = static_cast<float>(surface.restitution);
        definition.isSensor = shape_.sensor;
        definition.userData.pointer = reinterpret_cast<uintptr_t>(&notes_.back());
        body_.CreateFixture(&definition);
    }

    b2Body& body_;
    const ShapeDescription& shape_;
    std::deque<Box2dFixtureNote>& notes_;
};

const Box2dFixtureNote& noteOf(const b2Fixture& fixture) {
    return *reinterpret_cast<const Box2dFixtureNote*>(const_cast<b2Fixture&>(fixture).GetUserData().pointer);
}

}  // namespace

void addFixtures(b2Body& body, const ShapeDescription& shape, std::deque<Box2dFixtureNote>& notes) {
    std::visit(FixtureMaker(body, shape, notes), shape.geometry);
}

void Box2dSurfaces::PreSolve(b2Contact* contact, const b2Manifold*) {
    const FullSurface& a = noteOf(*contact->GetFixtureA()).surface;
    const FullSurface& b = noteOf(*contact->GetFixtureB()).surface;
    contact->SetTangentSpeed(static_cast<float>(a.surfaceSpeed + b.surfaceSpeed));
    if (!hasMixingRule(a) && !hasMixingRule(b)) { return; }  // Box2D's own mixing is the usual one
    contact->SetFriction(static_cast<float>(mixedFriction(a, b)));
    contact->SetRestitution(static_cast<float>(mixedRestitution(a, b)));
}

bool Box2dFilter::ShouldCollide(b2Fixture* fixtureA, b2Fixture* fixtureB) {
    const FilterDescription& a = noteOf(*fixtureA).shape->filter;
    const FilterDescription& b = noteOf(*fixtureB).shape->filter;
    if (noteOf(*fixtureA).isSensor && noteOf(*fixtureB).isSensor) { return false; }
    if (a.group != 0 && a.group == b.group) { return a.group > 0; }
    return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

}  // namespace swept

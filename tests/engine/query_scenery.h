#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <swept/shapes/chain.h>
#include <swept/shapes/distance.h>
#include <swept/shapes/ray_cast.h>

#include "../support/random.h"
#include "world_support.h"

/// Random worlds, and what a walk over all their shapes answers to queries.

namespace swept::test {

/// The test's own list of what it put into the world.
struct Item {
    ShapeId id;
    BodyId body;
    std::vector<Polygon> parts;  ///< one, or the segments of a chain
    ShapeDef def;
};

inline bool sees(const QueryFilter& query, const Item& item) {
    const ShapeDef& def = item.def;
    if (item.body == query.ignore || (def.sensor && !query.sensors)) { return false; }
    return (def.filter.category & query.mask) != 0 && (query.category & def.filter.mask) != 0;
}

/// Numbers are drawn one by one: the order of arguments is up to the compiler.
inline Polygon anyPolygon(Random& random) {
    const int kind = random.integer(0, 3);
    const double a = random.range(0.1, 1);
    const double b = random.range(0.1, 1);
    const double c = random.range(-1, 1);
    switch (kind) {
        case 0:
            return circle(a);
        case 1:
            return capsule(a, b / 2);
        case 2:
            return must(makeBox(vec(a, b), {}, 3 * c, real(0.05)));
        default:
            return segment(-a, c, b, -c);
    }
}

inline Polygon point() {
    Polygon point;
    point.count = 1;
    return point;
}

struct Scenery {
    World world = makeWorld();
    std::vector<Item> items;
    Random random;
    DVec2 origin;

    Scenery(std::uint64_t seed, DVec2 where) : random(seed), origin(where) {
        for (int i = 0; i < 30; ++i) { addOne(); }
        addChain();
        // Ids of what is gone must not come up again.
        for (int i = 0; i < 5; ++i) {
            const auto last = items.end() - 2 - i;
            const bool hasMore = last->parts.size() > 1;
            must(i % 2 == 0 && !hasMore ? world.destroyShape(last->id) : world.destroyBody(last->body));
            items.erase(last);
        }
        must(world.step(kStep));
    }

    DVec2 place(double size) { return origin + DVec2{random.range(-size, size), random.range(-size, size)}; }

    void addOne() {
        const DVec2 where = place(8);
        BodyDef def = bodyAt(static_cast<BodyType>(random.integer(0, 2)), where);
        def.angle = random.range(-4, 4);
        Item item;
        item.body = must(world.createBody(def));
        item.parts = {anyPolygon(random)};
        item.def.sensor = random.chance(0.15);
        item.def.filter = {1u << random.integer(0, 2), random.chance(0.8) ? 0xFFFFFFFFu : 1u, 0};
        item.id = must(world.addShape(item.body, item.parts[0], item.def));
        // What contacts move has a skin, which queries meet, too (engine/bodies/line_skin.h).
        Polygon& part = item.parts[0];
        const bool isLine = part.count == 2 && !(part.radius > 0);
        if (isLine && def.type == BodyType::dynamic && !item.def.sensor) { part.radius = extentOf(part) / 4096; }
        // A segment alone has no mass.
        if (def.type == BodyType::dynamic) { must(world.addShape(item.body, circle(0.01), item.def)); }
        if (def.type == BodyType::dynamic) { item.parts.push_back(circle(0.01)); }
        items.push_back(item);
    }
    void addChain() {
        Item item;
        item.body = must(world.createBody(bodyAt(BodyType::fixed, origin, 0.1)));
        std::vector<Vec2> points;
        for (int i = 0; i < 8; ++i) { points.push_back(vec(6 - 1.7 * i, random.range(-1, 1))); }
        item.id = must(world.addChain(item.body, points, false, item.def, real(0.02)));
        for (int i = 0; i + 1 < static_cast<int>(points.size()); ++i) {
            item.parts.push_back(polygonOf(chainSegment(points, false, real(0.02), i)));
        }
        items.push_back(item);
    }

    QueryFilter filter() {
        QueryFilter query{1u << random.integer(0, 2), random.chance(0.7) ? 0xFFFFFFFFu : 3u, random.chance(0.5)};
        if (random.chance(0.5)) {
            query.ignore = items[static_cast<std::size_t>(random.integer(0, static_cast<int>(items.size()) - 1))].body;
        }
        return query;
    }
    WorldTransform pose(const Item& item) const {
        return {world.position(item.body), rotationFromAngle(world.angle(item.body))};
    }

    /// Bodies with two shapes: the small one in the middle has an id of its own, its body tells.
    bool isOf(const Item& item, ShapeId id) const { return world.bodyOf(id) == item.body; }

    std::optional<Real> rayFraction(const Item& item, DVec2 from, Vec2 along) const {
        std::optional<Real> best;
        const WorldTransform frame = pose(item);
        for (const Polygon& part : item.parts) {
            const RayCastHit hit = rayCast(part, applyInverse(frame, from), unrotate(frame.rotation, along), 1);
            if (hit.hit && (!best || hit.fraction < *best)) { best = hit.fraction; }
        }
        return best;
    }
    std::optional<Real> rayFraction(const QueryFilter& query, DVec2 from, Vec2 along) const {
        std::optional<Real> best;
        for (const Item& item : items) {
            if (!sees(query, item)) { continue; }
            const std::optional<Real> fraction = rayFraction(item, from, along);
            if (fraction && (!best || *fraction < *best)) { best = fraction; }
        }
        return best;
    }
    Real distanceTo(const Item& item, const Polygon& polygon, const WorldTransform& where) const {
        Real smallest = std::numeric_limits<Real>::infinity();
        for (const Polygon& part : item.parts) {
            smallest = std::min(smallest, distance(part, polygon, relativeTransform(pose(item), where)).distance);
        }
        return smallest;
    }
    /// Smallest distance over all that the query sees.
    Real clearance(const QueryFilter& query, const Polygon& polygon, const WorldTransform& where) const {
        Real smallest = std::numeric_limits<Real>::infinity();
        for (const Item& item : items) {
            if (sees(query, item)) { smallest = std::min(smallest, distanceTo(item, polygon, where)); }
        }
        return smallest;
    }
};

/// Near the origin, and where a float could not tell the shapes apart.
inline std::vector<DVec2> origins() { return {{0, 0}, {1e5, -3e5}}; }

}  // namespace swept::test

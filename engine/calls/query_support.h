#pragma once

#include "../../shapes/distance.h"
#include "../queries.h"
#include "../state/world_state.h"

/// What the queries of a world share.

namespace swept::inline SWEPT_PRECISION {

inline bool sees(const WorldState& world, const QueryFilter& filter, const Shape& shape) {
    if (shape.def.sensor && !filter.sensors) { return false; }
    if (shape.body == filter.ignore.index && world.bodies.isValid(filter.ignore)) { return false; }
    return (shape.def.filter.category & filter.mask) != 0 && (filter.category & shape.def.filter.mask) != 0;
}

inline std::uint32_t slotOf(const WorldState& world, ProxyId proxy) {
    return world.proxyShapes[static_cast<std::size_t>(proxy)];
}

inline bool isGood(const Polygon& polygon, const WorldTransform& pose) {
    return validate(polygon).ok() && isFinite(pose.position) && isFinite(pose.rotation.c) && isFinite(pose.rotation.s);
}

inline Distance distanceTo(const WorldState& world, const Shape& shape, const Polygon& polygon,
                           const WorldTransform& pose) {
    return distance(shape.polygon, polygon, relativeTransform(world.motions[shape.body].pose, pose));
}

}  // namespace swept::inline SWEPT_PRECISION

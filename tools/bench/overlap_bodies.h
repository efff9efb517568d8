#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <swept/shapes/bounding_circle.h>
#include <swept/shapes/obb.h>
#include <swept/shapes/polygon.h>

namespace swept::bench {

/// A body with every volume that may bound it, in its own frame and, where it stands, in the world.
struct BoundedBody {
    std::vector<Polygon> shapes;
    std::vector<Circle> circles;  ///< of the shapes
    std::vector<Obb> obbs;
    std::vector<Aabb> boxes;  ///< world
    Circle circle;            ///< of all
    Obb obb;
    Aabb box;  ///< world
    WorldTransform pose;
};

struct BodyPair {
    BoundedBody a;
    BoundedBody b;
};

enum class OverlapFamily : std::uint8_t { round, polygons, boxes, bars, compounds };
inline constexpr OverlapFamily kOverlapFamilies[] = {
    OverlapFamily::round, OverlapFamily::polygons, OverlapFamily::boxes, OverlapFamily::bars, OverlapFamily::compounds};
const char* nameOf(OverlapFamily family);

/// Pairs placed uniformly where their boxes, enlarged by an eighth of their extent, overlap.
std::vector<BodyPair> makeBodyPairs(OverlapFamily family, int count, std::uint64_t seed);

/// Smallest rectangle about a cloud of points among those with a side along an edge of its hull, grown by `radius`.
Obb smallestObb(const Polygon& hull, Real radius);

}  // namespace swept::bench

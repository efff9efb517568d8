#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <swept/samples/scene_description.h>
#include <swept/samples/scene_surfaces.h>
#include <swept/shapes/polygon.h>

namespace swept {

/// A convex piece of a body where the scene puts it.
struct PlacedPiece {
    int body = 0;
    int shape = 0;
    int segment = -1;   ///< of a chain; −1 for other shapes
    Polygon polygon;    ///< frame of the body
    Aabb bounds;        ///< world, rounded outward
    double extent = 0;  ///< smallest non-zero width, metres
};

/// A body with what follows from its description.
struct PlacedBody {
    int index = 0;
    std::string name;
    const BodyDescription* description = nullptr;
    WorldTransform pose;
    DVec2 center;        ///< of mass, world; of the bounds for what has no mass
    double mass = 0;     ///< kg; 0 for what is not dynamic
    double inertia = 0;  ///< kg·m² about the centre; 0 for what is not dynamic
    double extent = 0;   ///< of its smallest piece that is no sensor; 0 without one
    double reach = 0;    ///< farthest point from `center`, metres
    double speed = 0;    ///< largest of any of its points at the start, m/s
    double drive = 0;    ///< fastest that motors of the joints it hangs together with turn or push anything, m/s
    int joints = 0;      ///< that name it
    Aabb bounds;         ///< world; of all pieces
    bool hasBounds = false;

    bool isDynamic() const { return description->type == SceneBodyType::dynamic; }
};

/// The bodies whose bounds reach farthest along a direction: one, and the next for who asks as the first.
struct FarthestBodies {
    int first = -1;  ///< −1: there is none
    double reach = -std::numeric_limits<double>::infinity();
    double next = -std::numeric_limits<double>::infinity();

    double reachWithout(int body) const { return body == first ? next : reach; }
};

/// A scene laid out in the world, in double precision: what every part of the inspection looks at.
struct PlacedScene {
    const SceneDescription* scene = nullptr;
    std::vector<PlacedBody> bodies;
    std::vector<PlacedPiece> pieces;
    std::unordered_map<std::string, int> byName;  ///< index of a body
    std::array<FarthestBodies, 2> farthest;       ///< along gravity, and against it
};

/// @param scene  that `validateScene` accepts; must outlive the result.
PlacedScene place(const SceneDescription& scene);

inline const PlacedBody& bodyOf(const PlacedScene& placed, const PlacedPiece& piece) {
    return placed.bodies[static_cast<std::size_t>(piece.body)];
}
inline const ShapeDescription& shapeOf(const PlacedScene& placed, const PlacedPiece& piece) {
    return bodyOf(placed, piece).description->shapes[static_cast<std::size_t>(piece.shape)];
}

inline FullSurface surfaceOf(const PlacedScene& placed, const PlacedPiece& piece) {
    return surfaceAt(shapeOf(placed, piece), static_cast<std::size_t>(std::max(piece.segment, 0)));
}

/// Two pieces of different bodies, at least one of them dynamic, that may collide by their filters, whose bounds come
/// within `margin` of each other. Sensors are left out.
struct NearPair {
    int pieceA = 0;
    int pieceB = 0;
    double separation = 0;  ///< signed, metres
};
std::vector<NearPair> nearPairs(const PlacedScene& placed, double margin);

/// Two bodies with shapes that may collide and have friction, the first one dynamic; −1: there are none.
struct RubbingBodies {
    int a = -1;
    int b = -1;
};
RubbingBodies firstRubbing(const PlacedScene& placed);

/// Pairs of bodies, lower index first, whose joint keeps them from colliding.
std::set<std::pair<int, int>> jointedPairs(const PlacedScene& placed);

bool filtersCollide(const FilterDescription& a, const FilterDescription& b);

/// Whether two pieces may touch: of different bodies, one of them dynamic, no sensors, by their filters. What joints
/// and chains keep apart is for others.
bool mayCollide(const PlacedScene& placed, const PlacedPiece& a, const PlacedPiece& b);

/// Whether `edge` is of a chain, and the other piece's body on its solid side, where it is ignored.
bool isBehindChain(const PlacedScene& placed, const PlacedPiece& edge, const PlacedPiece& other);

/// Index of the body of this name; −1 when there is none.
int bodyNamed(const PlacedScene& placed, const std::string& name);

/// "/bodies/3".
std::string pointerOf(const PlacedBody& body);
/// "/bodies/3/shapes/0".
std::string pointerOf(const PlacedPiece& piece);

}  // namespace swept

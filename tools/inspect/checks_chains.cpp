#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "checks.h"

namespace swept {
namespace {

/// How a piece lies below the centre of a body, along the gravity that acts on it.
enum class Below { beside, holds, passes };

Below below(const PlacedScene& placed, const PlacedPiece& piece, const PlacedBody& body, DVec2 fall) {
    const WorldTransform& pose = placed.bodies[static_cast<std::size_t>(piece.body)].pose;
    const DVec2 across{-fall.y, fall.x};
    const auto radius = static_cast<double>(piece.polygon.radius);
    double first = 0;
    double last = 0;
    double deepest = 0;
    bool isFirst = true;
    for (const Vec2 vertex : piece.polygon.points()) {
        const DVec2 to = apply(pose, vertex) - body.center;
        const double side = dot(across, to);
        first = isFirst ? side : std::min(first, side);
        last = isFirst ? side : std::max(last, side);
        deepest = isFirst ? dot(fall, to) : std::max(deepest, dot(fall, to));
        isFirst = false;
    }
    if (first - radius > 0 || last + radius < 0 || deepest + radius < 0) { return Below::beside; }
    if (piece.segment < 0) { return Below::holds; }
    const DVec2 along = apply(pose, piece.polygon.vertices[1]) - apply(pose, piece.polygon.vertices[0]);
    return dot(fall, DVec2{along.y, -along.x}) > 0 ? Below::passes : Below::holds;  // it collides on its right
}

/// The chain that a body falls through, with nothing else below it; null: there is none, or something holds it.
const PlacedPiece* chainPassed(const PlacedScene& placed, const PlacedBody& body, const PlacedPiece& own, DVec2 fall) {
    const PlacedPiece* passed = nullptr;
    for (const PlacedPiece& piece : placed.pieces) {
        const bool isGround = !placed.bodies[static_cast<std::size_t>(piece.body)].isDynamic();
        if (!isGround || !mayCollide(placed, piece, own)) { continue; }
        const Below how = below(placed, piece, body, fall);
        if (how == Below::holds) { return nullptr; }
        if (how == Below::passes && passed == nullptr) { passed = &piece; }
    }
    return passed;
}

bool isJointed(const PlacedScene& placed, const PlacedBody& body) {
    return std::any_of(placed.scene->joints.begin(), placed.scene->joints.end(),
                       [&](const JointDescription& j) { return j.bodyA == body.name || j.bodyB == body.name; });
}

}  // namespace

void checkChains(const PlacedScene& placed, std::vector<Finding>& findings) {
    std::set<std::pair<int, int>> told;  // body and shape of a chain
    for (const PlacedPiece& own : placed.pieces) {
        const PlacedBody& body = placed.bodies[static_cast<std::size_t>(own.body)];
        const DVec2 gravity = body.description->gravityScale * placed.scene->gravity;
        if (!body.isDynamic() || !(length(gravity) > 0) || isJointed(placed, body)) { continue; }
        const PlacedPiece* const chain = chainPassed(placed, body, own, (1 / length(gravity)) * gravity);
        if (chain == nullptr || !told.insert({chain->body, chain->shape}).second) { continue; }
        findings.push_back({Severity::warning, "chain-back", pointerOf(*chain),
                            body.name + " falls through this chain from its back, and nothing else is below: a chain "
                                        "collides on the right-hand side of its direction alone",
                            "list its points the other way round (ground from right to left)"});
    }
}

}  // namespace swept

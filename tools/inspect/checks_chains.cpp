#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <swept/broadphase/broadphase.h>

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

/// How far below the centre of a body the line of its fall meets a piece; of what is no segment, at least.
double depthOf(const PlacedScene& placed, const PlacedPiece& piece, const PlacedBody& body, DVec2 fall) {
    const WorldTransform& pose = placed.bodies[static_cast<std::size_t>(piece.body)].pose;
    const DVec2 across{-fall.y, fall.x};
    if (piece.segment < 0) {
        double depth = std::numeric_limits<double>::infinity();
        for (const Vec2 vertex : piece.polygon.points()) {
            depth = std::min(depth, dot(fall, apply(pose, vertex) - body.center));
        }
        return depth - static_cast<double>(piece.polygon.radius);
    }
    const DVec2 from = apply(pose, piece.polygon.vertices[0]) - body.center;
    const DVec2 along = apply(pose, piece.polygon.vertices[1]) - body.center - from;
    const double width = dot(across, along);
    const double fraction = width != 0 ? std::clamp(-dot(across, from) / width, 0.0, 1.0) : 0.0;
    return dot(fall, from + fraction * along);
}

/// The ground of a scene, to be asked what lies on a line.
class Ground {
public:
    explicit Ground(const PlacedScene& placed) : tree_(makeBroadphase(BroadphaseKind::wideBvh)) {
        for (const PlacedPiece& piece : placed.pieces) {
            if (bodyOf(placed, piece).isDynamic() || shapeOf(placed, piece).sensor) { continue; }
            all_ = pieces_.empty() ? piece.bounds : hullOf(all_, piece.bounds);
            hasChains_ = hasChains_ || piece.segment >= 0;
            pieces_.push_back(&piece);
        }
        for (const PlacedPiece* const piece : pieces_) {
            // A line that grazes a box must not miss it by rounding.
            if (!tree_->insert(grown(piece->bounds, kSlack * scale()), ProxyKind::fixed).ok()) { isWhole_ = false; }
        }
    }

    bool hasChains() const { return hasChains_; }

    /// All that the line through a body's centre may meet, in the order of the scene.
    std::vector<const PlacedPiece*> along(const PlacedBody& body, DVec2 direction) const {
        const double reach = 2 * (size() + length(body.center - toDouble(all_.lower)));
        if (!isWhole_ || !std::isfinite(reach)) { return pieces_; }
        std::vector<std::uint32_t> slots;
        tree_->ray(body.center - reach * direction, 2 * reach * direction, 1, [&](ProxyId id, Real limit) {
            slots.push_back(static_cast<std::uint32_t>(id));  // given in turn
            return limit;
        });
        std::sort(slots.begin(), slots.end());
        std::vector<const PlacedPiece*> found;
        for (const std::uint32_t slot : slots) { found.push_back(pieces_[slot]); }
        return found;
    }

private:
    /// Part of the coordinates of the scene by which boxes are grown: far above what rounding does to them.
    static constexpr double kSlack = 1e-9;

    double size() const { return (all_.upper.x - all_.lower.x) + (all_.upper.y - all_.lower.y); }
    double scale() const { return size() + length(toDouble(all_.lower)) + length(toDouble(all_.upper)); }

    std::unique_ptr<Broadphase> tree_;
    std::vector<const PlacedPiece*> pieces_;  ///< by slot of the tree
    Aabb all_{};
    bool hasChains_ = false;
    bool isWhole_ = true;
};

/// The nearest piece below a body of those that do the same to it.
struct Nearest {
    const PlacedPiece* piece = nullptr;  ///< null: there is none
    double depth = std::numeric_limits<double>::infinity();

    void offer(const PlacedPiece* other, double otherDepth) {
        if (piece == nullptr || otherDepth < depth) { *this = {other, otherDepth}; }
    }
};

/// The chain that a body falls through from its back.
struct Passage {
    const PlacedPiece* chain = nullptr;  ///< null: there is none, or something else holds the body
    /// From there to where another side of the same chain holds it, metres; infinite: nothing does.
    double room = std::numeric_limits<double>::infinity();
};

Passage passageOf(const PlacedScene& placed, const Ground& ground, const PlacedBody& body, const PlacedPiece& own,
                  DVec2 fall) {
    Nearest passing;
    Nearest holding;
    for (const PlacedPiece* const piece : ground.along(body, fall)) {
        if (!mayCollide(placed, *piece, own)) { continue; }
        const Below how = below(placed, *piece, body, fall);
        if (how == Below::beside) { continue; }
        (how == Below::holds ? holding : passing).offer(piece, depthOf(placed, *piece, body, fall));
    }
    if (passing.piece == nullptr || holding.piece == nullptr) { return {passing.piece}; }
    const bool isSame = passing.piece->body == holding.piece->body && passing.piece->shape == holding.piece->shape;
    if (!isSame || holding.depth < passing.depth) { return {}; }
    return {passing.piece, holding.depth - passing.depth};
}

/// What is wrong with a passage for a body that is so large; no kind: nothing.
Finding findingOf(const Passage& passage, const PlacedBody& body, double extent) {
    Finding finding{Severity::warning, "", pointerOf(*passage.chain), "", ""};
    if (!std::isfinite(passage.room)) {
        finding.kind = "chain-back";
        finding.text = body.name +
                       " falls through this chain from its back, and nothing else is below: a chain collides on the "
                       "right-hand side of its direction alone";
        finding.remedy = "list its points the other way round (ground from right to left)";
    } else if (passage.room < extent) {
        finding.kind = "chain-hollow";
        finding.text = body.name + " (" + metres(extent) +
                       ") falls into this chain from its back, and is held by its other side " + metres(passage.room) +
                       " below: it comes to rest in the middle of it";
        finding.remedy =
            "list its points the other way round (a loop counter-clockwise is solid, clockwise it is hollow)";
    }
    return finding;
}

}  // namespace

void checkChains(const PlacedScene& placed, std::vector<Finding>& findings) {
    const Ground ground(placed);
    if (!ground.hasChains()) { return; }
    std::set<std::pair<int, int>> told;  // body and shape of a chain
    for (const PlacedPiece& own : placed.pieces) {
        const PlacedBody& body = placed.bodies[static_cast<std::size_t>(own.body)];
        const DVec2 gravity = body.description->gravityScale * placed.scene->gravity;
        if (!body.isDynamic() || !(length(gravity) > 0) || body.joints > 0) { continue; }
        const Passage passage = passageOf(placed, ground, body, own, (1 / length(gravity)) * gravity);
        if (passage.chain == nullptr) { continue; }
        Finding finding = findingOf(passage, body, own.extent);
        if (finding.kind.empty() || !told.insert({passage.chain->body, passage.chain->shape}).second) { continue; }
        findings.push_back(std::move(finding));
    }
}

}  // namespace swept

#include "posed_scene.h"

#include <algorithm>

namespace swept::measures {

PosedScene::PosedScene(const SceneDescription& scene) : placed_(place(scene)) {
    for (const PlacedBody& body : placed_.bodies) {
        localCenters_.push_back(toDouble(applyInverse(body.pose, body.center)));
    }
}

void PosedScene::pose(const Sample& sample) {
    for (PlacedBody& body : placed_.bodies) {
        const BodyFrame& frame = sample.bodies[static_cast<std::size_t>(body.index)];
        body.pose = {frame.position, rotationFromAngle(frame.angle)};
        body.center = apply(body.pose, toReal(localCenters_[static_cast<std::size_t>(body.index)]));
        body.hasBounds = false;
    }
    for (PlacedPiece& piece : placed_.pieces) {
        PlacedBody& body = placed_.bodies[static_cast<std::size_t>(piece.body)];
        piece.bounds = boundsOf(piece.polygon, body.pose);
        body.bounds = body.hasBounds ? hullOf(body.bounds, piece.bounds) : piece.bounds;
        body.hasBounds = true;
    }
}

double PosedScene::deepestOverlap() const {
    double deepest = 0;
    for (const NearPair& pair : nearPairs(placed_, 0)) { deepest = std::max(deepest, -pair.separation); }
    return deepest;
}

}  // namespace swept::measures

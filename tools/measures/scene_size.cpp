#include "scene_size.h"

#include <algorithm>
#include <limits>

#include "../inspect/placed_scene.h"

namespace swept::measures {

double smallestExtent(const SceneDescription& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    const PlacedScene placed = place(scene);
    for (const PlacedBody& body : placed.bodies) {
        if (body.isDynamic() && body.extent > 0) { smallest = std::min(smallest, body.extent); }
    }
    return smallest;
}

}  // namespace swept::measures

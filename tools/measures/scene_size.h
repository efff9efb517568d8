#pragma once

#include <swept/samples/scene_description.h>

namespace swept::measures {

/// The smallest extent of a dynamic body, metres: what accuracy is measured by. Infinite when no body has one.
double smallestExtent(const SceneDescription& scene);

}  // namespace swept::measures

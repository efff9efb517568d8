#pragma once

#include <cstdint>
#include <vector>

#include <swept/samples/frame.h>
#include <swept/samples/scene_description.h>

namespace swept {

/// How far one body is from where another engine has it.
struct BodyDeviation {
    int body = 0;         ///< index in the scene
    double position = 0;  ///< metres
    double angle = 0;     ///< radians, unwrapped, at least 0
    double velocity = 0;  ///< metres per second
};

/// How far apart two states of a scene are, over its dynamic bodies.
struct Deviation {
    std::int64_t step = 0;
    double time = 0;
    std::vector<BodyDeviation> bodies;  ///< dynamic ones, in scene order
    double worstPosition = 0;
    int worstBody = -1;  ///< −1 when the scene has no dynamic body
    double meanPosition = 0;
    double worstAngle = 0;
};

/// @param ours, theirs  states of the same step with the scene's bodies.
Deviation deviationOf(const SceneDescription& scene, const Frame& ours, const Frame& theirs);

/// A tenth of the size of the smallest dynamic body (the longer side of its shapes' bounding box): beyond that a
/// deviation is seen with the naked eye. Metres; 0 when the scene has no dynamic body with a shape.
double visibleDeviation(const SceneDescription& scene);

}  // namespace swept

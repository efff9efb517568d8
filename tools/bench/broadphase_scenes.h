#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "broadphase_trace.h"

namespace swept::bench {

/// Distributions of moving boxes. Sizes are of the order of a metre, and so many that a box overlaps about two others.
enum class BoxScene : std::uint8_t {
    uniform,        ///< in a square, all moving by up to a tenth of a metre a step
    clustered,      ///< in heaps far from each other
    oneAxis,        ///< a strip four metres high
    mixedSizes,     ///< few large, many small: a box is twice as large a quarter as often
    mostlyStatic,   ///< nine of ten are static
    mostlyResting,  ///< nineteen of twenty do not move
    raining,        ///< falling on tiles, there to rest for a while and to fall anew
};
inline constexpr BoxScene kBoxScenes[] = {
    BoxScene::uniform,      BoxScene::clustered,     BoxScene::oneAxis, BoxScene::mixedSizes,
    BoxScene::mostlyStatic, BoxScene::mostlyResting, BoxScene::raining,
};

const char* nameOf(BoxScene scene);

/// The same numbers give the same motion.
/// @param count  proxies
/// @param steps  after the first one
Motion makeBoxScene(BoxScene scene, std::uint32_t count, int steps, std::uint64_t seed);

/// Boxes and rays to ask about, spread over what the boxes of a trace occupy after its last step: boxes that hold about
/// twenty others if all were spread evenly, rays a tenth as long as the region is wide.
struct SceneQueries {
    std::vector<Aabb> boxes;
    std::vector<struct RayQuery> rays;
};
SceneQueries queriesFor(const BoxTrace& trace, int count, std::uint64_t seed);

}  // namespace swept::bench

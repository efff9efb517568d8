#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <swept/samples/scene_description.h>

namespace swept {

/// The bodies of a joint, by index.
struct JointEnds {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

/// Of every joint of a scene, in its order. @param scene  accepted by `validateScene`
std::vector<JointEnds> jointEndsOf(const SceneDescription& scene);

/// Which joints hold one of these bodies, in ascending order.
std::vector<std::size_t> jointsOn(std::span<const JointEnds> ends, std::span<const std::uint32_t> bodies);

}  // namespace swept

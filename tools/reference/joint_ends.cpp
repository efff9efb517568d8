#include "joint_ends.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include <swept/samples/scene_reader.h>

namespace swept {

std::vector<JointEnds> jointEndsOf(const SceneDescription& scene) {
    std::unordered_map<std::string, std::uint32_t> byName;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        byName.emplace(bodyName(scene, i), static_cast<std::uint32_t>(i));
    }
    std::vector<JointEnds> ends;
    for (const JointDescription& joint : scene.joints) {
        ends.push_back({byName.at(joint.bodyA), byName.at(joint.bodyB)});
    }
    return ends;
}

std::vector<std::size_t> jointsOn(std::span<const JointEnds> ends, std::span<const std::uint32_t> bodies) {
    std::vector<std::uint32_t> sorted(bodies.begin(), bodies.end());
    std::sort(sorted.begin(), sorted.end());
    const auto isOneOf = [&](std::uint32_t body) { return std::binary_search(sorted.begin(), sorted.end(), body); };
    std::vector<std::size_t> joints;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (isOneOf(ends[i].a) || isOneOf(ends[i].b)) { joints.push_back(i); }
    }
    return joints;
}

}  // namespace swept

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../world_scene.h"

namespace swept::inline SWEPT_PRECISION {

/// Where the things of a world are in its scene, and what they are called there.
struct ScenePlaces {
    const SceneNames& names;
    std::vector<std::uint32_t> bodies{};  ///< by slot
    std::vector<std::uint32_t> joints{};  ///< by slot

    /// As it was given; empty: none was.
    std::string givenName(BodyId id) const { return names.ofBody ? names.ofBody(id) : std::string(); }
    std::string givenName(JointId id) const { return names.ofJoint ? names.ofJoint(id) : std::string(); }
    std::string nameOf(BodyId id) const {
        const std::string given = givenName(id);
        return given.empty() ? "body" + std::to_string(bodies[id.index]) : given;
    }
    std::string nameOf(JointId id) const {
        const std::string given = givenName(id);
        return given.empty() ? "joint" + std::to_string(joints[id.index]) : given;
    }
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../world_scene.h"

namespace swept::inline SWEPT_PRECISION {

/// What some things of a world are called in its scene, one after another: no two alike, in well-formed UTF-8.
class SceneWords {
public:
    /// @param usual  what they are called with their place behind it where no name was given: "body" or "joint"
    /// @param given  by place, some of them empty
    SceneWords(const char* usual, std::vector<std::string> given);

    /// For a member "name"; empty: the usual one.
    const std::string& given(std::uint32_t place) const { return given_[place]; }
    std::string at(std::uint32_t place) const {
        return given_[place].empty() ? usual_ + std::to_string(place) : given_[place];
    }

private:
    std::string usual_;
    std::vector<std::string> given_;
};

/// Where the things of a world are in its scene, and what they are called there.
struct ScenePlaces {
    std::vector<std::uint32_t> bodies{};  ///< by slot
    std::vector<std::uint32_t> joints{};  ///< by slot
    SceneWords bodyWords;
    SceneWords jointWords;
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cstdint>

namespace swept {

/// Names of things in a world: a slot and its generation. A default one is null; one whose thing was destroyed is stale
/// for ever (a slot is retired when its generation would wrap). Both are refused with `staleId`.
struct BodyId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t generation = 0;
    constexpr bool operator==(const BodyId&) const = default;
};
struct ShapeId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t generation = 0;
    constexpr bool operator==(const ShapeId&) const = default;
};
struct JointId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t generation = 0;
    constexpr bool operator==(const JointId&) const = default;
};

}  // namespace swept

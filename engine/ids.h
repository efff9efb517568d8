#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace swept {

/// Names of things in a world: a slot and its generation. A default one is null; one whose thing was destroyed is stale
/// for ever (a slot is retired when its generation would wrap). Both are refused with `staleId`. They name things in
/// their world and its copies; in another world the same id may name something else.
struct BodyId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t generation = 0;
    constexpr auto operator<=>(const BodyId&) const = default;  ///< an order for sorted containers, no more
};
struct ShapeId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t generation = 0;
    constexpr auto operator<=>(const ShapeId&) const = default;  ///< an order for sorted containers, no more
};
struct JointId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t generation = 0;
    constexpr auto operator<=>(const JointId&) const = default;  ///< an order for sorted containers, no more
};

/// What `std::hash` of ids does, for `std::unordered_map` and the like.
template <class Id>
struct IdHash {
    std::size_t operator()(Id id) const noexcept {
        return std::hash<std::uint64_t>{}((std::uint64_t{id.generation} << 32U) | id.index);
    }
};

}  // namespace swept

template <>
struct std::hash<swept::BodyId> : swept::IdHash<swept::BodyId> {};
template <>
struct std::hash<swept::ShapeId> : swept::IdHash<swept::ShapeId> {};
template <>
struct std::hash<swept::JointId> : swept::IdHash<swept::JointId> {};

#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

/// How many members an aggregate has: as many as can be given between its braces, bases included. So whoever lists the
/// members of something is told by the compiler when one is missing.

namespace swept {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

/// What is made of what it may hold need not be stood for.
template <class T>
concept StoodFor = !kIsOptional<T>;

/// Stands for a member of any type; never converted.
struct AnyMember {
    template <StoodFor T>
    operator T() const noexcept;
};

template <class T, std::size_t... kPlaces>
consteval bool takesMembers(std::index_sequence<kPlaces...>) {
    return requires { T{(static_cast<void>(kPlaces), AnyMember{})...}; };
}
template <class T, std::size_t kCount>
inline constexpr bool kTakesMembers = takesMembers<T>(std::make_index_sequence<kCount>());

template <class T, std::size_t kAtLeast = 1>
consteval std::size_t countMembers() {
    if constexpr (kTakesMembers<T, kAtLeast + 1>) {
        return countMembers<T, kAtLeast + 1>();
    } else {
        static_assert(kTakesMembers<T, kAtLeast>, "an aggregate whose members can be anything");
        return kAtLeast;
    }
}

/// Bases count as one each. @pre T is an aggregate of at least one member, and no built-in arrays
template <class T>
inline constexpr std::size_t kMemberCount = countMembers<T>();

}  // namespace swept

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../../shapes/listed_members.h"
#include "../../shapes/real.h"
#include "tie_members.h"

/// What a world's image (world_image.h) writes down of something: all of its members, but for those that are marked as
/// left out. Where members cannot be tied (tie_members.h), `allMembers(object)` lists them: a function beside the
/// type, or a static one of a class whose members are private. It is given constant objects and others.

namespace swept::inline SWEPT_PRECISION {

/// Flags of which there are no more than fit into 16 bits.
template <std::size_t kCount>
using Flags = std::array<bool, kCount>;

// What has such gives others of these functions.
template <class T>
void allMembers(T& object) = delete;
/// The bit-fields of an object, of which there are no references.
template <class T>
Flags<1> flagsOf(const T& object) = delete;
template <class T>
void setFlags(T& object, const Flags<1>& flags) = delete;

/// Stands for them among members.
template <class T>
struct FlagsIn {
    T& object;
};
template <class T>
FlagsIn<T> flagsIn(T& object) {
    return {object};
}

template <class T, class Wanted>
concept MaybeConst = std::is_same_v<std::remove_const_t<T>, Wanted>;

/// So many bases and members, where all are listed.
/// @param flags  that are among them
template <class T>
constexpr bool areAllListed(std::size_t listed, std::size_t flags = 0) {
    return kMemberCount<T> == listed + flags;
}

template <class T>
constexpr auto membersOf(T& object) {
    if constexpr (requires { std::remove_const_t<T>::allMembers(object); }) {
        return std::remove_const_t<T>::allMembers(object);
    } else if constexpr (requires { allMembers(object); }) {
        return allMembers(object);
    } else {
        return tieMembers(object);
    }
}

}  // namespace swept::inline SWEPT_PRECISION

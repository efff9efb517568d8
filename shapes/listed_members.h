#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

/// How something tells all that it consists of to who writes it down (engine/image/members.h): classes whose members
/// are private by a static function `allMembers(self)`, which returns what `listed` makes of its bases and members, in
/// the order of their declaration. It is given constant objects and others.

namespace swept {

/// A member that need not be written: it says nothing about what will be. Scratch, and what is found again.
template <class T>
struct LeftOut {
    T& member;
};
template <class T>
constexpr LeftOut<T> leftOut(T& member) {
    return {member};
}

template <std::size_t kPlace, class T>
struct ListedMember {
    T member;
};
template <class Places, class... Members>
struct ListedAt;
template <std::size_t... kPlaces, class... Members>
struct ListedAt<std::index_sequence<kPlaces...>, Members...> : ListedMember<kPlaces, Members>... {
    static constexpr std::size_t kCount = sizeof...(Members);

    /// @return what `take` makes of all of them
    template <class Take>
    constexpr decltype(auto) giveTo(Take&& take) {
        return take(static_cast<ListedMember<kPlaces, Members>&>(*this).member...);
    }
};
/// References to members, and what is left out. (Of a tuple of a hundred compilers make a hundred tuples.)
template <class... Members>
using Listed = ListedAt<std::index_sequence_for<Members...>, Members...>;
template <class... Members>
constexpr Listed<Members...> listed(Members&&... members) {
    return {{std::forward<Members>(members)}...};
}

template <class Base, class T>
constexpr auto& baseOf(T& object) {
    return static_cast<std::conditional_t<std::is_const_v<T>, const Base, Base>&>(object);
}

}  // namespace swept

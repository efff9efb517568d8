#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "../../shapes/copied_atomic.h"
#include "../../shapes/real.h"
#include "members.h"

/// How the bytes of an image are laid out: member by member in the order of declaration, numbers in little-endian
/// order without padding, so that machines and compilers agree.

namespace swept::inline SWEPT_PRECISION {

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// What stands for a number in an image. `long` is as wide as it is anywhere: of 64 bits, and so are sizes.
template <class T>
struct WrittenNumber {
    static_assert(sizeof(T) <= 8);
    using Type =
        std::conditional_t<std::is_same_v<T, long> || std::is_same_v<T, unsigned long> || sizeof(T) == 8, std::uint64_t,
                           std::conditional_t<sizeof(T) == 4, std::uint32_t,
                                              std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
};
template <Number T>
using WrittenAs = typename WrittenNumber<T>::Type;

/// What a type takes in an image.
struct Layout {
    bool isFixed = true;                      ///< always the same number of bytes
    std::size_t bytes = 0;                    ///< these, or the fewest
    std::uint64_t hash = 0x5357455054324421;  ///< of kinds, widths and order of all that is in it
    bool isAsInMemory = true;                 ///< of bytes that are in the same order here

    consteval void note(std::uint64_t word) {
        hash = std::rotl(hash ^ (word * 0x9E3779B97F4A7C15U), 23) * 0xBF58476D1CE4E5B9U;
    }
    consteval void add(const Layout& part, std::size_t times = 1) {
        isFixed = isFixed && part.isFixed;
        bytes += times * part.bytes;
        isAsInMemory = isAsInMemory && part.isAsInMemory;
        note(part.hash);
    }
};

/// What tells kinds of parts apart in a hash.
enum class PartKind : std::uint8_t {
    truth,
    enumerator,
    number,
    withSign,
    fraction,
    flags,
    array,
    list,
    maybe,
    choice,
    members
};

template <class T>
struct LayoutOf;
template <class T>
inline constexpr Layout kLayout = LayoutOf<T>::make();

consteval Layout layoutOfKind(PartKind kind, std::uint64_t size) {
    Layout layout;
    layout.note(static_cast<std::uint64_t>(kind) << 56U | size);
    return layout;
}

template <class T>
consteval PartKind kindOfNumber() {
    if constexpr (std::is_same_v<T, bool>) { return PartKind::truth; }
    if constexpr (std::is_enum_v<T>) { return PartKind::enumerator; }
    if constexpr (std::is_floating_point_v<T>) { return PartKind::fraction; }
    return std::is_signed_v<T> ? PartKind::withSign : PartKind::number;
}

template <Number T>
struct LayoutOf<T> {
    static consteval Layout make() {
        Layout layout = layoutOfKind(kindOfNumber<T>(), sizeof(WrittenAs<T>));
        layout.bytes = sizeof(WrittenAs<T>);
        layout.isAsInMemory =
            std::endian::native == std::endian::little && sizeof(T) == layout.bytes && !std::is_same_v<T, bool>;
        return layout;
    }
};

template <class T, std::size_t kCount>
struct LayoutOf<std::array<T, kCount>> {
    static consteval Layout make() {
        Layout layout = layoutOfKind(PartKind::array, kCount);
        layout.add(kLayout<T>, kCount);
        return layout;
    }
};

/// An array that may have any length is preceded by that.
template <class T, class Allocator>
struct LayoutOf<std::vector<T, Allocator>> {
    static consteval Layout make() {
        Layout layout = layoutOfKind(PartKind::list, 0);
        layout.note(kLayout<T>.hash);
        layout.isFixed = layout.isAsInMemory = false;
        layout.bytes = sizeof(std::uint64_t);
        return layout;
    }
};

/// What may be there takes its bytes if it is not, too: zeros.
template <class T>
struct LayoutOf<std::optional<T>> {
    static_assert(kLayout<T>.isFixed);
    static consteval Layout make() {
        Layout layout = layoutOfKind(PartKind::maybe, 0);
        layout.add(kLayout<T>);
        layout.isAsInMemory = false;
        ++layout.bytes;
        return layout;
    }
};

template <class... Alternatives>
struct LayoutOf<std::variant<Alternatives...>> {
    static consteval Layout make() {
        Layout layout = layoutOfKind(PartKind::choice, sizeof...(Alternatives));
        (layout.note(kLayout<Alternatives>.hash), ...);
        layout.isFixed = layout.isAsInMemory = false;
        layout.bytes = 1;
        return layout;
    }
};

template <class T>
struct LayoutOf<CopiedAtomic<T>> {
    static consteval Layout make() {
        Layout layout = kLayout<T>;
        layout.isAsInMemory = false;
        return layout;
    }
};

template <class T>
struct LayoutOf<LeftOut<T>> {
    static consteval Layout make() {
        Layout layout;
        layout.isAsInMemory = false;
        return layout;
    }
};

template <class T>
struct LayoutOf<FlagsIn<T>> {
    static consteval Layout make() {
        constexpr std::size_t kCount = std::tuple_size_v<decltype(flagsOf(std::declval<T&>()))>;
        static_assert(kCount <= 16);
        Layout layout = layoutOfKind(PartKind::flags, kCount);
        layout.isAsInMemory = false;
        layout.bytes = sizeof(std::uint16_t);
        return layout;
    }
};

/// All else consists of members.
template <class T>
struct LayoutOf {
    template <class Places, class... Members>
    static consteval Layout makeOf(const ListedAt<Places, Members...>*) {
        Layout layout = layoutOfKind(PartKind::members, sizeof...(Members));
        (layout.add(kLayout<std::remove_cvref_t<Members>>), ...);
        // What is tied stands in this order, and without gaps if all of it has room for nothing else.
        layout.isAsInMemory = layout.isAsInMemory && layout.isFixed && sizeof(T) == layout.bytes;
        return layout;
    }
    static consteval Layout make() {
        using Members = decltype(membersOf(std::declval<T&>()));
        return makeOf(static_cast<const Members*>(nullptr));
    }
};

}  // namespace swept::inline SWEPT_PRECISION

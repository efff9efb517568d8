#pragma once

#include <cstdint>
#include <type_traits>

#include "bit_cast.h"

/// Choices that are no branches, for where nothing foretells which way they go: GCC 12 makes branches of `?:`, and each
/// that was guessed wrong costs some fifteen instructions.

namespace swept {

/// All bits where it is so, none where not.
template <class Bits>
constexpr Bits maskOf(bool isSo) noexcept {
    return static_cast<Bits>(Bits{0} - Bits{isSo});
}

/// A number, or zero. @tparam Number  float or double
template <class Number>
constexpr Number orZero(bool isThere, Number number) noexcept {
    using Bits = std::conditional_t<sizeof(Number) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
    return bitCast<Number>(static_cast<Bits>(bitCast<Bits>(number) & maskOf<Bits>(isThere)));
}

}  // namespace swept

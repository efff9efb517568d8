#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace swept {

/// The value of type `To` that has the bits of `from`: `std::bit_cast`, which standard libraries of before 2022 lack
/// (Emscripten 3.1.6 of Debian 12 has one such), by what it is made of in each compiler.
template <class To, class From>
constexpr To bitCast(const From& from) noexcept {
#ifdef __cpp_lib_bit_cast
    return std::bit_cast<To>(from);
#else
    return __builtin_bit_cast(To, from);
#endif
}

/// A number, or zero: without the branch that compilers make of a choice. For where nothing foretells it.
/// @tparam Number  float or double
template <class Number>
constexpr Number orZero(bool isThere, Number number) noexcept {
    using Bits = std::conditional_t<sizeof(Number) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
    return bitCast<Number>(static_cast<Bits>(bitCast<Bits>(number) & (Bits{0} - Bits{isThere})));
}

}  // namespace swept

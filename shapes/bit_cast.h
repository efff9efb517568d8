#pragma once

#include <bit>

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

}  // namespace swept

#pragma once

#include <cstddef>
#include <type_traits>

#include "../../shapes/listed_members.h"
#include "member_count.h"

namespace swept {

/// What has more members is listed by hand (body_members.h).
inline constexpr std::size_t kMostTiedMembers = 20;

/// References to the members of an aggregate, in their order: all of them, or it does not compile. C++20 has no other
/// way to name members that it does not know.
/// @pre no bases with members, bit-fields or built-in arrays
template <class T>
constexpr auto tieMembers(T& object) {
    constexpr std::size_t kCount = kMemberCount<std::remove_const_t<T>>;
    static_assert(kCount <= kMostTiedMembers);
    if constexpr (kCount == 1) {
        auto& [m0] = object;
        return listed(m0);
    } else if constexpr (kCount == 2) {
        auto& [m0, m1] = object;
        return listed(m0, m1);
    } else if constexpr (kCount == 3) {
        auto& [m0, m1, m2] = object;
        return listed(m0, m1, m2);
    } else if constexpr (kCount == 4) {
        auto& [m0, m1, m2, m3] = object;
        return listed(m0, m1, m2, m3);
    } else if constexpr (kCount == 5) {
        auto& [m0, m1, m2, m3, m4] = object;
        return listed(m0, m1, m2, m3, m4);
    } else if constexpr (kCount == 6) {
        auto& [m0, m1, m2, m3, m4, m5] = object;
        return listed(m0, m1, m2, m3, m4, m5);
    } else if constexpr (kCount == 7) {
        auto& [m0, m1, m2, m3, m4, m5, m6] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6);
    } else if constexpr (kCount == 8) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7);
    } else if constexpr (kCount == 9) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8);
    } else if constexpr (kCount == 10) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9);
    } else if constexpr (kCount == 11) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10);
    } else if constexpr (kCount == 12) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11);
    } else if constexpr (kCount == 13) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12);
    } else if constexpr (kCount == 14) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13);
    } else if constexpr (kCount == 15) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14);
    } else if constexpr (kCount == 16) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15);
    } else if constexpr (kCount == 17) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16);
    } else if constexpr (kCount == 18) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17);
    } else if constexpr (kCount == 19) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18);
    } else if constexpr (kCount == 20) {
        auto& [m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19] = object;
        return listed(m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19);
    }
}

}  // namespace swept

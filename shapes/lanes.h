#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "compiler.h"

/// A few numbers side by side, for code outside of the wide kernels: a register of the baseline instruction set where
/// the compiler has vectors (GCC and clang, on any target), else an array, with the same bits. Arithmetic and
/// comparisons are those of each lane, with one number for all of them on either side; `lanes[i]` reads one. A
/// comparison gives integers of the same size: all bits are set where it holds, none elsewhere.

namespace swept {

#ifdef SWEPT_HAS_GNU_EXTENSIONS

template <class T, std::size_t kLanes>
struct VectorOf {
    typedef T Type [[gnu::vector_size(kLanes * sizeof(T))]];
};
template <class T, std::size_t kLanes>
using LanesOf = typename VectorOf<T, kLanes>::Type;

/// Those of the lanes of `a` and then of `b` that have these numbers.
template <int... kFrom, class Lanes>
SWEPT_FORCE_INLINE Lanes shuffled(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, kFrom...);
}

#else

template <class T, std::size_t kLanes>
struct LanesOf {
    static_assert(sizeof(T) == sizeof(std::int32_t) || sizeof(T) == sizeof(std::int64_t));
    using Bits = std::conditional_t<sizeof(T) == sizeof(std::int32_t), std::int32_t, std::int64_t>;
    using Mask = LanesOf<Bits, kLanes>;

    T lanes[kLanes];

    T operator[](std::size_t i) const { return lanes[i]; }

    /// What a function makes of each lane of both.
    template <class Result = LanesOf, class Function>
    static Result each(const LanesOf& a, const LanesOf& b, Function function) {
        Result result;
        for (std::size_t i = 0; i < kLanes; ++i) { result.lanes[i] = function(a.lanes[i], b.lanes[i]); }
        return result;
    }
    static LanesOf all(T number) {
        return each({}, {}, [number](T, T) { return number; });
    }
    /// All bits or none, of an integer.
    static constexpr Bits maskOf(bool holds) { return holds ? Bits{-1} : Bits{0}; }

    friend LanesOf operator-(const LanesOf& a) {
        return each(a, a, [](T x, T) { return -x; });
    }
    friend LanesOf operator~(const LanesOf& a) {
        return each(a, a, [](T x, T) { return ~x; });
    }
    friend LanesOf operator+(const LanesOf& a, const LanesOf& b) {
        return each(a, b, [](T x, T y) { return x + y; });
    }
    friend LanesOf operator-(const LanesOf& a, const LanesOf& b) {
        return each(a, b, [](T x, T y) { return x - y; });
    }
    friend LanesOf operator*(const LanesOf& a, const LanesOf& b) {
        return each(a, b, [](T x, T y) { return x * y; });
    }
    friend LanesOf operator&(const LanesOf& a, const LanesOf& b) {
        return each(a, b, [](T x, T y) { return x & y; });
    }
    friend LanesOf operator|(const LanesOf& a, const LanesOf& b) {
        return each(a, b, [](T x, T y) { return x | y; });
    }
    friend Mask operator<(const LanesOf& a, const LanesOf& b) {
        return each<Mask>(a, b, [](T x, T y) { return maskOf(x < y); });
    }
    friend Mask operator<=(const LanesOf& a, const LanesOf& b) {
        return each<Mask>(a, b, [](T x, T y) { return maskOf(x <= y); });
    }

    friend LanesOf operator+(T a, const LanesOf& b) { return all(a) + b; }
    friend LanesOf operator*(T a, const LanesOf& b) { return all(a) * b; }
    friend LanesOf operator+(const LanesOf& a, T b) { return a + all(b); }
    friend LanesOf operator-(const LanesOf& a, T b) { return a - all(b); }
    friend LanesOf operator*(const LanesOf& a, T b) { return a * all(b); }
    friend LanesOf operator&(const LanesOf& a, T b) { return a & all(b); }
};

template <int... kFrom, class T, std::size_t kLanes>
LanesOf<T, kLanes> shuffled(const LanesOf<T, kLanes>& a, const LanesOf<T, kLanes>& b) {
    constexpr int kMiddle = int{kLanes};
    return {{(kFrom < kMiddle ? a.lanes[kFrom % kMiddle] : b.lanes[kFrom % kMiddle])...}};
}

template <class T, std::size_t kLanes>
LanesOf<T, kLanes> largerOf(const LanesOf<T, kLanes>& a, const LanesOf<T, kLanes>& b) {
    return LanesOf<T, kLanes>::each(a, b, [](T x, T y) { return x > y ? x : y; });
}
template <class T, std::size_t kLanes>
LanesOf<T, kLanes> smallerOf(const LanesOf<T, kLanes>& a, const LanesOf<T, kLanes>& b) {
    return LanesOf<T, kLanes>::each(a, b, [](T x, T y) { return x < y ? x : y; });
}

#endif

/// Of two numbers, or lane by lane; `b` where neither is, or one is no number.
template <class T>
SWEPT_FORCE_INLINE T largerOf(T a, T b) {
    return a > b ? a : b;
}
template <class T>
SWEPT_FORCE_INLINE T smallerOf(T a, T b) {
    return a < b ? a : b;
}

/// Whether a comparison holds in all lanes.
template <class Mask>
SWEPT_FORCE_INLINE bool holdsInAll(const Mask& mask) {
    std::uint64_t words[sizeof(Mask) / sizeof(std::uint64_t)];
    std::memcpy(words, &mask, sizeof(Mask));
    std::uint64_t all = ~std::uint64_t{0};
    for (const std::uint64_t word : words) { all &= word; }
    return all == ~std::uint64_t{0};
}

}  // namespace swept

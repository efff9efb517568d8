#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include <swept/shapes/bit_cast.h>
#include <swept/shapes/lanes.h>

/// Vectors of the compiler and arrays in their place do the same; here is whichever is built (see `plain` in
/// tools/portability.sh).

namespace swept {
namespace {

using Floats = LanesOf<float, 4>;
using Ints = LanesOf<std::int32_t, 4>;
using Doubles = LanesOf<double, 2>;
using Longs = LanesOf<std::int64_t, 2>;

template <class Lanes, class T>
void expectLanes(const Lanes& lanes, std::initializer_list<T> expected) {
    std::size_t i = 0;
    for (const T number : expected) {
        EXPECT_EQ(lanes[i], number) << "lane " << i;
        ++i;
    }
}

TEST(Lanes, ComputeEachForItself) {
    const Floats a{1, 2, 3, 4};
    const Floats b{8, 6, 4, 2};
    expectLanes(a + b, {9.0F, 8.0F, 7.0F, 6.0F});
    expectLanes(a - b, {-7.0F, -4.0F, -1.0F, 2.0F});
    expectLanes(a * b, {8.0F, 12.0F, 12.0F, 8.0F});
    expectLanes(-a, {-1.0F, -2.0F, -3.0F, -4.0F});
    expectLanes(2.0F * a + 1.0F, {3.0F, 5.0F, 7.0F, 9.0F});
    expectLanes(1.0F + b * 0.5F - 2.0F, {3.0F, 2.0F, 1.0F, 0.0F});
    const Longs bits{6, 5};
    expectLanes((bits & Longs{3, 4}) | Longs{8, 0}, {std::int64_t{10}, std::int64_t{4}});
    expectLanes(~bits & std::int64_t{7}, {std::int64_t{1}, std::int64_t{2}});
}

TEST(Lanes, ComparedAreMasks) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    expectLanes(Floats{1, 2, 3, 4} < Floats{2, 2, 2, 9}, {-1, 0, 0, -1});
    expectLanes(Doubles{1, none} <= Doubles{1, 1}, {std::int64_t{-1}, std::int64_t{0}});
    EXPECT_TRUE(holdsInAll(Doubles{1, 2} <= Doubles{1, 3}));
    EXPECT_FALSE(holdsInAll(Doubles{1, 2} < Doubles{1, 3}));
    EXPECT_FALSE(holdsInAll(Doubles{1, 2} < Doubles{2, 2}));
    for (std::size_t odd = 0; odd < 4; ++odd) {
        const float at[4] = {odd == 0 ? 1.0F : 0.0F, odd == 1 ? 1.0F : 0.0F, odd == 2 ? 1.0F : 0.0F,
                             odd == 3 ? 1.0F : 0.0F};
        EXPECT_FALSE(holdsInAll(Floats{at[0], at[1], at[2], at[3]} <= Floats{})) << odd;
    }
}

TEST(Lanes, AreShuffledFromTwo) {
    const Floats a{0, 1, 2, 3};
    const Floats b{4, 5, 6, 7};
    expectLanes(shuffled<0, 2, 4, 6>(a, b), {0.0F, 2.0F, 4.0F, 6.0F});
    expectLanes(shuffled<7, 1, 5, 3>(a, b), {7.0F, 1.0F, 5.0F, 3.0F});
    expectLanes(shuffled<1, 3>(Doubles{0, 1}, Doubles{2, 3}), {1.0, 3.0});
}

/// The sign of a zero and numbers that are none go the same way everywhere.
TEST(Lanes, OfTwoThatAreEqualTheSecondIsTaken) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const Doubles larger = largerOf(Doubles{0.0, none}, Doubles{-0.0, 1});
    EXPECT_TRUE(std::signbit(larger[0]));
    EXPECT_EQ(larger[1], 1);
    const Doubles smaller = smallerOf(Doubles{-0.0, 1}, Doubles{0.0, none});
    EXPECT_FALSE(std::signbit(smaller[0]));
    EXPECT_TRUE(std::isnan(smaller[1]));
    expectLanes(largerOf(Floats{1, 2, 3, 4}, Floats{4, 3, 2, 1}), {4.0F, 3.0F, 3.0F, 4.0F});
    expectLanes(smallerOf(Floats{1, 2, 3, 4}, Floats{4, 3, 2, 1}), {1.0F, 2.0F, 2.0F, 1.0F});
    EXPECT_EQ(largerOf(2, 3), 3);
    EXPECT_TRUE(std::signbit(largerOf(0.0, -0.0)));
}

TEST(Lanes, KeepTheirBitsAsIntegers) {
    const Ints bits = bitCast<Ints>(Floats{1, -0.0F, 0, -1});
    EXPECT_EQ(bits[0], 0x3F800000);
    EXPECT_EQ(bits[1], std::numeric_limits<std::int32_t>::min());
    EXPECT_EQ(bits[2], 0);
    expectLanes(bitCast<Floats>(bits), {1.0F, -0.0F, 0.0F, -1.0F});
}

}  // namespace
}  // namespace swept

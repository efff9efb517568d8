#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <swept/tools/writers/number_text.h>

#include "../support/random.h"

namespace swept {
namespace {

std::string textOf(double value) {
    std::string text;
    appendNumber(text, value);
    return text;
}

double readBack(const std::string& text) {
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_EQ(result.ptr, text.data() + text.size()) << text;
    return value;
}

TEST(NumberText, IsTheShortestForm) {
    EXPECT_EQ(textOf(0), "0");
    EXPECT_EQ(textOf(-0.0), "-0");
    EXPECT_EQ(textOf(0.1), "0.1");
    EXPECT_EQ(textOf(1), "1");
    EXPECT_EQ(textOf(-9.81), "-9.81");
    EXPECT_EQ(textOf(1.0 / 60.0), "0.016666666666666666");
    EXPECT_EQ(textOf(1e22), "1e+22");
    EXPECT_EQ(textOf(std::numeric_limits<double>::denorm_min()), "5e-324");
}

TEST(NumberText, ReadsBackAsTheSameDouble) {
    constexpr std::uint64_t kSeed = 20;
    test::Random random(kSeed);
    int finite = 0;
    for (int i = 0; i < 100'000; ++i) {
        const auto bits = random.bits();
        const auto value = std::bit_cast<double>(bits);
        if (!std::isfinite(value)) { continue; }
        ++finite;
        const std::string text = textOf(value);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(readBack(text)), bits)
            << "seed " << kSeed << " case " << i << ": " << text;
        ASSERT_LE(text.size(), 24u) << text;
    }
    EXPECT_GT(finite, 99'000);
}

TEST(NumberText, JsonHasNoNumberForWhatIsNotFinite) {
    std::string text;
    appendJsonNumber(text, std::numeric_limits<double>::quiet_NaN());
    text += ' ';
    appendJsonNumber(text, -std::numeric_limits<double>::infinity());
    text += ' ';
    appendJsonNumber(text, 2.5);
    EXPECT_EQ(text, "null null 2.5");
}

TEST(NumberText, RoundsForHumans) {
    EXPECT_EQ(roundedText(1.0 / 3.0), "0.3333");
    EXPECT_EQ(roundedText(10), "10");
    EXPECT_EQ(roundedText(0.000123456, 3), "0.000123");
}

TEST(NumberText, RoundsDownWhereALimitMustHold) {
    EXPECT_EQ(roundedDownText(0.015, 2), "0.015");
    EXPECT_EQ(roundedDownText(1.0 / 60, 2), "0.016");
    EXPECT_EQ(roundedDownText(1.0 / 60, 4), "0.01666");
    EXPECT_EQ(roundedDownText(0.99999, 3), "0.999");
    EXPECT_EQ(roundedDownText(1999, 2), "1.9e+03");
    EXPECT_EQ(roundedDownText(0, 4), "0");
    for (double value = 1e-9; value < 1e9; value *= 1.37) {
        for (const int digits : {1, 2, 4}) {
            const double rounded = readBack(roundedDownText(value, digits));
            EXPECT_LE(rounded, value) << digits;
            EXPECT_GT(rounded, value * (1 - std::pow(10, 1 - digits))) << digits;
        }
    }
}

TEST(NumberText, CountsForHumans) {
    EXPECT_EQ(countText(0, "step"), "0 steps");
    EXPECT_EQ(countText(1, "step"), "1 step");
    EXPECT_EQ(countText(64, "step"), "64 steps");
}

TEST(NumberText, MinusZeroAloneLosesItsSign) {
    EXPECT_EQ(textOf(withoutMinusZero(-0.0)), "0");
    for (const double value : {0.0, -1.0, 0.1, -5e-324, 1e308}) { EXPECT_EQ(withoutMinusZero(value), value); }
    EXPECT_TRUE(std::isnan(withoutMinusZero(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace swept

#include <gtest/gtest.h>

#include <cmath>

#include <swept/engine/solve/energy_gain.h>

/// What is taken from islands that gained energy.

namespace swept::test {
namespace {

TEST(EnergyGain, LeavesTheSpeedOfWhatIsLeft) {
    EXPECT_EQ(speedLeft(4, 3, 4), 0.5);
    EXPECT_EQ(speedLeft(4, 0, 4), 1);
    EXPECT_EQ(speedLeft(4, 4, 4), 0);
    EXPECT_EQ(speedLeft(4, 5, 4), 0);
    EXPECT_EQ(speedLeft(0, 0, 0), 0);
    EXPECT_NEAR(speedLeft(1, 1 - 1e-6, 1), 1e-3, 1e-9);
}

/// An island of 27 J burst with 9e41 J; the difference of what it had and what it gained is a rounding of either.
TEST(EnergyGain, LeavesNothingOfRounding) {
    const double energy = 9e41;
    const double taken = std::nextafter(energy, 0);
    EXPECT_GT(energy - taken, 1e25);
    EXPECT_EQ(speedLeft(energy, taken, energy), 0);
    // Of a small part of it no more: its share of what was taken is as far off.
    EXPECT_EQ(speedLeft(1e26, 1e25, energy), 0);
}

}  // namespace
}  // namespace swept::test

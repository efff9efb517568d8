#include <gtest/gtest.h>

#ifdef SWEPT_SIMD

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <swept/shapes/bit_cast.h>
#include <swept/solver/wide/wide_columns.h>
#include <swept/solver/wide/wide_targets.h>
// after it
#include <hwy/targets.h>

#include "../support/random.h"

/// Columns of a factorisation eliminated four numbers at a time, against the same number by number: the same bits with
/// every instruction set of this machine.

namespace swept::test {
namespace {

/// Makes Highway choose one instruction set.
class WideColumns : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

/// A column of so many blocks that contributes to a full triangle of them right of it.
struct Triangle {
    explicit Triangle(std::size_t size) : count(size), diagonals(size + 1), blocks(size + size * (size - 1) / 2) {
        auto place = static_cast<std::uint32_t>(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            for (std::uint32_t k = 0; k < i; ++k) { targets.push_back(place++); }
            targets.push_back(kDiagonalBit | (i + 1));
        }
    }

    void fill(Random& random, double size) {
        const auto any = [&] { return random.sign() * std::pow(2.0, random.range(-size, size)); };
        for (Block33& block : diagonals) {
            for (double& number : block) { number = any(); }
        }
        for (Block33& block : blocks) {
            for (double& number : block) { number = random.chance(0.1) ? 0 : any(); }
        }
    }

    void eliminateBy(EliminateColumn how) {
        std::vector<SpreadBlock> scratch(count);
        how({diagonals[0], std::span(blocks).first(count), targets.data(), diagonals.data(), blocks.data()}, scratch);
    }

    std::vector<std::uint64_t> bits() const {
        std::vector<std::uint64_t> all;
        for (const std::vector<Block33>* part : {&diagonals, &blocks}) {
            for (const Block33& block : *part) {
                for (const double number : block) {
                    all.push_back(std::isnan(number) ? ~std::uint64_t{0} : bitCast<std::uint64_t>(number));
                }
            }
        }
        return all;
    }

    std::size_t count;
    std::vector<Block33> diagonals;
    std::vector<Block33> blocks;
    std::vector<std::uint32_t> targets;
};

TEST_P(WideColumns, AreEliminatedToTheBitAsNumberByNumber) {
    const EliminateColumn kernel = columnKernel();
    ASSERT_TRUE(kernel != nullptr || (GetParam() & (HWY_AVX2 | HWY_AVX3 | HWY_AVX3_DL)) == 0);
    if (kernel == nullptr) { GTEST_SKIP() << "no four doubles side by side"; }
    Random random(17);
    for (int i = 0; i < 400; ++i) {
        Triangle wanted(1 + static_cast<std::size_t>(i) % 20);
        wanted.fill(random, i % 3 == 0 ? 300 : 10);  // some overflow
        Triangle triangle = wanted;
        wanted.eliminateBy(eliminateColumn);
        triangle.eliminateBy(kernel);
        ASSERT_EQ(triangle.bits(), wanted.bits()) << "sample " << i << " of " << wanted.count << " blocks";
    }
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, WideColumns, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

}  // namespace
}  // namespace swept::test

#endif

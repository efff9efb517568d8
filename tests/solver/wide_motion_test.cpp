#include <gtest/gtest.h>

#ifdef SWEPT_SIMD

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <swept/shapes/bit_cast.h>
#include <swept/solver/wide/wide_contacts.h>
#include <swept/solver/wide/wide_motion.h>
#include <swept/solver/wide/wide_targets.h>
// after it
#include <hwy/targets.h>

#include "../support/random.h"

/// Bodies that move and turn side by side, against the same one by one: the same bits with every instruction set of
/// this machine.

namespace swept::test {
namespace {

/// Makes Highway choose one instruction set.
class WideMotion : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

/// Of all sizes and both signs, next to where they need reduction, and what is no angle.
std::vector<Real> allAngles() {
    constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
    std::vector<Real> angles{0, -Real(0), kInfinity, -kInfinity, std::numeric_limits<Real>::quiet_NaN()};
    Random random(7);
    for (int i = 0; i < 4'000; ++i) {
        const double size = std::pow(2.0, random.range(i % 2 == 0 ? -100 : -8, i % 3 == 0 ? 24 : 0));
        angles.push_back(static_cast<Real>(random.sign() * size));
        angles.push_back(static_cast<Real>(random.sign() * (0.7853981633974483 + random.range(-1e-6, 1e-6))));
    }
    return angles;
}

/// None that needs reduction, so that no group is gone through one by one.
std::vector<Real> smallAngles() {
    std::vector<Real> angles{0, -Real(0)};
    Random random(11);
    for (int i = 0; i < 4'000; ++i) {
        const double size = 0.77 * std::pow(2.0, random.range(i % 2 == 0 ? -100 : -8, 0));
        angles.push_back(static_cast<Real>(random.sign() * size));
    }
    return angles;
}

std::vector<BodyState> turnedBodies(const std::vector<Real>& angles) {
    Random random(13);
    std::vector<BodyState> bodies(angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i) {
        bodies[i].deltaAngle = angles[i];
        // Most stay as they are turned: their angles are chosen with care.
        bodies[i].angularVelocity = i % 4 == 3 ? static_cast<Real>(random.range(-3, 3)) : -Real(0);
        bodies[i].velocity = {static_cast<Real>(random.range(-9, 9)), static_cast<Real>(random.range(-9, 9))};
        bodies[i].deltaPosition = {static_cast<Real>(random.range(-1, 1)), static_cast<Real>(random.range(-1, 1))};
    }
    return bodies;
}

std::vector<Real> numbersOf(const BodyState& body) {
    return {body.velocity.x,      body.velocity.y,      body.angularVelocity, body.deltaAngle,
            body.deltaPosition.x, body.deltaPosition.y, body.deltaRotation.c, body.deltaRotation.s};
}
/// Of what is no number only that it is none.
std::vector<std::uint64_t> bitsOf(const BodyState& body) {
    std::vector<std::uint64_t> bits;
    for (const Real number : numbersOf(body)) {
        bits.push_back(std::isnan(number) ? ~std::uint64_t{0} : bitCast<std::uint64_t>(static_cast<double>(number)));
    }
    return bits;
}

TEST_P(WideMotion, BodiesMoveToTheBitAsOneByOne) {
    const MoveBodies move = motionKernel();
    // Angles are double, of which WebAssembly has none side by side here.
    ASSERT_EQ(move == nullptr, contactKernels() == nullptr || GetParam() == HWY_WASM);
    if (move == nullptr) { GTEST_SKIP() << "no doubles side by side"; }
    constexpr Real h = Real(1) / 1024;
    for (const std::vector<Real>& angles : {allAngles(), smallAngles()}) {
        std::vector<BodyState> bodies = turnedBodies(angles);
        std::vector<BodyState> wanted = bodies;
        moveBodies(wanted, h);
        std::size_t count = 0;  // whole registers, and any number that is left over
        for (std::size_t begin = 0; begin < bodies.size(); begin += count) {
            count = std::min(1 + begin % 2 * 32 + begin % 37, bodies.size() - begin);
            move(std::span(bodies).subspan(begin, count), h);
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            ASSERT_EQ(bitsOf(bodies[i]), bitsOf(wanted[i])) << wanted[i].deltaAngle;
            const Rotation rotation = rotationFromAngle(static_cast<double>(bodies[i].deltaAngle));
            ASSERT_EQ(bodies[i].deltaRotation, rotation) << wanted[i].deltaAngle;
        }
    }
}

TEST_P(WideMotion, RotationsAreFoundToTheBitAsOneByOne) {
    const FindRotations find = rotationKernel();
    ASSERT_EQ(find == nullptr, motionKernel() == nullptr);
    if (find == nullptr) { GTEST_SKIP() << "no doubles side by side"; }
    std::vector<double> angles{0.0, -0.0, 1e-300, -1e-9, 0x1p20, -0x1p20, 1e6, -1e6};
    for (int i = -4000; i < 4000; ++i) { angles.push_back(i * 0.0123); }
    for (int i = -300; i < 300; ++i) {  // borders of quadrants, and beside them
        const double border = (i + 0.5) * 1.5707963267948966;
        angles.insert(angles.end(), {border, std::nextafter(border, 1e9), std::nextafter(border, -1e9), 2 * border});
    }
    const std::vector<double> rare{1e7, -0x1p40, 1e300, std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()};
    for (std::size_t i = 0; i < rare.size(); ++i) {
        angles.insert(angles.begin() + static_cast<std::ptrdiff_t>(500 * (i + 1)), rare[i]);
    }
    std::vector<Rotation> wanted(angles.size());
    findRotations(angles, wanted);
    std::vector<Rotation> rotations(angles.size());
    for (std::size_t begin = 0; begin < angles.size(); begin += 19) {  // and what is left over
        const std::size_t count = std::min<std::size_t>(19, angles.size() - begin);
        find(std::span(angles).subspan(begin, count), std::span(rotations).subspan(begin, count));
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
        ASSERT_EQ(wanted[i], rotationFromAngle(angles[i])) << angles[i];
        ASSERT_EQ(rotations[i], wanted[i]) << angles[i];
        ASSERT_EQ(std::signbit(rotations[i].s), std::signbit(wanted[i].s)) << angles[i];
        ASSERT_EQ(std::signbit(rotations[i].c), std::signbit(wanted[i].c)) << angles[i];
    }
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, WideMotion, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

}  // namespace
}  // namespace swept::test

#endif

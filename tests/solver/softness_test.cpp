#include <gtest/gtest.h>
#include <swept/solver/joints/point_constraint.h>

#include <cmath>

#include "../support/random.h"
#include "numbers.h"

namespace swept::test {
namespace {

using Wide = long double;

/// Implicit Euler of m·x″ = −k·x − c·x′ solved directly: v₁ = (v₀ − h·ω²·x₀) / (1 + 2ζ·hω + (hω)²).
Wide implicitSpringVelocity(Wide omega, Wide zeta, Wide h, Wide x, Wide v) {
    return (v - h * omega * omega * x) / (1 + 2 * zeta * h * omega + h * omega * h * omega);
}

TEST(Softness, OneImpulseIsOneImplicitStepOfTheSpringForAnyWarmStart) {
    int stiff = 0;
    int loose = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Random random(seed);
        const Real omega = real(std::exp2(random.range(-4, 10)));
        const Real zeta = real(random.range(0, 10));
        const Real h = real(std::exp2(random.range(-10, -4)));
        const Real mass = real(std::exp2(random.range(-5, 5)));
        const Real error = real(random.range(-1, 1));
        const Real velocity = real(random.range(-1, 1));
        const Real warm = real(random.range(-1, 1)) * mass;
        const Real speed = velocity + warm / mass;  // warm starting has applied the impulse already
        const Real after = speed + scalarChange(mass, speed, error, warm, softnessOf(omega, zeta, h)) / mass;
        const Wide wanted = implicitSpringVelocity(omega, zeta, h, error, velocity);
        const Wide scale = 2 + Wide(omega) / (2 * Wide(zeta) + Wide(h) * Wide(omega)) * std::fabs(Wide(error));
        ASSERT_LE(std::fabs(Wide(after) - wanted), 16 * Wide(kEpsilon) * scale) << "seed " << seed;
        (h * omega > 1 ? stiff : loose) += 1;
    }
    EXPECT_GT(stiff, 2'000);
    EXPECT_GT(loose, 2'000);
}

TEST(Softness, RigidStopsTheSpeedAndIgnoresTheError) { EXPECT_EQ(scalarChange(4, 3, 100, 7, kRigid), -12); }

TEST(Softness, OfTheSubStepFollowsItsRate) {
    for (const Real h : {real(1.0 / 240), real(1.0 / 960), real(0.25)}) {
        const double omega = 2 * std::acos(-1.0) * static_cast<double>(kContactCycles) / static_cast<double>(h);
        const Softness direct = softnessOf(real(omega), kContactDampingRatio, h);
        const Softness named = softnessOfSubStep(kContactCycles, kContactDampingRatio, h);
        EXPECT_NEAR(named.biasRate, direct.biasRate, 4 * kEpsilon * direct.biasRate);
        EXPECT_NEAR(named.massScale, direct.massScale, 4 * kEpsilon);
        EXPECT_NEAR(named.impulseScale, direct.impulseScale, 4 * kEpsilon);
        EXPECT_NEAR(named.massScale + named.impulseScale, 1, 4 * kEpsilon);
    }
}

TEST(PointMatrix, SolvesTheTwoEquations) {
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Random random(seed);
        const auto any = [&] { return real(random.range(-1, 1)); };
        const BodyInertia a{real(std::exp2(random.range(-4, 4))), real(std::exp2(random.range(-3, 3)))};
        const BodyInertia b = random.chance(0.3) ? BodyInertia{} : BodyInertia{a.inverseMass, real(random.uniform())};
        const Vec2 armA{any(), any()};
        const Vec2 armB{any(), any()};
        const Vec2 wanted{any(), any()};
        const Vec2 impulse = solve(pointMatrix(a, armA, b, armB), wanted);
        BodyState stateA;
        BodyState stateB;
        applyImpulse(stateA, a, -impulse, armA);
        applyImpulse(stateB, b, impulse, armB);
        const Vec2 got = velocityAt(stateB, armB) - velocityAt(stateA, armA);
        // Condition of the matrix: at most 1 + I⁻¹·r²/m⁻¹ ≤ 1 + 8 · 2 / 2⁻⁴ for each body.
        ASSERT_LE(length(got - wanted), 600 * 8 * kEpsilon) << "seed " << seed;
    }
    EXPECT_EQ(solve(pointMatrix({}, {1, 2}, {}, {3, 4}), {1, 1}), Vec2{}) << "neither body can move";
}

}  // namespace
}  // namespace swept::test

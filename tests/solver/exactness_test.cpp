#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "../support/some_of.h"
#include "batch_fields.h"
#include "random_solve.h"

namespace swept::test {
namespace {

constexpr int kLargestPower = std::numeric_limits<Real>::digits > 24 ? 100 : 10;

Real scaled(Real value, Dimension dimension, const Dimension& powers) {
    return std::ldexp(value,
                      dimension.length * powers.length + dimension.mass * powers.mass + dimension.time * powers.time);
}

std::vector<Real> valuesOf(SolverBatch& batch) {
    std::vector<Real> values;
    visitBatch(batch, [&](Real& value, Dimension) { values.push_back(value); });
    return values;
}

Dimension randomPowers(Random& random) {
    const auto power = [&] { return random.integer(-kLargestPower, kLargestPower); };
    switch (random.integer(0, 3)) {  // one unit alone, or all together
        case 0:
            return {power(), 0, 0};
        case 1:
            return {0, power(), 0};
        case 2:
            return {0, 0, power()};
        default:
            return {power(), power(), power()};
    }
}

TEST(Solver, ScalesExactlyByPowersOfTwo) {
    int bounces = 0;
    int limited = 0;
    int compared = 0;
    for (std::uint64_t seed = 0; seed < someOf(3'000U); ++seed) {
        RandomSolve plain(seed);
        RandomSolve other(seed);
        Random random(~seed);
        const Dimension powers = randomPowers(random);
        visitBatch(other.batch, [&](Real& value, Dimension d) { value = scaled(value, d, powers); });
        other.settings.dt = scaled(other.settings.dt, kTime, powers);
        other.settings.restitutionThreshold = scaled(other.settings.restitutionThreshold, kSpeed, powers);
        other.settings.maxSpeed = scaled(other.settings.maxSpeed, kSpeed, powers);
        std::feclearexcept(FE_UNDERFLOW);
        const SolveReport first = Solver().solve(plain.batch, plain.settings);
        const SolveReport second = Solver().solve(other.batch, other.settings);
        if (std::fetestexcept(FE_UNDERFLOW) != 0) { continue; }
        ++compared;
        ASSERT_EQ(first.bounceRounds, second.bounceRounds) << "seed " << seed;
        ASSERT_EQ(first.speedsLimited, second.speedsLimited) << "seed " << seed;
        visitBatch(plain.batch, [&](Real& value, Dimension d) { value = scaled(value, d, powers); });
        const std::vector<Real> wanted = valuesOf(plain.batch);
        const std::vector<Real> got = valuesOf(other.batch);
        ASSERT_EQ(wanted.size(), got.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            ASSERT_TRUE(isFinite(got[i])) << "seed " << seed << " field " << i;
            ASSERT_EQ(wanted[i], got[i]) << "seed " << seed << " field " << i << ": length 2^" << powers.length
                                         << ", mass 2^" << powers.mass << ", time 2^" << powers.time;
        }
        bounces += first.bounceRounds;
        limited += first.speedsLimited;
    }
    EXPECT_GT(compared, someOf(2'900));
    EXPECT_GT(bounces, someOf(3'000));
    EXPECT_GT(limited, someOf(1'000));
}

TEST(Solver, GivesTheSameBitsTwice) {
    Solver used;
    for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
        RandomSolve first(seed);
        RandomSolve second(seed);
        Solver fresh;
        used.solve(first.batch, first.settings);
        fresh.solve(second.batch, second.settings);
        ASSERT_EQ(bitsOf(first.batch), bitsOf(second.batch)) << "seed " << seed;
    }
}

TEST(Solver, NeverWritesTheFixedWorldNorTheSpeedOfKinematicBodies) {
    int checked = 0;
    for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
        RandomSolve solve(seed);
        const RawVector<BodyState> before = solve.batch.states;
        solve.settings.maxSpeed = std::numeric_limits<Real>::infinity();
        Solver().solve(solve.batch, solve.settings);
        for (std::size_t slot = 0; slot < before.size(); ++slot) {
            if (solve.batch.inertias[slot].inverseMass > 0) { continue; }
            ++checked;
            ASSERT_EQ(solve.batch.states[slot].velocity, before[slot].velocity) << "seed " << seed;
            ASSERT_EQ(solve.batch.states[slot].angularVelocity, before[slot].angularVelocity) << "seed " << seed;
        }
        ASSERT_EQ(solve.batch.states[kFixedSlot].deltaPosition, Vec2{}) << "seed " << seed;
    }
    EXPECT_GT(checked, 1'500);
}

}  // namespace
}  // namespace swept::test

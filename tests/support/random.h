#pragma once

#include <cstdint>

/// Random numbers for tests: the same sequence on every machine, unlike the distributions of the standard library.

namespace swept::test {

/// splitmix64 (Steele, Lea, Flood 2014): every seed, also 0, 1, 2 …, gives an independent sequence.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

    constexpr std::uint64_t bits() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }

    /// In [0, 1), a multiple of 2⁻⁵³.
    constexpr double uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
    /// In [low, high).
    constexpr double range(double low, double high) { return low + (high - low) * uniform(); }
    /// In [low, high], both included; low ≤ high. The bias of the remainder is below (high − low) · 2⁻⁶⁴.
    constexpr int integer(int low, int high) {
        const auto span = static_cast<std::uint64_t>(static_cast<std::int64_t>(high) - low) + 1U;
        return static_cast<int>(low + static_cast<std::int64_t>(bits() % span));
    }
    /// True with the given probability.
    constexpr bool chance(double probability) { return uniform() < probability; }
    constexpr double sign() { return (bits() & 1U) != 0U ? 1.0 : -1.0; }

private:
    std::uint64_t state_;
};

}  // namespace swept::test

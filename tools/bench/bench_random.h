#pragma once

#include <cstdint>

namespace swept::bench {

/// splitmix64 (Steele, Lea, Flood 2014): the same seed, the same numbers, on every machine.
class BenchRandom {
public:
    explicit BenchRandom(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15ULL;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31);
    }
    /// Below `upper`, unless the interval is so narrow that rounding reaches it.
    double in(double lower, double upper) {
        return lower + (upper - lower) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }

private:
    std::uint64_t state_;
};

}  // namespace swept::bench

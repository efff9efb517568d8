#pragma once

#include <cstdint>
#include <random>

namespace swept {

/// Numbers by chance, the same ones for the same seed.
class Chance {
public:
    explicit Chance(std::uint32_t seed) : engine_(seed) {}
    double range(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }

private:
    std::mt19937 engine_;
};

}  // namespace swept

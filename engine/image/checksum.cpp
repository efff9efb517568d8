#include "checksum.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t);
constexpr std::size_t kLanes = 8;  // multiplications that need not wait for each other

std::uint64_t wordAt(const std::uint8_t* bytes, std::size_t count) {
    std::uint64_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&word, bytes, count);
    } else {
        for (std::size_t i = 0; i < count; ++i) { word |= std::uint64_t{bytes[i]} << (8 * i); }
    }
    return word;
}

/// One to one in either of the two.
std::uint64_t mixed(std::uint64_t sum, std::uint64_t word) { return std::rotl(sum ^ word, 29) * 0x9E3779B97F4A7C15U; }

}  // namespace

std::uint64_t checksumOf(std::span<const std::uint8_t> bytes) {
    std::array<std::uint64_t, kLanes> sums{1, 2, 3, 4, 5, 6, 7, 8};
    std::size_t at = 0;
    for (; bytes.size() - at >= kLanes * kWord; at += kLanes * kWord) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            sums[lane] = mixed(sums[lane], wordAt(bytes.data() + at + lane * kWord, kWord));
        }
    }
    std::uint64_t all = bytes.size();
    for (const std::uint64_t sum : sums) { all = mixed(all, sum); }
    for (; at < bytes.size(); at += kWord) {
        const std::size_t left = bytes.size() - at;
        all = mixed(all, wordAt(bytes.data() + at, left < kWord ? left : kWord));
    }
    return all ^ (all >> 32U);
}

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

/// What the fuzz targets share: bytes as choices and numbers, and a demand that is reported wherever the target runs.

namespace swept::test {

using Bytes = std::span<const std::uint8_t>;

/// Throws when a promise is broken: libFuzzer stops there and keeps the input, a replay fails.
inline void demand(bool kept, const char* promise) {
    if (!kept) { throw std::logic_error(promise); }
}

/// Takes choices and numbers from the front; zeros once the bytes are used up. Never twice among the arguments of one
/// call: these have no order, and a corpus must mean the same to every compiler. (In braces they have one.)
class FuzzInput {
public:
    explicit FuzzInput(Bytes bytes) : bytes_(bytes) {}

    bool isOver() const { return bytes_.empty(); }
    std::uint8_t byte() {
        if (bytes_.empty()) { return 0; }
        const std::uint8_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    /// 0 … count − 1.
    int below(int count) { return byte() % count; }
    bool flag() { return (byte() & 1U) != 0; }

    /// Mostly a number that a user would write; sometimes of any size; sometimes any bits at all, NaN included.
    double number() {
        const std::uint8_t kind = byte();
        if (kind < 224) { return short16() / 256.0; }
        if (kind < 248) {
            const double digits = short16();
            return std::ldexp(digits, static_cast<std::int8_t>(byte()));
        }
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) { bits = bits << 8U | byte(); }
        double any = 0;
        std::memcpy(&any, &bits, sizeof any);
        return any;
    }

private:
    std::int16_t short16() {
        const int high = byte();
        return static_cast<std::int16_t>(high << 8 | byte());
    }

    Bytes bytes_;
};

}  // namespace swept::test

#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "../../shapes/bit_cast.h"
#include "../../shapes/real.h"
#include "layout.h"

namespace swept::inline SWEPT_PRECISION {

/// Bytes that `encode` writes of something.
template <class T>
std::size_t encodedSize(const T& value);

template <class T, class Allocator>
std::size_t encodedSize(const std::vector<T, Allocator>& values) {
    std::size_t size = sizeof(std::uint64_t);
    if constexpr (kLayout<T>.isFixed) {
        size += values.size() * kLayout<T>.bytes;
    } else {
        for (const T& value : values) { size += encodedSize(value); }
    }
    return size;
}
template <class T, std::size_t kCount>
std::size_t encodedSize(const std::array<T, kCount>& values) {
    std::size_t size = 0;
    for (const T& value : values) { size += encodedSize(value); }
    return size;
}
template <class... Alternatives>
std::size_t encodedSize(const std::variant<Alternatives...>& value) {
    return 1 + std::visit([](const auto& held) { return encodedSize(held); }, value);
}
template <class T>
std::size_t encodedSize(const T& value) {
    if constexpr (kLayout<T>.isFixed) {
        return kLayout<T>.bytes;
    } else {
        return membersOf(value).giveTo([](const auto&... members) { return (encodedSize(members) + ...); });
    }
}

/// Writes numbers one after the other. @pre there is room for them
class Encoder {
public:
    explicit Encoder(std::uint8_t* at) : at_(at) {}

    template <class T>
    void put(const T& value) {
        if constexpr (Number<T>) {
            putNumber(value);
        } else {
            membersOf(value).giveTo([this](const auto&... members) { (this->put(members), ...); });
        }
    }
    template <class T, std::size_t kCount>
    void put(const std::array<T, kCount>& values) {
        for (const T& value : values) { put(value); }
    }
    template <class T, class Allocator>
    void put(const std::vector<T, Allocator>& values) {
        putNumber(static_cast<std::uint64_t>(values.size()));
        if constexpr (kLayout<T>.isAsInMemory) {
            static_assert(std::is_trivially_copyable_v<T>);
            if (!values.empty()) { putBytes(values.data(), values.size() * sizeof(T)); }
        } else {
            for (const T& value : values) { put(value); }
        }
    }
    template <class T>
    void put(const std::optional<T>& value) {
        putNumber(value.has_value());
        if (value) { return put(*value); }
        std::memset(at_, 0, kLayout<T>.bytes);
        at_ += kLayout<T>.bytes;
    }
    template <class... Alternatives>
    void put(const std::variant<Alternatives...>& value) {
        putNumber(static_cast<std::uint8_t>(value.index()));
        std::visit([this](const auto& held) { this->put(held); }, value);
    }
    template <class T>
    void put(const CopiedAtomic<T>& value) {
        put(value.load(std::memory_order_relaxed));
    }
    template <class T>
    void put(const LeftOut<T>&) {}
    template <class T>
    void put(const FlagsIn<T>& fields) {
        unsigned bits = 0;
        unsigned place = 0;
        for (const bool flag : flagsOf(fields.object)) { bits |= unsigned{flag} << place++; }
        putNumber(static_cast<std::uint16_t>(bits));
    }
    const std::uint8_t* at() const { return at_; }

private:
    template <Number T>
    void putNumber(T value) {
        WrittenAs<T> bits = 0;
        if constexpr (std::is_floating_point_v<T>) {
            bits = bitCast<WrittenAs<T>>(value);
        } else {
            bits = static_cast<WrittenAs<T>>(value);
        }
        if constexpr (std::endian::native == std::endian::little) {
            putBytes(&bits, sizeof bits);
        } else {
            for (std::size_t i = 0; i < sizeof bits; ++i) { *at_++ = static_cast<std::uint8_t>(bits >> (8 * i)); }
        }
    }
    void putBytes(const void* from, std::size_t count) {
        std::memcpy(at_, from, count);
        at_ += count;
    }

    std::uint8_t* at_;
};

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "../../shapes/bit_cast.h"
#include "../../shapes/real.h"
#include "layout.h"

namespace swept::inline SWEPT_PRECISION {

/// Reads what an `Encoder` wrote, and never beyond the end: from there on, and where something cannot be what it is
/// read as, nothing is read any more.
class Decoder {
public:
    explicit Decoder(std::span<const std::uint8_t> bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

    /// Whether all bytes were read, and all made sense.
    bool isDone() const { return at_ == end_ && !isBad_; }

    template <class T>
    void take(T& value) {
        if constexpr (!kLayout<T>.isFixed) {
            membersOf(value).giveTo([this](auto&... members) { (this->take(members), ...); });
        } else if (hasLeft(kLayout<T>.bytes)) {
            takeFixed(value);
        }
    }
    template <class T, std::size_t kCount>
    void take(std::array<T, kCount>& values) {
        for (T& value : values) { take(value); }
    }
    template <class T, class Allocator>
    void take(std::vector<T, Allocator>& values) {
        static_assert(kLayout<T>.bytes > 0);
        std::uint64_t count = 0;
        take(count);
        if (isBad_ || count > static_cast<std::uint64_t>(end_ - at_) / kLayout<T>.bytes) { return stop(); }
        values.resize(static_cast<std::size_t>(count));
        if constexpr (kLayout<T>.isAsInMemory) {
            static_assert(std::is_trivially_copyable_v<T>);
            if (!values.empty()) { takeBytes(values.data(), values.size() * sizeof(T)); }
        } else if constexpr (kLayout<T>.isFixed) {
            for (T& value : values) { takeFixed(value); }
        } else {
            for (T& value : values) { take(value); }
        }
    }
    template <class... Alternatives>
    void take(std::variant<Alternatives...>& value) {
        std::uint8_t index = 0;
        take(index);
        if (isBad_ || index >= sizeof...(Alternatives)) { return stop(); }
        takeAlternative(value, index, std::index_sequence_for<Alternatives...>());
    }

private:
    void stop() {
        isBad_ = true;
        at_ = end_;
    }
    bool hasLeft(std::size_t count) {
        const bool has = static_cast<std::size_t>(end_ - at_) >= count;
        if (!has) { stop(); }
        return has;
    }
    template <class Variant, std::size_t... kPlaces>
    void takeAlternative(Variant& value, std::size_t index, std::index_sequence<kPlaces...>) {
        ((index == kPlaces ? take(value.template emplace<kPlaces>()) : void()), ...);
    }

    // --- @pre there is as much left as they take
    template <class T>
    void takeFixed(T& value) {
        if constexpr (Number<T>) {
            takeNumber(value);
        } else {
            membersOf(value).giveTo([this](auto&... members) { (this->takeFixed(members), ...); });
        }
    }
    template <class T, std::size_t kCount>
    void takeFixed(std::array<T, kCount>& values) {
        for (T& value : values) { takeFixed(value); }
    }
    template <class T>
    void takeFixed(std::optional<T>& value) {
        bool isThere = false;
        takeNumber(isThere);
        if (isThere) { return takeFixed(value.emplace()); }
        value.reset();
        at_ += kLayout<T>.bytes;
    }
    template <class T>
    void takeFixed(CopiedAtomic<T>& value) {
        T number{};
        takeNumber(number);
        value.store(number, std::memory_order_relaxed);
    }
    template <class T>
    void takeFixed(LeftOut<T>&) {}
    template <class T>
    void takeFixed(FlagsIn<T>& fields) {
        std::uint16_t bits = 0;
        takeNumber(bits);
        auto flags = flagsOf(fields.object);
        unsigned place = 0;
        for (bool& flag : flags) { flag = ((bits >> place++) & 1U) != 0; }
        setFlags(fields.object, flags);
    }
    template <Number T>
    void takeNumber(T& value) {
        WrittenAs<T> bits = 0;
        if constexpr (std::endian::native == std::endian::little) {
            takeBytes(&bits, sizeof bits);
        } else {
            for (std::size_t i = 0; i < sizeof bits; ++i) {
                bits = static_cast<WrittenAs<T>>(bits | static_cast<WrittenAs<T>>(*at_++) << (8 * i));
            }
        }
        if constexpr (std::is_floating_point_v<T>) {
            value = bitCast<T>(bits);
        } else if constexpr (std::is_same_v<T, bool>) {
            isBad_ = isBad_ || bits > 1;
            value = bits != 0;
        } else {
            value = static_cast<T>(bits);
        }
    }
    void takeBytes(void* to, std::size_t count) {
        std::memcpy(to, at_, count);
        at_ += count;
    }

    const std::uint8_t* at_;
    const std::uint8_t* end_;
    bool isBad_ = false;
};

}  // namespace swept::inline SWEPT_PRECISION

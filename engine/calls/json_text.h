#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "../../shapes/dvec2.h"
#include "../../shapes/vec2.h"

/// Writes JSON. (The libraries depend on nothing that could do so.)

namespace swept::inline SWEPT_PRECISION {

/// No number of a scene may be larger (samples/scene_reader.h).
inline constexpr double kLargestInScene = 3e38;

/// The shortest digits that give the same number again, whatever the locale; up to a million without an exponent. What
/// is larger than a scene may have becomes the largest that it may have. @pre no NaN
template <class Number>
requires std::is_floating_point_v<Number>
void appendJson(std::string& text, Number number) {
    constexpr std::size_t kLongest = 64;  // 17 digits, sign, exponent and what a locale has between digits
    constexpr double kMostPlain = 1e6;
    char digits[kLongest];
    const double value = std::clamp(static_cast<double>(number), -kLargestInScene, kLargestInScene);
    const bool isPlain = std::fabs(value) < kMostPlain;
    // What has fewer digits than any decimal that a number holds is found by the first: its zeros are left out.
    for (int count = std::numeric_limits<Number>::digits10; count <= std::numeric_limits<Number>::max_digits10;
         ++count) {
        (void)std::snprintf(digits, kLongest, "%.*g", count, value);
        const bool isShort = !isPlain || std::strstr(digits, "e+") == nullptr;
        if (isShort && static_cast<Number>(std::strtod(digits, nullptr)) == static_cast<Number>(value)) { break; }
    }
    bool hasPoint = false;
    for (const char* c = digits; *c != '\0'; ++c) {
        if ((*c >= '0' && *c <= '9') || *c == '-' || *c == '+' || *c == 'e') {
            text += *c;
        } else if (!hasPoint) {  // as the locale writes it
            text += '.';
            hasPoint = true;
        }
    }
}
template <class Number>
requires(std::is_integral_v<Number> && !std::is_same_v<Number, bool>) void appendJson(std::string& text,
                                                                                      Number number) {
    text += std::to_string(number);
}
inline void appendJson(std::string& text, bool value) { text += value ? "true" : "false"; }
inline void appendJson(std::string& text, std::string_view value) {
    text += '"';
    for (const char c : value) {
        if (c == '"' || c == '\\') {
            text += '\\';
            text += c;
        } else if (static_cast<unsigned char>(c) < 0x20U) {
            char code[8];
            (void)std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
            text += code;
        } else {
            text += c;
        }
    }
    text += '"';
}
inline void appendJson(std::string& text, const char* value) { appendJson(text, std::string_view(value)); }
template <class Vector>
requires requires(const Vector& v) {
    v.x;
    v.y;
}
void appendJson(std::string& text, const Vector& v) {
    text += '[';
    appendJson(text, v.x);
    text += ", ";
    appendJson(text, v.y);
    text += ']';
}
template <class Vector>
void appendJson(std::string& text, std::span<const Vector> points) {
    text += '[';
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) { text += ", "; }
        appendJson(text, points[i]);
    }
    text += ']';
}

/// An object, member by member.
class JsonObject {
public:
    explicit JsonObject(std::string& text) : text_(text) { text_ += '{'; }
    void close() { text_ += '}'; }

    template <class Value>
    void add(const char* key, const Value& value) {
        appendJson(begin(key), value);
    }
    /// Unless the reader of the format takes it to be so anyway.
    template <class Value>
    void addUnless(const char* key, const Value& value, const Value& usual) {
        if (!(value == usual)) { add(key, value); }
    }
    /// For a value that is written by others. @param space  before it, if it is not the first member @return where
    std::string& begin(const char* key, const char* space = " ") {
        if (!isFirst_) {
            text_ += ',';
            text_ += space;
        }
        isFirst_ = false;
        appendJson(text_, key);
        text_ += ": ";
        return text_;
    }

private:
    std::string& text_;
    bool isFirst_ = true;
};

}  // namespace swept::inline SWEPT_PRECISION

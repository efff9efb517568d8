#include "number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace swept {
namespace {

// The longest shortest form is "-2.2250738585072014e-308": 24 characters.
constexpr std::size_t kLongestNumber = 32;

}  // namespace

void appendNumber(std::string& text, double value) {
    std::array<char, kLongestNumber> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(digits.data(), result.ptr);
}

void appendJsonNumber(std::string& text, double value) {
    if (std::isfinite(value)) {
        appendNumber(text, value);
    } else {
        text += "null";
    }
}

std::string roundedText(double value, int digits) {
    std::array<char, kLongestNumber> characters{};
    const auto result = std::to_chars(characters.data(), characters.data() + characters.size(), value,
                                      std::chars_format::general, digits);
    return std::string(characters.data(), result.ptr);
}

std::string roundedDownText(double value, int digits) {
    std::string text = roundedText(value, digits);
    if (!(std::strtod(text.c_str(), nullptr) > value)) { return text; }
    // One less in the last of the digits is below the value, as rounding up adds less than that.
    const double unit = std::pow(10, std::floor(std::log10(value)) - digits + 1);
    return roundedText(value - 0.75 * unit, digits);
}

std::string countText(std::int64_t count, const std::string& noun) {
    return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

}  // namespace swept

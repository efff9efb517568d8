#include "plain_letters.h"

#include <algorithm>
#include <array>

namespace swept {
namespace {

/// À … ſ (U+00C0 … U+017F), in the order of Unicode, one blank between. What the font has stands for itself, as "*".
constexpr std::string_view kLatin =
    "A A A A A A AE C E E E E I I I I D N O O O O O * O U U U U Y Th ss "
    "a a a a a a ae c e e e e i i i i d n o o o o o / o u u u u y th y "
    "A a A a A a C c C c C c C c D d D d E e E e E e E e E e G g G g G g G g H h H h "
    "I i I i I i I i I i IJ ij J j K k q L l L l L l L l L l N n N n N n n N n "
    "O o O o O o OE oe R r R r R r S s S s S s S s T t T t T t U u U u U u U u U u U u "
    "W w Y y Y Z z Z z Z z s";
constexpr char32_t kFirstLatin = 0xC0;
constexpr char32_t kLastLatin = 0x17F;

constexpr auto kLatinLetters = [] {
    std::array<std::string_view, kLastLatin - kFirstLatin + 1> letters{};
    std::size_t start = 0;
    for (std::string_view& letter : letters) {
        const std::size_t end = std::min(kLatin.find(' ', start), kLatin.size());
        letter = kLatin.substr(start, end - start);
        start = end + 1;
    }
    return letters;
}();
static_assert(kLatinLetters[0xFC - kFirstLatin] == "u" && kLatinLetters[0xD7 - kFirstLatin] == "*");
static_assert(kLatinLetters[0x153 - kFirstLatin] == "oe" && kLatinLetters.back() == "s");

/// "*": the letter itself.
std::string_view plain(char32_t letter) {
    if (letter >= kFirstLatin && letter <= kLastLatin) { return kLatinLetters[letter - kFirstLatin]; }
    if (letter >= 0x300 && letter <= 0x36F) { return ""; }  // accents of the letter before
    switch (letter) {
        case 0xA0:
            return " ";
        case 0x2018:
        case 0x2019:
            return "'";
        case 0x201C:
        case 0x201D:
        case 0x201E:
            return "\"";
        case 0x2026:
            return "...";
        case 0x2212:
            return "-";
        default:
            return "*";
    }
}

std::u32string decoded(std::string_view text) {
    std::u32string letters;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            letters.push_back(byte);
        } else if (byte < 0xC0 && !letters.empty()) {
            letters.back() = letters.back() << 6 | (byte & 0x3Fu);
        } else {
            letters.push_back(byte < 0xE0 ? byte & 0x1Fu : byte < 0xF0 ? byte & 0x0Fu : byte & 0x07u);
        }
    }
    return letters;
}

}  // namespace

std::u32string plainLetters(std::string_view text) {
    std::u32string letters;
    for (const char32_t letter : decoded(text)) {
        const std::string_view replaced = plain(letter);
        if (replaced == "*") {
            letters.push_back(letter);
        } else {
            letters.append(replaced.begin(), replaced.end());
        }
    }
    return letters;
}

}  // namespace swept

#include "scene_places.h"

#include <cstddef>
#include <set>
#include <utility>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bytes of the character that begins with this one; 0: none does.
std::size_t lengthOfCharacter(unsigned char first) {
    if (first < 0x80U) { return 1; }
    if (first >= 0xC2U && first < 0xE0U) { return 2; }
    if (first >= 0xE0U && first < 0xF0U) { return 3; }
    return first >= 0xF0U && first < 0xF5U ? 4 : 0;
}

/// Whether it is what the standard calls well-formed (Unicode 15, table 3-7).
bool isCharacter(const std::string& text, std::size_t begin, std::size_t length) {
    if (length == 0 || begin + length > text.size()) { return false; }
    const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(text[begin + i]); };
    for (std::size_t i = 1; i < length; ++i) {
        if ((byteAt(i) & 0xC0U) != 0x80U) { return false; }
    }
    if (length < 3) { return true; }
    const unsigned first = byteAt(0);
    const unsigned second = byteAt(1);
    const bool isShort = (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
    const bool isHalf = first == 0xEDU && second >= 0xA0U;  // of a pair of UTF-16
    const bool isBeyond = first == 0xF4U && second >= 0x90U;
    return !isShort && !isHalf && !isBeyond;
}

std::string wellFormed(const std::string& text) {
    std::string good;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = lengthOfCharacter(static_cast<unsigned char>(text[i]));
        if (isCharacter(text, i, length)) {
            good.append(text, i, length);
            i += length;
        } else {
            good += '?';
            ++i;
        }
    }
    return good;
}

}  // namespace

SceneWords::SceneWords(const char* usual, std::vector<std::string> given) : usual_(usual), given_(std::move(given)) {
    std::set<std::string> taken;
    for (std::size_t i = 0; i < given_.size(); ++i) {
        if (given_[i].empty()) { taken.insert(usual_ + std::to_string(i)); }
    }
    for (std::string& name : given_) {
        if (name.empty()) { continue; }
        name = wellFormed(name);
        const std::string first = name;
        for (int count = 2; !taken.insert(name).second; ++count) { name = first + ' ' + std::to_string(count); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION

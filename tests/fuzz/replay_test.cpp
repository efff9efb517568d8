#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "../support/random.h"
#include "fuzz_targets.h"

/// Everything that the fuzzers found worth keeping, and every input that once broke a promise, again; then damaged
/// copies.

namespace swept::test {
namespace {

std::vector<std::filesystem::path> inputsOf(const std::string& target) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SWEPT_FUZZ_CORPUS) / target)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::uint8_t> contentOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(stream), {}};
    return {text.begin(), text.end()};
}

void replay(const std::string& target, void (*fuzz)(Bytes)) {
    const auto files = inputsOf(target);
    ASSERT_GT(files.size(), 10u);
    for (const auto& file : files) { EXPECT_NO_THROW(fuzz(contentOf(file))) << file.filename(); }
}

/// A few bytes changed, dropped or doubled; in one of four a piece of another input put in.
std::vector<std::uint8_t> damaged(std::vector<std::uint8_t> bytes, const std::vector<std::uint8_t>& other,
                                  Random& random) {
    const auto placeIn = [&random](const auto& list) { return random.integer(0, static_cast<int>(list.size())); };
    for (int i = random.integer(1, 4); i > 0; --i) {
        const auto at = bytes.begin() + placeIn(bytes);
        const auto end = at + std::min<std::ptrdiff_t>(random.integer(1, 8), bytes.end() - at);
        switch (random.integer(0, 3)) {
            case 0:
                bytes.erase(at, end);
                break;
            case 1:
                bytes.insert(at, static_cast<std::uint8_t>(random.integer(0, 255)));
                break;
            case 2:
                if (at != bytes.end()) { *at = static_cast<std::uint8_t>(random.integer(0, 255)); }
                break;
            default: {
                const auto from = other.begin() + placeIn(other);
                const auto to = from + std::min<std::ptrdiff_t>(random.integer(1, 40), other.end() - from);
                bytes.insert(at, from, to);
            }
        }
    }
    return bytes;
}

/// Digits for digits: the text stays well formed and means something else. One of five is damaged as above.
std::vector<std::uint8_t> damagedText(std::vector<std::uint8_t> text, const std::vector<std::uint8_t>& other,
                                      Random& random) {
    if (random.chance(0.2)) { return damaged(text, other, random); }
    const auto isDigit = [](std::uint8_t c) { return c >= '0' && c <= '9'; };
    for (int i = random.integer(1, 4); i > 0; --i) {
        const auto from = text.begin() + random.integer(0, static_cast<int>(text.size()));
        const auto digit = std::find_if(from, text.end(), isDigit);
        if (digit != text.end()) { *digit = static_cast<std::uint8_t>(random.integer('0', '9')); }
    }
    return text;
}

using Damage = std::vector<std::uint8_t> (*)(std::vector<std::uint8_t>, const std::vector<std::uint8_t>&, Random&);

/// @param extension  of the inputs to start from; empty: all.
void damage(const std::string& target, const std::string& extension, Damage how, void (*fuzz)(Bytes)) {
    std::vector<std::vector<std::uint8_t>> inputs;
    for (const auto& file : inputsOf(target)) {
        if (extension.empty() || file.extension() == extension) { inputs.push_back(contentOf(file)); }
    }
    const int last = static_cast<int>(inputs.size()) - 1;
    for (std::uint64_t seed = 0; seed < SWEPT_FUZZ_ROUNDS; ++seed) {
        Random random(seed);
        const auto& first = inputs[static_cast<std::size_t>(random.integer(0, last))];
        const auto& second = inputs[static_cast<std::size_t>(random.integer(0, last))];
        ASSERT_NO_THROW(fuzz(how(first, second, random))) << "seed " << seed;
    }
}

TEST(FuzzReplay, Scenes) { replay("scene", fuzzScene); }
TEST(FuzzReplay, Hulls) { replay("hull", fuzzHull); }
TEST(FuzzReplay, TimesOfImpact) { replay("toi", fuzzToi); }
TEST(FuzzReplay, Worlds) { replay("world", fuzzWorld); }

TEST(FuzzDamaged, Scenes) { damage("scene", ".json", damagedText, fuzzScene); }
TEST(FuzzDamaged, Hulls) { damage("hull", "", damaged, fuzzHull); }
TEST(FuzzDamaged, TimesOfImpact) { damage("toi", "", damaged, fuzzToi); }
TEST(FuzzDamaged, Worlds) { damage("world", "", damaged, fuzzWorld); }

}  // namespace
}  // namespace swept::test

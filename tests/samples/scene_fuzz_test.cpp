#include <gtest/gtest.h>
#include <swept/samples/scene_reader.h>

#include "../support/some_of.h"
#include "random_scene.h"

/// Damaged scenes: whatever happens to the text, the answer is a scene that validates or an error that says where.

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SWEPT_TEST_SANITIZED
#endif
#endif

namespace swept {
namespace {

#if defined(SWEPT_TEST_SANITIZED)
constexpr std::uint64_t kDamaged = 4'000;  // a millisecond each
#else
constexpr std::uint64_t kDamaged = 20'000;
#endif

// What a hasty editor does to a file: characters change, vanish, double; words move to where they do not belong.
std::string damaged(std::string text, test::Random& random) {
    static const std::vector<std::string> kSnippets{"{",
                                                    "}",
                                                    "[",
                                                    "]",
                                                    ",",
                                                    ":",
                                                    "\"",
                                                    "-",
                                                    "1e999",
                                                    "1e39",
                                                    "-1",
                                                    "0",
                                                    "null",
                                                    "true",
                                                    "\"x\"",
                                                    "\\u0000",
                                                    "\xff",
                                                    "\"type\": ",
                                                    "\"radius\": 1, ",
                                                    "\"dynamic\"",
                                                    "\"chain\"",
                                                    "[[0, 0], [0, 0]]",
                                                    "1e-320",
                                                    "4294967296",
                                                    "{}"};
    const int count = random.integer(1, 3);
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size())));
        switch (random.integer(0, 4)) {
            case 0:
                text.insert(at, kSnippets[static_cast<std::size_t>(random.integer(0, 24))]);
                break;
            case 1:
                text.erase(at, static_cast<std::size_t>(random.integer(1, 12)));
                break;
            case 2:
                text.insert(at, text.substr(at, static_cast<std::size_t>(random.integer(1, 30))));
                break;
            case 3:
                if (at < text.size()) { text[at] = static_cast<char>(random.integer(0, 255)); }
                break;
            default: {  // a digit elsewhere in a number keeps the syntax and changes the meaning
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit != std::string::npos) { text[digit] = static_cast<char>('0' + random.integer(0, 9)); }
            }
        }
    }
    return text;
}

TEST(SceneFuzz, DamagedTextGivesASceneOrAnErrorWithAPlace) {
    std::uint64_t scenes = 0;
    std::uint64_t syntaxErrors = 0;
    std::uint64_t pointers = 0;
    std::string whole;
    for (std::uint64_t seed = 0; seed < kDamaged; ++seed) {
        test::Random random(seed);
        if (seed % 20 == 0) { whole = writeScene(test::SceneMaker(seed).make()); }
        const std::string text = damaged(whole, random);
        const SceneResult result = readScene(text, "fuzz");
        if (result.scene) {
            ++scenes;
            ASSERT_FALSE(validateScene(*result.scene).has_value()) << "seed " << seed;
            const SceneResult again = readScene(writeScene(*result.scene), "again");
            ASSERT_TRUE(again.scene.has_value()) << "seed " << seed << ": " << again.error.text();
            ASSERT_TRUE(*again.scene == *result.scene) << "seed " << seed;
            continue;
        }
        const std::string& where = result.error.pointer;
        const bool isLine = where.rfind("line ", 0) == 0 && where.find(", column ") != std::string::npos;
        ASSERT_TRUE(isLine || where.empty() || where.rfind("/", 0) == 0)
            << "seed " << seed << ": " << result.error.text();
        ASSERT_FALSE(result.error.reason.empty()) << "seed " << seed;
        (isLine ? syntaxErrors : pointers) += 1;
    }
    EXPECT_GT(scenes, kDamaged / 10);
    EXPECT_GT(syntaxErrors, kDamaged / 4);
    EXPECT_GT(pointers, kDamaged / 20);
}

// A file that was cut off is always a syntax error, never a smaller scene.
TEST(SceneFuzz, EveryPrefixIsRefused) {
    for (std::uint64_t seed = 0; seed < test::someOf(50U); ++seed) {
        const std::string text = writeScene(test::SceneMaker(seed).make());
        for (std::size_t length = 0; length + 2 < text.size(); length += 29) {
            const SceneResult result = readScene(std::string_view(text).substr(0, length), "prefix");
            ASSERT_FALSE(result.scene.has_value()) << "seed " << seed << ", " << length << " characters";
            ASSERT_EQ(result.error.pointer.rfind("line ", 0), 0u) << result.error.text();
        }
    }
}

}  // namespace
}  // namespace swept

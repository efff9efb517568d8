#include "declared_names.h"

#include <gtest/gtest.h>

#include "code_scanner.h"

namespace swept::house {
namespace {

using Names = std::set<std::string, std::less<>>;

DeclaredNames declaredBy(const char* text) {
    const std::string code = codeOnly(text);
    return declaredIn(tokensOf(code));
}

TEST(DeclaredNames, TokensAreWordsAndMarks) {
    const std::vector<std::string_view> expected = {"a", "::", "b1", "->", "c", "(", "-", "2", ")", ">", "=", "0"};
    EXPECT_EQ(tokensOf("a::b1->c\n(-2) >= 0"), expected);
}

TEST(DeclaredNames, OfNamespaces) {
    const DeclaredNames names = declaredBy(
        "namespace swept::inline P {\n"
        "struct Later;\n"
        "struct alignas(kLine) Wide : Base { int inner; void member(); };\n"
        "template <class T>\n"
        "class [[nodiscard]] Result {};\n"
        "enum class Kind : char { one, two };\n"
        "template <class T, class U = A<int>>\n"
        "using Pair = std::pair<T, U>;\n"
        "template <class T> concept Small = sizeof(T) < 8;\n"
        "inline constexpr int kTable[] = {1, 2};\n"
        "constexpr Real kHalf = half(1);\n"
        "template <class T>\n"
        "T larger(T a, T b) { return local(a); }\n"
        "std::vector<int> listOf(int count);\n"
        "int Wide::defined() { return 0; }\n"
        "bool operator==(Wide, Wide);\n"
        "static_assert(isTrue());\n"
        "}\n");
    EXPECT_EQ(names.things, (Names{"Later", "Wide", "Kind", "Pair", "Result", "Small", "kTable", "kHalf"}));
    EXPECT_EQ(names.functions, (Names{"larger", "listOf"}));
}

TEST(DeclaredNames, Anywhere) {
    const DeclaredNames names = declaredBy(
        "class A {\n"
        "    enum Inner { x };\n"
        "    void member();\n"
        "    B& other(int a) { return free(a) + a * product(2) + sum & mask(3); }\n"
        "    std::optional<C> maybe{};\n"
        "};\n");
    for (const char* const name : {"A", "Inner", "member", "other", "maybe"}) {
        EXPECT_EQ(names.anywhere.count(name), 1U) << name;
    }
    for (const char* const name : {"free", "product", "mask", "B", "C"}) {
        EXPECT_EQ(names.anywhere.count(name), 0U) << name;
    }
}

}  // namespace
}  // namespace swept::house

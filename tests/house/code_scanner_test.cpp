#include "code_scanner.h"

#include <gtest/gtest.h>

namespace swept::house {
namespace {

TEST(CodeScanner, BlanksWhatIsNotCode) {
    EXPECT_EQ(codeOnly("a // {\nb"), "a     \nb");
    EXPECT_EQ(codeOnly("a /* {\n} */ b"), "a     \n     b");
    EXPECT_EQ(codeOnly("f(\"{\\\"{\", '{', 1'000)"), "f(\"    \", ' ', 1'000)");
    EXPECT_EQ(codeOnly("R\"x(a)\" {)x\";{"), "R           ;{");
    EXPECT_EQ(codeOnly("#define A { \\\n {\nb"), "             \n  \nb");
}

TEST(CodeScanner, FindsFunctionsAndTheirLength) {
    const char* const text =
        "namespace a {\n"                                   // 1
        "struct S : B<decltype(x)> {\n"                     // 2
        "    explicit S(int v) : x{v}, y_{f(v)}, z(3) {\n"  // 3
        "        if (v) { g([](int) { return 1; }); }\n"    // 4
        "    }\n"                                           // 5
        "    int x{3};\n"                                   // 6
        "    bool operator==(const S&) const = default;\n"  // 7
        "public:\n"                                         // 8
        "    S() = default;\n"                              // 9
        "};\n"                                              // 10
        "template <class T, class U = int>\n"               // 11
        "    requires(sizeof(T) > 1)\n"                     // 12
        "auto f(T t = {1, 2})\n"                            // 13
        "    -> std::vector<T> {\n"                         // 14
        "    return {};\n"                                  // 15
        "}\n"                                               // 16
        "enum class E : char { a, b };\n"                   // 17
        "constexpr int kTable[] = {1, 2};\n"                // 18
        "INSTANTIATE(X, [](int) { return 1; });\n"          // 19
        "TEST(A, B) {\n"                                    // 20
        "}\n"                                               // 21
        "}  // namespace\n";                                // 22
    const std::vector<FunctionSpan> found = functionsIn(text);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].firstLine, 3);
    EXPECT_EQ(found[0].lastLine, 5);
    EXPECT_EQ(found[1].firstLine, 11);
    EXPECT_EQ(found[1].lastLine, 16);
    EXPECT_EQ(found[2].head, "TEST(A, B)");
    EXPECT_EQ(found[2].lines(), 2);
}

TEST(CodeScanner, MeasuresALongFunction) {
    std::string text = "int f(int a) {\n";
    for (int i = 0; i < 99; ++i) { text += "    a += 1;  // }\n"; }
    text += "}\n";
    ASSERT_EQ(functionsIn(text).size(), 1U);
    EXPECT_EQ(functionsIn(text)[0].lines(), 101);
}

TEST(CodeScanner, FindsIncludes) {
    const std::vector<Include> found = includesIn(
        "#include <vector>\n// #include <no>\n  #  include \"../a/b.h\"  // why\n/*\n#include <no>\n*/\nauto s = "
        "\"#include <no>\";\n");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].target, "vector");
    EXPECT_FALSE(found[0].quoted);
    EXPECT_EQ(found[1].target, "../a/b.h");
    EXPECT_TRUE(found[1].quoted);
    EXPECT_EQ(found[1].line, 3);
}

TEST(CodeScanner, CountsLines) {
    EXPECT_EQ(lineCount(""), 0);
    EXPECT_EQ(lineCount("a"), 1);
    EXPECT_EQ(lineCount("a\n"), 1);
    EXPECT_EQ(lineCount("a\nb"), 2);
}

}  // namespace
}  // namespace swept::house

#include <gtest/gtest.h>
#include <swept/samples/json_strict.h>
#include <swept/samples/scene_names.h>

#include <array>
#include <limits>

namespace swept {
namespace {

TEST(StrictJson, KeepsOrderAndValues) {
    const JsonResult result = parseStrict(R"({"b": [1, -2, 2.5, true, null], "a": {"ä": "\u00e4"}})");
    ASSERT_FALSE(result.error.has_value());
    EXPECT_EQ(result.value.begin().key(), "b");
    EXPECT_EQ(result.value["b"].size(), 5u);
    EXPECT_EQ(result.value["b"][1].get<int>(), -2);
    EXPECT_EQ(result.value["b"][2].get<double>(), 2.5);
    EXPECT_EQ(result.value["a"]["ä"].get<std::string>(), "ä");
}

TEST(StrictJson, AcceptsAnyValueAndAByteOrderMark) {
    EXPECT_EQ(parseStrict(" 3 ").value.get<int>(), 3);
    EXPECT_EQ(parseStrict("\"x\"").value.get<std::string>(), "x");
    EXPECT_TRUE(parseStrict("\xef\xbb\xbf{}").value.is_object());
}

TEST(StrictJson, TheSameKeyMayOccurInDifferentObjects) {
    EXPECT_FALSE(parseStrict(R"([{"a": 1}, {"a": {"a": [{"a": 2}]}}])").error.has_value());
}

TEST(StrictJson, PlacesOfErrors) {
    const JsonResult twice = parseStrict(R"([0, {"x": [1, {"y": 1, "y": 2}]}])");
    ASSERT_TRUE(twice.error.has_value());
    EXPECT_EQ(twice.error->where, "/1/x/1/y");
    const JsonResult overflow = parseStrict(R"({"x": [1, [], {}, 2e308]})");
    ASSERT_TRUE(overflow.error.has_value());
    EXPECT_EQ(overflow.error->where, "/x/3");
    const JsonResult inNested = parseStrict(R"([[1], [2, -1e400]])");
    ASSERT_TRUE(inNested.error.has_value());
    EXPECT_EQ(inNested.error->where, "/1/1");
}

TEST(StrictJson, Depth) {
    EXPECT_FALSE(parseStrict(std::string(64, '[') + std::string(64, ']')).error.has_value());
    EXPECT_TRUE(parseStrict(std::string(65, '[') + std::string(65, ']')).error.has_value());
    EXPECT_TRUE(parseStrict(std::string(1'000'000, '[')).error.has_value());
}

TEST(StrictJson, NamesCommonMistakes) {
    struct Case {
        const char* text;
        const char* where;
        const char* reason;
    };
    for (const Case& c :
         {Case{"[1, 2,]", "line 1, column 6", "a trailing comma: nothing follows it before ]"},
          Case{"{\"a\": 1,\n }", "line 1, column 8", "a trailing comma: nothing follows it before }"},
          Case{"[1 2]", "line 1, column 4", "a comma is missing before 2"},
          Case{"[[1]\n [2]]", "line 2, column 2", "a comma is missing before ["},
          Case{"[{} {}]", "line 1, column 5", "a comma is missing before {"},
          Case{"[true false]", "line 1, column 7", "a comma is missing before false"},
          Case{"{\"a\": 1 \"b c\": 2}", "line 1, column 9", "a comma is missing before \"b c\""},
          Case{"{\"a\": {}\n\"\\\"\": 2}", "line 2, column 1", "a comma is missing before \"\\\"\""},
          Case{"{'a': 1}", "line 1, column 2", "strings have double quotes, not single ones"},
          Case{"[1, // one\n 2]", "line 1, column 5", "JSON has no comments"},
          Case{"[1 /* one */]", "line 1, column 4", "JSON has no comments"},
          Case{"[1//2\n]", "line 1, column 3", "JSON has no comments"},
          Case{"{\"dt\": 1/64}", "line 1, column 8", "JSON has no fractions: 0.015625"},
          Case{"{\"dt\": 1/60}", "line 1, column 8", "JSON has no fractions: 0.016666666666666666"},
          Case{"[0,\n -1.5 / 2e1 ]", "line 2, column 2", "JSON has no fractions: -0.075"},
          Case{"1/8", "line 1, column 1", "JSON has no fractions: 0.125"},
          Case{"[1/0]", "line 1, column 2", "JSON has no fractions"},
          Case{"[1/2/3]", "line 1, column 2", "JSON has no fractions"},
          Case{"[\"a\"\"b\"]", "line 1, column 5", "a comma is missing before \"b\""},
          Case{"[[1]2]", "line 1, column 5", "a comma is missing before 2"},
          Case{"[1 -2.5e3]", "line 1, column 4", "a comma is missing before -2.5e3"},
          Case{"{\"a\": {\"b\":1} {\"c\":1}}", "line 1, column 15", "a } is missing before {, or a comma and a key"},
          Case{"{\"a\": [1] [2]}", "line 1, column 11", "a } is missing before [, or a comma and a key"},
          Case{"[1, NaN]", "line 1, column 5", "NaN is no JSON number"},
          Case{"{\"a\": nan}", "line 1, column 7", "nan is no JSON number"},
          Case{"[-Infinity]", "line 1, column 2", "-Infinity is no JSON number"},
          Case{"Infinity", "line 1, column 1", "Infinity is no JSON number"}}) {
        const JsonResult result = parseStrict(c.text);
        ASSERT_TRUE(result.error.has_value()) << c.text;
        EXPECT_EQ(result.error->where, c.where) << c.text;
        EXPECT_EQ(result.error->reason, c.reason) << c.text;
    }
    for (const char* const other : {"[]]", "[01]", "nul", "[,]", "}", "[names]", ",", "[1", "{\"a\": 1 2}", "{} {}",
                                    "[1.5.2]", "[1-2]", "[1 2-3]", "[truefalse]", "[\"x\", 1 tru\"a\"]"}) {
        const JsonResult result = parseStrict(other);
        ASSERT_TRUE(result.error.has_value()) << other;
        EXPECT_EQ(result.error->reason.find("no JSON number"), std::string::npos) << other;
        EXPECT_EQ(result.error->reason.find("comma"), std::string::npos) << other;
    }
}

/// What people write for a value may well stand in a string; an error there is the string's.
TEST(StrictJson, MistakesWithinStringsAreTheStrings) {
    for (const char* const text :
         {R"({"name": "it\'s"})", "\"a/\nb\"", "\"1/2\n/3\"", "\"a//\tb\"", "\"a/*\t\"", R"("x\u12/4")", R"("x\u//24")",
          R"("\/\'")", R"("\Infinity")", R"("\nan\inf")", "\"1/2", "[1 \"1-2\n\"]", "[\"a\" \"it\\'s\"]"}) {
        const JsonResult result = parseStrict(text);
        ASSERT_TRUE(result.error.has_value()) << text;
        EXPECT_NE(result.error->reason.find("invalid string"), std::string::npos) << text << '\n'
                                                                                  << result.error->reason;
    }
}

TEST(StrictJson, AnySlashIsNoComment) {
    for (const char* const text : {"[/x]", "[1 /", "/", "[\"5\"/2]", "[true/2]", "[1/x]", "[1/2x]", "[1.5.2/2]"}) {
        const JsonResult result = parseStrict(text);
        ASSERT_TRUE(result.error.has_value()) << text;
        EXPECT_EQ(result.error->reason.find("JSON has no"), std::string::npos) << text << '\n' << result.error->reason;
        EXPECT_EQ(result.error->reason.find("comma"), std::string::npos) << text << '\n' << result.error->reason;
    }
}

TEST(StrictJson, NumbersThatUnderflowAreTold) {
    for (const char* const tiny : {"1e-400", "-0.0012e-330"}) {
        const JsonResult result = parseStrict(std::string("{\"x\": [1, ") + tiny + "]}");
        ASSERT_FALSE(result.error.has_value()) << tiny;
        ASSERT_EQ(result.underflows.size(), 1u) << tiny;
        EXPECT_EQ(result.underflows[0].where, "/x/1");
        EXPECT_EQ(result.underflows[0].number, tiny);
        EXPECT_EQ(result.value["x"][1].get<double>(), 0);
    }
    EXPECT_TRUE(parseStrict("[0.0, -0.0, 0e-400, 5e-324, 0.000e5]").underflows.empty());
}

TEST(StrictJson, LargestNumbers) {
    EXPECT_EQ(parseStrict("1.7976931348623157e308").value.get<double>(), std::numeric_limits<double>::max());
    EXPECT_EQ(parseStrict("18446744073709551616").value.get<double>(), 0x1p64);  // beyond every integer type
}

TEST(StrictJson, ANulByteEndsNothing) {
    for (const char* const text : {"{\"a\": 1}#", "{\"a\": #1}", "1# 2", "#", "{\"a\": \"#\"}"}) {
        std::string nul = text;
        nul.replace(nul.find('#'), 1, 1, '\0');
        const JsonResult result = parseStrict(nul);
        ASSERT_TRUE(result.error.has_value()) << text;
        EXPECT_EQ(result.error->where, "line 1, column " + std::to_string(nul.find('\0') + 1));
        EXPECT_NE(result.error->reason.find("NUL"), std::string::npos) << result.error->reason;
    }
}

TEST(Place, WritesPointers) {
    const Place root;
    const Place list = root.at("a/b");
    const Place element = list.at(7);
    EXPECT_EQ(root.pointer(), "");
    EXPECT_EQ(element.at("c~d").pointer(), "/a~1b/7/c~0d");
}

TEST(NearestName, AllowsForOneThirdOfTheLetters) {
    const std::array<std::string_view, 3> names{"friction", "restitution", "mass"};
    EXPECT_EQ(nearestName("friktion", names), "friction");
    EXPECT_EQ(nearestName("firction", names), "friction");
    EXPECT_EQ(nearestName("RESTITUTION", names), "restitution");
    EXPECT_EQ(nearestName("mas", names), "mass");
    EXPECT_EQ(nearestName("colour", names), "");
    EXPECT_EQ(nearestName("", names), "");
    EXPECT_EQ(nearestName(std::string(100'000, 'x'), names), "");
}

TEST(Quotes, EscapeAndCutBetweenCharacters) {
    EXPECT_EQ(inQuotes("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\"");
    std::string umlauts = "x";
    for (int i = 0; i < 50; ++i) { umlauts += "ä"; }
    EXPECT_EQ(inQuotes(umlauts).substr(58), "ä…\"");  // 59 bytes kept: the 60th is the middle of a character
    EXPECT_EQ(inQuotes(std::string(1000, '\x80')), "\"…\"") << "no character ends there";
    EXPECT_EQ(inQuotes(std::string(10, '\x80')).size(), 12U) << "what is short stays";
}

TEST(ShortestNumber, IsShort) {
    EXPECT_EQ(shortestNumber(0.1), "0.1");
    EXPECT_EQ(shortestNumber(-5), "-5");
    EXPECT_EQ(shortestNumber(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(shortestNumber(-std::numeric_limits<double>::infinity()), "-inf");
}

}  // namespace
}  // namespace swept

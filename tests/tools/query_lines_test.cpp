#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <swept/tools/toi/query_lines.h>

/// One JSON line in, one JSON line out.

namespace swept::test {
namespace {

using Json = nlohmann::ordered_json;

/// The example of the format: a ball of radius ½ falls from 3 to −3 on a segment.
Json example() {
    return Json::parse(R"({"id": 1, "family": "generic",
        "a": {"vertices": [[-1, 0], [1, 0]], "radius": 0,
              "sweep": {"localCenter": [0, 0], "c0": [0, 0], "c1": [0, 0], "a0": 0, "a1": 0}},
        "b": {"vertices": [[0, 0]], "radius": 0.5,
              "sweep": {"localCenter": [0, 0], "c0": [0, 3], "c1": [0, -3], "k": [0, 0], "a0": 0, "a1": 2.5}},
        "tMax": 1, "target": 0.01, "tolerance": 0.001})");
}

Json answerOf(const LineAnswer& answer) { return Json::parse(answer.text); }
Json toiOf(const Json& line) { return answerOf(answerToiLine(line.dump())); }

std::string errorOf(const std::string& line) {
    const LineAnswer answer = answerToiLine(line);
    EXPECT_FALSE(answer.good) << answer.text;
    const Json json = answerOf(answer);
    EXPECT_EQ(json.size(), 2U) << answer.text;
    return json.at("error").get<std::string>();
}

template <class Change>
std::string errorAfter(Change change) {
    Json line = example();
    change(line);
    return errorOf(line.dump());
}

void expectStartsWith(const std::string& text, const std::string& start) {
    EXPECT_EQ(text.substr(0, start.size()), start) << text;
}

TEST(QueryLines, AnswersTheExample) {
    const LineAnswer answer = answerToiLine(example().dump());
    EXPECT_TRUE(answer.good);
    EXPECT_EQ(answer.text.find('\n'), std::string::npos);
    const Json json = answerOf(answer);
    std::string keys;
    for (const auto& [key, value] : json.items()) { keys += key + ' '; }
    EXPECT_EQ(keys,
              "id state t separation normal pointA pointB iterations target tolerance bracket separations features "
              "rootIterations ");
    EXPECT_EQ(json["id"], 1);
    EXPECT_TRUE(json["id"].is_number_integer());
    EXPECT_EQ(json["state"], "hit");
    EXPECT_NEAR(json["t"].get<double>(), (3 - 0.51) / 6, 0.001 / 6);
    EXPECT_NEAR(json["separation"].get<double>(), 0.01, 0.001);
    EXPECT_NEAR(json["normal"][1].get<double>(), 1, 1e-12);
    EXPECT_NEAR(json["pointA"][1].get<double>(), 0, 1e-12);
    EXPECT_NEAR(json["pointB"][1].get<double>(), 0.01, 0.001);
    EXPECT_EQ(json["target"], 0.01);
    EXPECT_EQ(json["tolerance"], 0.001);
}

TEST(QueryLines, FillsInDefaults) {
    Json line = example();
    for (const char* key : {"family", "target", "tolerance"}) { line.erase(key); }
    line["b"]["sweep"].erase("k");
    const Json json = toiOf(line);
    EXPECT_EQ(json["target"], 1.0 / 1024);  // the ball's diameter is the smaller extent
    EXPECT_EQ(json["tolerance"], 0.25 / 1024);
    EXPECT_EQ(json["state"], "hit");
}

TEST(QueryLines, AnswersEveryState) {
    Json line = example();
    line["tMax"] = 0.25;
    Json json = toiOf(line);
    EXPECT_EQ(json["state"], "separated");
    EXPECT_EQ(json["t"], 0.25);
    EXPECT_NEAR(json["separation"].get<double>(), 1.0, 1e-12);
    line["b"]["sweep"]["c0"] = {0.25, 0};
    json = toiOf(line);
    EXPECT_EQ(json["state"], "overlapped");
    EXPECT_EQ(json["t"], 0);
    EXPECT_NEAR(json["separation"].get<double>(), -0.5, 1e-12);
}

TEST(QueryLines, BlamesTheSweepForATolerance) {
    const auto tooFar = [](Json& line) {
        line["a"]["sweep"]["a1"] = 1e15;
        line.erase("tolerance");
    };
    expectStartsWith(errorAfter(tooFar), "/a/sweep, /b/sweep: ");  // no tolerance was given
    const auto given = [&](Json& line) {
        tooFar(line);
        line["tolerance"] = 1e-4;
    };
    expectStartsWith(errorAfter(given), "/tolerance: ");
}

TEST(QueryLines, EchoesTheIdWithItsType) {
    for (const Json& id : {Json(7), Json(-7), Json(1.5), Json("seven \"7\" ü"), Json(nullptr), Json(true),
                           Json(18446744073709551615U)}) {
        Json line = example();
        line["id"] = id;
        EXPECT_EQ(toiOf(line)["id"].dump(), id.dump());
        line["tMax"] = 2;  // also when something is wrong
        EXPECT_EQ(toiOf(line)["id"].dump(), id.dump());
        EXPECT_TRUE(toiOf(line).contains("error"));
    }
    EXPECT_EQ(answerToiLine(R"({"id": 1.0, "oops": 1})").text.substr(0, 9), R"({"id":1.0)");
    EXPECT_EQ(answerOf(answerToiLine(R"({"id": 5, "tMax": 1e999})"))["id"], 5);
    EXPECT_EQ(answerOf(answerToiLine(R"({"id": 5, "tMax": 1, "tMax": 1})"))["id"], 5);
    EXPECT_EQ(answerOf(answerToiLine(R"({"id": 5, "a": )"))["id"], 5);
    EXPECT_TRUE(answerOf(answerToiLine(R"({"a": {"id": 5}})"))["id"].is_null());
    EXPECT_TRUE(answerOf(answerToiLine("nonsense"))["id"].is_null());
}

TEST(QueryLines, EchoesAllDigitsOfTheId) {
    for (const std::string id :
         {"123456789012345678901234567890", "-98765432109876543210", "0.1000000000000000055511151231257827", "1e2",
          "[12345678901234567890123,[],{}]", R"({"a":[1,{"b":"x,]"}],"c":18446744073709551617,"d":null})"}) {
        const std::string line = R"({"id": )" + id + example().dump().substr(std::string(R"({"id":1)").size());
        const LineAnswer answer = answerToiLine(line);
        EXPECT_TRUE(answer.good) << answer.text;
        const std::string start = R"({"id":)" + id + ',';
        EXPECT_EQ(answer.text.substr(0, start.size()), start);
        EXPECT_EQ(answerToiLine(R"({"id": )" + id + R"(, "oops": 1})").text.substr(0, start.size()), start);
    }
    EXPECT_TRUE(answerOf(answerToiLine(R"({"id": [1, 2)"))["id"].is_null()) << "none that is complete";
}

TEST(QueryLines, BlamesNoMemberThatIsNotThere) {
    const auto twoPoints = [](Json& q) {
        q["a"]["vertices"] = {{0, 0}};
        q["b"]["radius"] = 0;
        q.erase("target");
        q.erase("tolerance");
    };
    expectStartsWith(errorAfter(twoPoints), "/tolerance: is missing: ");
    Json line = example();
    twoPoints(line);
    line["target"] = 0.01;
    line["tolerance"] = 0.001;
    EXPECT_EQ(toiOf(line)["state"], "hit");
}

TEST(QueryLines, TellsWhatSinglePrecisionDoesNotHold) {
    Json line = example();
    line["b"]["radius"] = 1e300;
    const LineAnswer answer = answerDistanceLine(line.dump(), Precision::f32);
    EXPECT_EQ(answerOf(answer)["error"], "/b: has numbers too large for f32");
    line = example();
    line["a"]["vertices"] = {{0, 0}, {1e-60, 0}, {0, 1e-60}};
    EXPECT_TRUE(answerDistanceLine(line.dump()).good);
    expectStartsWith(answerOf(answerDistanceLine(line.dump(), Precision::f32))["error"].get<std::string>(),
                     "/a: rounded to f32, it ");
}

TEST(QueryLines, TellsTheRangeOfWhatIsOutOfIt) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {errorAfter([](Json& q) { q["tMax"] = 2; }), "must be greater than 0 and at most 1, not 2"},
        {errorAfter([](Json& q) { q["target"] = -0.75; }), "must be at least -0.5, as the radii of both add up to 0.5"},
        {errorAfter([](Json& q) { q["tolerance"] = 1e-20; }), "double resolves only larger ones"}};
    for (const auto& [error, range] : cases) { EXPECT_NE(error.find(range), std::string::npos) << error; }
}

TEST(QueryLines, NamesWhatIsWrong) {
    expectStartsWith(errorAfter([](Json& q) { q["color"] = 1; }), "/color: ");
    expectStartsWith(errorAfter([](Json& q) { q["a"]["sweep"]["v"] = 1; }), "/a/sweep/v: ");
    expectStartsWith(errorAfter([](Json& q) { q.erase("id"); }), "/id: is missing");
    expectStartsWith(errorAfter([](Json& q) { q.erase("tMax"); }), "/tMax: is missing");
    expectStartsWith(errorAfter([](Json& q) { q["b"].erase("radius"); }), "/b/radius: is missing");
    expectStartsWith(errorAfter([](Json& q) { q["b"] = 3; }), "/b: must be an object, is a number");
    expectStartsWith(errorAfter([](Json& q) { q["b"]["radius"] = "1"; }), "/b/radius: must be a number, is a string");
    expectStartsWith(errorAfter([](Json& q) { q["b"]["radius"] = -1; }), "/b/radius: must not be negative");
    expectStartsWith(errorAfter([](Json& q) { q["a"]["vertices"][1] = {1, 2, 3}; }), "/a/vertices/1: ");
    expectStartsWith(errorAfter([](Json& q) { q["a"]["vertices"][1][0] = nullptr; }), "/a/vertices/1/0: ");
    expectStartsWith(errorAfter([](Json& q) { q["a"]["vertices"] = Json::array(); }), "/a/vertices: ");
    expectStartsWith(errorAfter([](Json& q) { q["a"]["vertices"] = {{0, 0}, {0, 1}, {1, 0}}; }), "/a/vertices: ");
    expectStartsWith(errorAfter([](Json& q) { q["tMax"] = 0; }), "/tMax: must be greater than 0");
    expectStartsWith(errorAfter([](Json& q) { q["tolerance"] = 0; }), "/tolerance: must be greater than 0");
    expectStartsWith(errorAfter([](Json& q) { q["tolerance"] = 1e-20; }), "/tolerance: is out of range");
    expectStartsWith(errorAfter([](Json& q) { q["target"] = -0.6; }), "/target: is out of range");
    expectStartsWith(errorOf("[1]"), "the line must be an object");
    expectStartsWith(errorOf(R"({"id": 1, "id": 2})"), "/id: ");
    expectStartsWith(errorOf(R"({"id": 1, "tMax": 1e999})"), "/tMax: ");
    expectStartsWith(errorOf("1e999"), "the number 1e999 overflows");
    expectStartsWith(errorOf(R"({"id": 1,})"), "line 1, column ");
    expectStartsWith(errorOf(example().dump() + " x"), "line 1, column ");
}

TEST(QueryLines, CastsWithoutRotation) {
    EXPECT_EQ(toiMethodFrom("certified"), ToiMethod::certified);
    EXPECT_EQ(toiMethodFrom("shapeCast"), ToiMethod::shapeCast);
    EXPECT_EQ(toiMethodFrom("magic"), std::nullopt);
    Json line = example();  // a bar that would turn into the ball, which stands still
    line["a"]["sweep"]["a1"] = 1.5;
    line["b"]["sweep"]["c0"] = line["b"]["sweep"]["c1"] = {0, 0.75};
    EXPECT_EQ(toiOf(line)["state"], "hit");
    EXPECT_EQ(answerOf(answerToiLine(line.dump(), ToiMethod::shapeCast))["state"], "separated");
}

TEST(QueryLines, AnswersByEveryMethod) {
    for (const ToiMethodInfo& info : kToiMethods) {
        const std::optional<ToiMethod> method = toiMethodFrom(info.name);
        ASSERT_TRUE(method) << info.name;
        const LineAnswer answer = answerToiLine(example().dump(), *method);
        EXPECT_TRUE(answer.good) << info.name;
        // The ball falls through: all but the last look see it at its surface, on the way.
        const Json json = answerOf(answer);
        const bool tunnels = *method == ToiMethod::discrete;
        EXPECT_EQ(json["state"], tunnels ? "separated" : "hit") << info.name;
        EXPECT_NEAR(json["t"].get<double>(), tunnels ? 1 : (3 - 0.51) / 6, 0.001 / 6) << info.name;
    }
}

TEST(QueryLines, MeasuresDistanceInBothPrecisions) {
    Json line = example();
    line["a"]["sweep"]["c0"] = {1e6 + 0.1, 0};
    line["b"]["sweep"]["c0"] = {1e6 + 0.1, 3};
    for (const Precision precision : {Precision::f32, Precision::f64}) {
        const double error = precision == Precision::f32 ? 1e-6 : 1e-14;
        const LineAnswer answer = answerDistanceLine(line.dump(), precision);
        EXPECT_TRUE(answer.good) << answer.text;
        const Json json = answerOf(answer);
        std::string keys;
        for (const auto& [key, value] : json.items()) { keys += key + ' '; }
        EXPECT_EQ(keys, "id distance normal pointA pointB iterations ");
        EXPECT_NEAR(json["distance"].get<double>(), 2.5, error);
        EXPECT_NEAR(json["normal"][1].get<double>(), 1, error);
        EXPECT_NEAR(json["pointB"][0].get<double>(), 1e6 + 0.1, 1e-9 + error);
    }
    line["b"]["sweep"]["c0"] = {1e6 + 0.1, 0.2};
    EXPECT_NEAR(answerOf(answerDistanceLine(line.dump()))["distance"].get<double>(), -0.3, 1e-9);
    line["a"]["vertices"] = {{0, 0}, {1e30, 0}, {1e30, 1e-30}};  // flat beyond float, not beyond double
    EXPECT_TRUE(answerDistanceLine(line.dump(), Precision::f64).good);
    line["a"]["vertices"] = {{0, 0}, {1e39, 0}};  // beyond the largest float
    EXPECT_TRUE(answerDistanceLine(line.dump(), Precision::f64).good);
    const LineAnswer beyond = answerDistanceLine(line.dump(), Precision::f32);
    EXPECT_FALSE(beyond.good);
    expectStartsWith(answerOf(beyond)["error"].get<std::string>(), "/a: ");
    line["b"]["sweep"]["a1"] = "x";
    EXPECT_FALSE(answerDistanceLine(line.dump()).good);
}

TEST(QueryLines, NumbersReadBackAsTheSameDouble) {
    Json line = example();
    line["target"] = 0.1 + 0.2;
    line["tolerance"] = 1.0 / 3;
    const std::string text = answerToiLine(line.dump()).text;
    EXPECT_NE(text.find("\"target\":0.30000000000000004,"), std::string::npos) << text;
    EXPECT_NE(text.find("\"tolerance\":0.3333333333333333,"), std::string::npos) << text;
}

TEST(QueryLines, AnswersInOrderAndSkipsBlankLines) {
    std::string text;
    for (int i = 0; i < 5; ++i) {
        Json line = example();
        line["id"] = i;
        if (i == 3) { line["tMax"] = "bad"; }
        text += "\n  \t\r\n" + line.dump() + (i % 2 == 0 ? "\r\n" : "\n");
    }
    std::istringstream in(text);
    std::ostringstream out;
    const auto answer = [](std::string_view line) { return answerToiLine(line); };
    EXPECT_EQ(answerQueries(in, out, answer), 2);
    std::istringstream answers(out.str());
    int count = 0;
    for (std::string line; std::getline(answers, line); ++count) {
        EXPECT_EQ(Json::parse(line)["id"], count);
        EXPECT_EQ(Json::parse(line).contains("error"), count == 3);
    }
    EXPECT_EQ(count, 5);
    std::istringstream nothing("\n\n");
    EXPECT_EQ(answerQueries(nothing, out, answer), 0);
}

/// Whatever is wrong: the line is named, the lines around it are answered.
TEST(QueryLines, NamesEachBadLineAndGoesOn) {
    const auto changed = [](auto change) {
        Json line = example();
        change(line);
        return line.dump();
    };
    const std::string good = example().dump();
    const std::string nan = changed([](Json& q) { q["a"]["radius"] = "?"; });
    const std::vector<std::pair<std::string, std::string>> lines{
        {good, ""},
        {std::string(nan).replace(nan.find("\"?\""), 3, "NaN"), "line 2, column "},
        {std::string(nan).replace(nan.find("\"?\""), 3, "1e999"), "line 3: /a/radius: "},
        {changed([](Json& q) { q["a"]["vertices"] = Json::array(); }), "line 4: /a/vertices: "},
        {changed([](Json& q) {
             q["a"]["vertices"] = Json::array();
             for (int i = 0; i < 9; ++i) { q["a"]["vertices"].push_back({i, i * i}); }
         }),
         "line 5: /a/vertices: "},
        {changed([](Json& q) {
             q["a"]["vertices"] = {{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};
         }),
         "line 6: /a/vertices: "},
        {changed([](Json& q) { q["b"]["radius"] = -1; }), "line 7: /b/radius: "},
        {changed([](Json& q) { q["tolerance"] = -1; }), "line 8: /tolerance: "},
        {changed([](Json& q) {
             q["id"] = {{"x", 1}, {"error", "none"}}, q["tMax"] = 2;
         }),
         "line 9: /tMax: "},
        {"nonsense", "line 10, column "},
        {good, ""},
    };
    std::string text;
    for (const auto& line : lines) { text += line.first + '\n'; }
    std::istringstream in(text);
    std::ostringstream out;
    EXPECT_EQ(answerQueries(in, out, [](std::string_view line) { return answerToiLine(line); }), 2);
    std::istringstream answers(out.str());
    for (const auto& [line, error] : lines) {
        std::string answer;
        ASSERT_TRUE(std::getline(answers, answer));
        const Json json = Json::parse(answer);
        EXPECT_EQ(json.contains("state"), error.empty()) << line;
        if (!error.empty()) { expectStartsWith(json.at("error").get<std::string>(), error); }
    }
}

}  // namespace
}  // namespace swept::test

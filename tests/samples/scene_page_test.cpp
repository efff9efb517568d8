#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include <swept/engine/counter_list.h>
#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/runner.h>
#include <swept/samples/scene_fields.h>
#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/toi/query_lines.h>
#include <swept/tools/writers/csv_writer.h>
#include <swept/tools/writers/event_writer.h>
#include <swept/tools/writers/report_writer.h>

// The pages say what the code does: samples/README.md, and what README.md has of scenes.

swept::SceneDescription seesaw();
double heightAfterTwoSeconds(const swept::SceneDescription& scene, std::string& error);

namespace swept {
namespace {

std::string textOf(const std::string& path) {
    std::ifstream file(std::string(SWEPT_SOURCE_ROOT) + "/" + path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty()) << path;
    return text.str();
}

const std::string& page() {
    static const std::string kPage = textOf("samples/README.md");
    return kPage;
}

/// The contents of all fenced blocks of a language.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
    const std::string opening = "\n```" + language + "\n";
    std::vector<std::string> found;
    for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
        at += opening.size();
        const std::size_t end = text.find("\n```", at);
        found.push_back(text.substr(at, end + 1 - at));
        at = end;
    }
    return found;
}

/// The part of the page under a heading, up to the next heading of the same rank or a higher one.
std::string section(const std::string& heading) {
    const std::size_t start = page().find("\n" + heading);
    if (start == std::string::npos) { return {}; }
    const std::size_t rank = heading.find(' ');
    std::size_t end = page().find("\n#", start + 1);
    while (end != std::string::npos && page().find(' ', end) - end - 1 > rank) { end = page().find("\n#", end + 1); }
    return page().substr(start, end == std::string::npos ? end : end - start);
}

/// Fails when a section does not name all the words in `code` style. Words in double quotes may stand so, too.
template <class Words>
void expectNamed(const std::string& heading, const Words& words) {
    const std::string text = section(heading);
    EXPECT_FALSE(text.empty()) << "no section " << heading;
    for (const auto& word : words) {
        const std::string plain = "`" + std::string(word) + "`";
        const std::string quoted = "`\"" + std::string(word) + "\"`";
        const bool isNamed = text.find(plain) != std::string::npos || text.find(quoted) != std::string::npos;
        EXPECT_TRUE(isNamed) << heading << " does not tell of " << word;
    }
}

template <class Object>
std::vector<std::string> keysOf() {
    std::vector<std::string> keys;
    forEachField<Object>([&](const auto& field) { keys.emplace_back(field.key); });
    return keys;
}

TEST(ScenePage, NamesEveryMemberWhereItBelongs) {
    expectNamed("### Scene", keysOf<SceneDescription>());
    expectNamed("### Scene", keysOf<ViewDescription>());
    expectNamed("### Body", keysOf<BodyDescription>());
    expectNamed("### Shape", keysOf<ShapeDescription>());
    expectNamed("### Shape", keysOf<FilterDescription>());
    expectNamed("### Shape", keysOf<SurfaceDescription>());
    expectNamed("### Joint", keysOf<JointDescription>());
    expectNamed("### Joint", keysOf<RevoluteDescription>());
    expectNamed("### Joint", keysOf<DistanceDescription>());
    expectNamed("### Joint", keysOf<PrismaticDescription>());
    expectNamed("### Joint", keysOf<WheelDescription>());
    expectNamed("### Joint", keysOf<WeldDescription>());
    expectNamed("### Joint", keysOf<MotorDescription>());
    expectNamed("### Joint", keysOf<MouseDescription>());
    expectNamed("### Joint", keysOf<GearDescription>());
    expectNamed("### Joint", keysOf<PulleyDescription>());
    expectNamed("### Settings", keysOf<SettingsDescription>());
}

TEST(ScenePage, NamesEveryWordWhereItBelongs) {
    expectNamed("### Body", namesOf<SceneBodyType>());
    expectNamed("### Shape", geometryNames());
    expectNamed("### Shape", namesOf<MixingRule>());
    expectNamed("### Joint", jointTypeNames());
    expectNamed("### Settings", namesOf<SceneProfile>());
    expectNamed("### Settings", namesOf<SceneBroadphase>());
    expectNamed("## Continuous collision", namesOf<SceneContinuous>());
}

/// The cells of the table row of a member, without the bars.
std::string rowOf(const std::string& heading, const std::string& member) {
    const std::string text = section(heading);
    const std::size_t start = text.find("\n| `" + member + "`");
    return start == std::string::npos ? std::string() : text.substr(start + 1, text.find('\n', start + 1) - start - 1);
}

// Geometries stand in one cell as JSON; their keys must be in it.
template <class Object>
void expectGeometryKeys(std::string_view name) {
    if constexpr (!kBare<Object>) {
        const std::string row = rowOf("### Shape", std::string(name));
        for (const std::string& key : keysOf<Object>()) {
            EXPECT_NE(row.find('"' + key + '"'), std::string::npos) << name << " without " << key << ": " << row;
        }
    }
}

TEST(ScenePage, ShowsEveryGeometryWithItsMembers) {
    expectGeometryKeys<BoxGeometry>("box");
    expectGeometryKeys<CircleGeometry>("circle");
    expectGeometryKeys<CapsuleGeometry>("capsule");
    expectGeometryKeys<SegmentGeometry>("segment");
    expectGeometryKeys<PolygonGeometry>("polygon");
    expectGeometryKeys<ChainGeometry>("chain");
}

void expectDefault(const std::string& heading, const std::string& member, const std::string& value) {
    const std::string row = rowOf(heading, member);
    EXPECT_NE(row.find("| " + value + " |"), std::string::npos) << member << " is " << value << " by default: " << row;
}

TEST(ScenePage, StatesTheDefaults) {
    const SceneDescription scene;
    const BodyDescription body;
    const ShapeDescription shape;
    const auto number = [](double value) { return shortestNumber(value); };
    expectDefault("### Scene", "gravity", "`[" + number(scene.gravity.x) + ", " + number(scene.gravity.y) + "]`");
    expectDefault("### Body", "gravityScale", number(body.gravityScale));
    expectDefault("### Body", "linearDamping", number(body.linearDamping));
    expectDefault("### Body", "awake", body.awake ? "true" : "false");
    expectDefault("### Body", "allowSleep", body.allowSleep ? "true" : "false");
    expectDefault("### Body", "enabled", body.enabled ? "true" : "false");
    expectDefault("### Body", "bullet", body.bullet ? "true" : "false");
    expectDefault("### Body", "type", "`\"" + std::string(namesOf<SceneBodyType>()[std::size_t(body.type)]) + "\"`");
    expectDefault("### Shape", "density", number(shape.density));
    expectDefault("### Shape", "friction", number(shape.friction));
    expectDefault("### Shape", "restitution", number(shape.restitution));
    expectDefault("### Shape", "rollingResistance", number(shape.rollingResistance));
    expectDefault("### Shape", "surfaceSpeed", number(shape.surfaceSpeed));
    for (const auto& [member, rule] :
         {std::pair("frictionMixing", shape.frictionMixing), std::pair("restitutionMixing", shape.restitutionMixing)}) {
        expectDefault("### Shape", member, "`\"" + std::string(namesOf<MixingRule>()[std::size_t(rule)]) + "\"`");
    }
    expectDefault("### Settings", "dt", "1/" + number(1 / scene.settings.dt));
    expectDefault("### Settings", "maxImpacts", std::to_string(scene.settings.maxImpacts));
    expectDefault("### Settings", "sleep", scene.settings.sleep ? "true" : "false");
    expectDefault("### Settings", "continuous",
                  "`\"" + std::string(namesOf<SceneContinuous>()[std::size_t(scene.settings.continuous)]) + "\"`");
    expectDefault("### Settings", "profile",
                  "`\"" + std::string(namesOf<SceneProfile>()[std::size_t(scene.settings.profile)]) + "\"`");
    expectDefault("### Settings", "broadphase",
                  "`\"" + std::string(namesOf<SceneBroadphase>()[std::size_t(scene.settings.broadphase)]) + "\"`");
    const std::string filter = rowOf("### Shape", "filter");
    EXPECT_NE(filter.find("(default " + std::to_string(shape.filter.mask) + ")"), std::string::npos) << filter;
}

// Every scene shown can be read, built and run.
TEST(ScenePage, ShowsScenesThatRun) {
    int shown = 0;
    for (const char* const path : {"samples/README.md", "README.md"}) {
        for (const std::string& text : blocks(textOf(path), "json")) {
            const SceneResult result = readScene(text, path);
            ASSERT_TRUE(result.scene) << result.error.text() << "\n" << text;
            std::string error;
            const auto runner = makeRunner(*result.scene, {}, error);
            ASSERT_NE(runner, nullptr) << error << "\n" << text;
            for (int i = 0; i < 30; ++i) { runner->step(); }
            EXPECT_TRUE(runner->report().finite);
            ++shown;
        }
    }
    EXPECT_GE(shown, 4);
}

/// Whether anything ever met the sensor of the third example, which stands behind the wall.
TEST(ScenePage, ShowsABulletThatTheWallStops) {
    const SceneResult result = readScene(blocks(page(), "json").at(2), "samples/README.md");
    ASSERT_TRUE(result.scene) << result.error.text();
    std::string error;
    RunnerOptions options;
    options.collectEvents = true;
    const auto runner = makeRunner(*result.scene, options, error);
    ASSERT_NE(runner, nullptr) << error;
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        runner->step();
        for (const SceneEvent& event : runner->events()) {
            EXPECT_NE(event.type, SceneEventType::sensorBegin) << "step " << event.step;
            hits += event.type == SceneEventType::hit ? 1 : 0;
        }
    }
    EXPECT_GT(hits, 0) << "the bullet met nothing";
}

/// Bullets of the built-in scene that are in neither of its two rooms after three seconds.
int bulletsThatLeft(SceneContinuous mode) {
    SceneDescription scene = findBuiltinScene("bullet-curtain")->make();
    scene.settings.continuous = mode;
    std::string error;
    const auto runner = makeRunner(scene, {}, error);
    EXPECT_NE(runner, nullptr) << error;
    const Trace trace = runTrace(*runner, 180, 180);
    int left = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].type != SceneBodyType::dynamic) { continue; }
        const DVec2 at = trace.frames.back().bodies[i].position;
        const bool isBelow = at.x > -8 && at.x < 3 && at.y > 0 && at.y < 4;
        const bool isAbove = at.x > -8 && at.x < 5 && at.y > 4 && at.y < 8.4;
        left += isBelow || isAbove ? 0 : 1;
    }
    return left;
}

TEST(ScenePage, TellsTheTruthOfTheContinuousModes) {
    EXPECT_GT(bulletsThatLeft(SceneContinuous::off), 9) << "most of 18, says the page";
    EXPECT_EQ(bulletsThatLeft(SceneContinuous::stop), 0);
    EXPECT_EQ(bulletsThatLeft(SceneContinuous::subStep), 0);
}

TEST(ScenePage, ShowsTheHeaderOfTheStates) {
    std::ostringstream written;
    const CsvWriter writer(written, {"body0"});
    const std::vector<std::string> shown = blocks(page(), "csv");
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_EQ(shown[0], written.str());
}

std::vector<std::string> membersOf(const nlohmann::ordered_json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) { keys.push_back(key); }
    EXPECT_FALSE(keys.empty());
    return keys;
}

TEST(ScenePage, NamesTheMembersAndTypesOfEvents) {
    std::ostringstream written;
    EventWriter writer(written, {"body0"});
    SceneEvent event;
    event.joint = 0;  // as of a joint that broke: then there is one member more
    writer.write(std::span(&event, 1));
    expectNamed("### Events", membersOf(nlohmann::ordered_json::parse(written.str())));
    std::vector<std::string> types;
    for (int i = 0; i <= static_cast<int>(SceneEventType::jointBreak); ++i) {
        types.emplace_back(eventTypeName(static_cast<SceneEventType>(i)));
    }
    expectNamed("### Events", types);
}

TEST(ScenePage, NamesTheMembersOfReports) {
    RunReport report;
    report.lostTime.push_back({0, 1, "stop"});
    report.deepestPair = DeepestPair{1, 0, 0};
    report.worstJoint = WorstJoint{1, 0};
    SceneDescription scene;
    scene.bodies.resize(1);
    scene.joints.resize(1);
    scene.settings.maxPenetration = 1;
    const auto json = nlohmann::ordered_json::parse(reportText(scene, report, {"engine", "f32", 2, 1}));
    expectNamed("### Report", membersOf(json));
    expectNamed("### Report", membersOf(json["lostTime"][0]));
    expectNamed("### Report", membersOf(json["budgets"]["maxPenetration"]));
    expectNamed("### Report", membersOf(json["energy"]));
    for (const char* const member : {"mostLostTime", "deepestPenetrationAt", "largestJointErrorAt"}) {
        expectNamed("### Report", membersOf(json[member]));
    }
}

TEST(ScenePage, NamesEveryCounterOfReports) {
    std::vector<std::string> names;
    for (const CounterEntry& counter : kCounters) { names.emplace_back(counter.name); }
    expectNamed("#### Counters", names);
}

TEST(ScenePage, ShowsAQueryThatIsAnswered) {
    const std::vector<std::string> shown = blocks(page(), "jsonl");
    ASSERT_EQ(shown.size(), 1u);
    const LineAnswer toi = answerToiLine(shown[0], ToiMethod::certified);
    EXPECT_TRUE(toi.good) << toi.text;
    expectNamed("## Queries", membersOf(nlohmann::ordered_json::parse(toi.text)));
    const LineAnswer distance = answerDistanceLine(shown[0], Precision::f64);
    EXPECT_TRUE(distance.good) << distance.text;
    expectNamed("## Queries", membersOf(nlohmann::ordered_json::parse(distance.text)));
    const auto query = nlohmann::ordered_json::parse(shown[0]);
    expectNamed("## Queries", membersOf(query));
    expectNamed("## Queries", membersOf(query["a"]));
    expectNamed("## Queries", membersOf(query["a"]["sweep"]));
}

TEST(ScenePage, ListsTheBuiltInScenesAsTheyAre) {
    const std::string text = section("## Built-in scenes");
    for (const BuiltinScene& scene : builtinScenes()) {
        const std::string row =
            "| `" + std::string(scene.name) + "` | " + scene.purpose + " | " + shortestNumber(scene.duration) + " |\n";
        EXPECT_NE(text.find(row), std::string::npos) << "missing: " << row;
    }
    std::size_t rows = 0;
    for (std::size_t at = text.find("\n| `"); at != std::string::npos; at = text.find("\n| `", at + 1)) { ++rows; }
    EXPECT_EQ(rows, builtinScenes().size());
}

TEST(ScenePage, ShowsCppThatIsCompiledAndWorks) {
    const std::vector<std::string> shown = blocks(page(), "cpp");
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_EQ(shown[0], textOf("tests/samples/page_example.cpp"));
    std::string error;
    const double height = heightAfterTwoSeconds(seesaw(), error);
    EXPECT_EQ(error, "");
    EXPECT_GT(height, 0) << "the box that fell on the plank lies on or above the floor";
    EXPECT_LT(height, 3);
}

// Every picture and every file that the pages point to is there.
TEST(ScenePage, PointsToFilesThatExist) {
    int pointers = 0;
    for (const std::string path : {"samples/README.md", "README.md"}) {
        const std::string text = textOf(path);
        const std::string folder = path.substr(0, path.rfind('/') + 1);
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
            std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
            target = target.substr(0, std::max<std::size_t>(1, target.find('#')));  // without the place in the file
            if (target.starts_with("#") || target.find("://") != std::string::npos || path == target) { continue; }
            const std::string file =
                std::string(SWEPT_SOURCE_ROOT) + "/" + (path.find('/') == std::string::npos ? "" : folder) + target;
            EXPECT_TRUE(std::ifstream(file).good()) << path << " points to " << target;
            ++pointers;
        }
    }
    EXPECT_GT(pointers, 10);
}

}  // namespace
}  // namespace swept

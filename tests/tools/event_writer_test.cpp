#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include <swept/tools/writers/event_writer.h>

namespace swept {
namespace {

SceneEvent hitEvent() {
    SceneEvent event;
    event.step = 12;
    event.time = 0.1875;
    event.fraction = 0.25;
    event.type = SceneEventType::hit;
    event.a = 0;
    event.b = 1;
    event.shapeB = 2;
    event.point = {0.5, -1};
    event.normal = {0, 1};
    event.approachSpeed = 3.5;
    event.impulse = 7;
    return event;
}

TEST(EventWriter, WritesTheFormatByteForByte) {
    std::ostringstream out;
    EventWriter writer(out, {"floor", "ball"});
    const std::vector<SceneEvent> events{hitEvent()};
    writer.write(events);
    EXPECT_EQ(out.str(),
              "{\"step\":12,\"time\":0.1875,\"fraction\":0.25,\"type\":\"hit\",\"a\":\"floor\",\"b\":\"ball\","
              "\"shapeA\":0,\"shapeB\":2,\"point\":[0.5,-1],\"normal\":[0,1],\"approachSpeed\":3.5,\"impulse\":7}\n");
}

TEST(EventWriter, NamesSegmentsOfChains) {
    std::ostringstream out;
    EventWriter writer(out, {"floor", "ball"});
    SceneEvent event = hitEvent();
    event.segmentA = 7;
    const std::vector<SceneEvent> events{event};
    writer.write(events);
    EXPECT_NE(out.str().find(",\"shapeB\":2,\"segmentA\":7,\"point\""), std::string::npos) << out.str();
}

TEST(EventWriter, NamesTheJointThatBroke) {
    std::ostringstream out;
    EventWriter writer(out, {"floor", "ball"});
    SceneEvent event = hitEvent();
    event.type = SceneEventType::jointBreak;
    event.joint = 3;
    writer.write(std::vector<SceneEvent>{event});
    EXPECT_NE(out.str().find("\"impulse\":7,\"joint\":3}"), std::string::npos) << out.str();
}

TEST(EventWriter, WritesNoMinusZero) {
    std::ostringstream out;
    EventWriter writer(out, {"floor", "ball"});
    SceneEvent event = hitEvent();
    event.point = {-0.0, 0};
    event.normal = {-1, -0.0};
    event.impulse = -0.0;
    writer.write(std::vector<SceneEvent>{event});
    EXPECT_NE(out.str().find("\"point\":[0,0],\"normal\":[-1,0],"), std::string::npos) << out.str();
    EXPECT_NE(out.str().find("\"impulse\":0}"), std::string::npos) << out.str();
}

TEST(EventWriter, WritesOneValidObjectALine) {
    std::ostringstream out;
    EventWriter writer(out, {"a \"quoted\"\nname", "b"});
    std::vector<SceneEvent> events(6, hitEvent());
    const char* const names[] = {"begin", "end", "hit", "sensorBegin", "sensorEnd", "jointBreak"};
    for (std::size_t i = 0; i < events.size(); ++i) { events[i].type = static_cast<SceneEventType>(i); }
    events[2].impulse = std::numeric_limits<double>::infinity();
    writer.write(events);
    std::istringstream lines(out.str());
    std::string line;
    std::size_t count = 0;
    for (; std::getline(lines, line); ++count) {
        const auto json = nlohmann::json::parse(line);
        EXPECT_EQ(json.at("type"), names[count]);
        EXPECT_EQ(json.at("a"), "a \"quoted\"\nname");
        EXPECT_EQ(json.at("impulse").is_null(), count == 2);
        EXPECT_EQ(json.size(), 12u);
    }
    EXPECT_EQ(count, events.size());
}

TEST(EventWriter, WritesNothingForAQuietStep) {
    std::ostringstream out;
    EventWriter writer(out, {"a"});
    writer.write({});
    EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace swept

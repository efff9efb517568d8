#include "event_writer.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "number_text.h"

namespace swept {
namespace {

void appendMember(std::string& line, const char* key, double value) {
    line += ",\"";
    line += key;
    line += "\":";
    appendJsonNumber(line, withoutMinusZero(value));
}

void appendMember(std::string& line, const char* key, DVec2 value) {
    line += ",\"";
    line += key;
    line += "\":[";
    appendJsonNumber(line, withoutMinusZero(value.x));
    line += ',';
    appendJsonNumber(line, withoutMinusZero(value.y));
    line += ']';
}

}  // namespace

const char* eventTypeName(SceneEventType type) {
    switch (type) {
        case SceneEventType::begin:
            return "begin";
        case SceneEventType::end:
            return "end";
        case SceneEventType::hit:
            return "hit";
        case SceneEventType::sensorBegin:
            return "sensorBegin";
        case SceneEventType::sensorEnd:
            return "sensorEnd";
        case SceneEventType::jointBreak:
            return "jointBreak";
    }
    return "";  // unreachable, but GCC cannot know
}

EventWriter::EventWriter(std::ostream& out, const std::vector<std::string>& bodyNames) : out_(out) {
    // A name that is not UTF-8 cannot come from a scene file; from C++ its bad bytes become the replacement character.
    constexpr auto kReplaceBadBytes = nlohmann::json::error_handler_t::replace;
    for (const std::string& name : bodyNames) {
        names_.push_back(nlohmann::json(name).dump(-1, ' ', false, kReplaceBadBytes));
    }
}

void EventWriter::write(std::span<const SceneEvent> events) {
    lines_.clear();
    for (const SceneEvent& event : events) {
        lines_ += "{\"step\":" + std::to_string(event.step);
        appendMember(lines_, "time", event.time);
        appendMember(lines_, "fraction", event.fraction);
        lines_ += ",\"type\":\"";
        lines_ += eventTypeName(event.type);
        lines_ += "\",\"a\":" + names_.at(static_cast<std::size_t>(event.a));
        lines_ += ",\"b\":" + names_.at(static_cast<std::size_t>(event.b));
        lines_ += ",\"shapeA\":" + std::to_string(event.shapeA);
        lines_ += ",\"shapeB\":" + std::to_string(event.shapeB);
        if (event.segmentA > 0) { lines_ += ",\"segmentA\":" + std::to_string(event.segmentA); }
        if (event.segmentB > 0) { lines_ += ",\"segmentB\":" + std::to_string(event.segmentB); }
        appendMember(lines_, "point", event.point);
        appendMember(lines_, "normal", event.normal);
        appendMember(lines_, "approachSpeed", event.approachSpeed);
        appendMember(lines_, "impulse", event.impulse);
        if (event.joint >= 0) { lines_ += ",\"joint\":" + std::to_string(event.joint); }
        lines_ += "}\n";
    }
    out_ << lines_;
}

}  // namespace swept

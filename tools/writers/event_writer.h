#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include <swept/samples/frame.h>

namespace swept {

/// Events as JSON lines, one object a line, with the bodies' names as `a` and `b`.
class EventWriter {
public:
    /// `out` must outlive the writer.
    EventWriter(std::ostream& out, const std::vector<std::string>& bodyNames);
    /// In the order given, which is that of time, then ids.
    void write(std::span<const SceneEvent> events);

private:
    std::ostream& out_;
    std::vector<std::string> names_;  // as JSON strings, quotes included
    std::string lines_;               // text of one step, its capacity reused
};

/// The name of the event's type in the format: "begin", "sensorEnd" …
const char* eventTypeName(SceneEventType type);

}  // namespace swept

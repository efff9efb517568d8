#include "csv_writer.h"

#include <ostream>

#include "number_text.h"

namespace swept {

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) { return text; }
    std::string quoted = "\"";
    for (const char character : text) {
        if (character == '"') { quoted += '"'; }
        quoted += character;
    }
    return quoted + '"';
}

CsvWriter::CsvWriter(std::ostream& out, const std::vector<std::string>& bodyNames,
                     const std::vector<std::size_t>& bodies)
    : out_(out), written_(bodyNames.size(), bodies.empty()) {
    for (const std::size_t body : bodies) { written_[body] = true; }
    for (const std::string& name : bodyNames) { fields_.push_back(csvField(name)); }
    out_ << "step,time,body,x,y,angle,vx,vy,omega,awake\n";
}

void CsvWriter::write(const Frame& frame) {
    std::string start = std::to_string(frame.step) + ',';
    appendNumber(start, frame.time);
    start += ',';
    rows_.clear();
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
        if (!written_[i]) { continue; }
        const BodyFrame& body = frame.bodies[i];
        rows_ += start;
        rows_ += fields_[i];
        for (const double number :
             {body.position.x, body.position.y, body.angle, body.velocity.x, body.velocity.y, body.angularVelocity}) {
            rows_ += ',';
            appendNumber(rows_, number);
        }
        rows_ += body.awake ? ",1\n" : ",0\n";
    }
    out_ << rows_;
}

}  // namespace swept

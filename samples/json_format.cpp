#include <cmath>

#include "scene_json.h"
#include "scene_names.h"

namespace swept {
namespace {

constexpr std::size_t kLineLength = 110;
constexpr std::size_t kIndent = 1;

std::string scalarText(const Json& value) {
    if (!value.is_number_float()) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }
    const double number = value.get<double>();
    if (!std::isfinite(number)) {
        return "null";  // JSON has no word for it
    }
    // "-0" would be read as a whole number, and those have no sign at 0.
    return number == 0 && std::signbit(number) ? "-0.0" : shortestNumber(number);
}

std::string keyText(const std::string& key) { return scalarText(Json(key)) + ": "; }

// Appends the value on one line. False, with `line` in any state, as soon as it is longer than `limit`.
bool appendOneLine(const Json& value, std::size_t limit, std::string& line) {
    if (!value.is_structured()) {
        line += scalarText(value);
        return line.size() <= limit;
    }
    const bool isObject = value.is_object();
    line += isObject ? '{' : '[';
    bool first = true;
    for (auto it = value.begin(); it != value.end(); ++it) {
        if (!first) { line += ", "; }
        first = false;
        if (isObject) { line += keyText(it.key()); }
        if (!appendOneLine(*it, limit, line)) { return false; }
    }
    line += isObject ? '}' : ']';
    return line.size() <= limit;
}

void appendFormatted(const Json& value, std::size_t depth, std::size_t used, std::string& text) {
    std::string line;
    // The document itself is always spread out, so that its parts start on lines of their own.
    if ((depth > 0 || !value.is_structured() || value.empty()) &&
        appendOneLine(value, used < kLineLength ? kLineLength - used : 0, line)) {
        text += line;
        return;
    }
    if (!value.is_structured()) {
        text += scalarText(value);
        return;
    }
    const bool isObject = value.is_object();
    text += isObject ? '{' : '[';
    const std::string indent((depth + 1) * kIndent, ' ');
    bool first = true;
    for (auto it = value.begin(); it != value.end(); ++it) {
        text += first ? "\n" : ",\n";
        first = false;
        text += indent;
        const std::string key = isObject ? keyText(it.key()) : std::string();
        text += key;
        appendFormatted(*it, depth + 1, indent.size() + key.size() + 1, text);
    }
    text += '\n' + std::string(depth * kIndent, ' ') + (isObject ? '}' : ']');
}

}  // namespace

std::string formatJson(const Json& value) {
    std::string text;
    appendFormatted(value, 0, 0, text);
    return text + '\n';
}

}  // namespace swept

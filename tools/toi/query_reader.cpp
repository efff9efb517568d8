#include "query_reader.h"

#include <algorithm>
#include <initializer_list>

namespace swept {
namespace {

using Error = std::optional<std::string>;

Error errorAt(const Place& place, const std::string& reason) { return place.pointer() + ": " + reason; }

/// Takes the id of the outermost object out of a line that need not be valid as a whole, as it is written: a number
/// may have more digits than a double holds.
class IdFinder : public nlohmann::json_sax<Json> {
public:
    /// JSON; empty: there is none that is complete
    std::string text() const { return isWhole_ ? text_ : ""; }

    bool null() override { return scalar("null"); }
    bool boolean(bool value) override { return scalar(value ? "true" : "false"); }
    bool number_integer(number_integer_t value) override { return scalar(std::to_string(value)); }
    bool number_unsigned(number_unsigned_t value) override { return scalar(std::to_string(value)); }
    bool number_float(number_float_t, const string_t& token) override { return scalar(token); }
    bool string(string_t& value) override { return scalar(isId_ ? Json(value).dump() : ""); }
    bool binary(binary_t&) override { return false; }  // exists in binary formats only
    bool start_object(std::size_t) override { return enter('{'); }
    bool start_array(std::size_t) override { return enter('['); }
    bool end_object() override { return leave('}'); }
    bool end_array() override { return leave(']'); }
    bool key(string_t& name) override {
        if (isId_) {
            startPart();
            text_ += Json(name).dump() + ':';
            isBehindKey_ = true;
        }
        isId_ = isId_ || (depth_ == 1 && name == "id");
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

private:
    int depth_ = 0;
    bool isId_ = false;  ///< what comes is of the id
    bool isBehindKey_ = false;
    bool isWhole_ = false;
    std::string text_;

    /// A comma where one is needed.
    void startPart() {
        const bool isFirst = text_.empty() || text_.back() == '{' || text_.back() == '[';
        if (!isFirst && !isBehindKey_) { text_ += ','; }
        isBehindKey_ = false;
    }
    /// @return false: the id is found, stop
    bool endPart() {
        isWhole_ = isId_ && depth_ == 1;
        return !isWhole_;
    }
    bool scalar(const std::string& token) {
        if (isId_) {
            startPart();
            text_ += token;
        }
        return endPart();
    }
    bool enter(char bracket) {
        if (isId_) {
            startPart();
            text_ += bracket;
        }
        ++depth_;
        return true;
    }
    bool leave(char bracket) {
        --depth_;
        if (isId_) { text_ += bracket; }
        return endPart();
    }
};

std::string idOf(std::string_view line) {
    IdFinder finder;
    Json::sax_parse(line.begin(), line.end(), &finder);
    const std::string text = finder.text();
    return text.empty() ? "null" : text;
}

Error checkKeys(const Json& object, const Place& place, std::initializer_list<std::string_view> required,
                std::initializer_list<std::string_view> optional) {
    if (!object.is_object()) { return errorAt(place, "must be an object, is " + kindOf(object)); }
    const auto among = [](const auto& names, std::string_view key) {
        return std::find(names.begin(), names.end(), key) != names.end();
    };
    for (const auto& [key, value] : object.items()) {
        if (!among(required, key) && !among(optional, key)) {
            return errorAt(place.at(key), "there is no such member");
        }
    }
    for (const std::string_view key : required) {
        if (!object.contains(key)) { return errorAt(place.at(key), "is missing"); }
    }
    return {};
}

Error readNumber(const Json& json, const Place& place, double& number) {
    if (!json.is_number()) { return errorAt(place, "must be a number, is " + kindOf(json)); }
    number = json.get<double>();
    return {};
}

Error readVector(const Json& json, const Place& place, DVec2& vector) {
    if (!json.is_array() || json.size() != 2) { return errorAt(place, "must be an array of two numbers"); }
    if (const Error error = readNumber(json[0], place.at(std::size_t{0}), vector.x)) { return error; }
    return readNumber(json[1], place.at(std::size_t{1}), vector.y);
}

Error readSweep(const Json& json, const Place& place, Sweep& sweep) {
    if (const Error error = checkKeys(json, place, {"localCenter", "c0", "c1", "a0", "a1"}, {"k"})) { return error; }
    struct VectorMember {
        const char* key;
        DVec2 Sweep::*member;
    };
    for (const VectorMember& m : {VectorMember{"localCenter", &Sweep::localCenter}, VectorMember{"c0", &Sweep::c0},
                                  VectorMember{"c1", &Sweep::c1}, VectorMember{"k", &Sweep::k}}) {
        if (!json.contains(m.key)) { continue; }
        if (const Error error = readVector(json[m.key], place.at(m.key), sweep.*m.member)) { return error; }
    }
    if (const Error error = readNumber(json["a0"], place.at("a0"), sweep.a0)) { return error; }
    return readNumber(json["a1"], place.at("a1"), sweep.a1);
}

Error readVertices(const Json& json, const Place& place, ToiPolygon& polygon) {
    if (!json.is_array()) { return errorAt(place, "must be an array of points, is " + kindOf(json)); }
    if (json.empty() || json.size() > polygon.vertices.size()) { return errorAt(place, "must have 1 to 8 points"); }
    polygon.count = static_cast<int>(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        if (const Error error = readVector(json[i], place.at(i), polygon.vertices[i])) { return error; }
    }
    return {};
}

Error readBody(const Json& json, const Place& place, ToiPolygon& polygon, Sweep& sweep) {
    if (const Error error = checkKeys(json, place, {"vertices", "radius", "sweep"}, {})) { return error; }
    if (const Error error = readVertices(json["vertices"], place.at("vertices"), polygon)) { return error; }
    if (const Error error = readNumber(json["radius"], place.at("radius"), polygon.radius)) { return error; }
    if (const Error error = readSweep(json["sweep"], place.at("sweep"), sweep)) { return error; }
    const Status status = validateToiPolygon(polygon);
    return status.ok() ? Error{} : errorAt(place.at(status.field), describe(status.code));
}

Error readOptional(const Json& json, const char* key, std::optional<double>& number) {
    if (!json.contains(key)) { return {}; }
    const Place root;
    return readNumber(json[key], root.at(key), number.emplace());
}

}  // namespace

std::optional<std::string> readQueryLine(std::string_view line, QueryLine& query) {
    query.id = idOf(line);
    const JsonResult parsed = parseStrict(line);
    if (parsed.error) { return (parsed.error->where.empty() ? "" : parsed.error->where + ": ") + parsed.error->reason; }
    const Json& json = parsed.value;
    if (!json.is_object()) { return "the line must be an object, is " + kindOf(json); }
    const Place root;
    if (const Error error = checkKeys(json, root, {"id", "a", "b", "tMax"}, {"family", "target", "tolerance"})) {
        return error;
    }
    if (const Error error = readBody(json["a"], root.at("a"), query.a, query.sweepA)) { return error; }
    if (const Error error = readBody(json["b"], root.at("b"), query.b, query.sweepB)) { return error; }
    if (const Error error = readNumber(json["tMax"], root.at("tMax"), query.tMax)) { return error; }
    if (const Error error = readOptional(json, "target", query.target)) { return error; }
    return readOptional(json, "tolerance", query.tolerance);
}

}  // namespace swept

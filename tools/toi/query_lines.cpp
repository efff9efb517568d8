#include "query_lines.h"

#include <istream>
#include <ostream>

#include "../../samples/scene_names.h"
#include "../writers/number_text.h"
#include "query_distance.h"
#include "query_reader.h"

namespace swept {
namespace {

/// One JSON object on one line, member by member.
class LineWriter {
public:
    explicit LineWriter(const std::string& id) { text_ = "{\"id\":" + id; }

    void add(const char* key, double number) {
        startMember(key);
        appendJsonNumber(text_, withoutMinusZero(number));
    }
    void add(const char* key, DVec2 vector) {
        startMember(key);
        text_ += '[';
        appendJsonNumber(text_, withoutMinusZero(vector.x));
        text_ += ',';
        appendJsonNumber(text_, withoutMinusZero(vector.y));
        text_ += ']';
    }
    void addPair(const char* key, double first, double second) { add(key, DVec2{first, second}); }
    void add(const char* key, const ToiFeature& a, const ToiFeature& b) {
        startMember(key);
        text_ += '[';
        append(a);
        text_ += ',';
        append(b);
        text_ += ']';
    }
    void add(const char* key, int number) {
        startMember(key);
        text_ += std::to_string(number);
    }
    void add(const char* key, const std::string& string) {
        startMember(key);
        text_ += Json(string).dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    std::string take() { return std::move(text_ += '}'); }

private:
    std::string text_;

    void append(const ToiFeature& feature) {
        text_ += '[';
        if (feature.first >= 0) { text_ += std::to_string(feature.first); }
        if (feature.second >= 0) { text_ += ',' + std::to_string(feature.second); }
        text_ += ']';
    }
    void startMember(const char* key) { text_ += std::string(",\"") + key + "\":"; }
};

const char* nameOf(ToiState state) {
    switch (state) {
        case ToiState::hit:
            return "hit";
        case ToiState::separated:
            return "separated";
        case ToiState::overlapped:
            return "overlapped";
        case ToiState::failed:
            return "failed";
    }
    return "";  // unreachable, but GCC cannot know
}

LineAnswer refusal(const std::string& id, const std::string& reason) {
    LineWriter line(id);
    line.add("error", reason);
    return {line.take(), false};
}

/// The JSON pointer of what a status names: of both shapes where it is about the two together.
std::string placeOf(const char* field) {
    if (field == std::string_view("sweep")) { return "/a/sweep, /b/sweep"; }
    if (field == std::string_view("sweepA")) { return "/a/sweep"; }
    if (field == std::string_view("sweepB")) { return "/b/sweep"; }
    return std::string("/") + field;
}

/// What a number out of range should be; empty for what else may be wrong.
std::string rangeOf(const Status& status, const QueryLine& query) {
    if (status.code != StatusCode::outOfRange) { return ""; }
    const std::string_view field = status.field;
    if (field == "tMax") { return ": must be greater than 0 and at most 1, not " + shortestNumber(query.tMax); }
    if (field == "target") {
        const double radii = query.a.radius + query.b.radius;
        return ": must be at least " + shortestNumber(-radii) + ", as the radii of both add up to " +
               shortestNumber(radii);
    }
    if (field == "tolerance") { return ": so far or so much about that double resolves only larger ones"; }
    return ": the bodies are farther apart than the largest number";
}

std::string textOf(const Status& status, const QueryLine& query) {
    return placeOf(status.field) + ": " + describe(status.code) + rangeOf(status, query);
}

/// Of what was right as it was written, and is not as the precision takes it.
std::string whatRoundingDid(const Status& status, const QueryLine& query) {
    const std::string_view field = status.field;
    if (field != "a" && field != "b") { return textOf(status, query); }
    if (status.code == StatusCode::notFinite) { return placeOf(status.field) + ": has numbers too large for f32"; }
    return placeOf(status.field) + ": rounded to f32, it " + describe(status.code);
}

ToiSettings settingsOf(const QueryLine& query) {
    ToiSettings settings = defaultToiSettings(query.a, query.b);
    settings.tMax = query.tMax;
    if (query.target) { settings.target = *query.target; }
    if (query.tolerance) { settings.tolerance = *query.tolerance; }
    return settings;
}

std::optional<std::string> readChecked(std::string_view line, QueryLine& query, ToiSettings& settings) {
    if (auto error = readQueryLine(line, query)) { return error; }
    settings = settingsOf(query);
    const Status status = validateToi(query.a, query.sweepA, query.b, query.sweepB, settings);
    if (status.ok()) { return std::nullopt; }
    const bool isDefault = status.field == std::string_view("tolerance") && !query.tolerance;
    if (isDefault && settings.tolerance == 0) {
        return "/tolerance: is missing: two bodies of which one is a point have no width that a default could follow";
    }
    if (status.code == StatusCode::outOfRange && isDefault) {
        return "/a/sweep, /b/sweep: so far or so much about that double does not resolve the default tolerance, " +
               shortestNumber(settings.tolerance) + " m";
    }
    return textOf(status, query);
}

/// The same of a whole refusal.
std::string refusalNamingTheLine(const std::string& refusal, int number) {
    const std::string key = ",\"error\":\"";  // quotes inside of strings are escaped: only the member itself looks so
    const std::size_t start = refusal.rfind(key) + key.size();
    return refusal.substr(0, start) + namingTheLine(refusal.substr(start), number);
}

}  // namespace

std::string namingTheLine(const std::string& reason, int number) {
    const std::string own = "line 1, ";  // of a syntax error
    const std::string name = "line " + std::to_string(number);
    return reason.starts_with(own) ? name + ", " + reason.substr(own.size()) : name + ": " + reason;
}

std::optional<std::string> readToiLine(std::string_view line, ToiQuery& query) {
    QueryLine read;
    ToiSettings settings;
    auto error = readChecked(line, read, settings);
    query = {read.a, read.sweepA, read.b, read.sweepB, settings};
    return error;
}

LineAnswer answerToiLine(std::string_view line, ToiMethod method) {
    QueryLine query;
    ToiSettings settings;
    if (const auto error = readChecked(line, query, settings)) { return refusal(query.id, *error); }
    const Toi toi = timeOfImpactBy(method, query.a, query.sweepA, query.b, query.sweepB, settings);
    LineWriter answer(query.id);
    answer.add("state", std::string(nameOf(toi.state)));
    answer.add("t", toi.fraction);
    answer.add("separation", toi.separation);
    answer.add("normal", toi.normal);
    answer.add("pointA", toi.pointA);
    answer.add("pointB", toi.pointB);
    answer.add("iterations", toi.iterations);
    answer.add("target", settings.target);
    answer.add("tolerance", settings.tolerance);
    if (method == ToiMethod::certified || method == ToiMethod::shapeCast) {
        answer.addPair("bracket", toi.fractionLower, toi.fraction);
        answer.addPair("separations", toi.separationLower, toi.separation);
        answer.add("features", toi.featureA, toi.featureB);
        answer.add("rootIterations", toi.rootIterations);
    }
    return {answer.take(), true};
}

LineAnswer answerDistanceLine(std::string_view line, Precision precision) {
    QueryLine query;
    if (const auto error = readQueryLine(line, query)) { return refusal(query.id, *error); }
    const auto function = precision == Precision::f32 ? queryDistance<Precision::f32> : queryDistance<Precision::f64>;
    const Result<QueryDistance> found = function(query.a, query.sweepA, query.b, query.sweepB);
    if (!found.ok()) { return refusal(query.id, whatRoundingDid(found.status(), query)); }
    const QueryDistance& distance = found.value();
    LineWriter answer(query.id);
    answer.add("distance", distance.distance);
    answer.add("normal", distance.normal);
    answer.add("pointA", distance.pointA);
    answer.add("pointB", distance.pointB);
    answer.add("iterations", distance.iterations);
    return {answer.take(), true};
}

int answerQueries(std::istream& in, std::ostream& out, const std::function<LineAnswer(std::string_view)>& answer) {
    bool allGood = true;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.find_first_not_of(" \t\r") == std::string::npos) { continue; }
        const LineAnswer answered = answer(line);
        out << (answered.good ? answered.text : refusalNamingTheLine(answered.text, number)) << '\n';
        allGood = allGood && answered.good;
    }
    return allGood ? 0 : 2;
}

}  // namespace swept

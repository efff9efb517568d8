#include "measured_cases.h"

#include <fstream>
#include <utility>

namespace swept::test {
namespace {

using Json = nlohmann::json;

DVec2 vectorFrom(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

void readBody(const Json& json, ToiPolygon& polygon, Sweep& sweep) {
    for (const Json& vertex : json.at("vertices")) {
        polygon.vertices[static_cast<std::size_t>(polygon.count++)] = vectorFrom(vertex);
    }
    polygon.radius = json.at("radius").get<double>();
    const Json& s = json.at("sweep");
    sweep.localCenter = vectorFrom(s.at("localCenter"));
    sweep.c0 = vectorFrom(s.at("c0"));
    sweep.c1 = vectorFrom(s.at("c1"));
    sweep.a0 = s.at("a0").get<double>();
    sweep.a1 = s.at("a1").get<double>();
}

}  // namespace

std::vector<MeasuredCase> readMeasuredCases() {
    std::ifstream cases(SWEPT_TOI_DATA "/toi_cases.jsonl");
    std::ifstream truths(SWEPT_TOI_DATA "/toi_truth.jsonl");
    std::vector<MeasuredCase> result;
    std::string line;
    std::string truthLine;
    while (std::getline(cases, line) && std::getline(truths, truthLine)) {
        const Json json = Json::parse(line);
        MeasuredCase measured;
        readBody(json.at("a"), measured.query.a, measured.query.sweepA);
        readBody(json.at("b"), measured.query.b, measured.query.sweepB);
        measured.truth = Json::parse(truthLine);
        measured.id = json.at("id").get<std::string>();
        measured.family = json.at("family").get<std::string>();
        result.push_back(std::move(measured));
    }
    return result;
}

}  // namespace swept::test

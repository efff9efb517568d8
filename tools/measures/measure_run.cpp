#include "measure_run.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "conserved.h"
#include "hits.h"
#include "posed_scene.h"
#include "reference.h"

namespace swept::measures {
namespace {

void measureOverlap(const SceneDescription& scene, const Recording& recording, Values& values) {
    PosedScene posed(scene);
    double deepest = 0;
    double sum = 0;
    for (const Sample& sample : recording.samples) {
        posed.pose(sample);
        const double depth = posed.deepestOverlap();
        deepest = std::max(deepest, depth);
        sum += depth;
    }
    values[Measure::penetration] = deepest;
    values[Measure::meanPenetration] = sum / static_cast<double>(recording.samples.size());
}

double longestLoss(const RunReport& report) {
    std::map<int, double> lost;
    double longest = 0;
    for (const LostTime& entry : report.lostTime) { longest = std::max(longest, lost[entry.body] += entry.seconds); }
    return longest;
}

void measureHits(const SceneDescription& scene, const Recording& recording, Values& values) {
    int missed = 0;
    double latest = 0;
    for (const ForeseenHit& hit : foreseenHits(scene, recording)) {
        missed += hit.missed ? 1 : 0;
        latest = std::max(latest, hit.late ? hit.wait : 0);
    }
    values[Measure::missedHits] = missed;
    values[Measure::lateHits] = latest;
}

/// Samples of the same tick, one of each run.
struct Meeting {
    const Sample* mine;
    const Sample* true_;
};
std::vector<Meeting> meetings(const Recording& recording, const Recording& truth) {
    std::vector<Meeting> result;
    std::size_t k = 0;
    for (const Sample& sample : recording.samples) {
        while (k < truth.samples.size() && truth.samples[k].tick < sample.tick) { ++k; }
        if (k < truth.samples.size() && truth.samples[k].tick == sample.tick) {
            result.push_back({&sample, &truth.samples[k]});
        }
    }
    return result;
}

std::vector<std::size_t> dynamicBodies(const SceneDescription& scene) {
    std::vector<std::size_t> bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].type == SceneBodyType::dynamic) { bodies.push_back(i); }
    }
    return bodies;
}

/// Farthest that a body gets from where it is at the first of some samples; along a direction, or (0, 0) in any.
template <class Get>
double wayOf(const std::vector<Meeting>& at, std::size_t first, std::size_t body, DVec2 direction, const Get& get) {
    double farthest = 0;
    const DVec2 start = get(at[first])->bodies[body].position;
    for (std::size_t i = first; i < at.size(); ++i) {
        const DVec2 way = get(at[i])->bodies[body].position - start;
        farthest = std::max(farthest, direction == DVec2{} ? length(way) : std::fabs(dot(way, direction)));
    }
    return farthest;
}

/// A body rests when it moves less than this part of its extent.
constexpr double kRest = 1.0 / 64;
/// A body stays when it moves less than this part of its extent from where it began.
constexpr double kStay = 1.0 / 16;

void measureRest(const SceneDescription& scene, const std::vector<Meeting>& at, Values& values) {
    const PlacedScene placed = place(scene);
    const auto mine = [](const Meeting& meeting) { return meeting.mine; };
    const auto truth = [](const Meeting& meeting) { return meeting.true_; };
    const DVec2 across =
        length(scene.gravity) > 0 ? (1 / length(scene.gravity)) * DVec2{scene.gravity.y, -scene.gravity.x} : DVec2{};
    const std::size_t lastQuarter = at.size() - 1 - (at.size() - 1) / 4;
    for (const std::size_t body : dynamicBodies(scene)) {
        const double extent = placed.bodies[body].extent;
        if (wayOf(at, lastQuarter, body, {}, truth) < kRest * extent) {
            const double way = wayOf(at, lastQuarter, body, {}, mine);
            values[Measure::restingDrift] = std::fmax(values[Measure::restingDrift], way);
        }
        if (across != DVec2{} && wayOf(at, 0, body, {}, truth) < kStay * extent) {
            const double way = wayOf(at, 0, body, across, mine);
            values[Measure::stackSway] = std::fmax(values[Measure::stackSway], way);
        }
    }
}

std::map<int, double> firstHits(const SceneDescription& scene, const Recording& recording) {
    std::map<int, double> first;
    for (const ForeseenHit& hit : foreseenHits(scene, recording)) { first.try_emplace(hit.body, hit.time); }
    return first;
}

/// NaN when nothing is hit in either run. A hit that only one of them has counts from its time to the end.
double eventTimeError(const SceneDescription& scene, const Recording& recording, const Recording& truth) {
    const std::map<int, double> mine = firstHits(scene, recording);
    const std::map<int, double> theirs = firstHits(scene, truth);
    double worst = mine.empty() && theirs.empty() ? std::nan("") : 0;
    const auto compare = [&](const std::map<int, double>& one, const std::map<int, double>& other) {
        for (const auto& [body, time] : one) {
            const auto found = other.find(body);
            worst = std::max(worst, std::fabs((found == other.end() ? truth.duration() : found->second) - time));
        }
    };
    compare(mine, theirs);
    compare(theirs, mine);
    return worst;
}

}  // namespace

Values measuredAlone(const SceneDescription& scene, const Recording& recording) {
    Values values;
    measureOverlap(scene, recording, values);
    if (!scene.joints.empty()) { values[Measure::jointError] = recording.report.largestJointError; }
    measureConserved(scene, recording, values);
    measureHits(scene, recording, values);
    if (!recording.report.counters.empty() && recording.report.counters.front().name != "brokenJoints") {
        values[Measure::lostTime] = longestLoss(recording.report);  // other engines keep no such book
    }
    return values;
}

Values measuredAgainst(const SceneDescription& scene, const Recording& recording, const Recording& truth,
                       bool truthHasPositionsOnly) {
    Values values;
    const std::vector<Meeting> at = meetings(recording, truth);
    for (const Meeting& meeting : at) {
        for (const std::size_t body : dynamicBodies(scene)) {
            const double away = length(meeting.mine->bodies[body].position - meeting.true_->bodies[body].position);
            values[Measure::position] = std::fmax(values[Measure::position], away);
        }
    }
    if (at.size() > 1) { measureRest(scene, at, values); }
    if (!truthHasPositionsOnly) { values[Measure::eventTime] = eventTimeError(scene, recording, truth); }
    return values;
}

Values measured(const SceneDescription& scene, const Recording& recording, const Reference& reference) {
    if (!recording.isComplete()) { return {}; }
    Values values = measuredAlone(scene, recording);
    if (!reference.recording.isComplete()) { return values; }
    const Values against = measuredAgainst(scene, recording, reference.recording, reference.isClosedForm);
    for (const MeasureInfo& info : allMeasures()) {
        const Measure measure = *measureNamed(info.name);
        if (info.needsReference) { values[measure] = against[measure]; }
    }
    return values;
}

}  // namespace swept::measures

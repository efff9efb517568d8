#include "toi_anatomy.h"

#include <algorithm>

namespace swept {
namespace {

constexpr int kSamples = 400;  // of the truth
constexpr int kLevels = 80;    // of a bound

class Diary final : public ToiObserver {
public:
    std::vector<ToiStep> steps;
    void onStep(const ToiStep& step) override { steps.push_back(step); }
};

std::vector<ToiStep> stepsOf(ToiQuery query, ToiMethod method) {
    Diary diary;
    query.settings.observer = &diary;
    timeOfImpactBy(method, query.a, query.sweepA, query.b, query.sweepB, query.settings);
    return diary.steps;
}

/// From the look down to where the step goes, level by level. Close together near the look, where the bound is steep or
/// flat as the motion is.
std::vector<ToiAnatomy::Point> boundFrom(const ToiQuery& q, const ToiStep& step) {
    std::vector<ToiAnatomy::Point> bound{{step.fraction, step.separation}};
    const double lowest = q.settings.target - 0.5 * q.settings.tolerance;
    for (int i = 1; i <= kLevels; ++i) {
        const double part = static_cast<double>(i) / kLevels;
        const double level = step.separation + (lowest - step.separation) * part * part;
        const double until = certainUntil(q.a, q.sweepA, q.b, q.sweepB, q.settings, step.fraction, level);
        if (until >= q.settings.tMax) {
            bound.push_back({q.settings.tMax, level});
            break;
        }
        if (until > bound.back().fraction) { bound.push_back({until, level}); }
    }
    return bound;
}

}  // namespace

ToiAnatomy dissectToi(const ToiQuery& query) {
    ToiAnatomy anatomy;
    anatomy.query = query;
    anatomy.answer = timeOfImpact(query.a, query.sweepA, query.b, query.sweepB, query.settings);
    for (const ToiStep& step : stepsOf(query, ToiMethod::certified)) {
        anatomy.looks.push_back({step, boundFrom(query, step)});
    }
    for (int i = 0; i <= kSamples; ++i) {
        const double fraction = query.settings.tMax * i / kSamples;
        anatomy.truth.push_back(
            {fraction, separationAt(query.a, query.sweepA, query.b, query.sweepB, fraction).separation});
    }
    for (const ToiStep& step : stepsOf(query, ToiMethod::conservativeAdvancement)) {
        anatomy.plainLooks.push_back(step.fraction);
    }
    return anatomy;
}

}  // namespace swept

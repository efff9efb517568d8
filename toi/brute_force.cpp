#include "brute_force.h"

#include "feature_curves.h"
#include "method_pair.h"

namespace swept {
namespace {

/// The earliest contact found so far.
class Earliest {
public:
    Earliest(double limit, EvaluationBudget& budget) : fraction_(limit), budget_(budget) {}

    template <class Curve>
    void consider(const Curve& curve) {
        const auto root = RootSearch<Curve>(curve, budget_).earliest(0, fraction_);
        if (!root) { return; }
        fraction_ = *root;
        found_ = true;
    }
    double fraction() const { return fraction_; }
    bool found() const { return found_; }

private:
    double fraction_;
    bool found_ = false;
    EvaluationBudget& budget_;
};

void considerEdgesOf(const FeatureFrame& frame, Earliest& earliest) {
    const int edges = frame.owner.polygon.count < 2 ? 0 : frame.owner.polygon.count;
    for (int edge = 0; edge < edges; ++edge) {
        for (int vertex = 0; vertex < frame.other.polygon.count; ++vertex) {
            earliest.consider(VertexEdgeCurve(frame, edge, vertex));
        }
    }
}

void considerVertices(const FeatureFrame& frame, Earliest& earliest) {
    for (int own = 0; own < frame.owner.polygon.count; ++own) {
        for (int other = 0; other < frame.other.polygon.count; ++other) {
            earliest.consider(VertexVertexCurve(frame, own, other));
        }
    }
}

}  // namespace

Toi bruteForce(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
               const ToiSettings& settings) {
    const MethodPair pair(a, sweepA, b, sweepB);
    SimplexCache cache;
    const MethodPose start = pair.poseAt(0, cache);
    if (const auto atStart = answerAtStart(start, sweepA, settings)) { return *atStart; }

    constexpr double kResolutionRatio = 1.0 / 16;  // of the tolerance: what counts as touching without crossing
    FeatureFrame ofA{pair.a, pair.b, pair.motion};
    ofA.level = settings.target + pair.radii();
    ofA.resolution = kResolutionRatio * settings.tolerance;
    ofA.farthest = pair.motion.farthestWithin(0, settings.tMax);
    ofA.fastest = pair.motion.fastestWithin(0, settings.tMax);
    const FeatureFrame ofB = swapped(ofA);
    EvaluationBudget budget{kMaxBruteForceEvaluations, 0};
    Earliest earliest(settings.tMax, budget);
    considerEdgesOf(ofA, earliest);
    considerEdgesOf(ofB, earliest);
    considerVertices(ofA, earliest);

    if (budget.exhausted()) { return answerFrom(start, sweepA, settings, ToiState::failed, budget.spent); }
    const MethodLook before{start.fraction, start.distance.distance};
    const MethodPose end = pair.poseAt(earliest.fraction(), cache);
    return earliest.found() ? hitAfter(before, end, sweepA, settings, budget.spent)
                            : answerFrom(end, sweepA, settings, ToiState::separated, budget.spent);
}

}  // namespace swept

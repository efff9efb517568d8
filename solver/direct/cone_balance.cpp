#include "cone_balance.h"

#include <algorithm>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Damping, as part of the trace of the matrix: where all three unknowns are fixed, so little that one step does.
constexpr double kFirstDamping = 1.0 / (1 << 20);
constexpr double kLeastDamping = 1.0 / (1 << 24);
constexpr double kMoreDamping = 16;
constexpr double kLessDamping = 1.0 / 8;
/// Pieces change a few times where a body is carried; one that is about to fall goes on for ever.
constexpr int kMostSteps = 24;
/// A step that leaves so much less is right, even if the value of the function is lost in rounding.
constexpr double kGoodStep = 0.5;

double largestOf(const std::array<double, 3>& left) {
    return std::max({std::fabs(left[0]), std::fabs(left[1]), std::fabs(left[2])});
}

}  // namespace

ConeBalance::Trial ConeBalance::trialAt(const Wrench& load, const Triple& at) const {
    Trial trial{at, {load.force.x, load.force.y, turns_ ? load.twist : 0}, 0};
    trial.value = at[0] * trial.left[0] + at[1] * trial.left[1] + at[2] * trial.left[2];
    for (const Edge& edge : edges_) {
        const Wrench& way = edge.direction;
        const double twist = turns_ ? way.twist : 0;
        const double part = edge.before + way.force.x * at[0] + way.force.y * at[1] + twist * at[2];
        if (!(part > 0)) { continue; }
        trial.value += 0.5 * part * part;
        trial.left[0] += part * way.force.x;
        trial.left[1] += part * way.force.y;
        trial.left[2] += part * twist;
    }
    return trial;
}

/// @return false: nothing pushes
bool ConeBalance::findStep(const Trial& trial, double damping, Triple& step) const {
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double xz = 0;
    double yz = 0;
    double zz = 0;
    double trace = 0;
    for (const Edge& edge : edges_) {
        const Wrench& way = edge.direction;
        const double x = way.force.x;
        const double y = way.force.y;
        const double z = turns_ ? way.twist : 0;
        trace += x * x + y * y + z * z;
        if (edge.before + x * trial.at[0] + y * trial.at[1] + z * trial.at[2] < 0) { continue; }
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
        zz += z * z;
    }
    if (!(trace > 0)) { return false; }
    // LDLᵀ.
    const double d0 = xx + damping * trace;
    const double l10 = xy / d0;
    const double l20 = xz / d0;
    const double d1 = std::max(yy - l10 * xy, 0.0) + damping * trace;
    const double rest = yz - l20 * xy;
    const double l21 = rest / d1;
    const double d2 = std::max(zz - l20 * xz - l21 * rest, 0.0) + damping * trace;
    const double b0 = -trial.left[0];
    const double b1 = -trial.left[1] - l10 * b0;
    const double b2 = -trial.left[2] - l20 * b0 - l21 * b1;
    step[2] = b2 / d2;
    step[1] = b1 / d1 - l21 * step[2];
    step[0] = b0 / d0 - l10 * step[1] - l20 * step[2];
    return true;
}

double ConeBalance::solve(const Wrench& load, bool turns, double wanted) {
    turns_ = turns;
    Trial best = trialAt(load, {});
    double damping = kFirstDamping;
    for (int i = 0; i < kMostSteps && largestOf(best.left) > wanted; ++i) {
        Triple step{};
        if (!findStep(best, damping, step)) { break; }
        const Trial next = trialAt(load, {best.at[0] + step[0], best.at[1] + step[1], best.at[2] + step[2]});
        if (next.value < best.value || largestOf(next.left) <= kGoodStep * largestOf(best.left)) {
            best = next;
            damping = std::max(kLessDamping * damping, kLeastDamping);
        } else {
            damping *= kMoreDamping;
        }
    }
    for (Edge& edge : edges_) {
        const Wrench& way = edge.direction;
        const double twist = turns_ ? way.twist : 0;
        edge.part =
            std::max(edge.before + way.force.x * best.at[0] + way.force.y * best.at[1] + twist * best.at[2], 0.0);
    }
    return largestOf(best.left);
}

}  // namespace swept::inline SWEPT_PRECISION

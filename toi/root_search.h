#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace swept {

/// A function of the fraction at one place.
struct CurveSample {
    double fraction = 0;
    double value = 0;
    double rate = 0;  ///< first derivative
};

/// Evaluations that a search may still spend; shared by all searches of one query.
struct EvaluationBudget {
    int left = 0;
    int spent = 0;
    bool exhausted() const { return left <= 0; }
};

/// Isolates the roots of a curve in an interval, earliest first, and returns the first that the curve accepts.
///
/// With M a bound on |second derivative| and h the length of an interval, the curve leaves its chord by at most M·h²/8:
/// no root where both ends are farther from 0 than that, on one side. Where the slope in the middle exceeds M·h/2, the
/// curve is monotone and the signs at the ends tell whether there is one root. Else the interval is halved. Halving
/// ends where M·h²/8 is down to half the resolution: the curve touches 0 as nearly as anybody asked, and that is a
/// root.
///
/// `Curve` has `CurveSample at(double fraction)`, `double bend()` (M), `double resolution()` (in units of the value)
/// and `bool accepts(double fraction)`.
template <class Curve>
class RootSearch {
public:
    RootSearch(const Curve& curve, EvaluationBudget& budget) : curve_(curve), budget_(budget) {}

    /// Nothing also when the budget ran out: look there before trusting it.
    std::optional<double> earliest(double from, double to) {
        const CurveSample start = sample(from);
        // At the level already, on either side of it by rounding: what leads away from here may have no other root.
        if (std::fabs(start.value) <= curve_.resolution() && !isOutside(start) && curve_.accepts(from)) { return from; }
        return earliestBetween(start, sample(to), kMaxHalvings);
    }

private:
    /// A fraction in [0, 1] has no finer halves than its significand has bits, and this many again below 2⁻⁵³.
    static constexpr int kMaxHalvings = 106;
    static constexpr int kMaxRefinements = 106;

    static bool isOutside(const CurveSample& s) { return s.value > 0; }

    CurveSample sample(double fraction) {
        --budget_.left;
        ++budget_.spent;
        return curve_.at(fraction);
    }

    std::optional<double> earliestBetween(const CurveSample& from, const CurveSample& to, int halvings) {
        const double span = to.fraction - from.fraction;
        const double sag = curve_.bend() * span * span / 8;
        const bool oneSide = isOutside(from) == isOutside(to);
        if (oneSide && (std::min)(std::fabs(from.value), std::fabs(to.value)) > sag) { return std::nullopt; }
        if (budget_.exhausted()) { return std::nullopt; }
        if (2 * sag <= curve_.resolution() || halvings == 0) {
            return accepted(oneSide ? nearer(from, to) : refined(from, to));
        }
        const CurveSample middle = sample(from.fraction + 0.5 * span);
        if (std::fabs(middle.rate) > 0.5 * curve_.bend() * span) {
            if (oneSide) { return std::nullopt; }
            return accepted(isOutside(middle) == isOutside(from) ? refined(middle, to) : refined(from, middle));
        }
        if (const auto root = earliestBetween(from, middle, halvings - 1)) { return root; }
        return earliestBetween(middle, to, halvings - 1);
    }

    std::optional<double> accepted(double fraction) const {
        return curve_.accepts(fraction) ? std::optional<double>(fraction) : std::nullopt;
    }

    static double nearer(const CurveSample& from, const CurveSample& to) {
        return std::fabs(to.value) < std::fabs(from.value) ? to.fraction : from.fraction;
    }

    /// The root between two samples of opposite sides: false position, with the stale end's value halved (Illinois,
    /// Dowell and Jarratt 1971), to the last digits. @return the end of the final bracket that is nearer to 0.
    double refined(CurveSample from, CurveSample to) {
        double weightFrom = from.value;
        double weightTo = to.value;
        int side = 0;
        for (int i = 0; i < kMaxRefinements; ++i) {
            const double part = weightFrom / (weightFrom - weightTo);
            const double next = from.fraction + part * (to.fraction - from.fraction);
            if (!(next > from.fraction && next < to.fraction)) { break; }
            const CurveSample found = sample(next);
            if (found.value == 0) { return next; }
            if (isOutside(found) == isOutside(from)) {
                from = found;
                weightFrom = found.value;
                if (side == 1) { weightTo /= 2; }
                side = 1;
            } else {
                to = found;
                weightTo = found.value;
                if (side == -1) { weightFrom /= 2; }
                side = -1;
            }
        }
        return nearer(from, to);
    }

    const Curve& curve_;
    EvaluationBudget& budget_;
};

}  // namespace swept

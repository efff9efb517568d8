#include "turning.h"

namespace swept::oracle {
namespace {

IntervalVec asInterval(PlainVec v) { return {v.x, v.y}; }

}  // namespace

Turning Turning::steady(double from, double to) {
    Turning turning;
    turning.plainFrom_ = from;
    turning.plainTo_ = to;
    turning.rate_ = from == to ? Interval(0) : Interval(to) - Interval(from);
    return turning;
}

Turning Turning::mixed(PlainVec from, PlainVec to) {
    Turning turning;
    turning.isSteady_ = false;
    turning.from_ = from;
    turning.to_ = to;
    turning.cross_ = Interval(from.x) * to.y - Interval(from.y) * to.x;
    return turning;
}

IntervalVec Turning::mixedAt(Interval fractions) const {
    return asInterval(from_) + fractions * (asInterval(to_) - asInterval(from_));
}

SinCos Turning::at(double fraction) const {
    if (isSteady_) { return sinCos(Interval(plainFrom_) + rate_ * Interval(fraction)); }
    constexpr Interval kAll{-1, 1};
    const IntervalVec p = mixedAt(fraction);
    const Interval size = length(p);
    if (!(size.lo > 0)) { return {kAll, kAll}; }
    return {meet(p.y / size, kAll), meet(p.x / size, kAll)};
}

Interval Turning::rateOver(Interval fractions) const {
    if (isSteady_) { return rate_; }
    const IntervalVec p = mixedAt(fractions);
    return cross_ / (square(p.x) + square(p.y));
}

Interval Turning::rateChangeOver(Interval fractions) const {
    if (isSteady_) { return 0; }
    const IntervalVec p = mixedAt(fractions);
    const IntervalVec change = asInterval(to_) - asInterval(from_);
    return -2.0 * rateOver(fractions) * dot(p, change) / (square(p.x) + square(p.y));
}

PlainVec Turning::guess(double fraction) const {
    if (isSteady_) {
        const double angle = plainFrom_ + fraction * (plainTo_ - plainFrom_);
        return {std::cos(angle), std::sin(angle)};
    }
    const PlainVec p = from_ + fraction * (to_ - from_);
    const double size = length(p);
    return size > 0 ? (1 / size) * p : PlainVec{1, 0};
}

}  // namespace swept::oracle

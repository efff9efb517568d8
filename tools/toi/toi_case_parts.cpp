#include "toi_case_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../tests/oracle/plain_separation.h"

namespace swept::cases {
namespace {

DVec2 rotated(DVec2 v, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

oracle::PlainSeparation at(const ToiQuery& q, double fraction) {
    return oracle::plainSeparation(q.a, q.sweepA, q.b, q.sweepB, fraction);
}

Sweep randomSweep(Dice& dice, const Approach& how, double size, DVec2 from, DVec2 to) {
    Sweep sweep;
    sweep.localCenter = (size * how.localCenter * dice.range(0, 1)) * direction(dice);
    sweep.c0 = from;
    sweep.c1 = to;
    sweep.k = (size * how.acceleration * dice.range(0, 1)) * direction(dice);
    sweep.a0 = dice.range(-kTurn, kTurn);
    sweep.a1 = sweep.a0 + (chance(dice, 0.2) ? 0 : kTurn * how.turns * dice.range(-1, 1));
    return sweep;
}

/// Where the separation is smallest: the best of some samples, refined by golden sections.
double nearestFraction(const ToiQuery& q) {
    constexpr int kSamples = 32;
    constexpr int kSections = 24;
    constexpr double kGolden = 0.6180339887498949;
    const double step = q.settings.tMax / kSamples;
    int best = 0;
    double least = separationAtFraction(q, 0);
    for (int i = 1; i <= kSamples; ++i) {
        const double separation = separationAtFraction(q, i * step);
        if (separation < least) {
            least = separation;
            best = i;
        }
    }
    double low = std::max(0, best - 1) * step;
    double high = std::min(kSamples, best + 1) * step;
    for (int i = 0; i < kSections; ++i) {
        const double span = high - low;
        const bool lower =
            separationAtFraction(q, high - kGolden * span) < separationAtFraction(q, low + kGolden * span);
        (lower ? high : low) = lower ? low + kGolden * span : high - kGolden * span;
    }
    return 0.5 * (low + high);
}

}  // namespace

bool chance(Dice& dice, double probability) { return dice.range(0, 1) < probability; }

int integer(Dice& dice, int low, int high) { return static_cast<int>(std::floor(dice.range(low, high + 1))); }

double logRange(Dice& dice, double low, double high) { return std::exp(dice.range(std::log(low), std::log(high))); }

double sign(Dice& dice) { return chance(dice, 0.5) ? 1 : -1; }

DVec2 direction(Dice& dice) { return rotated({1, 0}, dice.range(0, kTurn)); }

ToiPolygon randomPolygon(Dice& dice, double size, double aspect, int low, int high) {
    ToiPolygon polygon;
    polygon.count = integer(dice, low, high);
    const double phase = dice.range(0, kTurn);
    const double tilt = dice.range(0, kTurn);
    const DVec2 center{size * dice.range(-0.5, 0.5), size * dice.range(-0.5, 0.5)};
    for (int i = 0; i < polygon.count; ++i) {
        const double angle = phase + kTurn * (i + dice.range(0.1, 0.9)) / polygon.count;
        polygon.vertices[static_cast<std::size_t>(i)] =
            center + rotated({size * std::cos(angle), size * aspect * std::sin(angle)}, tilt);
    }
    if (polygon.count == 1 || chance(dice, 0.4)) { polygon.radius = size * dice.range(0.01, 0.5); }
    return polygon;
}

ToiPolygon circle(double radius) {
    ToiPolygon polygon;
    polygon.count = 1;
    polygon.radius = radius;
    return polygon;
}

ToiPolygon box(DVec2 center, DVec2 half) {
    ToiPolygon polygon;
    polygon.count = 4;
    polygon.vertices[0] = center + DVec2{-half.x, -half.y};
    polygon.vertices[1] = center + DVec2{half.x, -half.y};
    polygon.vertices[2] = center + DVec2{half.x, half.y};
    polygon.vertices[3] = center + DVec2{-half.x, half.y};
    return polygon;
}

ToiPolygon withCutCorner(Dice& dice, ToiPolygon polygon, double ratio) {
    const int corner = integer(dice, 0, polygon.count - 1);
    ToiPolygon cut = polygon;
    cut.count = polygon.count + 1;
    const auto at = [&polygon](int i) {
        return polygon.vertices[static_cast<std::size_t>((i + polygon.count) % polygon.count)];
    };
    // The corner becomes vertices 0 and 1, the others follow.
    cut.vertices[0] = at(corner) + ratio * (at(corner - 1) - at(corner));
    cut.vertices[1] = at(corner) + ratio * (at(corner + 1) - at(corner));
    for (int i = 1; i < polygon.count; ++i) { cut.vertices[static_cast<std::size_t>(i + 1)] = at(corner + i); }
    return cut;
}

void approach(Dice& dice, ToiQuery& query, double sizeA, double sizeB, const Approach& how) {
    const double both = sizeA + sizeB;
    const DVec2 start = (both * how.distance) * direction(dice);
    const DVec2 aim = (both * how.miss * dice.range(0, 1)) * direction(dice);
    const DVec2 way = aim - start;
    const double size = length(way);
    const DVec2 heading = size > 0 ? (1 / size) * way : DVec2{1, 0};
    const DVec2 along = (both * dice.range(0, 1)) * direction(dice);
    query.sweepA = randomSweep(dice, how, sizeA, {}, along);
    query.sweepB =
        randomSweep(dice, how, sizeB, start, start + along + (both * how.travel * dice.range(0, 1)) * heading);
}

void turnScene(ToiQuery& query, double angle) {
    for (Sweep* sweep : {&query.sweepA, &query.sweepB}) {
        for (DVec2* v : {&sweep->c0, &sweep->c1, &sweep->k}) { *v = rotated(*v, angle); }
        sweep->a0 += angle;
        sweep->a1 += angle;
    }
}

void drift(ToiQuery& query, DVec2 along) {
    query.sweepA.c1 += along;
    query.sweepB.c1 += along;
}

void swapBodies(ToiQuery& query) {
    std::swap(query.a, query.b);
    std::swap(query.sweepA, query.sweepB);
}

double separationAtFraction(const ToiQuery& query, double fraction) {
    return at(query, fraction).core - query.a.radius - query.b.radius;
}

void startAt(ToiQuery& query, double separation) {
    const DVec2 line = query.sweepB.c0 - query.sweepA.c0;
    const DVec2 travel = query.sweepB.c1 - query.sweepB.c0;
    double low = 0;
    double high = 2;
    for (int round = 0; round < 60; ++round) {
        const double middle = 0.5 * (low + high);
        query.sweepB.c0 = query.sweepA.c0 + middle * line;
        (separationAtFraction(query, 0) < separation ? low : high) = middle;
    }
    query.sweepB.c1 = query.sweepB.c0 + travel;
}

void passAt(ToiQuery& query, double separation) {
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
        const double fraction = nearestFraction(query);
        const oracle::PlainSeparation nearest = at(query, fraction);
        const double missing = separation - (nearest.core - query.a.radius - query.b.radius);
        const DVec2 aside{missing * nearest.axis.x, missing * nearest.axis.y};
        query.sweepB.c0 += aside;
        query.sweepB.c1 += aside;
    }
}

}  // namespace swept::cases

#include "families.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../support/random.h"

namespace swept::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A convex polygon on an ellipse; `aspect` ≤ 1 flattens it.
ToiPolygon randomPolygon(Random& random, double size, double aspect) {
    ToiPolygon polygon;
    polygon.count = random.integer(1, 8);
    if (polygon.count < 3 && random.chance(0.5)) { polygon.count += 2; }
    const double phase = random.range(0, kTurn);
    const double tilt = random.range(0, kTurn);
    const DVec2 center{size * random.range(-0.5, 0.5), size * random.range(-0.5, 0.5)};
    for (int i = 0; i < polygon.count; ++i) {
        const double angle = phase + kTurn * (i + random.range(0.1, 0.9)) / polygon.count;
        const double x = size * std::cos(angle);
        const double y = size * aspect * std::sin(angle);
        polygon.vertices[static_cast<std::size_t>(i)] =
            center + DVec2{x * std::cos(tilt) - y * std::sin(tilt), x * std::sin(tilt) + y * std::cos(tilt)};
    }
    if (polygon.count == 1 || random.chance(0.4)) { polygon.radius = size * random.range(0.01, 0.5); }
    return polygon;
}

struct Motion {
    double distance = 2;  ///< of the centres at the start, in sizes
    double travel = 3;
    double turns = 0.25;
    double aspect = 1;
    double acceleration = 0;
    double localCenter = 0.3;
};

Motion motionOf(Family family, Random& random) {
    switch (family) {
        case Family::generic:
        case Family::small:
        case Family::large:
            return {};
        case Family::bars:
            return {.distance = 1, .travel = 1, .turns = 1, .aspect = 0.05};
        case Family::manyTurns:
            return {.distance = 1.1, .travel = 0.5, .turns = 4, .aspect = 0.3};
        case Family::parabola:
            return {.travel = 2, .turns = random.chance(0.3) ? 0 : 0.3, .acceleration = 8};
        case Family::fast:
            return {.distance = 100, .travel = 300, .turns = 0.3};
        case Family::far:
            return {};
        case Family::tinyAndHuge:
            return {.distance = 1.5, .travel = 1};
        case Family::close:
            return {.distance = 2, .travel = 1};
        case Family::sliver:
            return {.travel = 4, .turns = 0.5, .aspect = std::pow(10.0, random.range(-5, -1))};
        case Family::offCenter:
            return {.distance = 3, .travel = 8, .turns = 0.5, .localCenter = 2};
    }
    return {};
}

DVec2 randomDirection(Random& random) {
    const double angle = random.range(0, kTurn);
    return {std::cos(angle), std::sin(angle)};
}

Sweep randomSweep(Random& random, const Motion& motion, double size, DVec2 from, DVec2 to) {
    Sweep sweep;
    sweep.localCenter = (size * motion.localCenter * random.uniform()) * randomDirection(random);
    sweep.c0 = from;
    sweep.c1 = to;
    sweep.k = (size * motion.acceleration * random.uniform()) * randomDirection(random);
    sweep.a0 = random.range(-kTurn, kTurn);
    sweep.a1 = sweep.a0 + (random.chance(0.2) ? 0 : kTurn * motion.turns * random.range(-1, 1));
    return sweep;
}

/// Moves B along the line of the centres until it starts at the wanted separation, if that can be had.
void startAt(Query& q, double separation) {
    const DVec2 line = q.sweepB.c0 - q.sweepA.c0;
    const DVec2 travel = q.sweepB.c1 - q.sweepB.c0;
    const auto moveTo = [&](double part) {
        q.sweepB.c0 = q.sweepA.c0 + part * line;
        q.sweepB.c1 = q.sweepB.c0 + travel;
        return static_cast<double>(trueSeparation(q, 0));
    };
    double low = 0;
    double high = 2;
    for (int round = 0; round < 60; ++round) {
        const double middle = 0.5 * (low + high);
        (moveTo(middle) < separation ? low : high) = middle;
    }
}

}  // namespace

std::string_view nameOf(Family family) {
    switch (family) {
        case Family::generic:
            return "generic";
        case Family::bars:
            return "bars";
        case Family::manyTurns:
            return "manyTurns";
        case Family::parabola:
            return "parabola";
        case Family::fast:
            return "fast";
        case Family::far:
            return "far";
        case Family::tinyAndHuge:
            return "tinyAndHuge";
        case Family::small:
            return "small";
        case Family::large:
            return "large";
        case Family::close:
            return "close";
        case Family::sliver:
            return "sliver";
        case Family::offCenter:
            return "offCenter";
    }
    return "";
}

Query randomQuery(Family family, std::uint64_t seed) {
    Random random(seed * kFamilies.size() + static_cast<std::uint64_t>(family));
    const Motion motion = motionOf(family, random);
    const double unit = family == Family::small ? 1e-9 : family == Family::large ? 1e9 : 1;
    const double sizeA = unit;
    const double sizeB =
        family == Family::tinyAndHuge ? std::pow(10.0, random.range(-5, -2)) : unit * random.range(0.2, 1);
    const double both = sizeA + sizeB;

    Query q;
    q.a = randomPolygon(random, sizeA, motion.aspect);
    q.b = randomPolygon(random, sizeB, motion.aspect);
    // B starts at the rim of a circle and heads for a point near the centre; both bodies drift.
    const DVec2 start = (both * motion.distance) * randomDirection(random);
    const DVec2 aim = (both * random.range(0, 0.7)) * randomDirection(random);
    const DVec2 heading = (1 / length(aim - start)) * (aim - start);
    const DVec2 drift = (both * random.uniform()) * randomDirection(random);
    const DVec2 origin = family == Family::far ? 1e6 * randomDirection(random) : DVec2{};
    q.sweepA = randomSweep(random, motion, sizeA, origin, origin + drift);
    q.sweepB = randomSweep(random, motion, sizeB, origin + start,
                           origin + start + drift + (both * motion.travel * random.uniform()) * heading);
    q.settings = defaultToiSettings(q.a, q.b);
    if (random.chance(0.3)) { q.settings.tolerance /= 64; }
    if (random.chance(0.2)) { q.settings.tMax = random.range(0.1, 1); }
    if (family == Family::close) { startAt(q, q.settings.target + q.settings.tolerance * random.range(-3, 3)); }
    return q;
}

}  // namespace swept::test

#include "oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace swept::test {
namespace {

using Long = long double;

struct Point {
    Long x = 0;
    Long y = 0;
};

Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Long dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
Long cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Long length(Point a) { return std::sqrt(dot(a, a)); }

struct Placed {
    std::array<Point, 8> points{};
    int count = 0;

    Point at(int i) const { return points[static_cast<std::size_t>(i % count)]; }
};

/// World coordinates minus `origin`, which keeps long double's precision for the difference.
Placed place(const ToiPolygon& polygon, const Sweep& s, double fraction, DVec2 origin) {
    const Long t = fraction;
    const Long angle = static_cast<Long>(s.a0) + t * (static_cast<Long>(s.a1) - s.a0);
    const Long c = std::cos(angle);
    const Long sn = std::sin(angle);
    const auto along = [t](Long c0, Long c1, Long k, Long from) {
        return (c0 - from) + t * (c1 - c0) + t * (t - 1) * k;
    };
    const Point center{along(s.c0.x, s.c1.x, s.k.x, origin.x), along(s.c0.y, s.c1.y, s.k.y, origin.y)};
    Placed result;
    result.count = polygon.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        const Long x = static_cast<Long>(polygon.vertices[i].x) - s.localCenter.x;
        const Long y = static_cast<Long>(polygon.vertices[i].y) - s.localCenter.y;
        result.points[i] = {center.x + c * x - sn * y, center.y + sn * x + c * y};
    }
    return result;
}

/// Smallest distance of a vertex of `p` from an edge of `q`.
Long nearest(const Placed& p, const Placed& q) {
    Long best = std::numeric_limits<Long>::infinity();
    for (int i = 0; i < p.count; ++i) {
        for (int j = 0; j < q.count; ++j) {
            const Point edge = q.at(j + 1) - q.at(j);
            const Point to = p.at(i) - q.at(j);
            const Long square = dot(edge, edge);
            const Long s = square > 0 ? std::clamp<Long>(dot(to, edge) / square, 0, 1) : 0;
            best = std::min(best, length({to.x - s * edge.x, to.y - s * edge.y}));
        }
    }
    return best;
}

/// Largest separation along the normals of the edges of `p` (both sides of a segment).
Long separationByEdges(const Placed& p, const Placed& q) {
    Long best = -std::numeric_limits<Long>::infinity();
    for (int i = 0; p.count > 1 && i < p.count; ++i) {
        const Point edge = p.at(i + 1) - p.at(i);
        const Long size = length(edge);
        Long own = -std::numeric_limits<Long>::infinity();
        Long other = std::numeric_limits<Long>::infinity();
        for (int j = 0; j < p.count; ++j) { own = std::max(own, -cross(edge, p.at(j) - p.at(i)) / size); }
        for (int j = 0; j < q.count; ++j) { other = std::min(other, -cross(edge, q.at(j) - p.at(i)) / size); }
        best = std::max(best, other - own);
    }
    return best;
}

Long coreSeparation(const Placed& a, const Placed& b) {
    const Long byEdges = std::max(separationByEdges(a, b), separationByEdges(b, a));
    const Long apart = std::min(nearest(a, b), nearest(b, a));
    // Apart when some edge shows it; lines without area touch at most, except where they cross.
    return byEdges > 0 || std::isinf(byEdges) || apart == 0 ? apart : std::min<Long>(byEdges, 0);
}

/// No point of the pair moves faster than this relative to the other body, per unit of fraction.
Long greatestSpeed(const Query& q) {
    const auto reach = [](const ToiPolygon& polygon, const Sweep& s) {
        double far = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
            far = std::max(far, swept::length(polygon.vertices[i] - s.localCenter));
        }
        return far * std::fabs(s.a1 - s.a0);
    };
    const DVec2 straight = (q.sweepB.c1 - q.sweepA.c1) - (q.sweepB.c0 - q.sweepA.c0);
    return swept::length(straight) + swept::length(q.sweepA.k) + swept::length(q.sweepB.k) + reach(q.a, q.sweepA) +
           reach(q.b, q.sweepB);
}

/// What a world coordinate of the answer may be off by.
double coordinateSlack(const Query& q) {
    double largest = 0;
    for (const Sweep* s : {&q.sweepA, &q.sweepB}) {
        largest += swept::length(s->c0) + swept::length(s->c1) + swept::length(s->k) + swept::length(s->localCenter);
    }
    return 8 * std::numeric_limits<double>::epsilon() * largest;
}

::testing::AssertionResult failure(const std::string& what, Long got, Long wanted) {
    return ::testing::AssertionFailure() << what << ": " << static_cast<double>(got) << " against "
                                         << static_cast<double>(wanted);
}

::testing::AssertionResult reportsTheTruth(const Query& q, const Toi& toi) {
    const Long separation = trueSeparation(q, toi.fraction);
    const double rounding = q.settings.tolerance / 2;
    if (!(std::fabs(toi.separation - separation) <= rounding)) {
        return failure("reported separation", toi.separation, separation);
    }
    if (!(std::fabs(swept::length(toi.normal) - 1) < 1e-14)) { return failure("normal", swept::length(toi.normal), 1); }
    const DVec2 between = toi.pointB - toi.pointA;
    const DVec2 wrong = between - toi.separation * toi.normal;
    if (toi.state != ToiState::overlapped && !(swept::length(wrong) <= rounding + coordinateSlack(q))) {
        return failure("witness points", swept::length(wrong), 0);
    }
    return ::testing::AssertionSuccess();
}

}  // namespace

long double trueCoreSeparation(const Query& q, double fraction) {
    const DVec2 origin = q.sweepA.c0;
    return coreSeparation(place(q.a, q.sweepA, fraction, origin), place(q.b, q.sweepB, fraction, origin));
}

long double trueSeparation(const Query& q, double fraction) {
    return trueCoreSeparation(q, fraction) - q.a.radius - q.b.radius;
}

::testing::AssertionResult keepsItsPromise(const Query& q, const Toi& toi) {
    const Long lowest = static_cast<Long>(q.settings.target) - q.settings.tolerance;
    const Long highest = static_cast<Long>(q.settings.target) + q.settings.tolerance;
    if (toi.state == ToiState::failed) { return ::testing::AssertionFailure() << "failed at " << toi.fraction; }
    if (toi.fraction < 0 || toi.fraction > q.settings.tMax) { return failure("fraction", toi.fraction, 0); }
    if (const auto truth = reportsTheTruth(q, toi); !truth) { return truth; }
    if (toi.state == ToiState::overlapped) {
        const Long core = trueCoreSeparation(q, 0);
        return toi.fraction == 0 && core <= q.settings.tolerance / 4 ? ::testing::AssertionSuccess()
                                                                     : failure("overlapped", core, 0);
    }
    const bool hit = toi.state == ToiState::hit;
    const Long there = trueSeparation(q, toi.fraction);
    if (hit && there > highest) { return failure("hit too early", there, highest); }
    if (hit && there < lowest && toi.fraction > 0) { return failure("hit too late", there, lowest); }
    if (!hit && toi.fraction != q.settings.tMax) { return failure("separated before", toi.fraction, q.settings.tMax); }
    if (hit && toi.fraction == 0) { return ::testing::AssertionSuccess(); }

    const Long speed = greatestSpeed(q);
    const Long smallestStep = static_cast<Long>(toi.fraction) / 3000;
    for (Long t = 0; t < toi.fraction;) {
        const Long separation = trueSeparation(q, static_cast<double>(t));
        if (separation < lowest) { return failure("passed at " + std::to_string(t), separation, lowest); }
        t += std::max((separation - lowest) / speed, smallestStep);
    }
    return ::testing::AssertionSuccess();
}

Query withoutRotation(Query query) {
    query.sweepA.a1 = query.sweepA.a0;
    query.sweepB.a1 = query.sweepB.a0;
    return query;
}

std::ostream& operator<<(std::ostream& out, const Query& query) {
    const auto body = [&out](const ToiPolygon& polygon, const Sweep& s) {
        out << "\n  radius " << polygon.radius << " vertices";
        for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
            out << " (" << polygon.vertices[i].x << ", " << polygon.vertices[i].y << ')';
        }
        out << "\n  localCenter (" << s.localCenter.x << ", " << s.localCenter.y << ") c0 (" << s.c0.x << ", " << s.c0.y
            << ") c1 (" << s.c1.x << ", " << s.c1.y << ") k (" << s.k.x << ", " << s.k.y << ") a0 " << s.a0 << " a1 "
            << s.a1;
    };
    const auto digits = out.precision(17);
    body(query.a, query.sweepA);
    body(query.b, query.sweepB);
    out << "\n  target " << query.settings.target << " tolerance " << query.settings.tolerance << " tMax "
        << query.settings.tMax;
    out.precision(digits);
    return out;
}

}  // namespace swept::test

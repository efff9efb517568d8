#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <swept/shapes/chain.h>

#include "chance.h"

namespace swept::chains {

inline constexpr double kQuarter = 1.5707963267948966;

inline Real real(double x) { return static_cast<Real>(x); }
inline Vec2 real(DVec2 v) { return {real(v.x), real(v.y)}; }
inline double decade(Chance& chance, double least, double most) { return std::pow(10, chance.range(least, most)); }

/// Convex, concave, flat, or nearly so.
inline double someCorner(Chance& chance) {
    switch (chance.below(6)) {
        case 0:
            return 0;
        case 1:
            return chance.range(-2e-3, 2e-3);
        case 2:
            return chance.below(2) == 0 ? kQuarter : -kQuarter;
        default:
            return chance.range(-1.5, 1.5);
    }
}

inline Polygon someShape(Chance& chance, double size) {
    const Real radius = chance.below(2) == 0 ? Real(0) : real(size * chance.range(0, 0.5));
    const Real half = real(size * chance.range(0.2, 1));
    switch (chance.below(4)) {
        case 0:
            return makeCircle({real(size * chance.range(-0.2, 0.2)), 0}, real(size)).value();
        case 1:
            return makeSegment({-half, 0}, {half, 0}, radius).value();
        case 2:
            return makeBox({half, real(size * chance.range(0.2, 1))}, {}, 0, radius).value();
        default: {
            std::vector<Vec2> corners;
            const int count = 3 + chance.below(6);
            for (int i = 0; i < count; ++i) {
                const double angle = 4 * kQuarter * (i + chance.range(0, 0.4)) / count;
                corners.push_back(real(size * DVec2{std::cos(angle), std::sin(angle)}));
            }
            return makePolygon(corners, radius).value();
        }
    }
}

/// What a chain segment is asked.
struct ChainQuery {
    ChainSegment segment;
    Polygon shape;
    Transform pose;
    Real margin = 0;
};

/// Over the segment or beside it; above, touching, nearly so, on both sides, or behind it.
inline ChainQuery someChainQuery(Chance& chance) {
    ChainQuery query;
    const double length = decade(chance, -1, 1);
    const double size = decade(chance, -1, 1);
    const double angle = chance.below(3) == 0 ? kQuarter * chance.below(4) : chance.range(0, 6.3);
    const auto along = [](double turned) { return DVec2{std::cos(turned), std::sin(turned)}; };
    const DVec2 start = chance.below(2) == 0 ? DVec2{} : DVec2{chance.range(-5, 5), chance.range(-5, 5)};
    const DVec2 end = start + length * along(angle);
    ChainSegment& s = query.segment;
    s.p = real(start);
    s.q = real(end);
    s.before = real(start - decade(chance, -1, 1) * along(angle - someCorner(chance)));
    s.after = real(end + decade(chance, -1, 1) * along(angle + someCorner(chance)));
    s.hasBefore = chance.below(5) > 0;
    s.hasAfter = chance.below(5) > 0;
    s.radius = chance.below(3) > 0 ? Real(0) : real(length * chance.range(0, 0.2));

    query.shape = someShape(chance, size);
    const double turn = chance.below(3) == 0 ? chance.range(0, 6.3) : angle + kQuarter * chance.below(4);
    const double tilt = chance.below(2) == 0 ? 0 : chance.range(-1, 1) * decade(chance, -9, -2);
    query.pose.rotation = rotationFromAngle(turn + tilt);
    const DVec2 up{std::sin(angle), -std::cos(angle)};
    double lowest = size;
    for (const Vec2 v : query.shape.points()) {
        lowest = std::min(lowest, dot(up, toDouble(rotate(query.pose.rotation, v))));
    }
    const double radii = static_cast<double>(s.radius) + static_cast<double>(query.shape.radius);
    const double off = chance.range(-1, 1) * size * decade(chance, -17, -1);
    const std::array<double, 4> heights{chance.range(-1, 3) * size, radii - lowest, radii - lowest + off, off - lowest};
    const DVec2 over = start + chance.range(-1.5, 2.5) * length * along(angle);
    query.pose.translation = real(over + heights[static_cast<std::size_t>(chance.below(4))] * up);
    query.margin = chance.below(4) == 0 ? Real(0) : real(size * chance.range(0, 0.3));
    return query;
}

}  // namespace swept::chains

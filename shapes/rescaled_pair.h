#pragma once

#include <cmath>
#include <initializer_list>
#include <type_traits>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Double coordinates so large or small that products of four of them leave the range of double are brought near 1 by a
/// power of two first, and the answer is scaled back. Only the cores are scaled: the copies have radius 0, since radii
/// are merely added at the end. Float coordinates never need it: all products are taken in double.
class RescaledPair {
public:
    /// @param more  further points in the frame of A that take part in the query.
    RescaledPair(const Polygon& a, const Polygon& b, const Transform& bInA, std::initializer_list<Vec2> more = {})
        : a_(a), b_(b), bInA_(bInA) {
        if constexpr (std::is_same_v<Real, double>) {
            const double largest = largestCoordinate(more);
            if (largest > kLargest || (largest < 1 / kLargest && largest > 0)) {
                std::frexp(largest, &exponent_);
                ++exponent_;  // a power of two above every sum of two coordinates
            }
        }
    }

    bool isNeeded() const { return exponent_ != 0; }
    Polygon a() const { return scaled(a_); }
    Polygon b() const { return scaled(b_); }
    Transform bInA() const { return {scaled(bInA_.translation), bInA_.rotation}; }
    /// A length or coordinate; at most the largest finite value.
    Real scaled(Real x) const {
        constexpr Real kMost = (std::numeric_limits<Real>::max)();
        const Real y = std::ldexp(x, -exponent_);
        return y > kMost ? kMost : y;
    }
    Vec2 scaled(Vec2 v) const { return {scaled(v.x), scaled(v.y)}; }

    /// Back to the scale of the input; beyond the range of double, its largest finite value.
    double restored(double x) const {
        constexpr double kMost = (std::numeric_limits<double>::max)();
        const double y = std::ldexp(x, exponent_);
        return y > kMost ? kMost : (y < -kMost ? -kMost : y);
    }
    DVec2 restored(DVec2 v) const { return {restored(v.x), restored(v.y)}; }

private:
    static constexpr double kLargest = 0x1p200;

    double largestCoordinate(std::initializer_list<Vec2> more) const {
        Vec2 most = (max)(bInA_.translation, -bInA_.translation);
        for (const Polygon* p : {&a_, &b_}) {
            for (const Vec2& v : p->points()) { most = (max)(most, (max)(v, -v)); }
        }
        for (const Vec2& v : more) { most = (max)(most, (max)(v, -v)); }
        return static_cast<double>(most.x > most.y ? most.x : most.y);
    }
    Polygon scaled(const Polygon& p) const {
        Polygon q = p;
        for (Vec2& v : q.vertices) { v = scaled(v); }
        q.radius = 0;
        return q;
    }

    const Polygon& a_;
    const Polygon& b_;
    const Transform& bInA_;
    int exponent_ = 0;
};

}  // namespace swept::inline SWEPT_PRECISION

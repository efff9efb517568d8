#include "hull.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <vector>

#include "convexity.h"
#include "rescaling.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

bool lowerThenLefter(Vec2 a, Vec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

bool turnsLeft(Vec2 p, Vec2 q, Vec2 r) { return cross(toDouble(q) - toDouble(p), toDouble(r) - toDouble(q)) > 0; }

/// One side of the hull, along points sorted from its first to its last vertex; the last one is left to the other side.
template <class Iterator>
void appendSide(Iterator begin, Iterator end, std::vector<Vec2>& hull) {
    const std::size_t first = hull.size();
    for (Iterator it = begin; it != end; ++it) {
        while (hull.size() >= first + 2 && !turnsLeft(hull[hull.size() - 2], hull.back(), *it)) { hull.pop_back(); }
        hull.push_back(*it);
    }
    hull.pop_back();
}

/// Strict hull, counter-clockwise from the lowest point, of sorted points without repetitions (at least 2).
std::vector<Vec2> strictHull(const std::vector<Vec2>& sorted) {
    std::vector<Vec2> hull;
    appendSide(sorted.begin(), sorted.end(), hull);
    appendSide(sorted.rbegin(), sorted.rend(), hull);
    return hull;
}

/// Removes vertices that lie within `tolerance` of the chord of their neighbours, lowest first: removing them in order
/// around the hull instead would flatten a finely stepped arc, each vertex being close to the chord of the moment.
class Pruner {
public:
    Pruner(std::vector<Vec2> hull, double tolerance) : hull_(std::move(hull)), tolerance_(tolerance) {
        const std::size_t count = hull_.size();
        for (std::size_t i = 0; i < count; ++i) {
            next_.push_back(i + 1 < count ? i + 1 : 0);
            previous_.push_back(i > 0 ? i - 1 : count - 1);
        }
        heights_.resize(count);
        alive_.assign(count, true);
        for (std::size_t i = 0; i < count; ++i) { offer(i); }
    }

    std::vector<Vec2> run() {
        std::size_t left = hull_.size();
        while (left > 2 && !queue_.empty()) {
            const Entry lowest = queue_.top();
            queue_.pop();
            const std::size_t i = lowest.vertex;
            if (!alive_[i] || lowest.height != heights_[i]) { continue; }  // outdated
            alive_[i] = false;
            --left;
            next_[previous_[i]] = next_[i];
            previous_[next_[i]] = previous_[i];
            offer(previous_[i]);
            offer(next_[i]);
        }
        std::vector<Vec2> result;
        for (std::size_t i = 0; i < hull_.size(); ++i) {
            if (alive_[i]) { result.push_back(hull_[i]); }
        }
        return result;
    }

private:
    struct Entry {
        double height;
        std::size_t vertex;
        bool operator>(const Entry& other) const {
            return height > other.height || (height == other.height && vertex > other.vertex);
        }
    };

    void offer(std::size_t i) {
        heights_[i] = heightOver(hull_[previous_[i]], hull_[i], hull_[next_[i]]);
        if (heights_[i] <= tolerance_) { queue_.push({heights_[i], i}); }
    }

    std::vector<Vec2> hull_;
    double tolerance_;
    std::vector<std::size_t> next_;
    std::vector<std::size_t> previous_;
    std::vector<double> heights_;
    std::vector<bool> alive_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// Sorted, without repetitions, and without −0, which equals 0 and would make the result depend on the input's order.
std::vector<Vec2> sortedPoints(std::span<const Vec2> points) {
    std::vector<Vec2> sorted;
    sorted.reserve(points.size());
    for (const Vec2 point : points) { sorted.push_back(point + Vec2{}); }
    std::sort(sorted.begin(), sorted.end(), lowerThenLefter);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    return sorted;
}

/// Of what is huge or tiny, found near 1. (What is 2⁻¹⁰⁰⁰ of the largest coordinate may lose digits.)
Result<Polygon> hullOfRescaled(std::span<const Vec2> points, int exponent, Real radius) {
    std::vector<Vec2> near;
    near.reserve(points.size());
    for (const Vec2 point : points) { near.push_back(rescaled(point, -exponent)); }
    const Result<Polygon> hull = convexHull(near, 0);
    if (!hull.ok()) { return hull; }
    Polygon polygon = hull.value();
    for (Vec2& v : polygon.vertices) { v = rescaled(v, exponent); }
    const Result<Polygon> whole = makePolygon(polygon.points(), radius);
    return whole.ok() ? whole : Status{whole.status().code, "points"};
}

}  // namespace

Result<Polygon> convexHull(std::span<const Vec2> points, Real radius) {
    if (points.empty()) { return Status{StatusCode::tooFewVertices, "points"}; }
    for (const Vec2 point : points) {
        if (!isFinite(point)) { return Status{StatusCode::notFinite, "points"}; }
    }
    if (!isFinite(radius)) { return Status{StatusCode::notFinite, "radius"}; }
    if (radius < 0) { return Status{StatusCode::negative, "radius"}; }

    if (kProductsMayOverflow) {
        const double size = largestOf(points);
        if (!productsFit(size) && size > 0) { return hullOfRescaled(points, exponentOf(size), radius); }
    }
    const std::vector<Vec2> sorted = sortedPoints(points);
    if (sorted.size() < 3) { return Status{StatusCode::degenerate, "points"}; }
    std::vector<Vec2> hull = Pruner(strictHull(sorted), kSmallestHeight * sizeOf(sorted)).run();
    if (hull.size() < 3) { return Status{StatusCode::degenerate, "points"}; }
    if (hull.size() > static_cast<std::size_t>(kMaxPolygonVertices)) {
        return Status{StatusCode::tooManyVertices, "points"};
    }
    std::rotate(hull.begin(), std::min_element(hull.begin(), hull.end(), lowerThenLefter), hull.end());
    const Result<Polygon> polygon = makePolygon(hull, radius);
    if (polygon.ok()) { return polygon; }
    return Status{polygon.status().code, "points"};
}

}  // namespace swept::inline SWEPT_PRECISION

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "model.h"

/// Queries with numbers at the ends of their range, or beyond.

namespace swept::test {
namespace {

/// Each slot that `cast` shows when nothing shortens it.
template <class Cast>
std::multiset<std::uint32_t> shown(const Cast& cast) {
    std::multiset<std::uint32_t> slots;
    const auto visit = [&slots](ProxyId id, Real limit) {
        slots.insert(static_cast<std::uint32_t>(id));
        return limit;
    };
    cast(FunctionRef<Real(ProxyId, Real)>(visit));
    return slots;
}

/// Bounds of a query may be infinite, but not lower > upper; every kind finds the same, and nothing that there is not.
TEST(FarQueries, OfBoxesWithoutEndFindWhatOverlaps) {
    const Real none = std::numeric_limits<Real>::infinity();
    const Real most = std::numeric_limits<Real>::max();
    const Real bounds[] = {-none, -most, -1, Real(2.4), Real(2.5), 30, most, none};
    Random random(7);
    Model model;
    std::vector<std::unique_ptr<Broadphase>> each;
    for (const BroadphaseKind kind : kEveryKind) { each.push_back(makeBroadphase(kind)); }
    for (int i = 0; i < 21; ++i) {  // three nodes of eight, one of them not full
        const Aabb box = i == 20 ? Aabb{{-most, most}, {most, most}} : boxAround(i, i % 3, 0.5, 0.5);
        model.insert(box, ProxyKind::dynamic);
        for (const auto& broadphase : each) { ASSERT_TRUE(broadphase->insert(box, ProxyKind::dynamic).ok()); }
    }
    for (int i = 0; i < 400; ++i) {
        const auto any = [&] { return bounds[below(random, static_cast<std::uint32_t>(std::size(bounds)))]; };
        Aabb box;
        for (Real* const bound : {&box.lower.x, &box.lower.y, &box.upper.x, &box.upper.y}) { *bound = any(); }
        if (i == 0) { box = {{-none, -none}, {none, none}}; }
        const std::set<std::uint32_t> expected = model.overlapping(box);
        ASSERT_TRUE(i > 0 || expected.size() == 21U);
        for (std::size_t k = 0; k < each.size(); ++k) {
            std::multiset<std::uint32_t> found;
            std::multiset<std::uint32_t> dynamic;
            each[k]->query(box, [&](ProxyId id) {
                found.insert(static_cast<std::uint32_t>(id));
                return true;
            });
            each[k]->queryDynamic({&box, 1},
                                  [&](std::size_t, ProxyId id) { dynamic.insert(static_cast<std::uint32_t>(id)); });
            const std::multiset<std::uint32_t> wanted(expected.begin(), expected.end());
            ASSERT_EQ(found, wanted) << nameOf(kEveryKind[k]) << " case " << i;
            ASSERT_EQ(dynamic, wanted) << nameOf(kEveryKind[k]) << " case " << i;
        }
    }
}

/// Numbers whose differences overflow or whose products vanish: every kind finds what a walk over all boxes finds.
TEST(FarQueries, OfRaysAndSweepsFindWhatAWalkOverAllFinds) {
    using Limits = std::numeric_limits<Real>;
    // In f64 differences of what is farther apart overflow, and small distances over long ways are fractions that
    // vanish: there nothing tells whether boxes touch.
    constexpr bool isDouble = sizeof(Real) == sizeof(double);
    const Real most = isDouble ? Limits::max() / 8 : Limits::max();
    const double longest = isDouble ? 1 : std::numeric_limits<double>::max();
    const Real sizes[] = {0,   Limits::denorm_min(), 3 * Limits::denorm_min(), Limits::min(), 1, most / 8, most / 2,
                          most};
    std::vector<BroadphaseKind> kinds(std::begin(kEveryKind), std::end(kEveryKind));
    if (isDouble) { std::erase(kinds, BroadphaseKind::quadtree); }  // cannot halve squares of subnormal size
    Random random(9);
    const auto any = [&] {
        const Real size = sizes[below(random, static_cast<std::uint32_t>(std::size(sizes)))];
        return random.chance(0.5) ? size : -size;
    };
    const auto anyBox = [&] {
        Vec2 p;
        Vec2 q;
        for (Real* const number : {&p.x, &p.y, &q.x, &q.y}) { *number = any(); }
        return Aabb{(min)(p, q), (max)(p, q)};
    };
    int found = 0;
    for (int world = 0; world < 400; ++world) {
        std::vector<std::unique_ptr<Broadphase>> each;
        for (const BroadphaseKind kind : kinds) { each.push_back(makeBroadphase(kind)); }
        for (int i = 0; i < 12; ++i) {
            const Aabb box = anyBox();
            for (const auto& broadphase : each) { ASSERT_TRUE(broadphase->insert(box, ProxyKind::dynamic).ok()); }
        }
        for (int i = 0; i < 20; ++i) {
            const Aabb from = anyBox();
            DVec2 by;
            by.x = std::clamp(static_cast<double>(any()), -longest, longest);
            by.y = std::clamp(static_cast<double>(any()), -longest, longest);
            std::multiset<std::uint32_t> onRay;
            std::multiset<std::uint32_t> onSweep;
            for (std::size_t k = 0; k < each.size(); ++k) {
                const auto ray = shown([&](auto visit) { each[k]->ray(toDouble(from.lower), by, 1, visit); });
                const auto sweep = shown([&](auto visit) { each[k]->sweep(from, by, 1, visit); });
                if (k == 0) {
                    onRay = ray;
                    onSweep = sweep;
                }
                ASSERT_EQ(ray, onRay) << nameOf(kinds[k]) << " world " << world << " case " << i;
                ASSERT_EQ(sweep, onSweep) << nameOf(kinds[k]) << " world " << world << " case " << i;
            }
            found += static_cast<int>(onRay.size() + onSweep.size());
        }
    }
    EXPECT_GT(found, 10'000);
}

}  // namespace
}  // namespace swept::test

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

}  // namespace
}  // namespace swept::test

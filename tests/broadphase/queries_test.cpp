#include <gtest/gtest.h>

#include "model.h"

namespace swept::test {
namespace {

/// First t at which a box carried along touches another, in long double; infinite when never.
long double firstTouch(const Aabb& moving, DVec2 by, const Aabb& other) {
    const long double infinity = std::numeric_limits<long double>::infinity();
    long double enter = 0;
    long double exit = infinity;
    const auto clip = [&](long double lower, long double upper, long double speed, long double otherLower,
                          long double otherUpper) {
        if (speed == 0) {
            if (otherLower > upper || lower > otherUpper) { enter = infinity; }
            return;
        }
        const long double t0 = (otherLower - upper) / speed;
        const long double t1 = (otherUpper - lower) / speed;
        enter = std::max(enter, std::min(t0, t1));
        exit = std::min(exit, std::max(t0, t1));
    };
    clip(moving.lower.x, moving.upper.x, by.x, other.lower.x, other.upper.x);
    clip(moving.lower.y, moving.upper.y, by.y, other.lower.y, other.upper.y);
    return enter <= exit ? enter : infinity;
}

struct Filled {
    Model model;
    std::vector<std::unique_ptr<Broadphase>> each;  // of kEveryKind, all pairs first
};

Filled filled(Family family, Random& random, int count) {
    Filled all;
    for (const BroadphaseKind broadphase : kEveryKind) { all.each.push_back(makeBroadphase(broadphase)); }
    for (int i = 0; i < count; ++i) {
        const Aabb box = randomBox(family, random);
        const ProxyKind kind = randomKind(random);
        all.model.insert(box, kind);
        for (const auto& broadphase : all.each) { EXPECT_TRUE(broadphase->insert(box, kind).ok()); }
    }
    return all;
}

class Queries : public testing::TestWithParam<Family> {};

TEST_P(Queries, OfBoxesFindWhatOverlaps) {
    Random random(100 + static_cast<std::uint64_t>(GetParam()));
    const Filled all = filled(GetParam(), random, 200);
    std::size_t found = 0;
    for (int i = 0; i < 200; ++i) {
        const Aabb box = randomBox(GetParam(), random);
        const std::set<std::uint32_t> expected = all.model.overlapping(box);
        found += expected.size();
        for (const auto& broadphase : all.each) {
            std::vector<std::uint32_t> slots;
            broadphase->query(box, [&](ProxyId id) {
                slots.push_back(static_cast<std::uint32_t>(id));
                return true;
            });
            std::sort(slots.begin(), slots.end());
            ASSERT_TRUE(std::equal(slots.begin(), slots.end(), expected.begin(), expected.end())) << "case " << i;
            int visits = 0;
            broadphase->query(box, [&](ProxyId) { return ++visits < 2; });
            ASSERT_EQ(visits, static_cast<int>(std::min<std::size_t>(expected.size(), 2))) << "false ends the query";
        }
    }
    EXPECT_GT(found, 200U);
}

/// Likewise all that is dynamic, for any number of boxes at once.
TEST_P(Queries, OfManyBoxesMissNothingThatIsDynamic) {
    Random random(200 + static_cast<std::uint64_t>(GetParam()));
    const Filled all = filled(GetParam(), random, 200);
    std::size_t wanted = 0;
    for (std::size_t count = 0; count < 40; ++count) {
        std::vector<Aabb> boxes(count);
        for (Aabb& box : boxes) { box = randomBox(GetParam(), random); }
        for (const auto& broadphase : all.each) {
            std::vector<std::set<std::uint32_t>> found(count);
            broadphase->queryDynamic(boxes, [&](std::size_t index, ProxyId id) {
                ASSERT_LT(index, count);
                EXPECT_TRUE(found[index].insert(static_cast<std::uint32_t>(id)).second) << "twice, of " << count;
            });
            for (std::size_t i = 0; i < count; ++i) {
                const std::set<std::uint32_t> overlapping = all.model.overlapping(boxes[i]);
                for (const std::uint32_t slot : found[i]) { ASSERT_EQ(overlapping.count(slot), 1U) << "of " << count; }
                for (const std::uint32_t slot : overlapping) {
                    if (all.model.proxies().at(slot).kind != ProxyKind::dynamic) { continue; }
                    ASSERT_EQ(found[i].count(slot), 1U) << "of " << count;
                    ++wanted;
                }
            }
        }
    }
    EXPECT_GT(wanted, 200U);
}

/// All that is static or kinematic, and nothing that does not overlap.
TEST_P(Queries, OfGroundMissNothingThatStands) {
    Random random(300 + static_cast<std::uint64_t>(GetParam()));
    const Filled all = filled(GetParam(), random, 200);
    std::size_t standing = 0;
    for (int i = 0; i < 200; ++i) {
        const Aabb box = randomBox(GetParam(), random);
        const std::set<std::uint32_t> overlapping = all.model.overlapping(box);
        for (const auto& broadphase : all.each) {
            std::set<std::uint32_t> slots;
            broadphase->queryGround(box, [&](ProxyId id) {
                EXPECT_TRUE(slots.insert(static_cast<std::uint32_t>(id)).second) << "twice, case " << i;
                return true;
            });
            for (const std::uint32_t slot : slots) { ASSERT_EQ(overlapping.count(slot), 1U) << "case " << i; }
            for (const std::uint32_t slot : overlapping) {
                const ProxyKind kind = all.model.proxies().at(slot).kind;
                if (kind != ProxyKind::fixed && kind != ProxyKind::kinematic) { continue; }
                ASSERT_EQ(slots.count(slot), 1U) << "case " << i;
                ++standing;
            }
            int visits = 0;
            broadphase->queryGround(box, [&](ProxyId) { return ++visits < 2; });
            ASSERT_EQ(visits, static_cast<int>(std::min<std::size_t>(slots.size(), 2))) << "false ends the query";
        }
    }
    EXPECT_GT(standing, 200U);
}

/// Each slot that `cast` visits when nothing shortens it.
template <class Cast>
std::set<std::uint32_t> visited(const Cast& cast) {
    std::set<std::uint32_t> slots;
    int visits = 0;
    const auto visit = [&](ProxyId id, Real limit) {
        slots.insert(static_cast<std::uint32_t>(id));
        ++visits;
        return limit;
    };
    cast(FunctionRef<Real(ProxyId, Real)>(visit));
    EXPECT_EQ(slots.size(), static_cast<std::size_t>(visits)) << "each proxy is visited once";
    return slots;
}

/// Checks a set of visits against the long double times: all that is met for sure, nothing that is missed for sure.
void expectMatches(const Filled& all, const std::set<std::uint32_t>& slots, const Aabb& moving, DVec2 by, Real limit) {
    for (const auto& [slot, proxy] : all.model.proxies()) {
        const long double t = firstTouch(moving, by, proxy.box);
        if (t <= static_cast<long double>(limit)) {
            ASSERT_EQ(slots.count(slot), 1U) << "slot " << slot << " met at " << static_cast<double>(t);
        } else if (slots.count(slot) != 0) {
            // Only rounding can excuse it: shift the box by a few double ulps of its coordinates and it is met.
            const long double reach = std::max(
                {std::fabs(static_cast<long double>(by.x)), std::fabs(static_cast<long double>(by.y)), 1e-300L});
            const Aabb& b = proxy.box;
            long double size = 0;
            for (const Real c : {b.lower.x, b.lower.y, b.upper.x, b.upper.y, moving.lower.x, moving.lower.y,
                                 moving.upper.x, moving.upper.y}) {
                size = std::max(size, std::fabs(static_cast<long double>(c)));
            }
            const long double slack = 16 * 0x1p-52L * (size + reach);
            const Aabb wider = roundedOutward({static_cast<double>(b.lower.x) - static_cast<double>(slack),
                                               static_cast<double>(b.lower.y) - static_cast<double>(slack)},
                                              {static_cast<double>(b.upper.x) + static_cast<double>(slack),
                                               static_cast<double>(b.upper.y) + static_cast<double>(slack)});
            ASSERT_LE(firstTouch(moving, by, wider), static_cast<long double>(limit) * (1 + 1e-14L)) << "slot " << slot;
        }
    }
}

TEST_P(Queries, OfRaysAndSweepsFindWhatIsMet) {
    Random random(200 + static_cast<std::uint64_t>(GetParam()));
    const Filled all = filled(GetParam(), random, 150);
    std::size_t found = 0;
    for (int i = 0; i < 200; ++i) {
        const Aabb from = randomBox(GetParam(), random);
        const Aabb to = randomBox(GetParam(), random);
        DVec2 by = {static_cast<double>(to.lower.x) - static_cast<double>(from.lower.x),
                    static_cast<double>(to.lower.y) - static_cast<double>(from.lower.y)};
        if (i % 8 == 0) { by.x = 0; }
        if (i % 8 == 1) { by.y = 0; }
        if (i % 16 == 0) { by.y = 0; }
        const Real limit = i % 3 == 0 ? Real(1) : static_cast<Real>(random.uniform());
        const Aabb point = {from.lower, from.lower};
        const auto ray = [&](const Broadphase& broadphase) {
            return visited([&](auto visit) { broadphase.ray(toDouble(from.lower), by, limit, visit); });
        };
        const auto sweep = [&](const Broadphase& broadphase) {
            return visited([&](auto visit) { broadphase.sweep(from, by, limit, visit); });
        };
        const std::set<std::uint32_t> onRay = ray(*all.each[0]);
        const std::set<std::uint32_t> onSweep = sweep(*all.each[0]);
        for (const auto& broadphase : all.each) {
            ASSERT_EQ(onRay, ray(*broadphase)) << "case " << i;
            ASSERT_EQ(onSweep, sweep(*broadphase)) << "case " << i;
        }
        expectMatches(all, onRay, point, by, limit);
        expectMatches(all, onSweep, from, by, limit);
        if (HasFatalFailure()) { FAIL() << GetParam() << " case " << i; }
        found += onRay.size() + onSweep.size();
    }
    EXPECT_GT(found, 200U);
}

TEST_P(Queries, OfRaysShortenedByTheVisitorEndAtTheNearest) {
    Random random(300 + static_cast<std::uint64_t>(GetParam()));
    const Filled all = filled(GetParam(), random, 150);
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
        const Aabb from = randomBox(GetParam(), random);
        const DVec2 by = {random.range(-50, 50), random.range(-50, 50)};
        long double nearest = std::numeric_limits<long double>::infinity();
        for (const auto& [slot, proxy] : all.model.proxies()) {
            nearest = std::min(nearest, firstTouch(from, by, proxy.box));
        }
        for (const auto& broadphase : all.each) {
            Real best = 2;
            broadphase->sweep(from, by, 1, [&](ProxyId id, Real limit) {
                const auto t = static_cast<Real>(firstTouch(from, by, broadphase->box(id)));
                if (t <= limit) { best = std::min(best, t); }
                return std::min(limit, t);
            });
            if (nearest <= 1) {
                ASSERT_EQ(best, static_cast<Real>(nearest)) << "case " << i;
                ++hits;
            } else {
                ASSERT_EQ(best, Real(2)) << "case " << i;
            }
        }
    }
    EXPECT_GT(hits, 100);
}

/// A ray of no length, or one that ends where it begins, meets all that is there.
TEST_P(Queries, OfRaysAndSweepsUpToTheStartFindWhatIsThere) {
    Random random(400 + static_cast<std::uint64_t>(GetParam()));
    const Filled all = filled(GetParam(), random, 150);
    std::size_t found = 0;
    for (int i = 0; i < 100; ++i) {
        const Aabb from = randomBox(GetParam(), random);
        const Aabb point = {from.lower, from.lower};
        const DVec2 by = i % 3 == 0 ? DVec2{} : DVec2{random.range(-50, 50), random.range(-50, 50)};
        const Real limit = i % 3 == 0 ? static_cast<Real>(i % 2) : Real(0);
        const std::set<std::uint32_t> atPoint = all.model.overlapping(point);
        const std::set<std::uint32_t> atBox = all.model.overlapping(from);
        for (std::size_t k = 0; k < all.each.size(); ++k) {
            const Broadphase& broadphase = *all.each[k];
            const auto onRay = visited([&](auto visit) { broadphase.ray(toDouble(from.lower), by, limit, visit); });
            const auto onSweep = visited([&](auto visit) { broadphase.sweep(from, by, limit, visit); });
            ASSERT_EQ(onRay, atPoint) << nameOf(kEveryKind[k]) << " case " << i;
            ASSERT_EQ(onSweep, atBox) << nameOf(kEveryKind[k]) << " case " << i;
            int visits = 0;
            broadphase.sweep(from, by, limit, [&visits](ProxyId, Real) { return ++visits, Real(-1); });
            ASSERT_EQ(visits, atBox.empty() ? 0 : 1) << nameOf(kEveryKind[k]) << " case " << i << ": less than 0 stops";
        }
        found += atBox.size();
    }
    EXPECT_GT(found, 100U);
}

INSTANTIATE_TEST_SUITE_P(AllFamilies, Queries, testing::ValuesIn(kFamilies),
                         [](const testing::TestParamInfo<Family>& family) { return nameOf(family.param); });

TEST(Queries, OfAnEmptyWorldFindNothing) {
    for (const BroadphaseKind kind : kEveryKind) {
        const auto broadphase = makeBroadphase(kind);
        int visits = 0;
        const auto visit = [&visits](ProxyId, Real) { return Real(++visits); };
        broadphase->query({{-1, -1}, {1, 1}}, [&visits](ProxyId) { return ++visits > 0; });
        broadphase->ray({0, 0}, {1, 1}, 1, visit);
        broadphase->sweep({{0, 0}, {1, 1}}, {1, 1}, 1, visit);
        EXPECT_EQ(visits, 0);
        EXPECT_EQ(broadphase->counters().boxTests, 0U);
    }
}

/// Likewise once all that there was is gone, when the structure was fitted to so many, or not yet; what comes then is
/// found.
TEST(Queries, OfAClearedWorldFindNothing) {
    for (const BroadphaseKind kind : kEveryKind) {
        for (const int count : {1, 15, 16, 17, 40, 500}) {
            for (const bool isFitted : {false, true}) {
                SCOPED_TRACE(testing::Message() << nameOf(kind) << ", " << count << (isFitted ? ", fitted" : ""));
                const auto broadphase = makeBroadphase(kind);
                std::vector<ProxyPair> pairs;
                std::vector<ProxyId> ids;
                for (int i = 0; i < count; ++i) {
                    ids.push_back(broadphase->insert(boxAround(3 * i, 0, 0.5, 0.5), ProxyKind::dynamic).value());
                }
                broadphase->pairs(pairs);
                // What moved keeps the next call from being about nothing.
                ASSERT_TRUE(broadphase->move(ids[0], boxAround(0.5, 0, 0.5, 0.5)).ok());
                for (const ProxyId id : ids) { ASSERT_TRUE(broadphase->remove(id).ok()); }
                if (isFitted) { broadphase->pairs(pairs); }
                int visits = 0;
                const auto visit = [&visits](ProxyId, Real limit) { return ++visits, limit; };
                broadphase->query({{-9, -9}, {2000, 9}}, [&visits](ProxyId) { return ++visits > 0; });
                broadphase->ray({-5, 0}, {2000, 0}, 1, visit);
                broadphase->sweep({{-5, 0}, {-4, 1}}, {2000, 1}, 1, visit);
                ASSERT_EQ(visits, 0);
                ASSERT_TRUE(broadphase->insert(boxAround(1e5, 0, 0.5, 0.5), ProxyKind::dynamic).ok());
                broadphase->ray({-5, 0}, {2e5, 0}, 1, visit);
                ASSERT_EQ(visits, 1);
            }
        }
    }
}

TEST(Queries, StopWhenTheVisitorReturnsZero) {
    for (const BroadphaseKind kind : kEveryKind) {
        const auto broadphase = makeBroadphase(kind);
        for (int i = 0; i < 20; ++i) {
            ASSERT_TRUE(broadphase->insert(boxAround(i, 0, 0.4, 0.4), static_cast<ProxyKind>(i % 4)).ok());
        }
        int visits = 0;
        broadphase->ray({-5, 0}, {50, 0}, 1, [&](ProxyId, Real) {
            ++visits;
            return Real(0);
        });
        EXPECT_EQ(visits, 1);
    }
}

}  // namespace
}  // namespace swept::test

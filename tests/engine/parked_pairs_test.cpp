#include <gtest/gtest.h>
#include <swept/engine/state/parked_pairs.h>

#include <algorithm>
#include <map>
#include <vector>

#include "../support/random.h"

/// What is asleep, by shape: against a map of all of it.

namespace swept::test {
namespace {

struct Slot {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

std::vector<std::uint32_t> placesOf(const ParkedPairs<ContactPair>& parked, std::uint32_t proxy) {
    std::vector<std::uint32_t> places;
    parked.visitOf(static_cast<ProxyId>(proxy), [&places](std::uint32_t place) { places.push_back(place); });
    std::sort(places.begin(), places.end());
    return places;
}

TEST(ParkedPairs, AreFoundByEitherShapeUntilTheyGo) {
    constexpr int kProxies = 12;
    Random random(7);
    ParkedPairs<ContactPair> parked;
    std::map<std::uint32_t, Slot> wanted;  // by place
    std::size_t most = 0;
    for (int round = 0; round < 4'000; ++round) {
        // More and more, then fewer and fewer.
        if (wanted.empty() || random.chance(round / 400 % 2 == 0 ? 0.7 : 0.3)) {
            const auto a = static_cast<std::uint32_t>(random.integer(0, kProxies - 1));
            const auto b = (a + static_cast<std::uint32_t>(random.integer(1, kProxies - 1))) % kProxies;
            // All of one body against all of another: lists are those of shapes.
            parked.add({.bodyA = 0, .bodyB = 1, .proxyA = static_cast<ProxyId>(a), .proxyB = static_cast<ProxyId>(b)});
            // The one place that was free before.
            std::uint32_t place = 0;
            while (isGap(parked[place]) || wanted.contains(place)) { ++place; }
            wanted[place] = {a, b};
        } else {
            auto gone = wanted.begin();
            std::advance(gone, random.integer(0, static_cast<int>(wanted.size()) - 1));
            parked.erase(gone->first);
            wanted.erase(gone);
        }
        most = std::max(most, wanted.size());
        ASSERT_EQ(parked.size(), wanted.size()) << "round " << round;
        ASSERT_LE(parked.all().size(), most) << "round " << round;
        const auto proxy = static_cast<std::uint32_t>(random.integer(0, kProxies));  // one more than ever had any
        std::vector<std::uint32_t> places;
        for (const auto& [place, pair] : wanted) {
            if (pair.a == proxy || pair.b == proxy) { places.push_back(place); }
            ASSERT_EQ(static_cast<std::uint32_t>(parked[place].proxyA), pair.a) << "round " << round;
        }
        ASSERT_EQ(placesOf(parked, proxy), places) << "round " << round;
    }
    EXPECT_GT(most, 100U);
}

}  // namespace
}  // namespace swept::test

#include <gtest/gtest.h>

#include <vector>

#include <swept/solver/direct/tie_weights.h>

/// How hard it is to turn what joints tie together.

namespace swept::test {
namespace {

TEST(TieWeights, OfARowWhoseLinksAreInAnyOrder) {
    constexpr std::uint32_t kCount = 9;
    std::vector<TieWeights::Member> members;
    std::vector<TieWeights::Link> links;
    for (std::uint32_t i = 0; i < kCount; ++i) { members.push_back({.mass = 2, .inertia = 0.5}); }
    for (const std::uint32_t i : {5U, 0U, 7U, 2U, 3U, 1U, 6U, 4U}) {
        if (i % 2 == 0) {
            links.push_back({.a = i, .b = i + 1, .offset = {3, 4}});
        } else {
            links.push_back({.a = i + 1, .b = i, .offset = {-3, -4}});
        }
    }
    TieWeights weights;
    weights.find(members, links);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        double wanted = 0;
        for (std::uint32_t k = 0; k < kCount; ++k) {
            const double away = 5 * (static_cast<double>(i) - static_cast<double>(k));
            wanted += 0.5 + 2 * away * away;
        }
        EXPECT_NEAR(weights.inertiaAbout(i), wanted, 1e-12 * wanted) << i;
    }
}

TEST(TieWeights, OfEachTieOnItsOwn) {
    const std::vector<TieWeights::Member> members{{1, 1}, {3, 2}, {5, 7}, {0, 0}, {2, 4}};
    TieWeights weights;
    for (int again = 0; again < 2; ++again) {
        weights.find(members, std::vector<TieWeights::Link>{{.a = 4, .b = 1, .offset = {0, 2}},
                                                            {.a = 3, .b = 0, .offset = {1, 0}}});
        EXPECT_EQ(weights.inertiaAbout(0), 1) << "what cannot be moved weighs nothing";
        EXPECT_EQ(weights.inertiaAbout(3), 2) << "about the one that cannot be moved";
        EXPECT_EQ(weights.inertiaAbout(2), 7) << "that nothing ties";
        EXPECT_EQ(weights.inertiaAbout(1), 2 + 4 + 2 * 4);
        EXPECT_EQ(weights.inertiaAbout(4), 2 + 4 + 3 * 4);
    }
}

TEST(TieWeights, OfALoop) {
    const std::vector<TieWeights::Member> members{{1, 0}, {1, 0}, {1, 0}, {1, 0}};
    TieWeights weights;
    weights.find(members, std::vector<TieWeights::Link>{{.a = 0, .b = 1, .offset = {1, 0}},
                                                        {.a = 1, .b = 2, .offset = {0, 1}},
                                                        {.a = 2, .b = 3, .offset = {-1, 0}},
                                                        {.a = 3, .b = 0, .offset = {0, -1}}});
    for (std::uint32_t i = 0; i < 4; ++i) { EXPECT_EQ(weights.inertiaAbout(i), 1 + 2 + 1); }
}

}  // namespace
}  // namespace swept::test

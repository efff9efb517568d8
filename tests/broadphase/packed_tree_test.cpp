#include <gtest/gtest.h>

#include <swept/broadphase/wide_kernels.h>

#include <numeric>

#include "model.h"

/// Wide trees that are packed of boxes at once, and then changed one by one.

namespace swept::test {
namespace {

struct Packed {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> places;
    WideTree tree;

    void pack(Family family, Random& random, std::size_t count) {
        boxes.resize(count);
        for (Aabb& box : boxes) { box = randomBox(family, random); }
        tree.pack(boxes);
        places.resize(count);
        std::iota(places.begin(), places.end(), 0U);
    }
    void change(Family family, Random& random) {
        if (random.integer(0, 1) == 0 && !boxes.empty()) {
            const std::size_t slot = below(random, static_cast<std::uint32_t>(boxes.size()));
            boxes[slot] = randomBox(family, random);
            tree.move(places[slot], boxes[slot]);
            return;
        }
        boxes.push_back(randomBox(family, random));
        places.push_back(0);
        tree.insert(static_cast<std::uint32_t>(boxes.size() - 1), boxes.back(), places);
    }
    void expectFound(Family family, Random& random) const {
        std::vector<Aabb> asked(kWide);
        for (Aabb& box : asked) { box = randomBox(family, random); }
        for (const WideKernels* kernels : {&scalarKernels(), &widestKernels()}) {
            std::vector<std::set<std::size_t>> found(kWide);
            kernels->queries(tree, WideBoxes::of(asked), [&](std::uint32_t lane, ProxyId id) {
                EXPECT_TRUE(found[lane].insert(static_cast<std::size_t>(id)).second);
            });
            for (std::size_t lane = 0; lane < kWide; ++lane) {
                for (std::size_t i = 0; i < boxes.size(); ++i) {
                    ASSERT_EQ(found[lane].count(i) == 1, overlaps(boxes[i], asked[lane]))
                        << kernels->name << ", box " << i << " of " << boxes.size();
                }
            }
        }
    }
};

class PackedTree : public testing::TestWithParam<Family> {};

TEST_P(PackedTree, IsWhatItWasPackedOfWithAllChangesSince) {
    Random random(500 + static_cast<std::uint64_t>(GetParam()));
    Packed packed;
    for (const std::size_t count :
         {0U, 1U, 7U, 8U, 9U, 64U, 65U, 200U, 3U}) {  // one after the other: nothing is left of before
        packed.pack(GetParam(), random, count);
        for (int i = 0; i < 30; ++i) {
            ASSERT_NO_FATAL_FAILURE(packed.expectFound(GetParam(), random)) << "change " << i << " of " << count;
            packed.change(GetParam(), random);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllFamilies, PackedTree, testing::ValuesIn(kFamilies),
                         [](const auto& given) { return nameOf(given.param); });

}  // namespace
}  // namespace swept::test

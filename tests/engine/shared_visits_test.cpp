#include <thread>
#include <utility>

#include "filtered_crowd.h"

/// What touches a body or a sensor is asked by several threads at once: each is told what one alone is.

namespace swept::test {
namespace {

using Touches = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // slots of shapes

Touches touchesOf(const World& world, std::span<const BodyId> bodies) {
    Touches touches;
    for (const BodyId body : bodies) {
        world.visitContacts(body, [&](const ContactView& view) {
            touches.push_back({view.shapeA.index, view.shapeB.index});
        });
        world.visitShapes(body, [&](ShapeId shape) {
            world.visitOverlaps(shape, [&](ShapeId other) { touches.push_back({shape.index, other.index}); });
        });
    }
    return touches;
}

TEST(SharedVisits, TellEachThreadAll) {
    constexpr std::size_t kThreads = 4;
    const SameKind filter;
    FilteredCrowd crowd(1, filter);
    run(crowd.world, 60);
    for (int i = 0; i < 40; ++i) {
        run(crowd.world, 1);
        const World asked = crowd.world;
        const Touches wanted = touchesOf(crowd.world, crowd.bodies);
        ASSERT_GT(wanted.size(), 50U);
        std::array<Touches, kThreads> told;
        std::array<std::uint64_t, kThreads> copies{};
        {
            std::vector<std::jthread> threads;
            for (std::size_t k = 0; k < kThreads; ++k) {
                threads.emplace_back([&, k] {
                    told[k] = touchesOf(asked, crowd.bodies);
                    copies[k] = World(asked).stateHash();
                });
            }
        }
        for (std::size_t k = 0; k < kThreads; ++k) {
            ASSERT_EQ(told[k], wanted) << "step " << i;
            ASSERT_EQ(copies[k], asked.stateHash());
        }
    }
}

}  // namespace
}  // namespace swept::test

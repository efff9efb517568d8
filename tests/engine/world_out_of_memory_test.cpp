#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <vector>

#include "world_support.h"

/// When memory runs out while something is made, nothing was made, and the world goes on as if nobody had tried.

namespace {
std::optional<int> allocationsLeft;  // none: as many as are asked for

void* given(std::size_t size, std::size_t alignment) {
    if (allocationsLeft && (*allocationsLeft)-- == 0) {
        allocationsLeft.reset();
        throw std::bad_alloc();
    }
    const std::size_t rounded = (size / alignment + 1) * alignment;
    if (void* const memory = std::aligned_alloc(alignment, rounded)) { return memory; }
    throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return given(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return given(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) { return given(size, std::size_t(alignment)); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return given(size, std::size_t(alignment)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace swept::test {
namespace {

int contactPointsOf(World& world, BodyId body) {
    int count = 0;
    world.visitContacts(body, [&count](const ContactView&) { ++count; });
    return count;
}

/// Boxes that slide on a floor, so many that the next one needs room, and some that sleep. Contacts were asked for so
/// often that whoever asks next lists those of what slides.
struct Floor {
    World world = makeWorld(WorldSettings{.gravity = vec(0, -kGravity)});
    BodyId ground = addStatic(world, must(makeBox(vec(100, 1), vec(0, -1))));
    std::vector<BodyId> boxes;

    Floor() {
        for (int i = 0; i < 63; ++i) {
            boxes.push_back(addBody(world, dynamicAt({1.5 * i - 40, 0.5}, vec(1, 0)), box(0.5, 0.5)));
        }
        run(world, 3);
        for (std::size_t i = 0; i < 10; ++i) { must(world.setAwake(boxes[i], false)); }
        for (const std::size_t i : {20U, 30U}) { EXPECT_EQ(contactPointsOf(world, boxes[i]), 2); }
    }
};

using Call = void (*)(World&, const Floor&);

void makeBody(World& world, const Floor&) {
    BodyDef def = dynamicAt({0, 5});
    def.mass = 1;
    must(world.createBody(def));
}
void addToGround(World& world, const Floor& floor) {
    must(world.addShape(floor.ground, must(makeBox(vec(1, 1), vec(0, 20)))));
}
void addToBox(World& world, const Floor& floor) {
    must(world.addShape(floor.boxes[3], must(makeBox(vec(0.2, 0.2), vec(0, 0.7)))));
}
void addChainToGround(World& world, const Floor& floor) {
    std::vector<Vec2> points;
    for (int i = 0; i < 70; ++i) { points.push_back(vec(70 - 2 * i, 30)); }
    must(world.addChain(floor.ground, points, false));
}
void joinBoxes(World& world, const Floor& floor) {
    must(world.createJoint(RevoluteJointDef{.base = {.bodyA = floor.boxes[2], .bodyB = floor.boxes[20]}}));
}
void joinToGround(World& world, const Floor& floor) {
    must(world.createJoint(WeldJointDef{.base = {.bodyA = floor.ground, .bodyB = floor.boxes[5]}}));
}

std::uint32_t countOfShapes(const World& world) {
    std::uint32_t count = 0;
    world.visitBodies([&](BodyId body) { world.visitShapes(body, [&count](ShapeId) { ++count; }); });
    return count;
}

/// @return false where the call asked for less memory
bool failsAt(int allocation, const Call& call, World& world, const Floor& floor) {
    allocationsLeft = allocation;
    try {
        call(world, floor);
    } catch (const std::bad_alloc&) { return true; }
    allocationsLeft.reset();
    return false;
}

/// @param isCopy  of a copy, no array of which has any room left
void expectNothingWasMade(const Call& call, bool isCopy) {
    const Floor floor;
    std::uint64_t wanted = 0;
    {
        World world = floor.world;
        call(world, floor);
        run(world, 60);
        wanted = world.stateHash();
    }
    int failures = 0;
    for (;; ++failures) {
        SCOPED_TRACE(testing::Message() << "allocation " << failures);
        Floor other;
        World world = isCopy ? World(floor.world) : std::move(other.world);
        const std::uint64_t before = world.stateHash();
        const std::uint32_t shapes = countOfShapes(world);
        const std::uint32_t joints = world.jointCount();
        if (!failsAt(failures, call, world, floor)) { break; }
        ASSERT_EQ(world.stateHash(), before);
        ASSERT_EQ(countOfShapes(world), shapes);
        ASSERT_EQ(world.jointCount(), joints);
        std::uint32_t found = 0;
        world.queryBox({{-1000, -1000}, {1000, 1000}}, {}, [&found](ShapeId) { return ++found > 0; });
        ASSERT_EQ(found, shapes);
        for (const BodyId box : floor.boxes) { ASSERT_EQ(contactPointsOf(world, box), 2); }
        call(world, floor);
        run(world, 60);
        ASSERT_EQ(world.stateHash(), wanted);
    }
    EXPECT_GT(failures, 0) << "asks for no memory";
    ASSERT_LT(failures, 1000);
}

class OutOfMemory : public testing::TestWithParam<Call> {};

TEST_P(OutOfMemory, NothingIsMadeAndTheWorldGoesOn) { expectNothingWasMade(GetParam(), false); }
TEST_P(OutOfMemory, NothingIsMadeInACopyEither) { expectNothingWasMade(GetParam(), true); }

INSTANTIATE_TEST_SUITE_P(Calls, OutOfMemory,
                         testing::Values(&makeBody, &addToGround, &addToBox, &addChainToGround, &joinBoxes,
                                         &joinToGround));

TEST(OutOfMemory, NothingIsLoaded) {
    Floor floor;
    const std::vector<std::uint8_t> saved = floor.world.save();
    run(floor.world, 5);
    const std::vector<std::uint8_t> before = floor.world.save();
    int failures = 0;
    for (;; ++failures) {
        allocationsLeft = failures;
        try {
            must(floor.world.load(saved));
            break;
        } catch (const std::bad_alloc&) { ASSERT_TRUE(floor.world.save() == before) << "allocation " << failures; }
    }
    allocationsLeft.reset();
    EXPECT_GT(failures, 100);
    EXPECT_TRUE(floor.world.save() == saved);
}

}  // namespace
}  // namespace swept::test

#include <atomic>
#include <cstdlib>
#include <new>

#include "../support/random.h"
#include "world_support.h"

/// A step of a warm world asks for no memory.

namespace {
std::atomic<std::uint64_t> allocations = 0;

void* counted(std::size_t size) {
    ++allocations;
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) { return memory; }
    throw std::bad_alloc();
}
}  // namespace

// The whole test program counts its allocations; the aligned forms keep their default and are not used here.
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace swept::test {
namespace {

void addRoom(World& world) {
    const BodyId room = must(world.createBody({}));
    std::vector<Vec2> points{vec(12, 12)};
    for (int i = 0; i <= 40; ++i) { points.push_back(vec(12 - 0.6 * i, i % 2 == 0 ? 0.0 : 0.2)); }
    points.push_back(vec(-12, 12));
    must(world.addChain(room, points, false, material(0.5, 0.3)));
}

void addPile(World& world) {
    for (int row = 0; row < 5; ++row) {
        for (int i = 0; i < 6; ++i) { addBody(world, dynamicAt({-8 + 1.05 * i, 1 + 1.05 * row}), box(0.5, 0.5)); }
    }
}

std::vector<BodyId> addFlyers(World& world) {
    Random random(9);
    std::vector<BodyId> flyers;
    for (int i = 0; i < 12; ++i) {
        BodyDef def = dynamicAt({random.range(0, 10), random.range(5, 10)},
                                vec(random.range(-60, 60), random.range(-60, 60)), random.range(-30, 30));
        flyers.push_back(addBody(world, def, i % 2 == 0 ? circle(0.1) : box(0.2, 0.05), material(0.1, 1)));
    }
    return flyers;
}

/// It swings to and fro: let go level it would crack like a whip, and find a new busiest step now and then.
void addRope(World& world) {
    const DVec2 top{0, 11};
    const double angle = 0.3 - kPi / 2;
    const DVec2 along{std::cos(angle), std::sin(angle)};
    BodyId previous = must(world.createBody(bodyAt(BodyType::fixed, top)));
    for (int i = 0; i < 10; ++i) {
        BodyDef body = dynamicAt(top + (0.25 + 0.5 * i) * along);
        body.angle = angle;
        const BodyId link = addBody(world, body, capsule(0.2, 0.05));
        RevoluteJointDef def{.base = {.bodyA = previous, .bodyB = link}, .anchor = top + 0.5 * i * along};
        must(world.createJoint(def));
        previous = link;
    }
}

/// @return allocations of the last 100 of `steps` steps; `act` is called before each of them all.
template <class Act>
std::uint64_t allocationsWarm(World& world, int warm, Act act) {
    for (int i = 0; i < warm; ++i) {
        act(i);
        must(world.step(kStep));
    }
    const std::uint64_t before = allocations;
    for (int i = warm; i < warm + 100; ++i) {
        act(i);
        (void)world.step(kStep);
    }
    return allocations - before;
}

const auto kNothing = [](int) {};

TEST(WorldAllocation, PileRopeAndTerrain) {
    World world = makeWorld();
    const std::uint64_t cold = allocations;
    addRoom(world);
    addPile(world);
    addRope(world);
    EXPECT_GT(allocations, cold) << "the counter works";
    EXPECT_EQ(allocationsWarm(world, 600, kNothing), 0u);
}

/// The same flight every 100 steps: a chaotic one would find a new busiest step now and then. What the boxes of pairs
/// keep from the flight before makes some steps busier in the first few.
std::uint64_t allocationsOfFlyers(World& world, const std::vector<BodyId>& flyers) {
    std::vector<BodyDef> starts;
    for (const BodyId id : flyers) {
        starts.push_back(dynamicAt(world.position(id), world.velocity(id), spinOf(world, id)));
    }
    const auto restart = [&](int step) {
        for (std::size_t i = 0; i < flyers.size() && step % 100 == 0; ++i) {
            must(world.setPose(flyers[i], starts[i].position, 0));
            must(world.setVelocity(flyers[i], starts[i].velocity, starts[i].angularVelocity));
        }
    };
    return allocationsWarm(world, 600, restart);
}

World flyersRoom() {
    World world = makeWorld(0.0);
    addRoom(world);
    addStatic(world, box(12, 0.1), material(0, 1), {0, 12.1});
    return world;
}

TEST(WorldAllocation, Flyers) {
    World world = flyersRoom();
    const std::vector<BodyId> flyers = addFlyers(world);
    EXPECT_EQ(allocationsOfFlyers(world, flyers), 0u);
    EXPECT_GT(world.counters().sweeps, 0u);
}

TEST(WorldAllocation, FlyersWithSensors) {
    World world = flyersRoom();
    const std::vector<BodyId> flyers = addFlyers(world);
    ShapeDef sensor = material(0);
    sensor.sensor = true;
    for (const BodyId id : flyers) { must(world.addShape(id, circle(0.6), sensor)); }
    EXPECT_EQ(allocationsOfFlyers(world, flyers), 0u);
}

TEST(WorldAllocation, FallingAsleepAndWakingUp) {
    World world;
    addRoom(world);
    addPile(world);
    const BodyId kicker = addBody(world, dynamicAt({-5, 7}), circle(0.4));
    std::uint64_t woken = 0;
    std::uint64_t slept = 0;
    const auto kick = [&](int step) {
        if (step % 300 == 0) { must(world.applyImpulse(kicker, vec(0, 0.2), world.position(kicker))); }
        woken += world.counters().wokeUp;
        slept += world.counters().fellAsleep;
    };
    EXPECT_EQ(allocationsWarm(world, 1'500, kick), 0u);
    EXPECT_GT(woken, 0u);
    EXPECT_GT(slept, 0u);
}

/// As much of a body of a thousand shapes as of one of ten, as long as none is added.
TEST(WorldAllocation, AnotherDensityIsWeighedWithoutAny) {
    const auto allocationsOf = [](int count) {
        World world = makeWorld();
        const BodyId ship = must(world.createBody(dynamicAt({0, 0})));
        std::vector<ShapeId> shapes;
        for (int i = 0; i < count; ++i) {
            shapes.push_back(must(world.addShape(ship, must(makeBox(vec(0.5, 0.5), vec(i, 0))))));
        }
        const std::uint64_t before = allocations;
        must(world.redefine(shapes[3], material(0.5, 0, 2)));
        return allocations - before;
    };
    EXPECT_EQ(allocationsOf(10), allocationsOf(1000));
}

}  // namespace
}  // namespace swept::test

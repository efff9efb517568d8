#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include <vector>

#include "edit_rounds.h"

namespace swept::bench {
namespace {

b2PolygonShape boxAt(float halfX, float halfY, b2Vec2 center) {
    b2PolygonShape shape;
    shape.SetAsBox(halfX, halfY, center, 0);
    return shape;
}

b2Body* addBox(b2World& world, int place) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = {1.02F * static_cast<float>(place % kEditWide),
                    0.5F + 1.02F * static_cast<float>(place / kEditWide)};
    b2Body* const body = world.CreateBody(&def);
    const b2PolygonShape shape = boxAt(0.5F, 0.5F, {0, 0});
    body->CreateFixture(&shape, 1);
    return body;
}

void destroyBodies(benchmark::State& state) {
    b2World world({0, -10});
    const b2BodyDef fixed;
    const b2PolygonShape floor = boxAt(1000, 1, {0, -1});
    world.CreateBody(&fixed)->CreateFixture(&floor, 0);
    const int count = static_cast<int>(state.range(0));
    std::vector<b2Body*> pile;
    for (int i = 0; i < count; ++i) { pile.push_back(addBox(world, i)); }
    const auto bodyAt = [&pile](int place) -> auto& { return pile[static_cast<std::size_t>(place)]; };
    measureDestruction(
        state, count, [&] { world.Step(static_cast<float>(kFlightStep), 8, 3); },
        [&](int place) { world.DestroyBody(bodyAt(place)); }, [&](int place) { bodyAt(place) = addBox(world, place); });
}

b2Fixture* addTile(b2Body& level, int place) {
    const b2PolygonShape shape =
        boxAt(0.5F, 0.5F, {static_cast<float>(place % kEditWide), static_cast<float>(place / kEditWide)});
    return level.CreateFixture(&shape, 0);
}

void replaceTiles(benchmark::State& state) {
    b2World world({0, -10});
    const b2BodyDef fixed;
    b2Body& level = *world.CreateBody(&fixed);
    const int count = static_cast<int>(state.range(0));
    std::vector<b2Fixture*> tiles;
    for (int i = 0; i < count; ++i) { tiles.push_back(addTile(level, i)); }
    int next = 0;
    for ([[maybe_unused]] auto _ : state) {
        const int place = editedOf(next++, count);
        level.DestroyFixture(tiles[static_cast<std::size_t>(place)]);
        tiles[static_cast<std::size_t>(place)] = addTile(level, place);
    }
}

}  // namespace

void registerEditBox2d() {
    benchmark::RegisterBenchmark("edit/destroy/box2d_2.4.1", destroyBodies)
        ->Arg(1000)
        ->Arg(10000)
        ->Iterations(kEditRounds)
        ->UseManualTime();
    benchmark::RegisterBenchmark("edit/tile/box2d_2.4.1", replaceTiles)->Arg(1000)->Arg(10000);
}

}  // namespace swept::bench

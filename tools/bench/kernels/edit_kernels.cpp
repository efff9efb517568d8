#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include <swept/engine/world.h>

#include "edit_rounds.h"
#include "kernel_precision.h"

/// What it costs to destroy bodies of a pile, and tiles of a level, between steps. Compiled once per precision;
/// box2d_edits.cpp is the same there.

namespace swept::bench {
namespace {

BodyId addBox(World& world, int place) {
    const DVec2 position{1.02 * (place % kEditWide), 0.5 + 1.02 * (place / kEditWide)};
    const BodyId id = world.createBody({.type = BodyType::dynamic, .position = position}).value();
    (void)world.addShape(id, makeBox({Real(0.5), Real(0.5)}).value());
    return id;
}

void destroyBodies(benchmark::State& state) {
    World world;
    const BodyId ground = world.createBody({}).value();
    (void)world.addShape(ground, makeBox({1000, 1}, {0, -1}).value());
    const int count = static_cast<int>(state.range(0));
    std::vector<BodyId> pile;
    for (int i = 0; i < count; ++i) { pile.push_back(addBox(world, i)); }
    const auto bodyAt = [&pile](int place) -> auto& { return pile[static_cast<std::size_t>(place)]; };
    measureDestruction(
        state, count, [&] { (void)world.step(kFlightStep); },
        [&](int place) { (void)world.destroyBody(bodyAt(place)); },
        [&](int place) { bodyAt(place) = addBox(world, place); });
}

ShapeId addTile(World& world, BodyId level, int place) {
    const Vec2 center{static_cast<Real>(place % kEditWide), static_cast<Real>(place / kEditWide)};
    return world.addShape(level, makeBox({Real(0.5), Real(0.5)}, center).value()).value();
}

/// Taken away and put back, no step in between.
void replaceTiles(benchmark::State& state) {
    World world;
    const BodyId level = world.createBody({}).value();
    const int count = static_cast<int>(state.range(0));
    std::vector<ShapeId> tiles;
    for (int i = 0; i < count; ++i) { tiles.push_back(addTile(world, level, i)); }
    int next = 0;
    for ([[maybe_unused]] auto _ : state) {
        const int place = editedOf(next++, count);
        (void)world.destroyShape(tiles[static_cast<std::size_t>(place)]);
        tiles[static_cast<std::size_t>(place)] = addTile(world, level, place);
    }
}

void registerAllEditKernels() {
    const std::string precision = kPrecision;
    benchmark::RegisterBenchmark(("edit/destroy/" + precision).c_str(), destroyBodies)
        ->Arg(1000)
        ->Arg(10000)
        ->Iterations(kEditRounds)
        ->UseManualTime();
    benchmark::RegisterBenchmark(("edit/tile/" + precision).c_str(), replaceTiles)->Arg(1000)->Arg(10000);
}

}  // namespace

#if defined(SWEPT_F64)
void registerEditKernelsF64() { registerAllEditKernels(); }
#else
void registerEditKernelsF32() { registerAllEditKernels(); }
#endif

}  // namespace swept::bench
